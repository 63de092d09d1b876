"""form="arcs": lines and arcs alone, within the tolerance of the data by the outside checker."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
from tests.support.promise import checked

import shapespline as ss
from shapespline.errors import InvalidInputError
from shapespline.geometry import turn_between, two_sided_distance
from shapespline.values import CORNER_TURN


def around(centre, radius, begin, end, n):
    angle = np.linspace(begin, end, n, endpoint=False)
    return np.column_stack([np.cos(angle), np.sin(angle)]) * radius + centre


def slot(n=60):
    """Two lines and two half circles, tangent."""
    side = np.linspace(0, 4, n, endpoint=False)
    return np.concatenate(
        [
            np.column_stack([side, -np.ones(n)]),
            around((4, 0), 1, -pi / 2, pi / 2, n),
            np.column_stack([4 - side, np.ones(n)]),
            around((0, 0), 1, pi / 2, 3 * pi / 2, n),
        ]
    )


def kinds(fit):
    return {piece.kind for piece in fit.pieces}


def exact_distance(fit, points):
    """Of points to the lines and arcs themselves."""
    away = []
    for piece in fit.pieces:
        if piece.arc is not None:
            away.append(piece.arc.distances(points))
            continue
        (a, b) = piece.control_points
        share = np.clip((points - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
        away.append(np.hypot(*(points - a - share[:, None] * (b - a)).T))
    return np.min(away, axis=0)


def test_a_slot_is_lines_and_tangent_arcs():
    options = {"closed": True, "tolerance": 0.005, "character": "fewest"}
    fit = checked(ss.fit_curve(slot(), form="arcs", **options), 0.005)
    assert kinds(fit) == {"line", "arc"}
    assert sum(piece.kind == "line" for piece in fit.pieces) == 2
    # Fewer than the biarcs of a curve that was fitted for itself.
    curve = ss.fit_curve(slot(), **options)
    assert len(fit.pieces) < ss.geometry.arc_polyline(curve.spline, 0.005 / 4).n_segments
    for before, after in zip(fit.pieces, [*fit.pieces[1:], fit.pieces[0]], strict=True):
        assert (before.control_points[-1] == after.control_points[0]).all()
        assert abs(turn_between(before, after)) < CORNER_TURN
    assert exact_distance(fit, slot()).max() <= fit.max_distance <= 0.005
    assert max(piece.twin_error for piece in fit.pieces) <= 0.01 * 0.005 * (1 + 1e-9)


def test_circles_are_one_arc():
    ring = around((5, 2), 3.0, 0.3, 0.3 + 2 * pi, 90)
    fit = checked(ss.fit_curve(ring, closed=True, tolerance=0.01, form="arcs"), 0.01)
    assert (len(fit.pieces), fit.n_stored_points) == (1, 2)
    assert fit.pieces[0].arc.is_circle
    # Points on a circle: least squares find it to rounding.
    assert fit.pieces[0].arc.radius == pytest.approx(3.0, rel=1e-12)
    back = ss.fit_curve(ring[::-1], closed=True, tolerance=0.01, form="arcs")
    assert back.pieces[0].arc.sweep == -2 * pi
    open_one = ss.fit_curve(ring[:50], closed=False, tolerance=0.01, form="arcs")
    assert len(checked(open_one, 0.01).pieces) == 1
    ends = ss.fit_curve(ring[:50], closed=False, tolerance=0.01, form="arcs", ends="fixed")
    assert (checked(ends, 0.01).spline([0.0, 1.0]) == ring[[0, 49]]).all()


def test_a_square_is_no_circle():
    square = ss.Contour([(0, 0), (4, 0), (4, 4), (0, 4)], closed=True).resampled(80)
    # A circle lies within 0.42 of it.
    fit = checked(ss.fit_curve(square, tolerance=0.5, form="arcs"), 0.5)
    assert (kinds(fit), len(fit.corners)) == ({"line"}, 4)
    few = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], dtype=float)
    for angle in (0.0, 0.3, 0.7, 1.1):
        turned = few @ [[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]]
        for tolerance in (0.05, 0.1, 0.25):
            fit = checked(
                ss.fit_curve(turned, closed=True, tolerance=tolerance, form="arcs"), tolerance
            )
            assert (kinds(fit), len(fit.pieces)) == ({"line"}, 4)
        # Within 0.3 there are curves of fewer points. A circle would be within 0.11, but four
        # points tell of none.
        fit = checked(ss.fit_curve(turned, closed=True, tolerance=0.3, form="arcs"), 0.3)
        assert not any(piece.arc is not None and piece.arc.is_circle for piece in fit.pieces)


def test_a_shared_border_is_the_same_arcs_and_its_bound_counts_their_twins():
    bow = around((3, 0), 1.0, -pi / 2, pi / 2, 40)
    left = ss.Contour(np.concatenate([[(0, -1)], bow, [(0, 1)]]), closed=True)
    right = ss.Contour(np.concatenate([[(6, 1)], bow[::-1], [(6, -1)]]), closed=True)
    shape = ss.Shape([left, right])
    one, two = ss.fit_shape(shape, tolerance=0.01, form="arcs", shared_boundaries=True)
    for fit in (one, two):
        found = two_sided_distance(fit.spline, fit.contour)
        twin = max(piece.twin_error for piece in fit.pieces)
        assert 0 < twin <= 0.01 * 0.01
        assert fit.hausdorff_distance == pytest.approx(found.hausdorff_distance + twin, rel=1e-12)
        assert fit.kept
    mine, theirs = ([piece.arc for piece in fit.pieces if piece.arc] for fit in (one, two))
    assert len(mine) >= 1
    assert {arc.radius for arc in mine} == {arc.radius for arc in theirs}


def test_corners_ends_and_points_are_kept():
    x = np.linspace(0, 2, 80)
    arch = np.column_stack([x, np.abs(np.sin(2 * x)) * (1 + 0.3 * x)])
    fit = ss.fit_curve(arch, closed=False, tolerance=0.01, form="arcs", through=[0, 30, 79])
    assert kinds(checked(fit, 0.01)) <= {"line", "arc"}
    nodes = np.array([piece.control_points[0] for piece in fit.pieces])
    nodes = np.concatenate([nodes, fit.pieces[-1].control_points[-1:]])
    for index in (0, 30, 79):  # up to rounding
        assert np.abs(nodes - arch[index]).max(axis=1).min() < 1e-12
    assert len(fit.corners) == 1
    up = ss.fit_curve(
        arch[:40], closed=False, tolerance=0.01, form="arcs", end_tangents=[(1, 2), None]
    )
    first = up.pieces[0].control_points
    x, y = first[1] - first[0]
    assert abs(2 * x - y) < 1e-9


@pytest.mark.slow
def test_outlines_of_every_day(outline):
    for name, tolerance in (("hand620_closed", 0.3), ("loop500_open", 0.2), ("fa_gear_c0", 0.5)):
        fit = ss.fit_curve(outline(name), tolerance=tolerance, form="arcs")
        assert kinds(checked(fit, tolerance)) <= {"line", "arc"}
        assert exact_distance(fit, fit.contour.points).max() <= fit.max_distance


def test_what_does_not_go_with_arcs_is_said():
    for options, message in (
        ({}, "form='arcs' acts within a tolerance: give one"),
        ({"tolerance": 0.1, "degree": 2}, "degree must be 3 or more for form='arcs', got 2"),
        ({"tolerance": 0.1, "symmetric": True}, "symmetric acts with form='pieces' only"),
        ({"n_control_points": 8}, "form does not act with n_control_points"),
    ):
        with pytest.raises(InvalidInputError, match=message):
            ss.fit_curve(slot(), closed=True, form="arcs", **options)

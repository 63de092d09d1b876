"""Outlines beside each other: uncrossed, and with a boundary that is one."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from tests.support.engines import fit_pieces
from tests.support.maps import cells, wavy
from tests.support.places import IMAGES
from tests.support.shapes import on_circle

import shapespline as ss
from checks import crossings, polyline_of, self_crossings, two_sided
from shapespline.analysis.shared_boundaries import shared_arcs


def area(fit):
    """Enclosed by a curve, of its Beziers' control polygons exactly: by Green's formula."""
    u = np.linspace(0, 1, 200_001)
    x, y = fit.spline(u).T
    return 0.5 * float(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]))


def test_a_map_keeps_its_borders():
    shape, tolerance = ss.Shape(cells()), 0.05
    drawing = ss.fit_shape(shape, tolerance=tolerance, shared_boundaries=True)
    stored = {}
    for index, fit in enumerate(drawing):
        contour = shape.contours[index]
        found = two_sided(fit.curve, contour.points, closed=True, step=tolerance / 10)
        assert found.larger <= tolerance
        assert fit.kept
        if index < 4:
            for piece in fit.pieces:
                stored.setdefault(piece.control_points.tobytes(), set()).add(index)
                stored.setdefault(piece.control_points[::-1].tobytes(), set()).add(index)
    # Every inner border belongs to two cells, to the bit.
    shared = {frozenset(cells) for cells in stored.values() if len(cells) > 1}
    assert shared == {frozenset(pair) for pair in [(0, 1), (1, 2), (2, 3), (0, 3)]}
    # The island and the hole around it are one curve.
    ring, hole = drawing.fits[4].spline, drawing.fits[5].spline
    assert_array_equal(np.sort(ring.control_points, axis=0), np.sort(hole.control_points, axis=0))
    # No slivers: inner borders cancel, so the cells fill what their outer arcs enclose. A curve
    # within the tolerance of its data encloses as much, but for a strip along the data.
    total = sum(area(fit) for fit in drawing.fits[:4])
    data = sum(_polygon_area(contour.points) for contour in shape.contours[:4])
    outer = 4 * 20 * 1.1
    assert abs(total - data) <= tolerance * outer


def _polygon_area(points):
    x, y = points.T
    return 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1))


def test_outlines_apart_share_nothing():
    apart = [ss.Contour(on_circle(40, centre=(5 * k, 0)), closed=True) for k in range(3)]
    arcs = shared_arcs(apart, 1e-6)
    assert arcs.points == []
    plain, shared = (
        ss.fit_shape(ss.Shape(apart), tolerance=0.01, shared_boundaries=flag, character="fewest")
        for flag in (False, True)  # circles that share nothing are drawn
    )
    for a, b in zip(plain, shared, strict=True):
        assert_array_equal(a.control_points, b.control_points)


def test_open_lines_that_run_together():
    common = wavy((0, 0), (10, 0), 0.5, 4)
    first = ss.Contour(np.concatenate([[(-3.0, 2.0)], common, [(13.0, 2.0)]]), closed=False)
    second = ss.Contour(
        np.concatenate([[(13.0, -2.0)], common[::-1], [(-3.0, -2.0)]]), closed=False
    )
    drawing = ss.fit_shape(ss.Shape([first, second]), tolerance=0.05, shared_boundaries=True)
    pieces = [
        {p.control_points.tobytes() for p in fit.pieces}
        | {p.control_points[::-1].tobytes() for p in fit.pieces}
        for fit in drawing
    ]
    assert pieces[0] & pieces[1]
    assert all(fit.kept for fit in drawing)


def slotted(x, y):
    """A plate with a round hole and its filling, and a copy of the plate beside, all traced."""
    hole = on_circle(90, radius=4.0, centre=(x + 10, y + 8))
    plate = np.concatenate(
        [
            np.column_stack([x + np.arange(0, 20, 0.5), np.full(40, y)]),
            np.column_stack([np.full(32, x + 20.0), y + np.arange(0, 16, 0.5)]),
            np.column_stack([x + np.arange(20, 0, -0.5), np.full(40, y + 16.0)]),
            np.column_stack([np.full(32, float(x)), y + np.arange(16, 0, -0.5)]),
        ]
    )
    rings = (plate, hole[::-1], hole)
    return [ss.Contour(one, True, accuracy=0.02, level_line=one) for one in rings]


@pytest.mark.parametrize("tolerance", [None, 0.1])
def test_shared_boundaries_are_given_back_as_drawn(tolerance):
    contours = [*slotted(0, 0), *slotted(40.003, 2)]
    shape = ss.Shape(contours, [-1, 0, -1, -1, 3, -1])
    drawing = ss.fit_shape(shape, tolerance=tolerance, shared_boundaries=True)
    plain = ss.fit_shape(shape, tolerance=tolerance)
    assert [fit.n_stored_points for fit in drawing] == [fit.n_stored_points for fit in plain]
    circles = [drawing.fits[k].pieces[0].arc for k in (1, 2, 4, 5)]
    assert len({arc.radius for arc in circles}) == 1
    for hole, filling in ((1, 2), (4, 5)):
        assert_array_equal(*(drawing.fits[k].pieces[0].arc.centre for k in (hole, filling)))
    for k in (0, 3):
        lines = drawing.fits[k].pieces
        level = {i for one in drawing.fits[k].regularities for i in one.pieces
                 if one.name == "axis-parallel"}  # fmt: skip
        assert [piece.kind for piece in lines] == ["line"] * 4
        assert level == {0, 1, 2, 3}
        assert all((np.ptp(piece.control_points, axis=0) == 0).any() for piece in lines)
    # What outlines keep together is told of those that a border was first met in.
    together = {(one.name, one.pieces) for one in drawing.regularities}
    assert ("equal-radius", (1, 4)) in together


def test_regularities_of_a_border_that_is_run_backwards_are_those_of_its_pieces():
    (square, _, _) = slotted(0, 0)
    turned = ss.Contour(square.points[::-1], True, accuracy=0.02, level_line=square.points[::-1])
    drawing = ss.fit_shape(ss.Shape([square, turned]), tolerance=0.1, shared_boundaries=True)
    for fit in drawing:
        for one in fit.regularities:
            if one.name == "axis-parallel":
                ends = [fit.pieces[k].control_points for k in one.pieces]
                assert all((points[0] == points[-1]).any() for points in ends)
        assert any(one.name == "axis-parallel" for one in fit.regularities)


def test_shared_boundaries_exclude_what_is_not_of_one_border():
    for said in ({"n_control_points": 20}, {"tolerance": 0.1, "outliers": True}):
        with pytest.raises(ss.InvalidInputError, match="shared_boundaries exclude"):
            ss.fit_shape(ss.Shape(cells()), shared_boundaries=True, **said)


def test_a_map_without_a_tolerance_keeps_its_borders():
    drawing = ss.fit_shape(ss.Shape(cells()), shared_boundaries=True)
    ring, hole = drawing.fits[4].spline, drawing.fits[5].spline
    assert_array_equal(np.sort(ring.control_points, axis=0), np.sort(hole.control_points, axis=0))
    ends = {p.control_points[0].tobytes() for fit in drawing.fits[:4] for p in fit.pieces}
    assert all(
        p.control_points[-1].tobytes() in ends for fit in drawing.fits[:4] for p in fit.pieces
    )


@pytest.mark.slow
def test_curves_of_uncrossed_lines_do_not_cross():
    x = np.linspace(0, 20, 400)
    gap, tolerance = 0.05, 0.4
    low = ss.Contour(np.column_stack([x, np.sin(x)]), closed=False)
    high = ss.Contour(np.column_stack([x, np.sin(x) + gap + 0.02 * np.cos(9 * x)]), closed=False)
    apart = [ss.fit_curve(contour, tolerance=tolerance) for contour in (low, high)]
    assert crossings(*(polyline_of(fit.curve, 0.02) for fit in apart))  # else no test
    drawing = ss.fit_shape(ss.Shape([low, high]), tolerance=tolerance)
    assert not crossings(*(polyline_of(fit.curve, 0.02) for fit in drawing))
    for fit in drawing:
        assert fit.kept
        assert fit.tolerance == tolerance


@pytest.mark.slow
def test_slits_stay_open_at_the_price_of_the_pieces_beside_them():
    picture = ss.read(IMAGES / "opencv_butterfly.jpg", contours="longest", min_area=120)
    (contour,) = picture
    searched = fit_pieces(contour, 1.5)
    (fit,) = ss.fit_shape(picture, tolerance=1.5)
    assert self_crossings(polyline_of(searched.pieces, 0.15)) > 0
    assert self_crossings(contour.polyline) == 0
    assert self_crossings(polyline_of(fit.curve, 0.05)) == 0
    assert fit.kept
    assert fit.tolerance == 1.5
    found = two_sided(fit.curve, contour.points, closed=True, step=0.15)
    assert found.larger <= 1.5
    # Everything fitted closer until nothing crosses: eight times as many points.
    assert fit.n_stored_points < 2 * searched.n_stored_points
    alone = ss.fit_curve(contour, tolerance=1.5)
    assert_array_equal(alone.control_points, fit.control_points)


@pytest.mark.slow
def test_a_promise_is_not_given_up_for_a_crossing():
    # A stroke that runs to and fro over itself: whose points are whose cannot be told.
    t = np.linspace(0, 6 * np.pi, 300)
    points = np.column_stack([40 * np.sin(t), 0.02 * t + 0.3 * np.sin(7 * t)])
    fit = ss.fit_curve(points, closed=False, tolerance=0.5)
    found = two_sided(fit.curve, points, closed=False, step=0.05)
    assert fit.kept
    assert found.larger <= 0.5


def test_what_was_estimated_does_not_follow_the_noise_to_come_apart():
    t = np.linspace(0, 1, 240)
    hook = np.column_stack([60 * t, 20 * np.sin(6 * t)])
    noisy = np.round(hook + np.random.default_rng(2).normal(0, 0.4, hook.shape))
    contour = ss.Contour.silently(noisy, closed=False)
    alone = ss.fit_curve(contour)
    (fit,) = ss.fit_shape(ss.Shape([contour]))
    assert_array_equal(fit.control_points, alone.control_points)

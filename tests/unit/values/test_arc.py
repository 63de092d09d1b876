"""Arcs: checked, with a twin that is near, and through every change an arc still."""

from __future__ import annotations

import pickle
from math import cos, pi, sin, sqrt

import numpy as np
import pytest
from tests.support.each import each

from shapespline.errors import InvalidInputError
from shapespline.geometry import backwards, exact_fit, joined, turn_between
from shapespline.values import EXACT_TURN, Arc, BSplineCurve, Piece

LINE_KNOTS = np.array([0.0, 0, 1, 1])
EPS = np.finfo(float).eps


def curve_of(piece):
    return BSplineCurve(piece.knots, piece.control_points, piece.degree)


def line(begin, end):
    return Piece("line", 1, LINE_KNOTS, np.array([begin, end], dtype=float))


def slot():
    """Two lines and two half circles of radius 1, end to end."""
    right = Piece.of_arc(Arc((4, 0), 1.0, -pi / 2, pi), begin=(4, -1), end=(4, 1))
    left = Piece.of_arc(Arc((0, 0), 1.0, pi / 2, pi), begin=(0, 1), end=(0, -1))
    return [line((0, -1), (4, -1)), right, line((4, 1), (0, 1)), left]


def test_the_twin_keeps_its_bound_to_both_sides_and_no_fewer_beziers_do():
    share = np.linspace(0, 1, 4001)
    for sweep in (2 * pi, -2 * pi, 3.0, -0.3, 1e-4):
        arc = Arc((3.0, -2.0), 5.0, 0.7, sweep)
        for tolerance, part in ((0.5, 1e-4), (1e-3, 2e-6), (None, 1e-9)):
            piece = Piece.of_arc(arc, tolerance)
            away = np.hypot(*(curve_of(piece)(share) - arc.centre).T) - 5.0
            # Evaluation adds some units in the last place of the coordinates.
            assert np.abs(away).max() <= piece.twin_error + 40 * EPS
            assert piece.twin_error <= 5.0 * part * (1 + 1e-9)
            if part * 5 > 1e-7 and piece.n_beziers > 4:
                # Both sides are used alike; one Bezier less (of a circle, four) would miss.
                assert away.max() == pytest.approx(-away.min(), rel=0.02)
                knots, points = arc.twin(piece.n_beziers - (4 if arc.is_circle else 1))
                fewer = piece._replace(knots=knots, control_points=points)
                assert fewer.twin_error > 5.0 * part


def test_ends_and_tangents_of_the_twin_are_those_of_the_arc():
    arc = Arc((1.0, 2.0), 3.0, 0.4, -2.0)
    piece = Piece.of_arc(arc, 0.1)
    assert (piece.control_points[0] == arc.begin).all()
    assert (piece.control_points[-1] == arc.end).all()
    for leg, angle in ((piece.control_points[:2], 0.4), (piece.control_points[-2:], -1.6)):
        x, y = leg[1] - leg[0]
        # Clockwise: a quarter before the radius. Coordinates round by EPS, arms are about 1.
        assert abs(x * cos(angle) + y * sin(angle)) < 20 * EPS
        assert x * sin(angle) - y * cos(angle) > 0
    whole = Piece.of_arc(Arc((0.1, 0.2), 0.3, 1.0, 2 * pi))
    assert (whole.control_points[0] == whole.control_points[-1]).all()
    assert abs(turn_between(whole, whole)) < EXACT_TURN


def test_distances_are_those_to_the_arc_itself():
    arc = Arc((1.0, 1.0), 2.0, pi / 2, pi)  # the left half
    points = np.random.default_rng(0).uniform(-4, 5, (200, 2))
    # The nearest of many points is no nearer, and farther by at most half a step.
    sampled = arc.at(np.linspace(0, 1, 20001))
    nearest = np.hypot(*(points[:, None] - sampled).transpose(2, 0, 1)).min(axis=1)
    found = arc.distances(points)
    assert (found <= nearest + 1e-14).all()
    assert (nearest - found <= pi * 2 / 40000).all()


@each(
    [
        ((0, 0), 0.0, 0.0, 1.0, "radius of an arc must be positive, got 0.0"),
        ((0, 0), 1.0, 0.0, 0.0, "sweep of an arc must be between -2 pi and 2 pi"),
        ((0, 0), 1.0, 0.0, 7.0, "sweep of an arc must be between -2 pi and 2 pi"),
        ((0, float("nan")), 1.0, 0.0, 1.0, "centre of an arc must be two finite numbers"),
        ((0, 0), 1.0, float("inf"), 1.0, "start_angle of an arc must be finite"),
    ],
)
def test_what_is_no_arc_is_refused(centre, radius, start, sweep, message):
    with pytest.raises(InvalidInputError, match=message):
        Arc(centre, radius, start, sweep)


def test_arcs_are_values():
    arc = Arc((0, 0), 1, 0, pi)
    assert arc == Arc((0.0, -0.0), 1.0, 0.0, pi)
    assert hash(arc) == hash(Arc((0, 0), 1, 0, pi))
    assert pickle.loads(pickle.dumps(arc)) == arc
    with pytest.raises(AttributeError):
        arc.radius = 2.0
    piece = Piece.of_arc(arc)
    assert piece == pickle.loads(pickle.dumps(piece)) != Piece.of_arc(Arc((0, 0), 1, 0, 3.0))
    assert Arc((0, 0), 1, 0, 2 * pi - 1e-13).is_circle
    assert not arc.is_circle
    assert Arc.through((4, -1), (4, 1), pi).centre == pytest.approx((4, 0))
    assert Arc.through((1, 0), (0, 1), -1.5 * pi).radius == pytest.approx(1)
    with pytest.raises(InvalidInputError, match="two that differ"):
        Arc.through((1, 0), (1, 0), 1.0)


def test_a_fit_of_lines_and_arcs_measures_the_arcs_themselves():
    fit = exact_fit(slot())
    assert fit.closed
    assert fit.n_stored_points == 2 * 1 + 2 * 2
    # Rounding of a few operations; the twins alone would miss by 1e-9.
    assert fit.length == pytest.approx(8 + 2 * pi, rel=8 * EPS)
    assert fit.area == pytest.approx(8 + pi, rel=16 * EPS)
    assert fit.bounds == pytest.approx((-1, -1, 5, 1), rel=4 * EPS)
    assert max(piece.twin_error for piece in fit.pieces) < 2e-9 < fit.hausdorff_distance
    circle = exact_fit([Piece.of_arc(Arc((1, 1), 2.0, 0.3, -2 * pi))])
    assert circle.n_stored_points == 2
    assert circle.closed
    assert not len(circle.corners)
    assert circle.area == pytest.approx(4 * pi, rel=16 * EPS)
    assert circle.bounds == pytest.approx((-1, -1, 3, 3), rel=4 * EPS)
    assert fit == pickle.loads(pickle.dumps(fit))
    assert hash(fit) != hash(circle)


def test_the_bound_of_a_fit_counts_the_twin():
    coarse = Piece.of_arc(Arc((0, 0), 1.0, 0.0, 1.5), 1.0)
    spline = joined([coarse])
    fit = exact_fit([coarse])
    other = exact_fit([coarse._replace(kind="spline", arc=None)])
    assert fit.hausdorff_distance == other.hausdorff_distance + coarse.twin_error
    assert spline.degree == 3


def test_similarities_keep_arcs_and_other_maps_make_their_splines():
    fit = exact_fit(slot())
    turned = fit.transformed([[0, 2, 1], [2, 0, -3]])  # turned, mirrored, doubled, moved
    arcs = [piece.arc for piece in turned.pieces if piece.arc]
    assert [arc.radius for arc in arcs] == pytest.approx([2, 2])
    assert all(arc.sweep == pytest.approx(-pi) for arc in arcs)
    for piece in turned.pieces:
        if piece.arc:
            assert piece.twin_error < 4e-9
    stretched = fit.transformed([[1, 0], [0, 3]])
    assert [piece.kind for piece in stretched.pieces] == ["line", "spline", "line", "spline"]
    assert stretched.area == pytest.approx(3 * fit.area, rel=1e-8)  # of twins


def test_reversed_and_split_arcs_are_arcs():
    fit = exact_fit(slot())
    back = fit.reversed()
    assert [piece.kind for piece in back.pieces] == ["arc", "line", "arc", "line"]
    assert back.pieces[0].arc.sweep == -pi
    assert back.pieces[0].twin_error < 2e-9
    assert backwards(back.pieces) == fit.pieces or back.reversed().area == fit.area
    circle = exact_fit([Piece.of_arc(Arc((0, 0), 1.0, 0.0, 2 * pi), 0.1)])
    one, two = circle.split([0.23, 0.61])
    assert [piece.kind for piece in (*one.pieces, *two.pieces)] == ["arc"] * 3
    assert sum(part.length for part in (one, two)) == pytest.approx(2 * pi, rel=8 * EPS)
    # Cut where the curve is at that parameter, but for its distance to the arc.
    for part, at in ((one, 0.23), (two, 0.61)):
        assert np.hypot(*(part.pieces[0].arc.begin - circle.spline([at])[0])) < 2e-4
    assert max(piece.twin_error for piece in one.pieces) <= 1e-4
    assert one.points(5)[0] == pytest.approx(one.pieces[0].arc.begin)
    assert repr(circle).startswith("Fit(closed, 1 piece of degree 3, 2 stored points")


def test_arcs_join_lines_without_a_corner():
    fit = exact_fit(slot())
    assert not len(fit.corners)
    root = sqrt(0.5)
    corner = exact_fit([line((2, 0), (1, 0)), Piece.of_arc(Arc((0, 0), 1.0, 0.0, pi / 4))])
    assert len(corner.corners) == 1
    assert corner.spline([1.0])[0] == pytest.approx((root, root))

"""Lines and arcs instead of curves: within the tolerance by an independent sampler, and smooth."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.support.arcs import on_segment
from tests.support.make_fit import blob, wave
from tests.support.pieces import bezier, square
from tests.support.shapes import moved, random_curve

import shapespline as ss
from checks import distance_to_polyline
from shapespline.errors import InvalidInputError
from shapespline.formats.elliptic import elliptical_arc
from shapespline.geometry.biarcs import arc_polyline
from shapespline.geometry.exact import exact_fit
from shapespline.values.curve import BSplineCurve


def segments(found):
    """(begin, end, bulge) of every line and arc."""
    ends = np.roll(found.points, -1, axis=0)
    return list(zip(found.points, ends, found.bulges, strict=True))[: found.n_segments]


def two_sided(curve, found, n=1500):
    """Dense polylines of both, and the distances between them both ways."""
    mine = curve(np.unique(np.concatenate([np.linspace(0, 1, n), curve.breakpoints])))
    theirs = np.concatenate(
        [on_segment(*s, max(8, n // found.n_segments)) for s in segments(found)]
    )
    step = max(np.hypot(*np.diff(line, axis=0).T).max() for line in (mine, theirs))
    return distance_to_polyline(mine, theirs).max(), distance_to_polyline(theirs, mine).max(), step


def directions(segment):
    """Angle of the tangent at the beginning and end."""
    begin, end, bulge = segment
    chord = math.atan2(*(end - begin)[::-1])
    return chord - 2 * math.atan(bulge), chord + 2 * math.atan(bulge)


def turns(found):
    """Turn at every joint, radians."""
    parts = [directions(segment) for segment in segments(found)]
    pairs = list(zip(parts, parts[1:] + parts[:1], strict=True))
    pairs = pairs if found.closed else pairs[:-1]
    return np.array([math.remainder(after[0] - before[1], 2 * math.pi) for before, after in pairs])


@pytest.mark.parametrize("tolerance", [1.0, 0.1, 0.01, 0.001])
@pytest.mark.parametrize("curve", [blob(11), wave(9), blob(7, 5), wave(8, 2)])
@pytest.mark.slow
def test_within_the_tolerance_both_ways_and_smooth(curve, tolerance):
    found = arc_polyline(curve, tolerance, closed=curve.periodic)
    forward, reverse, step = two_sided(curve, found, 4000)
    # Sample chords stray from curve and arc by a little: at most step^2 / 8 over the radius.
    radius = 1 / max(1e-9, np.abs(curve.curvature(np.linspace(0, 1, 5000))).max())
    slack = step**2 / 4 / min(radius, 1.0)
    assert max(forward, reverse) <= tolerance + slack
    assert np.abs(turns(found)).max() <= 1e-6
    assert found.closed == curve.periodic


def test_finer_tolerances_take_the_cube_root_of_it_more_arcs():
    """A biarc is off by the third power of its length: eight times finer, twice as many."""
    curve = blob(11)
    counts = [arc_polyline(curve, 0.1 / 8**k, closed=True).n_segments for k in range(4)]
    ratios = np.divide(counts[1:], counts[:-1])
    assert ((ratios > 1.5) & (ratios < 2.6)).all()


@given(st.integers(0, 5000), st.sampled_from([2, 3, 4]), st.sampled_from([0.5, 0.02]))
@pytest.mark.slow
def test_wild_curves_keep_it_too(seed, degree, tolerance):
    rng = np.random.default_rng(seed)
    curve = random_curve(rng, degree, degree + 4)
    found = arc_polyline(curve, tolerance)
    forward, reverse, step = two_sided(curve, found, 1200)
    # Near a cusp no radius bounds the chords, only their length does.
    assert max(forward, reverse) <= tolerance + 0.5 * step
    assert (found.points[0] == curve.control_points[0]).all()
    assert (found.points[-1] == curve.control_points[-1]).all()


def test_a_circle_is_two_arcs_and_a_line_one_line():
    circle = exact_fit(elliptical_arc((3, 4), (5, 0), (0, 5), 0.0, 2 * math.pi))
    found = arc_polyline(circle.spline, 1e-3, closed=True)
    assert found.bulges == pytest.approx([1, 1], abs=1e-6)
    assert np.hypot(*(found.points - (3, 4)).T) == pytest.approx([5, 5], rel=1e-8)
    line = arc_polyline(exact_fit([bezier((0, 0), (2, 1))]).spline, 0.1)
    assert line.points.tolist() == [[0, 0], [2, 1]]
    assert line.bulges.tolist() == [0, 0]


def test_corners_and_lines_stay():
    found = arc_polyline(exact_fit(square(3.0)).spline, 0.1, closed=True)
    assert found.points.tolist() == [[0, 0], [3, 0], [3, 3], [0, 3]]
    assert not found.bulges.any()
    # A rounded rectangle: its arcs are arcs, its lines lines.
    corner = [(2, 0, -90), (2, 1, 0), (0, 1, 90), (0, 0, 180)]
    pieces = []
    for (x, y, angle), (u, v, after) in zip(corner, corner[1:] + corner[:1], strict=True):
        arc = elliptical_arc((x, y), (0.5, 0), (0, 0.5), math.radians(angle), math.pi / 2)
        start = np.array([u + 0.5 * math.cos(math.radians(after)),
                          v + 0.5 * math.sin(math.radians(after))])  # fmt: skip
        pieces += [*arc, bezier(arc[-1].control_points[-1], start)]
    points = pieces[-1].control_points.copy()
    points[-1] = pieces[0].control_points[0]
    pieces[-1] = pieces[-1]._replace(control_points=points)
    found = arc_polyline(exact_fit(pieces).spline, 1e-4, closed=True)
    assert found.n_segments == 8
    assert sorted(np.abs(found.bulges).round(6)) == [0] * 4 + [round(math.tan(math.pi / 8), 6)] * 4


def test_a_similarity_changes_nothing_but_the_points():
    curve = blob(9)
    shifted = BSplineCurve(
        curve.knots, moved(curve.control_points, 0.7, 2.0, (300, -50)), 3, periodic=True
    )
    before, after = (arc_polyline(c, t, closed=True) for c, t in ((curve, 0.05), (shifted, 0.1)))
    assert before.n_segments == after.n_segments
    assert moved(before.points, 0.7, 2.0, (300, -50)) == pytest.approx(after.points, abs=1e-6)


def test_the_promise_adds_up(outline):
    """Data to arcs: within the tolerance of the fit and that of the arcs together."""
    contour = outline("hand620_closed")
    fit = ss.fit_curve(contour, tolerance=1.0)
    found = arc_polyline(fit.spline, 0.25, closed=True)
    line = np.concatenate([on_segment(*segment, 60) for segment in segments(found)])
    assert distance_to_polyline(contour.points, line).max() <= 1.25 + 0.01
    assert distance_to_polyline(line, contour.polyline).max() <= 1.25


@pytest.mark.parametrize("tolerance", [0, -1.0, float("nan"), float("inf"), "fine", 1e-18])
def test_tolerances_that_are_none(tolerance):
    with pytest.raises(InvalidInputError, match="arc_tolerance"):
        arc_polyline(blob(9), tolerance, closed=True)

"""What an attack from outside has found once, each by its reproducer."""

from __future__ import annotations

import numpy as np
import pytest
from benchmarks.attack.options import drawn_options
from benchmarks.attack.shapes import drawn
from scipy.interpolate import BSpline, splev
from tests.support.shapes import on_circle

import shapespline as ss
from checks import bits, distance_to_curve, polyline_of, self_crossings
from shapespline.engines.pieces import PiecesProblem, chords_found
from shapespline.fitting import Request, Settings
from shapespline.fitting.solve import answer
from shapespline.monitor import Monitor
from shapespline.values import periodic_knots

pytestmark = pytest.mark.filterwarnings("ignore::shapespline.DroppedPointsWarning")


def koch(level):
    """The outline of a Koch snowflake, 3 * 4**level points."""
    corners = np.exp(2j * np.pi * np.arange(3) / 3)
    for _ in range(level):
        side = np.roll(corners, -1) - corners
        parts = [0.0, 1 / 3, 0.5 - 1j * np.sqrt(3) / 6, 2 / 3]
        corners = (corners[:, None] + side[:, None] * np.array(parts)).ravel()
    return np.column_stack([corners.real, corners.imag])


def coast(n, seed):
    """A closed outline of midpoints displaced at every scale, at least n points."""
    rng = np.random.default_rng(seed)
    points = 10 * np.exp(2j * np.pi * np.arange(3) / 3)
    while len(points) < n:
        side = np.roll(points, -1) - points
        middles = points + side / 2 + 1j * side * rng.normal(0, 0.25, len(points))
        points = np.column_stack([points, middles]).ravel()
    return np.column_stack([points.real, points.imag])


def far_from(fit, points, tolerance):
    return distance_to_curve(np.asarray(points), fit.curve, tolerance / 50).max()


@pytest.mark.parametrize("form", ["pieces", "spline"])
@pytest.mark.parametrize("effort", ["fast", "balanced", "smallest"])
def test_a_polyline_of_six_points_is_no_error(form, effort):
    points = [(0.9, 0.7), (0.7, -2), (-0.2, 0.1), (-0.2, -2), (1.6, -1), (0.5, -1.2)]
    fit = ss.fit_curve(points, closed=False, tolerance=0.03, form=form, effort=effort)
    assert fit.kept


@pytest.mark.slow
@pytest.mark.parametrize("form", ["pieces", "spline"])
@pytest.mark.parametrize("closed", [False, True])
def test_neighbours_that_only_rounding_parts_are_no_error(form, closed):
    """The sum of knot intervals cannot tell them apart: knots fell on the end of the domain."""
    points = np.array([(51.2, -32.0), (-6.4, -64.0), (-6.399999999999999, -64.0), (0.0, 3.0)])
    for data in (points, points[:3], np.concatenate([points, points[:1] + 1e-14])):
        if not closed or len(data) > 3:
            fit = ss.fit_curve(data, closed=closed, tolerance=0.03, form=form)
            assert fit.kept


def test_a_spiral_too_rough_for_one_spline_is_no_error():
    t = np.linspace(0.5, 12 * np.pi, 176)
    spiral = np.column_stack([t * np.cos(t), t * np.sin(t)])
    with pytest.warns(ss.SparsePointsWarning):
        assert ss.fit_curve(spiral, closed=False, tolerance="0.1%", effort="fast").kept


def test_a_tolerance_beyond_the_size_is_no_error():
    points = [(1, 0), (0, 0), (2, -1)]
    assert ss.fit_curve(points, closed=True, tolerance=3.0, degree=2, effort="smallest").kept


def doubled(points, at):
    """Points of which one comes twice, and where every one of them is then."""
    place = np.arange(len(points))
    return np.insert(points, at, points[at], axis=0), place + (place >= at)


@pytest.mark.parametrize("closed", [False, True])
def test_indices_count_the_points_that_are_given(closed):
    points = on_circle(100, radius=10.0)
    twice, _ = doubled(points if closed else points[:80], 5)
    last = len(twice) - 1
    fit = ss.fit_curve(twice, closed=closed, tolerance=0.05, through=[50, last])
    for at in (50, last):
        assert np.abs(fit.curve(fit.parameters[at]) - twice[at]).max() <= 1e-9
        nodes = np.array([piece.control_points[[0, -1]] for piece in fit.pieces]).reshape(-1, 2)
        assert (nodes == twice[at]).all(axis=1).any()
    with pytest.raises(ss.InvalidInputError, match="indices below"):
        ss.fit_curve(twice, closed=closed, tolerance=0.05, through=[last + 1])


@pytest.mark.parametrize("closed", [False, True])
def test_corners_weights_and_outliers_count_the_same(closed):
    side = np.linspace(0, 1, 20, endpoint=False)
    x = np.concatenate([side, 1 + 0 * side, 1 - side, 0 * side])
    square = np.column_stack([x, np.roll(x, 20)])
    twice, place = doubled(square, 5)
    corners = place[[20, 40, 60]].tolist()
    fit = ss.fit_curve(twice, closed=closed, tolerance=0.05, corners=corners)
    found = np.sort(fit.curve(fit.corners).round(6), axis=0).tolist()
    assert found[-1] == [1.0, 1.0]
    plain = ss.fit_curve(square, closed=closed, tolerance=0.05, corners=[20, 40, 60])
    assert bits(*(p.control_points for p in fit.pieces)) == bits(
        *(p.control_points for p in plain.pieces)
    )

    weights = np.ones(len(twice))
    weights[place[50]] = 20.0
    heavy = ss.fit_curve(twice, closed=closed, tolerance=0.05, weights=weights)
    assert far_from(heavy, square[50:51], 0.05) <= 0.05 / 20

    square[30] += 7.0
    twice, place = doubled(square, 5)
    kept = ss.fit_curve(twice, closed=closed, tolerance=0.05, outliers=True, through=[place[50]])
    assert kept.outliers.tolist() == [place[30]]
    assert far_from(kept, square[50:51], 0.05) <= 1e-9


@pytest.mark.parametrize("through", [None, [0], [0, 120], [0, 120, 250], [250], [120, 250, 299]])
@pytest.mark.parametrize("tangents", [((1, 0), None), (None, (1, 0)), ((0, 1), (-1, 1))])
def test_tangents_are_met_beside_points_to_go_through(through, tangents):
    x = np.linspace(0, 2 * np.pi, 300)
    points = np.column_stack([x, np.sin(x)])
    fit = ss.fit_curve(
        points, closed=False, tolerance="0.1%", end_tangents=tangents, through=through
    )
    assert fit.kept
    assert fit.status == ss.Status.KEPT
    for wanted, at in zip(tangents, (0.0, 1.0), strict=True):
        if wanted is not None:
            x, y = fit.spline([at], derivative=1)[0]
            assert abs(np.arctan2(wanted[0] * y - wanted[1] * x, wanted[0] * x + wanted[1] * y)) < (
                1e-6
            )


@pytest.mark.parametrize("degree", [1, 2, 3, 5])
def test_tangents_that_the_data_do_not_have_are_met_in_every_degree(degree):
    x = np.linspace(0, 2 * np.pi, 100)
    points = np.column_stack([x, np.sin(3 * x)])
    fit = ss.fit_curve(
        points, closed=False, tolerance=0.02, end_tangents=((-1, 0.3), (0, 1)), degree=degree
    )
    assert fit.kept
    assert fit.status == ss.Status.KEPT


@pytest.mark.parametrize("degree", [2, 3, 4])
def test_knots_coefficients_and_degree_are_right_at_the_end(degree):
    outline = ss.Contour(koch(2), closed=True).resampled(60)
    fit = ss.fit_curve(outline, tolerance="0.02%", form="spline", degree=degree, effort="fast")
    begin = fit.curve(0.0)
    assert fit.closed
    for end in (BSpline(*fit.curve.tck)(1.0), np.ravel(splev(1.0, _columns(fit.curve.tck)))):
        assert np.abs(end - begin).max() <= 1e-12


def _columns(tck):
    knots, points, degree = tck
    return knots, list(points.T), degree


def test_a_periodic_curve_with_a_multiple_knot_at_its_seam_is_right_at_its_end():
    knots = periodic_knots(5, 3, [0.0, 0.3, 0.6, 0.8, 1.0, 1.0])
    ring = ss.BSplineCurve(knots, on_circle(5), 3, periodic=True)
    assert np.abs(ring.to_scipy()([0.0, 0.4, 1.0]) - ring([0.0, 0.4, 0.0])).max() <= 1e-12
    assert np.abs(BSpline(*ring.to_scipy().tck)(1.0) - ring([0.0])[0]).max() <= 1e-12


def test_the_only_piece_of_a_periodic_fit_is_a_spline():
    fit = ss.fit_curve(on_circle(200), closed=True, tolerance=0.002, form="spline")
    (piece,) = fit.pieces
    spline = BSpline(piece.knots, piece.control_points, piece.degree)
    u = np.linspace(0, 1, 50, endpoint=False)
    assert np.abs(spline(u) - fit.curve(u)).max() <= 1e-12


@pytest.mark.slow
@pytest.mark.parametrize("rows", [20_000, 131_072, 200_000])
def test_the_blocks_of_a_dask_array_do_not_matter(rows):
    array = pytest.importorskip("dask.array")
    t = np.linspace(0, 2 * np.pi, 400_000, endpoint=False)
    r = 10 + np.sin(7 * t) + 0.3 * np.cos(23 * t)
    points = np.column_stack([r * np.cos(t), r * np.sin(t)])
    here = ss.fit_large(points, tolerance=0.002)
    there = ss.fit_large(array.from_array(points, chunks=(rows, 2)), tolerance=0.002)
    assert bits(here.spline.knots, here.control_points) == bits(
        there.spline.knots, there.control_points
    )


@pytest.mark.slow
@pytest.mark.parametrize("n", [49_152, 98_304])
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_more_points_of_a_coast_cost_no_more(n, seed):
    """Averages stood for them as if they were noise, and took most of the tolerance."""
    points = coast(n, seed)
    outline, sparse = ss.Contour(points, closed=True), ss.Contour(points[:: n // 12_288], True)
    tolerance = 0.005 * outline.box_diagonal
    fit = ss.fit_curve(outline, tolerance=tolerance)
    assert fit.kept
    assert fit.n_stored_points <= chords_found(PiecesProblem.of(outline, tolerance, None)).n_points
    # The search is greedy: its path differs by some percent.
    few = ss.fit_curve(sparse, tolerance=tolerance).n_stored_points
    assert fit.n_stored_points <= 1.1 * few


@pytest.mark.slow
@pytest.mark.parametrize("seed", [31, 0, 3, 12])
def test_thin_trailing_edges_do_not_cross(seed):
    shape = drawn(seed, "airfoil")
    size = float(np.hypot(*np.ptp(shape.points, axis=0)))
    fit = ss.fit_curve(shape.points, closed=shape.closed, tolerance=0.005 * size)
    assert fit.kept
    assert self_crossings(polyline_of(fit.curve, fit.tolerance / 50)) == 0


@pytest.mark.slow
@pytest.mark.parametrize("options", [{"through": [20, 90]}, {"form": "spline", "effort": "fast"}])
def test_a_crossing_is_said_where_nothing_repairs_it(options):
    x = np.linspace(0, 10, 80)
    there = np.column_stack([x, np.sin(2 * x)])
    points = np.concatenate([there, there[::-1] + np.array([0.0, 1e-3])])
    fit = ss.fit_curve(points, closed=False, tolerance=0.02, **options)
    assert fit.kept
    assert self_crossings(polyline_of(fit.curve, 0.001)) > 0
    assert "crosses" in fit.status.value


@pytest.mark.slow
@pytest.mark.parametrize("seed", [6, 27, 38])
def test_repairs_do_not_depend_on_the_direction(seed):
    """Pieces that cross were fitted again in the order of the data as they came."""
    points = drawn(seed, "pixels").points
    tolerance = 0.004 * float(np.hypot(*np.ptp(points, axis=0)))
    once, back, turned = (
        sorted(map(tuple, np.concatenate([p.control_points for p in fit.pieces]).tolist()))
        for fit in (
            ss.fit_curve(data, closed=True, tolerance=tolerance, effort="fast")
            for data in (points, points[::-1], np.roll(points, len(points) // 3, axis=0))
        )
    )
    assert once == back
    assert once == turned


def test_two_lines_turn_into_a_tangent_within_the_tolerance():
    rng = np.random.default_rng(4)
    points = np.cumsum(rng.normal(0, 1, (60, 2)), axis=0)
    tangents = ((0.65, -0.76), (-0.38, 0.92))
    fit = ss.fit_curve(
        points, closed=False, tolerance=0.01, degree=1, end_tangents=tangents, through=[30]
    )
    assert fit.status == ss.Status.KEPT


def test_a_tangent_far_from_the_origin_is_met_but_for_rounding():
    rng = np.random.default_rng(4)
    points = np.cumsum(rng.normal(0, 1, (60, 2)), axis=0) + 1e8
    fit = ss.fit_curve(points, closed=False, tolerance=0.1, end_tangents=((0.65, -0.76), (0, 1)))
    assert fit.status == ss.Status.KEPT


@pytest.mark.parametrize(
    ("seed", "tolerance", "effort"),
    [(10528, 0.0062639805326850815, "fast"), (10856, 0.0012545062873238317, "balanced")],
)
def test_feet_on_curves_that_are_far_from_evenly_fast_are_found_from_everywhere(
    seed, tolerance, effort
):
    # One way round, Newton's method went to and fro about a foot: the distance was 48 tolerances.
    points = drawn(seed).points
    fits = [
        ss.fit_curve(way, closed=True, tolerance=tolerance, degree=5, form="spline", effort=effort)
        for way in (points, points[::-1])
    ]
    assert fits[0].n_stored_points == fits[1].n_stored_points
    one, other = (np.sort(fit.spline.control_points, axis=0) for fit in fits)
    np.testing.assert_array_equal(one, other)
    curve = fits[0].curve
    dense = curve(np.linspace(0, 1, 50_001))
    near = np.array([np.hypot(*(dense - p).T).min() for p in fits[0].contour.points])
    assert fits[0].max_distance <= near.max() * 1.01


@pytest.mark.parametrize("seed", [21338])
def test_mirrored_chains_of_lines_meet_on_the_axis(seed):
    # Two halves in degree 1, a small spline of lines on the axis: its inner points were lost.
    shape = drawn(seed)
    options = drawn_options(np.random.default_rng([seed, 1]), shape.points, shape.closed)
    fit = ss.fit_curve(shape.points, **options)
    assert fit.kept
    assert {piece.degree for piece in fit.pieces} == {1}


@pytest.mark.slow
@pytest.mark.parametrize("seed", [10450, 20405, 20599])
def test_directions_of_weights_and_of_single_splines_do_not_matter(seed):
    """Two strokes whose points read alike both ways, and a spline clamped at its seam."""
    shape = drawn(seed)
    asked = drawn_options(np.random.default_rng([seed, 1]), shape.points, shape.closed)
    back = dict(asked)
    if "weights" in asked:
        back["weights"] = asked["weights"][::-1]
    once, again = (
        sorted(map(tuple, np.concatenate([p.control_points for p in fit.pieces]).tolist()))
        for fit in (
            ss.fit_curve(shape.points, **asked),
            ss.fit_curve(shape.points[::-1], **back),
        )
    )
    assert once == again


def test_what_lies_on_itself_is_not_fitted_again_for_its_crossings():
    """A stroke there and back is what the search found; fitted again it took twice as many."""
    points, settings = drawn(20574).points, Settings(tolerance=0.0102, corners=None)
    searched = answer(Request.of(points, True, settings), Monitor())
    fit = ss.fit_curve(points, closed=True, tolerance=0.0102, corners=None)
    assert fit.kept
    assert fit.spline == searched.spline
    assert "crosses" in fit.status.value

"""Curves as polylines: as near as asked for."""

import numpy as np
import pytest
from tests.support.make_fit import blob, wave
from tests.support.shapes import closures, some_curve

from checks import distance_to_polyline, polyline_of
from shapespline.errors import InvalidInputError
from shapespline.geometry.flattening import chords, sampled
from shapespline.values import BSplineCurve


@closures
@pytest.mark.parametrize("degree", [1, 2, 3, 5])
@pytest.mark.parametrize("sampling", [1.0, 0.01])
def test_no_point_of_the_curve_is_farther_than_the_sampling(degree, periodic, sampling):
    curve = some_curve(degree, periodic)
    points, parameters = chords(curve, sampling)
    assert points == pytest.approx(curve(parameters), abs=1e-12)
    assert (np.diff(parameters) > 0).all()
    dense = polyline_of(curve, 0.05)
    assert distance_to_polyline(dense, points).max() <= sampling * (1 + 1e-9)


def test_finer_ones_have_the_root_of_the_ratio_more_chords():
    counts = [len(chords(blob(9), 1e-3 / 100**k)[0]) for k in range(3)]
    assert np.divide(counts[1:], counts[:-1]) == pytest.approx([10, 10], rel=0.25)


def test_a_closed_curve_makes_a_closed_contour():
    closed, parameters = sampled(blob(9), 0.01)
    assert closed.closed
    assert len(parameters) == len(closed)
    open_one, parameters = sampled(wave(), 0.01)
    assert not open_one.closed
    assert parameters[[0, -1]].tolist() == [0, 1]


@pytest.mark.parametrize("sampling", [0, -1.0, np.nan, np.inf, "fine", 1e-15])
def test_what_is_no_sampling(sampling):
    with pytest.raises(InvalidInputError, match="sampling"):
        chords(blob(9), sampling)


def of_vertices(points):
    """The curve of degree 1 through vertices, closed."""
    ring = np.concatenate([points, points[:1]])
    knots = np.arange(len(ring), dtype=float) / (len(ring) - 1)
    return BSplineCurve(np.concatenate([[0.0], knots, [1.0]]), ring, 1)


def regular(count):
    angle = 2 * np.pi * np.arange(count) / count
    return 10 * np.column_stack([np.cos(angle), np.sin(angle)])


def test_chords_that_a_circle_was_drawn_with_have_no_points_between():
    contour, _ = sampled(of_vertices(regular(24)))
    assert len(contour) == 24


def test_edges_of_a_polygon_have():
    for count in (4, 6, 12, 16):
        contour, _ = sampled(of_vertices(regular(count)))
        # Steps of at most a fiftieth of the box diagonal.
        edge = 20 * np.sin(np.pi / count)
        assert len(contour) >= count * edge / (0.02 * contour.box_diagonal)


def test_long_edges_beside_chords_have_points_between():
    arch = regular(24)[:13]
    ends = np.array([(-10.0, -30.0), (10.0, -30.0)])
    contour, _ = sampled(of_vertices(np.concatenate([arch, ends])))
    on_arch = np.hypot(*contour.points.T) < 10 * (1 + 1e-12)
    above = contour.points[:, 1] > 1e-9
    assert (on_arch & above).sum() == 11
    # Two sides of 30 and the base of 20.
    assert len(contour) >= 80 / (0.02 * contour.box_diagonal)

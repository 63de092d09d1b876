"""Contour: what it accepts, drops, refuses and knows."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_array_equal
from tests.support.reference import EPS
from tests.support.shapes import flower, on_circle, rectangle

from shapespline.errors import DegenerateContourError, DroppedPointsWarning, InvalidInputError
from shapespline.values.contour import Contour

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]


# --- what is accepted --------------------------------------------------------------------------


@pytest.mark.parametrize(
    "points",
    [
        SQUARE,
        tuple(SQUARE),
        np.array(SQUARE, dtype=np.int8),
        np.array(SQUARE, dtype=np.float32),
        np.array(SQUARE, dtype=np.longdouble),
        np.array(SQUARE, dtype=object),
        np.array(SQUARE, dtype=float, order="F"),
        np.array(SQUARE, dtype=">f8"),
        np.repeat(np.array(SQUARE, dtype=float), 2, axis=1)[:, ::2],
        np.ma.array(SQUARE, mask=False),
    ],
)
def test_arrays_of_all_kinds_become_float64(points):
    contour = Contour(points, closed=True)
    assert contour.points.dtype == np.float64
    assert contour.points.flags.c_contiguous
    assert contour.points.tolist() == [list(map(float, p)) for p in SQUARE]


def test_the_points_are_a_copy_that_nobody_can_change():
    given_points = np.array(SQUARE, dtype=float)
    contour = Contour(given_points, closed=True)
    given_points[:] = 9
    assert contour.points.tolist() == [list(map(float, p)) for p in SQUARE]
    with pytest.raises(ValueError, match="read-only"):
        contour.points[0] = 9
    with pytest.raises(AttributeError):
        contour.closed = False


@pytest.mark.parametrize(
    ("points", "closed"),
    [
        (SQUARE, True),  # the gap is as long as a step
        ([*SQUARE, (0, 0)], True),
        ([(0, 0), (1, 0), (2, 0), (3, 0)], False),
        ([(0, 0), (1, 0)], False),
        ([(0, 0), (1, 0), (1, 1.5)], True),  # gap 1.80 of median step 1.25
        ([(0, 0), (1, 0), (1, 0.5), (1.2, 0.5)], False),  # gap 1.30 of median step 0.5
        (on_circle(100, 5), True),
        (on_circle(100, 5)[:-1], False),  # one point missing: twice the step
    ],
)
def test_closed_is_found_from_the_gap(points, closed):
    assert Contour(points).closed is closed
    assert Contour(points, closed=False).closed is False


def test_repeated_neighbours_are_dropped_with_a_warning():
    with pytest.warns(DroppedPointsWarning, match="dropped 3 of 7 points: equal to the point bef"):
        contour = Contour([(0, 0), (0, 0), (1, 0), (1, 1), (1, 1), (1, 1), (0, 1)], closed=True)
    assert contour.points.tolist() == [[0, 0], [1, 0], [1, 1], [0, 1]]
    assert contour.source.tolist() == [0, 0, 1, 2, 2, 2, 3]
    assert (contour.n_given, len(contour)) == (7, 4)


def test_the_repeated_first_point_of_a_closed_outline_is_dropped_in_silence():
    contour = Contour([*SQUARE, SQUARE[0]], closed=True)
    assert len(contour) == 4
    assert contour.source.tolist() == [0, 1, 2, 3, 0]
    with pytest.warns(DroppedPointsWarning, match="dropped 1 of 6"):
        contour = Contour([*SQUARE, SQUARE[0], SQUARE[0]], closed=True)
    assert contour.source.tolist() == [0, 1, 2, 3, 0, 0]
    open_one = Contour([*SQUARE, SQUARE[0]], closed=False)
    assert (len(open_one), open_one.semi_closed) == (5, True)
    assert not Contour(SQUARE, closed=False).semi_closed
    assert not Contour(SQUARE, closed=True).semi_closed


@given(st.lists(st.tuples(st.integers(0, 2), st.integers(0, 2)), min_size=1, max_size=12))
def test_every_given_point_has_its_stand_in(points):
    for closed in (False, True):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DroppedPointsWarning)
            try:
                contour = Contour(points, closed)
            except DegenerateContourError:
                assert len(set(points)) < (3 if closed else 2)
                continue
        assert len(set(points)) >= (3 if closed else 2)
        assert_array_equal(contour.points[contour.source], points)
        assert set(contour.source.tolist()) == set(range(len(contour)))
        steps = np.diff(contour.polyline, axis=0)
        assert (steps != 0).any(axis=1).all()


def test_points_of_opencv_are_points():
    given = np.array(SQUARE, dtype=np.int32)[:, None]
    assert given.shape == (4, 1, 2)
    assert_array_equal(Contour(given, closed=True).points, SQUARE)


# --- what is refused ---------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("points", "message"),
    [
        (np.zeros((2, 40)), r"points must have shape \(n, 2\), got \(2, 40\); transpose it\?"),
        (np.zeros((4, 3)), r"points must have shape \(n, 2\), got \(4, 3\); choose two columns$"),
        (np.zeros(8), r"points must have shape \(n, 2\), got \(8,\)$"),
        (5.0, r"points must have shape \(n, 2\), got \(\)"),
        ([], r"points must have shape \(n, 2\), got \(0,\)"),
        ([(0, 0), (1, np.nan), (2, 0)], r"finite, got \[1.0, nan\] at index 1 \(1 such rows\)"),
        ([(0, 0), (np.inf, 0), (-np.inf, 0)], r"finite, got \[inf, 0.0\] at index 1 \(2 such"),
        ([("a", "b"), ("c", "d")], r"points must be an array of numbers, got list"),
        ("abc", r"points must be an array of numbers, got str"),
        (None, r"points must "),
        ({}, r"points must be an array of numbers, got dict"),
        ([(0, 0), (1, 0, 2)], r"points must be an array of numbers, got list"),
        ([(0, 1j), (1, 0)], "points must be real, got complex numbers; pass real"),
        ([(0, 0), (1e61, 0)], "must not exceed 1e.60 in magnitude, got 1e.61; rescale"),
        (np.ma.array(SQUARE, mask=[[1, 0]] * 4), "must not be masked; drop the masked rows"),
    ],
)  # fmt: skip
def test_bad_points(points, message):
    with pytest.raises(InvalidInputError, match=message):
        Contour(points)


@pytest.mark.parametrize(
    ("points", "closed", "message"),
    [
        (np.empty((0, 2)), False, r"at least 2 distinct points for an open contour, got 0 \(of 0"),
        ([(1, 2)], False, r"at least 2 distinct points for an open contour, got 1 \(of 1 given"),
        ([(1, 2)] * 5, False, r"got 1 \(of 5 given\)"),
        ([(1, 2), (3, 4), (1, 2)], True, r"at least 3 distinct points for a closed .* got 2"),
        ([(1, 2), (3, 4)] * 30, True, r"at least 3 distinct points for a closed .* got 2"),
    ],
)  # fmt: skip
def test_degenerate_points(points, closed, message):
    with pytest.raises(DegenerateContourError, match=message):
        Contour(points, closed)


def test_the_largest_coordinate_is_allowed():
    contour = Contour([(0, 0), (1e60, 0)])
    assert np.isfinite(contour.length)


# --- measures ----------------------------------------------------------------------------------


def test_measures_by_hand():
    closed = Contour([(0, 0), (3, 0), (3, 4)], closed=True)
    assert closed.arc_length.tolist() == [0, 3, 7, 12]
    assert (closed.length, closed.box_diagonal) == (12, 5)
    assert closed.polyline.tolist() == [[0, 0], [3, 0], [3, 4], [0, 0]]
    assert closed.at(np.array([0, 1.5, 5, 9.5, 12])).tolist() == [
        [0, 0], [1.5, 0], [3, 2], [1.5, 2], [0, 0],
    ]  # fmt: skip
    as_open = Contour(closed.points, closed=False)
    assert as_open.arc_length.tolist() == [0, 3, 7]
    assert as_open.polyline is as_open.points


def test_resampled_by_hand():
    line = Contour([(0, 0), (1, 0), (10, 0)])
    assert line.resampled(11).points.tolist() == [[i, 0] for i in range(11)]
    ring = rectangle(2, 1).resampled(3)
    assert ring.closed
    assert ring.points.tolist() == [[0, 0], [2, 0], [1, 1]]


@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("n", [2, 3, 7, 100, 1001])
def test_resampling_is_even_and_on_the_polyline(closed, n):
    if closed and n < 3:
        return
    contour = Contour(flower(240).points, closed)
    found = contour.resampled(n)
    assert len(found) == n
    stations = np.linspace(0, contour.length, n, endpoint=not closed)
    slack = 8 * EPS * contour.length  # interpolation of coordinates no larger than the length
    assert np.abs(found.points - contour.at(stations)).max() <= slack
    assert_array_equal(found.points[0], contour.points[0])
    if not closed:
        assert_array_equal(found.points[-1], contour.points[-1])
    # Chords are no longer than the polyline between their ends.
    assert found.length <= contour.length * (1 + len(contour) * EPS)


def test_accuracy_is_carried_and_checked():
    square = Contour([(0, 0), (1, 0), (1, 1), (0, 1)], closed=True, accuracy=0.1)
    assert square.accuracy == 0.1
    assert square.resampled(9).accuracy == 0.1
    assert Contour([(0, 0), (1, 0)]).accuracy is None
    for wrong in (-1.0, np.inf, np.nan, "fine"):
        with pytest.raises(InvalidInputError, match="accuracy must be a length"):
            Contour([(0, 0), (1, 0)], accuracy=wrong)


@pytest.mark.parametrize("closed", [True, False])
def test_arc_length_is_the_sum_of_the_steps(closed):
    contour = Contour(np.random.default_rng(1).normal(0, 9, (50, 2)), closed)
    steps = np.hypot(*np.diff(contour.polyline, axis=0).T)
    assert contour.arc_length.tolist() == [0.0, *np.cumsum(steps).tolist()]
    assert contour.box[0].tolist() == contour.points.min(axis=0).tolist()
    assert contour.box[1].tolist() == contour.points.max(axis=0).tolist()

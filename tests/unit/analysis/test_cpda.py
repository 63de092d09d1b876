"""Chord-to-point distance accumulation: the definition, invariances, maxima, noise."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_array_equal
from tests.support import reference
from tests.support.shapes import flower, moved, on_circle, rectangle, wave

from shapespline.analysis.cpda import (
    accumulate,
    chord_to_point,
    local_maxima,
    moving_average,
    round_off_floor,
)
from shapespline.errors import InvalidInputError
from shapespline.values.contour import Contour

EPS = reference.EPS


def rounding(points, length):
    """Of one sum: coordinates difference exactly to half a unit of the largest of them.

    A distance is a cross product over a chord: its relative rounding is below 8 units of the
    larger offset times chord over the chord, the offset no longer than L steps, plus what the
    reflected ends carry (3 units of the largest coordinate); L - 1 of them are summed.
    """
    points = np.asarray(points)
    steps = np.hypot(*np.diff(points, axis=0).T)
    largest = np.abs(points).max()
    return (length - 1) * EPS * (8 * length * steps.max() + 12 * largest)


lengths = pytest.mark.parametrize("length", [2, 3, 8, 15])


# --- the accumulation --------------------------------------------------------------------------


@lengths
@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("seed", [0, 1])
def test_the_definition(length, closed, seed):
    points = np.random.default_rng(seed).uniform(-5, 5, (31, 2))
    signed, unsigned = accumulate(Contour(points, closed), length)
    expected_signed, expected_unsigned = reference.cpda(points, length, closed)
    # The chords of random points may be short: their distance is in error by the offset times
    # the relative rounding of the chord, at most largest / shortest more.
    slack = rounding(points, length) * 10
    assert np.abs(signed - expected_signed).max() <= slack
    assert np.abs(unsigned - expected_unsigned).max() <= slack


def test_by_hand():
    hat = Contour([(0, 0), (1, 0), (2, 1), (3, 0), (4, 0)], closed=False)
    signed, unsigned = accumulate(hat, 2)
    # Ends: the reflected neighbour makes a straight line. Next to them: the point (1, 0) against
    # the chord from (0, 0) to (2, 1), 1/sqrt(5) to its right, a left turn. The top turns right.
    assert signed == pytest.approx([0, 5**-0.5, -1, 5**-0.5, 0], abs=4 * EPS)
    assert unsigned == pytest.approx([0, 5**-0.5, 1, 5**-0.5, 0], abs=4 * EPS)


def test_a_chord_whose_ends_coincide_measures_the_distance_to_that_point():
    spike = Contour([(0, 0), (3, 4), (0, 0), (-1, 0)], closed=False)
    signed, unsigned = accumulate(spike, 2)
    assert (signed[1], unsigned[1]) == (5, 5)


@lengths
def test_index_shift_on_closed_data(length):
    points = flower(97).points
    signed, unsigned = accumulate(Contour(points, True), length)
    for shift in (1, 5, 50):
        shifted = accumulate(Contour(np.roll(points, shift, axis=0), True), length)
        assert_array_equal(shifted[0], np.roll(signed, shift))
        assert_array_equal(shifted[1], np.roll(unsigned, shift))


@lengths
@pytest.mark.parametrize("contour", [flower(97), wave(120)], ids=["closed", "open"])
def test_motion_scale_and_reversal(length, contour):
    points = contour.points
    signed, unsigned = accumulate(contour, length)
    other = moved(points, 1.1, 3.0, (40, -70))
    slack = rounding(other, length) * 2
    found = accumulate(Contour(other, contour.closed), length)
    assert np.abs(found[0] - 3 * signed).max() <= slack
    assert np.abs(found[1] - 3 * unsigned).max() <= slack
    exact = accumulate(Contour(points * 4, contour.closed), length)
    assert_array_equal(exact[0], 4 * signed)
    mirrored = accumulate(Contour(points * [1, -1], contour.closed), length)
    assert_array_equal(mirrored[0], -signed)
    backwards = accumulate(Contour(points[::-1], contour.closed), length)
    assert np.abs(backwards[0][::-1] + signed).max() <= slack
    assert np.abs(backwards[1][::-1] - unsigned).max() <= slack


@lengths
@pytest.mark.parametrize("far", [0, 1e3, 1e9])
def test_nothing_but_rounding_on_a_line(length, far):
    t = np.sort(np.random.default_rng(1).uniform(0, 10, 200))
    line = Contour(np.column_stack([t * 0.6, t * 0.8]) + far, closed=False)
    _, unsigned = accumulate(line, length)
    assert unsigned.max() <= round_off_floor(line, length)
    found = chord_to_point(line, length, prominence=0.02)
    assert len(found.maxima) == 0
    exact = Contour(np.column_stack([np.arange(50.0), 2 * np.arange(50.0)]), closed=False)
    assert accumulate(exact, length)[1].max() == 0


@pytest.mark.parametrize("length", [2, 3, 5, 10, 20])
def test_a_circle_has_the_value_that_theory_gives(length):
    n, radius = 400, 7.0
    signed, unsigned = accumulate(Contour(on_circle(n, radius), True), length)
    # The chord from angle -a to b and the point at 0: distance 2 r sin(a/2) sin(b/2), with
    # a = (L - s) h, b = s h. To leading order r h^2 s (L - s) / 2: the sum over s is
    # r h^2 L (L^2 - 1) / 12 = k d^2 L (L^2 - 1) / 12 with arc steps d = r h. sin x >= x - x^3/6
    # and <= x: each term is low by a fraction of at most (a^2 + b^2) / 24 <= (L h)^2 / 24.
    h = 2 * np.pi / n
    theory = radius * h**2 * length * (length**2 - 1) / 12
    low = (length * h) ** 2 / 24
    slack = rounding(on_circle(n, radius), length)
    assert (signed <= theory + slack).all()
    assert (signed >= theory * (1 - low) - slack).all()
    assert_array_equal(signed, unsigned)
    # The chord d' between neighbours is shorter than the arc by a fraction h^2 / 24.
    found = chord_to_point(Contour(on_circle(n, radius), True), length)
    spacing = 2 * radius * np.sin(h / 2)
    assert np.abs(found.curvature(spacing) * radius - 1).max() <= low + h**2 / 12 + 1e-9


@given(st.integers(0, 1000))
def test_signed_is_unsigned_on_convex_data(seed):
    rng = np.random.default_rng(seed)
    angle = np.sort(rng.uniform(0, 2 * np.pi, 40))
    ellipse = Contour(np.column_stack([3 * np.cos(angle), np.sin(angle)]), True)
    signed, unsigned = accumulate(ellipse, 6)
    if (np.diff(angle) < np.pi / 12).all():  # no chord spans more than half a turn
        assert (signed >= -rounding(ellipse.points, 6)).all()
        assert np.abs(signed - unsigned).max() <= 2 * rounding(ellipse.points, 6)


@pytest.mark.parametrize("length", [1, 0, -3, 2.5, True, float("nan"), None, "8"])
def test_bad_length(length):
    with pytest.raises(InvalidInputError, match=r"length must be a whole number .* at least 2"):
        accumulate(flower(), length)


def test_too_long():
    ring, line = flower(21), wave(21)
    accumulate(ring, 10)
    accumulate(line, 20)
    with pytest.raises(InvalidInputError, match="length must be at most 10 for 21 points, got 11;"):
        accumulate(ring, 11)
    with pytest.raises(InvalidInputError, match="length must be at most 20 for 21 points, got 21;"):
        accumulate(line, 21)


# --- noise, smoothing --------------------------------------------------------------------------


@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("window", [1, 3, 7])
def test_the_moving_average_is_a_mean(closed, window):
    values = np.random.default_rng(0).uniform(0, 1, 20)
    half = window // 2
    around = np.pad(values, half, mode="wrap" if closed else "reflect")
    expected = [np.mean(around[i : i + window]) for i in range(20)]
    assert (
        np.abs(moving_average(values, window, closed=closed) - expected).max() <= 2 * window * EPS
    )


def test_window():
    contour = flower()
    assert chord_to_point(contour, 8, prominence=0.02).window == 5
    assert chord_to_point(contour, 8, window=3).window == 3
    noisy = Contour(contour.points + np.random.default_rng(0).normal(0, 0.03, (240, 2)), True)
    assert chord_to_point(noisy, 8, prominence=0.02).window == 9


# --- maxima ------------------------------------------------------------------------------------


def maxima(values, closed=False, **options):
    return local_maxima(np.asarray(values, dtype=float), closed=closed, **options).tolist()


@pytest.mark.parametrize(
    ("values", "closed", "expected"),
    [
        ([0, 1, 0], False, [1]),
        ([1, 0, 1], False, []),
        ([1, 0, 1], True, [2]),  # one plateau over the seam
        ([0, 2, 2, 0], False, [1]),
        ([0, 2, 2, 2, 0], False, [2]),
        ([2, 2, 0, 2], True, [0]),  # places 3, 0, 1
        ([0, 1, 2, 3], False, []),
        ([0, 1, 2, 3], True, [3]),
        ([1, 1, 1], False, []),
        ([1, 1, 1], True, []),
        ([0, 3, 1, 3, 0], False, [1, 3]),
        ([0, 1, 1, 2, 0], False, [3]),
        ([5, 0], True, [0]),
        ([0], True, []),
    ],
)
def test_maxima_by_hand(values, closed, expected):
    assert maxima(values, closed) == expected


def test_ties_leave_one_of_two_equal_peaks():
    assert maxima([0, 3, 2.9, 3, 0], prominence=0.5) == [3]
    assert maxima([0, 3, 2.9, 3, 0], closed=True, prominence=0.5) == [3]
    assert maxima([0, 3, 2.9, 3, 2.9, 3, 0], prominence=0.5) == [5]
    assert maxima([0, 3, 1, 3, 0], prominence=0.5) == [1, 3]
    assert maxima([1, 0.5, 1, 0.5, 1, 0.5], closed=True, prominence=0.2) == [0, 2, 4]


def test_spacing_keeps_the_highest():
    values = [0, 5, 0, 6, 0, 5, 0, 4, 0]
    assert maxima(values, spacing=2) == [1, 3, 5, 7]
    assert maxima(values, spacing=3) == [3, 7]
    assert maxima(values, spacing=5) == [3]
    ring = [6, 0, 5, 0, 4, 0, 3, 0, 5.5, 0]
    assert maxima(ring, closed=True, spacing=3) == [0, 4]
    assert maxima(ring, closed=True, spacing=4) == [0, 4]
    assert maxima(ring, closed=True, spacing=5) == [0]


def scipys(values):
    """Peaks of a sequence, and their prominences."""
    from scipy.signal import find_peaks, peak_prominences  # a second to load

    peaks = find_peaks(values)[0]
    return peaks, peak_prominences(values, peaks)[0]


sequences = st.lists(st.integers(0, 12), min_size=3, max_size=60)


@pytest.mark.slow
@given(sequences, st.floats(0, 6))
def test_open_prominence_is_scipys(values, prominence):
    values = np.array(values, dtype=float)
    # Ties are ours to break: make heights distinct by less than any of the prominences matters.
    values += np.random.default_rng(len(values)).permutation(len(values)) * 2.0**-20
    peaks, height = scipys(values)
    expected = peaks[height > prominence]
    assert_array_equal(maxima(values, prominence=prominence), expected)


@pytest.mark.slow
@given(sequences, st.floats(0, 6))
def test_closed_prominence_is_scipys_on_three_rounds(values, prominence):
    values = np.array(values, dtype=float)
    n = len(values)
    values += np.random.default_rng(n).permutation(n) * 2.0**-20
    around = np.tile(values, 3)
    peaks, height = scipys(around)
    peaks = peaks[height > prominence]
    expected = peaks[(peaks >= n) & (peaks < 2 * n)] - n
    # The highest peak of all stands over the lowest value, which scipy's first or last round
    # finds as well as a whole one.
    assert_array_equal(maxima(values, closed=True, prominence=prominence), expected)


@given(sequences, st.integers(0, 59), st.floats(0, 6), st.integers(1, 5))
def test_closed_maxima_shift_with_the_values(values, shift, prominence, spacing):
    values = np.array(values, dtype=float)
    values += np.random.default_rng(len(values)).permutation(len(values)) * 2.0**-20
    options = {"closed": True, "prominence": prominence, "spacing": spacing}
    found = np.array(maxima(values, **options), dtype=int)
    shifted = maxima(np.roll(values, shift), **options)
    assert_array_equal(shifted, np.sort((found + shift) % len(values)))


@given(sequences, st.booleans(), st.integers(1, 8))
def test_no_two_maxima_are_nearer_than_the_spacing(values, closed, spacing):
    n = len(values)
    every = maxima(values, closed)
    kept = maxima(values, closed, spacing=spacing)
    assert set(kept) <= set(every)

    def gap(a, b):
        return min(abs(a - b), n - abs(a - b)) if closed else abs(a - b)

    assert all(gap(a, b) >= spacing for a in kept for b in kept if a != b)
    # Whatever was left out is near one that is as high.
    for out in set(every) - set(kept):
        assert any(gap(out, a) < spacing and values[a] >= values[out] for a in kept)


# --- together ----------------------------------------------------------------------------------


def test_fields():
    contour = flower()
    for signed in (True, False):
        found = chord_to_point(contour, 8, signed=signed, window=3, prominence=0.1)
        sums = accumulate(contour, 8)
        assert_array_equal(found.raw, np.abs(sums[0]) if signed else sums[1])
        assert_array_equal(found.signed, moving_average(sums[0], 3, closed=True))
        smooth = np.abs(found.signed) if signed else moving_average(sums[1], 3, closed=True)
        assert_array_equal(found.values, smooth)
        assert found.length == 8
        assert found.floor == pytest.approx(0.1 * smooth.max(), rel=2 * EPS)
        every = local_maxima(smooth, closed=True, prominence=found.floor)
        assert_array_equal(found.maxima, every)
    literal = chord_to_point(contour, 8, window=3)
    assert literal.floor == 0
    assert_array_equal(literal.maxima, local_maxima(literal.values, closed=True))


def test_corners_are_the_maxima_of_a_rectangle():
    contour = rectangle(30, 20)
    assert chord_to_point(contour, 6, prominence=0.05).maxima.tolist() == [0, 30, 50, 80]
    assert (chord_to_point(contour, 6).signed >= 0).all()


@pytest.mark.parametrize("sigma", [0.02, 0.05])
def test_noise_makes_no_maxima_on_a_circle(sigma):
    rng = np.random.default_rng(11)
    ring = Contour(on_circle(600, 50) + rng.normal(0, sigma, (600, 2)), True)
    every = chord_to_point(ring, 8, window=3)
    found = chord_to_point(ring, 8, prominence=0.02)
    # 4 deviations of the noise: of 600 values less than one in ten such runs has any.
    assert len(every.maxima) > 50
    assert len(found.maxima) <= 1

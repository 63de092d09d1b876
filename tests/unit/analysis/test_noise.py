"""noise_level: what was added is found, whatever the spacing; clean data have none."""

from __future__ import annotations

import numpy as np
import pytest
from tests.support.shapes import flower, rectangle, wave

from shapespline import _kernels
from shapespline.analysis.noise import (
    FEWEST_POINTS,
    HALF_WINDOW,
    along_one_direction,
    bends_evenly,
    left_in_windows,
    left_of_cubics,
    noise_level,
    tells_noise,
)
from shapespline.values.contour import Contour

DEGREES_OF_FREEDOM = 2 * HALF_WINDOW + 1 - 4


def spread(n):
    """Relative standard deviation of the estimate from n independent windows (median of chi^2)."""
    from scipy.stats import chi2  # a second to load

    middle = chi2.median(DEGREES_OF_FREEDOM)
    return 0.5 / (2 * np.sqrt(n) * chi2.pdf(middle, DEGREES_OF_FREEDOM) * middle)


@pytest.mark.parametrize("sigma", [0.01, 0.1, 1.0, 10.0])  # of a step
@pytest.mark.parametrize(
    "contour", [flower(40_000), rectangle(12_000, 8_000)], ids=["flower", "box"]
)
def test_known_noise_is_found_however_dense_the_points(contour, sigma):
    n = len(contour)
    deviation = sigma * contour.length / n
    noise = np.random.default_rng(5).normal(0, deviation, (n, 2))
    found = noise_level(Contour(contour.points + noise, closed=True))
    # Windows overlap: every seventh is independent.
    assert abs(found / deviation - 1) <= 4 * spread(n / (2 * HALF_WINDOW + 1))


def shaken_along(contour, angle, deviation, across=0.0):
    """With noise along one direction, and that part of it across."""
    noise = np.random.default_rng(2).normal(0, deviation, (len(contour), 2)) * (1.0, across)
    turn = np.array([(np.cos(angle), np.sin(angle)), (-np.sin(angle), np.cos(angle))])
    return Contour(contour.points + noise @ turn, contour.closed)


@pytest.mark.parametrize("angle", [0.0, 0.5, 2.0])
@pytest.mark.parametrize("share", [0.3, 0.5, 0.7])
def test_noise_along_one_direction_is_found_whatever_part_runs_that_way(angle, share):
    # A box, turned with the noise: that share of its sides runs along it, and has none across.
    box = rectangle(round(2000 * share), round(2000 * (1 - share)))
    turn = np.array([(np.cos(angle), np.sin(angle)), (-np.sin(angle), np.cos(angle))])
    turned = Contour(box.points @ turn, closed=True)
    deviation = 0.3 * turned.length / len(turned)
    contour = shaken_along(turned, angle, deviation)
    found = along_one_direction(contour)
    assert abs(found / deviation - 1) <= 4 * spread(len(turned) / (2 * HALF_WINDOW + 1))
    assert noise_level(contour) >= found
    assert left_of_cubics(contour) < 0.95 * deviation


@pytest.mark.parametrize("across", [0.5, 1.0])
def test_noise_in_both_directions_is_not_along_one(across):
    contour = rectangle(600, 400)
    assert along_one_direction(shaken_along(contour, 0.5, 0.5, across)) == 0.0


def test_a_little_across_is_still_along_one_direction():
    contour = rectangle(600, 400)
    assert along_one_direction(shaken_along(contour, 0.0, 0.5, 0.15)) > 0.0


@pytest.mark.parametrize("flat", [0.7, 0.95])
def test_uneven_steps_where_an_outline_runs_one_way_are_no_noise(flat):
    # Exact points, uneven along the upper and lower side: the other ones show that it is no noise.
    random, steep = np.random.default_rng(3), 1.0 - flat
    x = [np.sort(random.random(round(500 * flat))) * flat for _ in range(2)]
    y = np.arange(round(500 * steep)) / 500
    sides = [
        np.column_stack([x[0], 0 * x[0]]),
        np.column_stack([0 * y + flat, y]),
        np.column_stack([x[1][::-1], 0 * x[1] + steep]),
        np.column_stack([0 * y, steep - y]),
    ]
    assert along_one_direction(Contour(np.concatenate(sides), closed=True)) == 0.0


@pytest.mark.parametrize("seed", range(20))
def test_neither_are_those_of_a_bar_whose_ends_have_few_points(seed):
    random = np.random.default_rng(seed)
    corners = np.array([(0, 0), (100, 0), (100, 12), (0, 12), (0, 0)], dtype=float)
    at = np.concatenate([[0.0], np.cumsum(random.exponential(1.0, 120))])
    stations = np.array([0.0, 100.0, 112.0, 212.0, 224.0])
    at *= 224.0 / at[-1]
    bar = np.column_stack([np.interp(at[:-1], stations, axis) for axis in corners.T])
    assert along_one_direction(Contour(bar, closed=True)) == 0.0


def uneven_ellipse(n, height, seed):
    """Points of an ellipse 100 wide at steps that are exponentially distributed."""
    t = np.linspace(0, 2 * np.pi, 4000)
    dense = np.column_stack([50 * np.cos(t), 0.5 * height * np.sin(t)])
    stations = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(dense, axis=0).T))])
    at = np.cumsum(np.random.default_rng(seed).exponential(1.0, n))
    at *= stations[-1] / (at[-1] * 1.001)
    points = np.column_stack([np.interp(at, stations, axis) for axis in dense.T])
    return Contour(points, closed=True)


def test_nor_where_it_is_round():
    # Steps along it have a part in any direction, but none across the outline.
    found = [along_one_direction(uneven_ellipse(380, 27, seed)) for seed in range(40)]
    assert found == [0.0] * 40


def test_heights_over_even_steps_are_noisy_by_as_much_as_is_across():
    # All of it is in one direction, but no part of the profile runs that way.
    x = np.arange(400.0)
    heights = 40 * np.sin(x / 15) + np.random.default_rng(1).normal(0, 1, 400)
    profile = Contour(np.column_stack([x, heights]), closed=False)
    assert along_one_direction(profile) == 0.0
    assert noise_level(profile) == left_of_cubics(profile) > 0.0


@pytest.mark.parametrize(("steep", "tells"), [(0, False), (30, False), (100, True)])
def test_few_windows_where_it_is_steep_tell_nothing(steep, tells):
    points = [(k, 0.0) for k in range(500)] + [(500.0, k) for k in range(steep)]
    shaken = shaken_along(Contour(points, closed=False), 0.0, 0.5)
    assert (along_one_direction(shaken) > 0.0) == tells


def test_pixels_are_off_along_either_axis_and_not_along_one():
    # Most windows of a chain of pixels leave nothing along one axis, but not always the same one.
    t = np.linspace(0, 2 * np.pi, 20_000, endpoint=False)
    chain = np.rint(np.column_stack([60 * np.cos(t), 50 * np.sin(t)]))
    chain = chain[(np.diff(chain, axis=0, prepend=chain[-1:]) != 0).any(axis=1)]
    assert along_one_direction(Contour(chain, closed=True)) == 0.0


def test_a_source_that_knows_its_accuracy_is_believed_about_the_direction():
    contour = shaken_along(rectangle(700, 300), 0.0, 0.5)
    known = Contour(contour.points, closed=True, accuracy=0.01)
    assert noise_level(known) == max(0.01, left_of_cubics(known)) < along_one_direction(known)


@pytest.mark.parametrize("percent", [0.2, 1.0])
def test_known_noise_is_found_on_real_outlines(all_outlines, percent):
    for index, (name, contour) in enumerate(all_outlines):
        if "_n" in name:
            continue
        deviation = percent / 100 * contour.box_diagonal
        noise = np.random.default_rng(index).normal(0, deviation, contour.points.shape)
        found = noise_level(Contour(contour.points + noise, contour.closed))
        n = len(contour)
        assert abs(found / deviation - 1) <= max(0.2, 4 * spread(n / (2 * HALF_WINDOW + 1))), name


def test_clean_outlines_have_less_than_their_sampling_can_show(all_outlines):
    for name, contour in all_outlines:
        if "_n" not in name:
            step = np.median(np.diff(contour.arc_length))
            assert noise_level(contour) < 0.01 * step, name


def test_steps_along_the_outline_do_not_count():
    # A line with steps that vary tenfold: as a function of the index it is rough, across it is not.
    x = np.cumsum(np.random.default_rng(2).uniform(0.1, 1.0, 500))
    assert noise_level(Contour(np.column_stack([x, 2 * x]), closed=False)) < 1e-12 * x[-1]


def test_clean_figures_have_rounding_only():
    for contour in (rectangle(30, 20), wave(6)):
        largest = np.abs(contour.points - contour.points[0]).max()
        # A rounding of each coordinate, in sums of seven with coefficients below one.
        assert noise_level(contour) <= 7 * np.finfo(float).eps * largest


def test_direction_and_first_point_do_not_matter():
    points = flower(300).points + np.random.default_rng(3).normal(0, 0.05, (300, 2))
    level = noise_level(Contour(points, closed=True))
    for other in (points[::-1], np.roll(points, 41, axis=0)):
        # The first point is subtracted: a rounding of the coordinates.
        assert noise_level(Contour(other, closed=True)) == pytest.approx(level, rel=1e-9)


def test_the_accuracy_of_the_source_is_the_least():
    assert noise_level(Contour(rectangle(30, 20).points, closed=True, accuracy=0.25)) == 0.25
    few = [(0, 0), (1, 0), (1, 1)]
    assert noise_level(Contour(few, closed=True)) == 0.0
    assert noise_level(Contour(few, closed=True, accuracy=0.1)) == 0.1


@pytest.mark.parametrize("seed", range(5))
def test_curves_bend_evenly_and_corners_and_noise_do_not(seed):
    # Seven points to a wave leave 0.25 of what chords leave, corners 0.82, noise 1.14 (by the
    # differences' own sums of squares: 2/3 and 70 / 54), whatever the direction.
    t = np.arange(60)
    waves = np.column_stack([t, 4 * np.sin(2 * np.pi * t / 7 + seed)])
    teeth = np.column_stack([t, 3 * np.abs((t + seed) % 10 - 5)])
    noise = np.random.default_rng(seed).normal(size=(60, 2))
    shaken = waves + 4 * noise
    found = [bends_evenly(rows) for rows in (waves, waves[::-1], teeth, teeth[::-1], noise, shaken)]
    assert found == [True, True, False, False, False, False]
    assert not bends_evenly(waves[:4])


def test_few_points_and_exact_ones_do_not_tell_their_noise():
    points = flower(400).points
    assert tells_noise(Contour(points, closed=True))
    assert not tells_noise(Contour(points[: FEWEST_POINTS - 1], closed=False))
    assert not tells_noise(Contour(points, closed=True, accuracy=0.0))


def test_cubics_leave_noise_of_few_points_too():
    angle = 2 * np.pi * np.arange(60) / 60
    circle = 30 * np.column_stack([np.cos(angle), np.sin(angle)])
    levels = []
    for seed in range(20):
        noise = np.random.default_rng(seed).normal(0, 0.1, circle.shape)
        contour = Contour(circle + noise, closed=True)
        assert noise_level(contour) == 0.0
        levels.append(left_of_cubics(contour))
    # Twenty times eight windows that do not overlap; bends leave 2e-4.
    assert abs(np.mean(levels) / 0.1 - 1) <= 4 * spread(20 * 60 / 7) + 0.01


def test_too_few_points_leave_nothing():
    assert left_of_cubics(Contour([(0, 0), (1, 1), (2, 0), (3, 1)], closed=False)) == 0.0


@pytest.mark.parametrize(("closed", "step"), [(True, 1), (False, 1), (True, 5), (False, 3)])
def test_windows_leave_what_cubics_through_them_do(closed, step):
    points = np.random.default_rng(2).normal(0, 1, (40, 2))
    middles = np.arange(0 if closed else HALF_WINDOW, 40 if closed else 40 - HALF_WINDOW)[::step]
    offsets, expected = np.arange(-HALF_WINDOW, HALF_WINDOW + 1), []
    for middle in middles:
        window = points[(middle + offsets) % 40]
        cubics = np.polynomial.polynomial.polyfit(offsets, window, 3)
        rest = window - np.polynomial.polynomial.polyval(offsets, cubics).T
        across = rest @ [cubics[1, 1], -cubics[1, 0]] / np.hypot(*cubics[1])
        expected.append((across**2).sum())
    assert left_in_windows(points, closed, step) == pytest.approx(np.array(expected), rel=1e-9)


def test_the_direction_of_middle_points_is_a_mean_of_squares():
    rows = np.random.default_rng(3).normal(0, 1, (2, 30, 8))
    middle = rows[0, :, HALF_WINDOW + 1] + 1j * rows[1, :, HALF_WINDOW + 1]
    mean = (middle**2 / np.abs(middle) ** 2).mean()
    assert complex(*_kernels.left_at_twice_the_angle(rows)) == pytest.approx(mean, abs=1e-15)

"""Starts by name, and the seeds of Park and Lee's reference."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.interpolate import make_lsq_spline
from tests.support.shapes import flower, wave

from shapespline import SENSIBLE, Contour, Reading, fit_curve, initial_curve, optimize
from shapespline.engines.least_squares import STARTS
from shapespline.engines.least_squares.starts import baselines
from shapespline.errors import InvalidInputError

names = pytest.mark.parametrize("name", STARTS)
closures = pytest.mark.parametrize("closed", [True, False])


@names
@closures
def test_every_start_of_a_given_size(name, closed):
    contour = Contour(flower(240).points[: 240 if closed else 200], closed)
    count = 9 if name == "cpda-maxima" else 24
    start = STARTS[name](contour, count, 3, None)
    assert start.spline.n_control_points == count
    assert start.spline.periodic == closed
    assert len(start.parameters) == len(contour)
    assert (np.diff(start.parameters) >= 0).all()
    off = np.hypot(*(start.spline(start.parameters) - contour.points).T)
    assert np.sqrt(np.mean(off**2)) < 0.1 * contour.box_diagonal


@pytest.mark.slow
@names
def test_every_name_in_fit_curve_and_in_a_reading(name):
    contour = flower(240)
    count = 9 if name == "cpda-maxima" else 24
    fit = fit_curve(contour, n_control_points=count, knots=name)
    assert fit.n_control_points == count
    start = initial_curve(contour, 8, reading=Reading(start=name), n_control_points=count)
    assert start.n_control_points == count
    again = optimize(contour, start)
    assert again.rms_distance < 0.02 * contour.box_diagonal


def test_unknown_starts_name_those_that_exist():
    with pytest.raises(
        InvalidInputError, match="knots must be one of balanced, cpda-filled"
    ) as one:
        fit_curve(flower(), n_control_points=12, knots="even")
    with pytest.raises(InvalidInputError, match="start must be one of balanced") as two:
        Reading(start="even")
    assert all(name in str(error.value) for error in (one, two) for name in STARTS)


def test_a_solved_start_on_clamped_knots_comes_back_to_its_begin():
    contour = flower(240)
    reading = Reading(start="uniform", clamped=True)
    start = initial_curve(contour, 8, reading=reading, n_control_points=24)
    assert not start.spline.periodic
    assert len(start.parameters) == 241
    np.testing.assert_array_equal(start.control_points[[0, -1]], contour.points[[0, 0]])
    assert SENSIBLE.start == "cpda-filled"


def test_park_lee_seeds_are_curvature_maxima_of_a_base_curve(monkeypatch):
    """By the definition: least squares on uniform knots, curvature by formula, every maximum."""
    contour = wave(201)
    seen = []
    whole = baselines._dominant

    def spy(contour, seeds, *rest):
        seen.append(seeds)
        return whole(contour, seeds, *rest)

    monkeypatch.setattr(baselines, "_dominant", spy)
    baselines.park_lee_start(contour, 30, 3)
    u = contour.arc_length / contour.length
    count = 201 // 4
    knots = np.concatenate([np.zeros(4), np.arange(1, count - 3) / (count - 3), np.ones(4)])
    base = make_lsq_spline(u, contour.points, knots, k=3)
    (dx, dy), (ddx, ddy) = base(u, 1).T, base(u, 2).T
    bend = np.abs(dx * ddy - dy * ddx) / np.hypot(dx, dy) ** 3
    low = 0.25 * bend.mean()
    expected = {0, 200} | {
        i for i in range(1, 200) if bend[i - 1] < bend[i] > bend[i + 1] and bend[i] > low
    }
    assert set(seen[0]) == expected
    assert len(expected) > 3

"""Noise that goes on from point to point."""

from __future__ import annotations

import numpy as np
import pytest

from shapespline.analysis.slow_noise import LARGEST, SLOW, slow_noise
from shapespline.values import Contour

LENGTH, N = 100.0, 1000


def line(noise):
    return Contour(np.column_stack([np.linspace(0, LENGTH, N), noise]), closed=False)


@pytest.mark.parametrize("seed", range(10))
def test_independent_noise_does_not_go_on(seed):
    assert not list(slow_noise(line(np.random.default_rng(seed).normal(0, 0.01, N))))


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("width", [2, 3])
def test_means_of_neighbours_go_on_and_their_noise_is_told(seed, width):
    noise = np.random.default_rng(seed).normal(0, 0.01, N + 4)
    means = np.convolve(noise, np.ones(width) / width)[width : width + N]
    found = list(slow_noise(line(means)))
    deviation, apart = found[-1]
    assert apart == width
    # Of a part of N windows, which overlap: three deviations of a few hundred.
    assert deviation == pytest.approx(0.01 / width**0.5, rel=0.12)


def test_bends_that_grow_with_the_distance_are_no_noise():
    t = np.linspace(0, 2 * np.pi, 120, endpoint=False)
    radius = 10 + np.cos(30 * t)
    points = np.column_stack([radius * np.cos(t), radius * np.sin(t)])
    assert not list(slow_noise(Contour(points, closed=True)))


@pytest.mark.parametrize("n", [100, 200])
@pytest.mark.parametrize("seed", range(10))
def test_waves_of_few_noisy_points_are_none(n, seed):
    t = 2 * np.pi * np.arange(n) / n
    radius = 40 * (1 + 0.15 * np.sin(5 * t) + 0.08 * np.cos(11 * t))
    points = np.column_stack([radius * np.cos(t), radius * np.sin(t)])
    points += np.random.default_rng(seed).normal(0, 0.5, points.shape)
    assert not list(slow_noise(Contour(points, closed=True)))


def test_deviations_grow_and_end_where_bends_begin():
    noise = np.random.default_rng(1).normal(0, 0.01, N)
    for before, after in zip(range(N - 1), range(1, N), strict=True):
        noise[after] = 0.7 * noise[before] + (1 - 0.7**2) ** 0.5 * noise[after]
    found = list(slow_noise(line(noise)))
    deviations, steps = zip(*found, strict=True)
    assert list(steps) == list(range(2, 2 + len(found)))
    assert list(deviations) == sorted(deviations)
    assert deviations[-1] < LARGEST * deviations[0] / SLOW


def test_few_points_tell_nothing():
    assert not list(slow_noise(Contour([(0, 0), (1, 0.1), (2, 0), (3, 0.1)], closed=False)))

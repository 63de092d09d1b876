"""Noise that goes on from point to point."""

from __future__ import annotations

from importlib import import_module
from itertools import pairwise

import numpy as np
import pytest

from shapespline.analysis import noise_level
from shapespline.analysis.slow_noise import LARGEST, SLOW, STILL, slow_noise
from shapespline.values import Contour

LENGTH, N = 100.0, 1000


def line(noise):
    return Contour(np.column_stack([np.linspace(0, LENGTH, N), noise]), closed=False)


@pytest.mark.parametrize("seed", range(10))
def test_independent_noise_does_not_go_on(seed):
    assert not list(slow_noise(line(np.random.default_rng(seed).normal(0, 0.01, N)), 0.01))


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("width", [2, 3])
def test_means_of_neighbours_go_on_and_their_noise_is_told(seed, width):
    noise = np.random.default_rng(seed).normal(0, 0.01, N + 4)
    means = np.convolve(noise, np.ones(width) / width)[width : width + N]
    found = {apart: told for told, apart in slow_noise(line(means), noise_level(line(means)))}
    # Of a part of N windows, which overlap: three deviations of a few hundred. By as much more may
    # be told over more points, by chance.
    assert found[width] == pytest.approx(0.01 / width**0.5, rel=0.12)
    assert max(found.values()) < 1.24 * 0.01 / width**0.5


def test_bends_that_grow_with_the_distance_are_no_noise():
    t = np.linspace(0, 2 * np.pi, 120, endpoint=False)
    radius = 10 + np.cos(30 * t)
    points = np.column_stack([radius * np.cos(t), radius * np.sin(t)])
    assert not list(slow_noise(Contour(points, closed=True), 0.0))


@pytest.mark.parametrize("n", [100, 200])
@pytest.mark.parametrize("seed", range(10))
def test_waves_of_few_noisy_points_are_none(n, seed):
    t = 2 * np.pi * np.arange(n) / n
    radius = 40 * (1 + 0.15 * np.sin(5 * t) + 0.08 * np.cos(11 * t))
    points = np.column_stack([radius * np.cos(t), radius * np.sin(t)])
    points += np.random.default_rng(seed).normal(0, 0.5, points.shape)
    assert not list(slow_noise(Contour(points, closed=True), 0.0))


def test_deviations_grow_and_end_where_bends_begin():
    noise = np.random.default_rng(1).normal(0, 0.01, N)
    for before, after in zip(range(N - 1), range(1, N), strict=True):
        noise[after] = 0.7 * noise[before] + (1 - 0.7**2) ** 0.5 * noise[after]
    found = list(slow_noise(line(noise), 0.0))
    deviations, steps = zip(*found, strict=True)
    assert steps[0] == 2
    assert list(steps) == sorted(steps)
    assert min(b / a for a, b in pairwise(deviations)) > STILL
    assert deviations[-1] < LARGEST * deviations[0] / SLOW


def test_few_points_tell_nothing():
    few = Contour([(0, 0), (1, 0.1), (2, 0), (3, 0.1)], closed=False)
    assert not list(slow_noise(few, 0.0))


def test_what_grows_by_little_from_one_distance_to_the_next_is_told_later(monkeypatch):
    noise = [1.0, 1.3, 1.45, 1.52, 1.6]
    module = import_module("shapespline.analysis.slow_noise")
    monkeypatch.setattr(module, "_noise_of", lambda points, closed, apart: noise[apart - 1])
    assert list(slow_noise(line(np.zeros(N)), 1.0)) == [(1.3, 2), (1.45, 3), (1.6, 5)]
    noise[4] = 4.1  # that are bends
    assert list(slow_noise(line(np.zeros(N)), 1.0)) == [(1.3, 2), (1.45, 3)]


def test_where_the_quiet_part_has_no_noise_nothing_is_told():
    noise = np.random.default_rng(1).normal(0, 0.01, N + 4)
    means = np.convolve(noise, np.ones(3) / 3)[3 : 3 + N]
    level = noise_level(line(means))
    assert list(slow_noise(line(means), level))
    assert not list(slow_noise(line(means), 3.0 * level))

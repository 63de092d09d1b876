"""Ratios of times in one run, far above what was measured: they catch a search gone wild.

docs/performance.md has the figures, ``python -m benchmarks.scale`` prints them.
"""

import warnings

import numpy as np
import pytest
from benchmarks.door import waited, ways
from benchmarks.scale import median_of, splprep_seconds, wiggly

import shapespline as ss

pytestmark = pytest.mark.slow


def test_many_points_cost_little_more_than_few():
    # Measured: 0.06 s and 0.15 s. Ten times as many points would cost ten times as much otherwise.
    few, many = wiggly(100_000), wiggly(1_000_000)
    ratio = median_of(lambda: ss.fit_curve(many, closed=True, tolerance=0.1), 3) / median_of(
        lambda: ss.fit_curve(few, closed=True, tolerance=0.1), 3
    )
    assert ratio < 6.0


def test_a_million_points_are_fitted_in_a_part_of_the_time_of_splprep():
    # Measured: 31 to 42 times faster.
    points = wiggly(1_000_000)
    ours = median_of(lambda: ss.fit_curve(points, closed=True, tolerance=0.1), 3)
    assert ours < splprep_seconds(points, 1) / 10.0


@pytest.mark.parametrize(
    ("name", "most"), [("hand620_closed", 16), ("leaf840_closed", 11), ("plane1100_closed", 6)]
)
def test_some_splprep_calls(outline, name, most):
    # Measured: 4.1, 5.4 and 1.3 calls that keep the same tolerance; to find that lines and arcs do
    # not make up these outlines takes 3 to 4 more (DRA-11).
    from benchmarks.peers import splprep_points

    contour = outline(name)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        peer = min(
            splprep_points(contour.points, closed=True, tolerance=0.1).seconds for _ in range(3)
        )
    fewest = median_of(lambda: ss.fit_curve(contour, tolerance=0.1, character="fewest"), 3)
    assert fewest < most * peer
    assert median_of(lambda: ss.fit_curve(contour, tolerance=0.1), 3) < (most + 6) * peer


def test_points_that_scatter_do_not_take_minutes():
    points = wiggly(100_000) + np.random.default_rng(0).normal(0, 0.015, (100_000, 2))
    clean = median_of(lambda: ss.fit_curve(wiggly(100_000), closed=True, tolerance=0.1), 3)
    # Measured: 4 times; before averages stood for points 500 times.
    assert median_of(lambda: ss.fit_curve(points, closed=True, tolerance=0.1), 1) < 25 * clean


def test_nobody_waits_at_the_door(tmp_path):
    # Seconds of processor. Measured: 0.1, 1.5 and 4 times those of numpy's import (PKG-08).
    found = {
        name: waited(arguments, str(tmp_path), runs=3).processor
        for name, arguments in ways(str(tmp_path)).items()
    }
    numpy = found["import numpy"]
    assert found["import shapespline"] - found["python -c pass"] < 0.5 * numpy
    assert found["shapespline --help"] < 4 * numpy
    assert found["one small fit"] < 12 * numpy

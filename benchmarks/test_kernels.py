"""Passes of the kernels over a million points: time a point, beside what memory allows.

    python -m pytest benchmarks --benchmark-only --benchmark-enable

Bytes are what a pass must read and write if every point comes once; flops are counted by hand from
the formulas, cubic, a division as one. Without ``--benchmark-enable`` every pass is made once and
its result looked at, as by ``make test``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import pytest

import shapespline as ss
from benchmarks.scale import wiggly
from shapespline import _kernels
from shapespline.geometry.nearest import nearest

if TYPE_CHECKING:
    from collections.abc import Callable

    from pytest_benchmark.fixture import BenchmarkFixture

N = 1_000_000
TOLERANCE = 0.1


class Subject(NamedTuple):
    """The wiggly curve's points and a fit to them."""

    points: np.ndarray
    fit: ss.Fit


@pytest.fixture(scope="module")
def subject() -> Subject:
    points = wiggly(N)
    return Subject(points, ss.fit_curve(points, closed=True, tolerance=TOLERANCE))


@pytest.fixture
def timed(benchmark: BenchmarkFixture) -> Callable[..., object]:
    """Times a call and notes what it moves and computes a point."""

    def run(kernel: str, call: Callable[[], object], moved: int, flops: int) -> object:
        benchmark.extra_info.update(kernel=kernel, points=N, bytes=moved, flops=flops)
        return benchmark.pedantic(call, rounds=7, warmup_rounds=1)

    return run


def test_copy(timed, subject):
    copied = np.empty_like(subject.points)
    timed("copy", lambda: np.copyto(copied, subject.points), 32, 0)
    assert (copied == subject.points).all()


def test_squared_distances_from_the_mean(timed, subject):
    away = np.empty(N)
    # Largest coordinate, sum of whole numbers, distances: three readings of the points.
    timed(
        "distances from the mean",
        lambda: _kernels.centroid_distances_sq(subject.points, away),
        56,
        13,
    )
    scale = 2.0 ** -np.ceil(np.log2(np.abs(subject.points).max()))
    expected = (((subject.points - subject.points.mean(axis=0)) * scale) ** 2).sum(axis=1)
    np.testing.assert_allclose(away, expected, rtol=0, atol=1e-9)


def test_thinning(timed, subject):
    polyline = subject.fit.contour.polyline
    # A chord, two cross and three dot products, a new cone: a square root, two directions.
    kept = timed(
        "thinning", lambda: _kernels.thinned(polyline, 0.01 * TOLERANCE, 0.5, None), 16, 30
    )
    assert 58 < len(kept) < N / 50


def test_residuals_at_known_parameters(timed, subject):
    spline, parameters = subject.fit.spline, subject.fit.parameters
    # Cox-de Boor to degree 3: six steps of 6; four points by their basis functions: 16; the point.
    off = timed("residuals", lambda: spline(parameters) - subject.points, 40, 54)
    assert np.hypot(*off.T).max() <= TOLERANCE


def test_nearest_point_of_the_curve(timed, subject):
    # Two Newton steps of a cubic with two derivatives, 28 for them and 14 for the step, one more
    # distance of 14.
    found = timed("nearest point", lambda: nearest(subject.fit.spline, subject.points), 48, 98)
    assert np.sqrt(found.distances_sq.max()) <= TOLERANCE


def test_certified_distance_from_curve_to_data(timed, subject):
    spline = subject.fit.spline
    args = (spline.knots, subject.fit.degree, spline.coefficients, subject.fit.contour.polyline)
    # The tree over the segments: a box of two points, compared on the way.
    lower, upper, _ = timed(
        "distance curve to data",
        lambda: _kernels.curve_deviation(*args, 1e-3, 1e-7),
        16,
        8,
    )
    assert lower <= upper <= TOLERANCE


def test_normal_equations(timed, subject):
    spline, points, parameters = subject.fit.spline, subject.points, subject.fit.parameters
    form = spline.degree, spline.periodic
    sums = np.empty(_kernels.eliminated_size(spline.n_control_points, *form))
    problem = _kernels.LeastSquares(spline.knots, *form, points, None)
    # Point and tangent 22, weights and pull 25, six powers, 21 + 8 moments at 2 each, the cost 4.
    timed(
        "normal equations",
        lambda: problem.eliminated_equations(spline.control_points, parameters, sums),
        24,
        115,
    )
    cost = 0.5 * float(((spline(parameters) - points) ** 2).sum())
    assert sums[0] == pytest.approx(cost, rel=1e-9)

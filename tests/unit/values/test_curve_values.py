"""Values and derivatives of BSplineCurve against the definition, scipy and difference quotients,
within and beyond its domain; its Bezier pieces, its length and its curvature.
"""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_array_equal
from scipy.interpolate import BPoly
from tests.support import reference
from tests.support.shapes import closures, degrees, random_curve, some_curve

from shapespline import _kernels
from shapespline.values.curve import BSplineCurve
from shapespline.values.knots import clamped_knots, periodic_knots

EPS = reference.EPS


def some_parameters(curve, n=40, seed=1):
    """Random ones, every knot, both neighbours of every knot and the ends."""
    begin, end = curve.domain
    u = curve.breakpoints
    near = np.concatenate([np.nextafter(u, begin), np.nextafter(u, end)])
    return np.concatenate([np.random.default_rng(seed).uniform(begin, end, n), u, near])


def bound(curve, u, derivative=0):
    return reference.evaluation_bound(
        curve.knots, curve.control_points, curve.degree, u, curve.periodic, derivative
    )


def truth(curve, u, derivative=0):
    return reference.evaluated(
        curve.knots, curve.control_points, curve.degree, u, curve.periodic, derivative
    )


def kernel_basis(curve, u):
    """Basis values of all unrolled coefficients, dense."""
    values, first = np.empty((len(u), curve.degree + 1)), np.empty(len(u), dtype=np.int64)
    _kernels.basis_functions(curve.knots, curve.degree, curve.periodic, u, values, first)
    full = np.zeros((len(u), len(curve.coefficients)))
    for row, start, local in zip(full, first, values, strict=True):
        row[start : start + curve.degree + 1] = local
    return full


# --- values ------------------------------------------------------------------------------------


@degrees
@closures
def test_the_basis_is_a_partition_of_unity_and_its_definition(degree, periodic):
    curve = some_curve(degree, periodic)
    u = some_parameters(curve)
    found = kernel_basis(curve, u)
    assert (found >= 0).all()
    # Every value is in error by 6 roundings a level at most (see evaluation_bound), their sum by
    # p + 1 more. A periodic parameter that is reduced is the double next to it: not here.
    assert np.abs(found.sum(axis=1) - 1).max() <= (7 * degree + 1) * EPS
    expected = reference.basis_matrix(curve.knots, degree, u, periodic)
    underflow = np.finfo(float).tiny  # next to a knot at zero
    assert (np.abs(found - expected) <= 6 * degree * EPS * expected + underflow).all()


@degrees
@closures
@pytest.mark.parametrize("derivative", [0, 1, 2, 3])
def test_values_and_derivatives_are_those_of_the_definition(degree, periodic, derivative):
    if derivative > degree:
        return
    curve = some_curve(degree, periodic)
    u = some_parameters(curve)
    error = np.abs(curve(u, derivative) - truth(curve, u, derivative))
    assert (error <= bound(curve, u, derivative)).all()


@degrees
@closures
def test_values_and_derivatives_are_scipys(degree, periodic):
    curve = some_curve(degree, periodic)
    spline = curve.to_scipy()
    u = some_parameters(curve)
    for derivative in range(degree + 1):
        if derivative == degree:  # scipy and we may take another side of a rounded knot
            u = u[:40]
        # scipy's recursion is the same in other order: as many roundings again, twice for
        # derivatives, where it differences values instead of coefficients.
        error = np.abs(curve(u, derivative) - spline(u, nu=derivative))
        assert (error <= 4 * bound(curve, u, derivative)).all()


@degrees
@closures
def test_derivatives_are_difference_quotients(degree, periodic):
    curve = some_curve(degree, periodic)
    begin, end = curve.breakpoints[:-1], curve.breakpoints[1:]
    u = 0.5 * (begin + end)
    step = 0.25 * (end - begin)[:, None]
    for derivative in range(1, degree + 1):

        def quotient(h, order=derivative - 1):
            ahead, behind = curve(u + h[:, 0], order), curve(u - h[:, 0], order)
            return (ahead - behind) / (2 * h)

        coarse, fine = quotient(step), quotient(step / 2)
        finest = quotient(step / 4)
        # Central differences of a polynomial of degree up to 8: the error is a even power series
        # of h; the last two differ by more than the last is off when it is the h^2 term that
        # dominates, and the sum of all differences bounds it in any case of signs.
        off = np.abs(curve(u, derivative) - finest)
        gap = np.abs(finest - fine) + np.abs(fine - coarse)
        rounding = 8 * bound(curve, u, derivative - 1) / step + bound(curve, u, derivative)
        assert (off <= gap + rounding).all()


@degrees
@closures
def test_a_derivative_above_the_degree_is_zero(degree, periodic):
    curve = some_curve(degree, periodic)
    u = some_parameters(curve)
    assert_array_equal(curve(u, degree + 1), np.zeros((len(u), 2)))
    assert_array_equal(curve(u, degree + 5), np.zeros((len(u), 2)))


def test_the_last_derivative_takes_the_right_span_at_a_knot_and_the_left_at_the_end():
    zigzag = BSplineCurve([0, 0, 0.5, 1, 1], [(0, 0), (1, 1), (2, 0)], degree=1)
    slopes = zigzag([0, 0.25, 0.5, 1, -3, 3], derivative=1)
    assert slopes.tolist() == [[2, 2], [2, 2], [2, -2], [2, -2], [2, 2], [2, -2]]
    ring = BSplineCurve(periodic_knots(4, 1), [(0, 0), (1, 0), (1, 1), (0, 1)], 1, periodic=True)
    assert ring([0, 0.25, 1, -0.1], derivative=1).tolist() == [[4, 0], [0, 4], [4, 0], [0, -4]]


@degrees
def test_clamped_curves_begin_and_end_at_their_end_control_points(degree):
    curve = some_curve(degree, periodic=False)
    ends = curve.control_points[[0, -1]]
    # Each level multiplies and divides by the same number: two roundings.
    assert (np.abs(curve([0.0, 1.0]) - ends) <= 2 * degree * EPS * np.abs(ends)).all()


@degrees
def test_open_curves_extend_their_end_polynomials(degree):
    curve = some_curve(degree, periodic=False)
    u = np.array([-0.5, -1e-3, 1 + 1e-3, 1.5, 3.0])
    for derivative in range(min(degree, 2) + 1):
        error = np.abs(curve(u, derivative) - truth(curve, u, derivative))
        assert (error <= bound(curve, u, derivative)).all()
    # The same polynomial as inside: Taylor's series about the end has no more than p + 1 terms.
    series, factorial = 0, 1.0
    for k in range(degree + 1):
        factorial *= max(k, 1)
        series = series + truth(curve, [1.0], k)[0] * np.longdouble(0.5) ** k / factorial
    assert (np.abs(curve([1.5])[0] - series) <= 2 * bound(curve, [1.5])[0]).all()


@degrees
def test_periodic_curves_read_parameters_modulo_the_period(degree):
    rng = np.random.default_rng(degree)
    curve = random_curve(rng, degree, degree + 5, periodic=True)
    u = np.arange(64) / 64  # exact, and so is what is added
    inside = curve(u)
    for turns in (-1, 1, -7, 1000, -(2**40)):
        assert_array_equal(curve(u + turns), inside)
        assert_array_equal(curve(u + turns, 1), curve(u, 1))


def test_the_smallest_negative_parameter_is_the_seam():
    ring = BSplineCurve(periodic_knots(4, 1), [(0, 0), (1, 0), (1, 1), (0, 1)], 1, periodic=True)
    assert ring([-1e-300, -5e-324]).tolist() == [[0, 0], [0, 0]]
    far = ring([1e15 + 0.25, -1e15 + 0.25, 1e300])
    assert np.isfinite(far).all()
    assert far[:2].tolist() == [[1, 0], [1, 0]]


def test_a_period_that_is_not_one():
    rng = np.random.default_rng(3)
    unit = random_curve(rng, 3, 9, periodic=True, multiple=False)
    wide = BSplineCurve(8 * unit.knots - 4, unit.control_points, 3, periodic=True)
    assert wide.domain == (-4, 4)
    u = np.arange(64) / 64
    for turns in (0, 1, -3):
        # 8 u - 4 in binary: exact, but the knots were rounded when 4 was subtracted.
        slack = 16 * EPS * np.abs(np.diff(unit.control_points, axis=0)).max() * 3 * 9**2
        assert np.abs(wide(8 * (u + turns) - 4) - unit(u)).max() <= slack


@degrees
@pytest.mark.parametrize("extra", [0, 1, 2])
def test_few_periodic_control_points_wrap_around(degree, extra):
    curve = some_curve(degree, periodic=True, extra=extra)
    u = some_parameters(curve)
    assert curve.n_control_points == degree + 1 + extra
    assert (np.abs(curve(u) - truth(curve, u)) <= bound(curve, u)).all()
    assert_array_equal(curve([0.0]), curve([1.0]))


@degrees
def test_periodic_curves_join_as_smoothly_as_their_degree(degree):
    rng = np.random.default_rng(degree)
    curve = random_curve(rng, degree, degree + 6, periodic=True, multiple=False)
    before = np.nextafter(1.0, 0)
    for derivative in range(degree):
        jump = np.abs(curve([before], derivative) - curve([0.0], derivative))
        slope = np.abs(truth(curve, [before], derivative + 1)) if derivative < degree else 0
        both = bound(curve, [before], derivative) + bound(curve, [0.0], derivative)
        assert (jump <= both + EPS * slope).all()


def test_scalars_and_empty_arrays():
    line = BSplineCurve(clamped_knots(2, 1), [(0, 0), (2, 4)], degree=1)
    assert line(0.5).tolist() == [[1, 2]]
    assert line([]).shape == (0, 2)
    assert line([], derivative=1).shape == (0, 2)
    assert line([0.5, 0.25])[::-1].tolist() == [[0.5, 1], [1, 2]]


@given(st.integers(1, 9), st.booleans(), st.integers(0, 10**6), st.integers(0, 12))
def test_order_of_the_parameters_does_not_matter(degree, periodic, seed, extra):
    curve = some_curve(degree, periodic, seed, extra)
    rng = np.random.default_rng(seed)
    u = rng.uniform(-0.5, 1.5, 30)
    alone = np.concatenate([curve([x]) for x in u])
    assert_array_equal(curve(u), alone)
    assert_array_equal(curve(np.sort(u)), alone[np.argsort(u)])


# --- Beziers, length, curvature ----------------------------------------------------------------


@degrees
@closures
def test_beziers_are_the_curve(degree, periodic):
    curve = some_curve(degree, periodic)
    points, breakpoints = curve.beziers()
    assert_array_equal(breakpoints, curve.breakpoints)
    assert points.shape == (len(breakpoints) - 1, degree + 1, 2)
    if not periodic:
        assert_array_equal(points[0, 0], curve.control_points[0])
        assert_array_equal(points[-1, -1], curve.control_points[-1])
    # Blossoming makes 5 roundings a level of numbers that are convex combinations.
    scale = np.abs(curve.control_points).max()
    off = 10 * degree * EPS * scale
    assert np.abs(points[1:, 0] - points[:-1, -1]).max() <= 2 * off
    u = np.linspace(breakpoints[0], breakpoints[-1], 101)[:-1]
    bernstein = BPoly(points.transpose(1, 0, 2), breakpoints)
    # scipy's Bernstein polynomials: 4 roundings a level of non-negative terms; a local parameter
    # rounded at the size of u over the width.
    narrow = np.diff(breakpoints).min()
    speed = 2 * degree * scale / narrow
    assert (
        np.abs(bernstein(u) - truth(curve, u)).max() <= off + 8 * degree * EPS * scale + EPS * speed
    )


def test_a_bezier_by_hand():
    curve = BSplineCurve([0, 0, 0, 0.5, 1, 1, 1], [(0, 0), (0, 4), (4, 4), (4, 0)], 2)
    points, breakpoints = curve.beziers()
    assert breakpoints.tolist() == [0, 0.5, 1]
    assert points.tolist() == [[[0, 0], [0, 4], [2, 4]], [[2, 4], [4, 4], [4, 0]]]


def circle_like(n=64, degree=5, radius=3.0):
    """A periodic spline that interpolates a circle at its Greville abscissae."""
    knots = periodic_knots(n, degree)
    angle = 2 * np.pi * np.arange(n) / n
    at = (np.arange(n) + 0.5 * (degree + 1)) / n % 1
    rows = reference.folded(reference.basis_matrix(knots, degree, at, True), n).astype(float)
    points = radius * np.column_stack([np.cos(angle), np.sin(angle)])
    return BSplineCurve(knots, np.linalg.solve(rows, points), degree, periodic=True)


def test_length_and_curvature_of_a_circle():
    circle = circle_like()
    u = np.linspace(0, 1, 333)
    off = np.abs(np.hypot(*circle(u).T) - 3).max()
    # Quintic interpolation of a circle with h = 2 pi / 64 has error h^6 / 6! / 2^6 r (and the
    # Lebesgue constant of the interpolation, below 5): the second derivative loses h^2 of it.
    h = 2 * np.pi / 64
    expected = 5 * 3 * h**6 / 720
    assert off <= expected
    assert abs(circle.length() - 2 * np.pi * 3) <= 2 * np.pi * expected / h
    assert np.abs(circle.curvature(u) - 1 / 3).max() <= 20 * expected / h**2
    turned = BSplineCurve(circle.knots, circle.control_points[::-1], 5, periodic=True)
    assert np.abs(turned.curvature(u) + 1 / 3).max() <= 20 * expected / h**2


def test_length_by_hand():
    line = BSplineCurve([0, 0, 0.3, 1, 1], [(0, 0), (3, 4), (3, 10)], 1)
    assert line.length() == pytest.approx(11, abs=64 * 11 * EPS)
    # y = x^2 on [0, 1]: sqrt(5)/2 + asinh(2)/4. The speed is analytic, its nearest singularity
    # 1/2 from the axis: 16 nodes on a quarter of the span leave below 1e-15.
    parabola = BSplineCurve([0, 0, 0, 1, 1, 1], [(0, 0), (0.5, 0), (1, 1)], 2)
    assert parabola.length() == pytest.approx(np.sqrt(5) / 2 + np.arcsinh(2) / 4, abs=64 * EPS)


def test_curvature_by_hand():
    parabola = BSplineCurve([0, 0, 0, 1, 1, 1], [(0, 0), (0.5, 0), (1, 1)], 2)
    assert parabola.curvature([0.0]).tolist() == [2.0]
    assert parabola.curvature([1.0])[0] == pytest.approx(2 / 5**1.5, abs=32 * EPS)
    line = BSplineCurve([0, 0, 1, 1], [(0, 0), (3, 4)], 1)
    assert line.curvature([0.5]).tolist() == [0.0]
    still = BSplineCurve([0, 0, 0, 1, 1, 1], [(0, 0), (0, 0), (1, 1)], 2)
    assert np.isnan(still.curvature([0.0]))

"""optimize and its data: weights, repeated points, a fit as a start, the same elsewhere and
backwards, sampled splines recovered, and data or arguments it refuses.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from tests.support.reference import EPS
from tests.support.shapes import Start, flower, moved, on_circle, plain_start, random_curve, wave

from shapespline.engines.least_squares import DEFAULT_LIMITS
from shapespline.errors import DroppedPointsWarning, InvalidInputError
from shapespline.fitting import optimize
from shapespline.geometry.distances import RELATIVE_GAP, two_sided_distance
from shapespline.solvers.iteration import Limits
from shapespline.values.contour import Contour
from shapespline.values.curve import BSplineCurve
from shapespline.values.fit import Fit

SHORT = Limits(max_iterations=25)


# --- data --------------------------------------------------------------------------------------


def test_weights_pull():
    rng = np.random.default_rng(0)
    contour = Contour(wave(120).points + rng.normal(0, 0.3, (120, 2)), False)
    start = plain_start(contour, arc_length=6.0)
    heavy = np.ones(120)
    heavy[60] = 1e4
    even, pulled = optimize(contour, start), optimize(contour, start, weights=heavy)

    def off(fit):
        return np.hypot(*(fit.spline([fit.parameters[60]])[0] - contour.points[60]))

    assert off(pulled) < 1e-2 * off(even)
    ones = optimize(contour, start, weights=np.ones(120))
    assert_array_equal(ones.control_points, even.control_points)
    # Four times the weight is four times the cost: sums and square roots scale exactly.
    fourfold = optimize(contour, start, weights=np.full(120, 4.0))
    assert fourfold.history[0].cost == 4 * even.history[0].cost
    assert_array_equal(fourfold.control_points, even.control_points)


def test_repeated_points_have_parameters_and_weights_of_their_own():
    contour = flower(160)
    with pytest.warns(DroppedPointsWarning):
        doubled = Contour(np.repeat(contour.points, 2, axis=0), True)
    start = plain_start(contour, length=5)
    once = optimize(contour, start)
    fit = optimize(doubled, plain_start(doubled, length=5))
    assert fit.parameters.shape == (320,)
    assert_array_equal(fit.parameters, np.repeat(once.parameters, 2))
    assert_array_equal(fit.control_points, once.control_points)
    weighted = optimize(doubled, start, weights=np.full(320, 0.5))
    assert_array_equal(weighted.control_points, once.control_points)
    again = optimize(doubled, fit)  # its parameters are those of the points that were given
    assert again.history[0].cost == pytest.approx(fit.history[-1].cost, rel=0.2)


def test_a_fit_is_a_start():
    contour = flower(160)
    first = optimize(contour, plain_start(contour, length=5), limits=Limits(max_iterations=4))
    assert isinstance(first, Fit)
    second = optimize(contour, first)
    # It starts at nearest foot parameters: no residual is longer than where the first run ended.
    assert second.history[0].cost <= first.history[-1].cost * (1 + 1e-9)
    assert second.history[-1].cost <= first.history[-1].cost
    assert second.rms_distance <= first.rms_distance * (1 + 1e-9)


# --- elsewhere, backwards ----------------------------------------------------------------------


def test_powers_of_two_commute_exactly():
    contour = flower(160)
    fit = optimize(contour, plain_start(contour, length=5))
    for scale in (2.0**-30, 4.0, 2.0**30):
        other = Contour(scale * contour.points, True)
        found = optimize(other, plain_start(other, length=5))
        assert_array_equal(found.control_points, scale * fit.control_points)


@pytest.mark.parametrize("closed", [True, False], ids=["closed", "open"])
@pytest.mark.parametrize(
    ("angle", "scale", "shift"),
    [(0.7, 1.0, (0, 0)), (0, 1.0, (1e6, -2e6)), (2.0, 1e-6, (3e-6, 0)), (1.0, 1e7, (5e8, 1e8))],
)
def test_similarity_transforms_commute(closed, angle, scale, shift):
    contour = Contour(flower(160).points, closed)
    fit = optimize(contour, plain_start(contour, length=5))
    other = Contour(moved(contour.points, angle, scale, shift), closed)
    found = optimize(other, plain_start(other, length=5))
    # Both stop where the cost falls by less than 1e-6 of itself. Rounding of the place (1e-9 of
    # the shape at worst here) moves the path by as much and may shift the stop by an iteration:
    # the costs then differ by a few of these decreases, the distances by the root of that.
    cost, other_cost = fit.history[-1].cost, found.history[-1].cost / scale**2
    assert abs(other_cost - cost) <= 1e-4 * cost
    assert abs(found.rms_distance / scale - fit.rms_distance) <= 1e-2 * fit.rms_distance
    gap = np.abs(found.control_points - moved(fit.control_points, angle, scale, shift)).max()
    assert gap <= 1e-2 * scale * fit.max_distance * 10


def test_reversed_open_data_give_the_reversed_curve():
    contour = wave(150)
    back = Contour(contour.points[::-1], False)
    fit = optimize(contour, plain_start(contour, length=12))
    start = plain_start(contour, length=12)
    mirrored = Start(
        BSplineCurve(1 - start.spline.knots[::-1], start.spline.control_points[::-1], 3),
        1 - start.parameters[::-1],
    )
    found = optimize(back, mirrored)
    assert found.history[-1].cost == pytest.approx(fit.history[-1].cost, rel=1e-4)


# --- recovery ----------------------------------------------------------------------------------


@pytest.mark.parametrize("degree", [1, 2, 3, 4, 5])
@pytest.mark.parametrize("periodic", [False, True], ids=["clamped", "periodic"])
def test_a_sampled_spline_is_recovered(degree, periodic):
    rng = np.random.default_rng([degree, periodic])
    m = 10
    if periodic:
        shape = on_circle(m, 8.0) * (1 + 0.2 * rng.uniform(-1, 1, (m, 1)))
    else:
        shape = np.column_stack([np.linspace(0, 20, m), rng.uniform(-3, 3, m)])
    template = random_curve(rng, degree, m, periodic=periodic, multiple=False)
    if degree == 1 and not periodic:
        template = BSplineCurve([0, *np.linspace(0, 1, m), 1], shape, 1)
    truth = BSplineCurve(template.knots, shape, degree, periodic)
    u = np.linspace(0, 1, 400, endpoint=not periodic)
    contour = Contour(truth(u), periodic)
    nearby = shape + rng.normal(0, 0.05, shape.shape)
    if not periodic:
        nearby[[0, -1]] = shape[[0, -1]]
    start = Start(
        BSplineCurve(template.knots, nearby, degree, periodic),
        np.clip(np.sort(u + rng.normal(0, 5e-4, 400)), 0, None if periodic else 1),
    )
    start.parameters[0] = 0
    if not periodic:
        start.parameters[-1] = 1
    limits = Limits(max_iterations=200, relative_decrease=1e-12, gradient_tolerance=0)
    fit = optimize(contour, start, limits=limits)
    # A zero-residual problem: convergence is quadratic up to the flat valley of
    # reparametrisations, where it is linear in the damping. Six decades are no accident; without
    # the parameters a start 0.05 off stays 1e-3 off.
    assert fit.max_distance <= 1e-6
    sagitta = two_sided_distance(truth, contour).reverse_distance
    assert fit.hausdorff_distance <= sagitta * (1 + RELATIVE_GAP) + 1e-6


def test_exact_data_cost_nothing():
    knots_source = plain_start(flower(160), length=5)
    truth, u = knots_source.spline, knots_source.parameters
    contour = Contour(truth(u), True)
    fit = optimize(contour, Start(truth, u))
    assert fit.history[0].paper_error <= 64 * EPS * 12
    assert fit.max_distance <= 640 * EPS * 12
    # Two end points of the polyline and a bend between: the sagitta of the samples.
    assert fit.hausdorff_distance <= 0.02


# --- bad input ---------------------------------------------------------------------------------


def test_bad_arguments():
    contour = flower(160)
    start = plain_start(contour, length=5)
    with pytest.raises(InvalidInputError, match=r"method must be one of .*got 'newton'"):
        optimize(contour, start, "newton")
    for bad in (0, -1.0, np.nan):
        with pytest.raises(InvalidInputError, match=r"tolerance must be .*data units"):
            optimize(contour, start, tolerance=bad)
    with pytest.raises(InvalidInputError, match=r"weights must have shape \(160,\), .*\(159,\)"):
        optimize(contour, start, weights=np.ones(159))
    for bad in (0.0, -1.0, np.nan, np.inf):
        weights = np.ones(160)
        weights[3] = bad
        with pytest.raises(InvalidInputError, match="weights must be positive and finite; leave"):
            optimize(contour, start, weights=weights)
    with pytest.raises(InvalidInputError, match="expected 160, got 100; make it from the same"):
        optimize(contour, Start(start.spline, start.parameters[:100]))
    with pytest.raises(InvalidInputError, match="ends must be one of"):
        optimize(contour, start, ends="loose")
    with pytest.raises(InvalidInputError, match="ends must be 'free' for a periodic curve"):
        optimize(contour, start, ends="fixed")
    for bad in (-0.1, np.nan, np.inf):
        with pytest.raises(InvalidInputError, match="stray_weight"):
            optimize(contour, start, stray_weight=bad)
    with pytest.raises(InvalidInputError, match="max_iterations"):
        optimize(contour, start, limits=Limits(max_iterations=-1))
    bad = start.parameters.copy()
    bad[7] = np.nan
    with pytest.raises(InvalidInputError, match="finite"):
        optimize(contour, Start(start.spline, bad))


@pytest.mark.parametrize("weights", ["heavy", [["a"]], None, np.ones((160, 1))])
def test_weights_that_are_none(weights):
    contour = flower(160)
    start = plain_start(contour, length=5)
    if weights is None:
        assert optimize(contour, start, weights=None, limits=SHORT).kept
        return
    with pytest.raises(InvalidInputError, match="weights must"):
        optimize(contour, start, weights=weights)


def test_the_default_limits_hold():
    assert DEFAULT_LIMITS.max_iterations >= 100
    assert 0 < DEFAULT_LIMITS.relative_decrease <= 1e-5


@pytest.mark.parametrize("scale", [1e-110, 1e-160, 1e-200, 1e-310])
def test_data_whose_squares_underflow_are_refused(scale):
    # They had a certified distance of zero, and were called kept.
    with pytest.raises(InvalidInputError, match="rescale"):
        Contour(scale * flower(160).points, True)


def test_the_smallest_data_are_fitted_like_any_other():
    contour = flower(160)
    small = Contour(2.0**-180 * contour.points, True)
    fit = optimize(small, plain_start(small, length=5))
    expected = optimize(contour, plain_start(contour, length=5))
    assert_array_equal(fit.control_points * 2.0**180, expected.control_points)
    assert fit.hausdorff_distance == 2.0**-180 * expected.hausdorff_distance

"""Steps of least squares over chunks of points, against dense equations."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from tests.support.scattered import ring, wave

import shapespline as ss
from shapespline import _kernels
from shapespline.values import clamped_knots, periodic_knots

ALONG_PART = 1e-3  # of the way along the tangent, the kernel's


@pytest.mark.parametrize("degree", [1, 3, 7])
@pytest.mark.parametrize("periodic", [True, False])
def test_the_step_is_that_of_the_dense_equations(degree, periodic):
    random = np.random.default_rng(degree)
    m, n, damping = 12, 90, 0.3
    knots = periodic_knots(m, degree) if periodic else clamped_knots(m, degree)
    angle = 2 * np.pi * np.arange(m) / m
    control_points = np.column_stack([3 * np.cos(angle), np.sin(angle)])
    control_points += random.normal(0, 0.05, (m, 2))
    curve = ss.BSplineCurve(knots, control_points, degree, periodic)
    parameters = np.linspace(0, 1, n, endpoint=not periodic)
    points = curve(parameters) + random.normal(0, 0.1, (n, 2))
    shape = np.column_stack(
        [
            ss.BSplineCurve(knots, np.column_stack([unit, unit]), degree, periodic)(parameters)[
                :, 0
            ]
            for unit in np.eye(m)
        ]
    )
    tangents = curve(parameters, derivative=1)
    matrix, right = np.zeros((2 * m, 2 * m)), np.zeros(2 * m)
    for j in range(n):
        t = tangents[j] / np.hypot(*tangents[j])
        moves = periodic or 0 < j < n - 1
        across = np.eye(2) - (1 - ALONG_PART) * moves * np.outer(t, t)
        matrix += np.kron(np.outer(shape[j], shape[j]), across)
        right -= np.kron(shape[j], across @ (curve(parameters[j : j + 1])[0] - points[j]))
    damped = matrix + damping * np.diag(matrix.diagonal() + 1e-11 * matrix.diagonal().max())
    expected = np.linalg.solve(damped, right)

    form, size = (degree, periodic), _kernels.eliminated_size(m, degree, periodic)
    parts = []
    for part in (slice(0, 40), slice(40, n)):  # what chunks say adds up
        parts.append(np.empty(size))
        problem = _kernels.LeastSquares(knots, *form, points[part], None)
        problem.eliminated_equations(control_points, parameters[part], parts[-1])
    step = np.empty((m, 2))
    solved, decrease, norm = _kernels.eliminated_step(*form, parts[0] + parts[1], damping, step)
    assert solved
    # Backward stable: what rounding of the entries (4e-12 at degree 7) makes of the solution.
    rounding = np.linalg.cond(damped) * 1e-11 * np.abs(expected).max()
    assert_allclose(step.ravel(), expected, rtol=0, atol=rounding)
    model = right @ expected - 0.5 * expected @ matrix @ expected
    assert decrease == pytest.approx(model, rel=1e-6)
    assert norm == pytest.approx(np.linalg.norm(right), rel=1e-9)
    cost = 0.5 * ((curve(parameters) - points) ** 2).sum()
    assert parts[0][0] + parts[1][0] == pytest.approx(cost, rel=1e-12)


@pytest.mark.parametrize("closed", [True, False])
def test_near_feet_lead_nearer_and_square_to_the_curve(closed):
    fit = ss.fit_curve(ring(400) if closed else wave(400), n_control_points=30, closed=closed)
    spline = fit.spline
    points = (ring if closed else wave)(3000, 0.05)
    begin = np.linspace(0, 1, 3000, endpoint=not closed)
    parameters = begin.copy()
    _kernels.near_feet(
        spline.knots, spline.degree, closed, spline.control_points, points, 8, parameters
    )
    away, before = (np.hypot(*(spline(u) - points).T) for u in (parameters, begin))
    assert (away <= before).all()
    inside = np.ones(3000, dtype=bool) if closed else (parameters > 0) & (parameters < 1)
    tangents = spline(parameters, derivative=1)
    along = ((spline(parameters) - points) * tangents).sum(axis=1) / np.hypot(*tangents.T)
    # Of a curve 20 wide, after eight squarings; a step that overshoots is the last of its point.
    assert (np.abs(along[inside]) < 1e-6).mean() > 0.98

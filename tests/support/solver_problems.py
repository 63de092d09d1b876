"""Small problems with known minima, for every solver."""

from __future__ import annotations

import numpy as np

from shapespline.solvers.levenberg_marquardt import Proposal

EPS = float(np.finfo(float).eps)


class LeastSquares:
    """Half a sum of squares, from residuals and their Jacobian; counts its evaluations."""

    name: str
    start: np.ndarray
    minimum: float

    def __init__(self):
        self.evaluations = 0

    def residuals(self, x):
        raise NotImplementedError

    def jacobian(self, x):
        raise NotImplementedError

    def cost(self, x):
        self.evaluations += 1
        r = self.residuals(x)
        return 0.5 * float(r @ r)

    def cost_and_gradient(self, x):
        self.evaluations += 1
        r = self.residuals(x)
        return 0.5 * float(r @ r), self.jacobian(x).T @ r

    def scale(self, x):
        d = (self.jacobian(x) ** 2).sum(axis=0)
        return np.maximum(d, 1e-12 * d.max())

    def damped_step(self, x, damping):
        r, jac = self.residuals(x), self.jacobian(x)
        gradient, diagonal = jac.T @ r, self.scale(x)
        step = -np.linalg.solve(jac.T @ jac + damping * np.diag(diagonal), gradient)
        model = r + jac @ step
        decrease = 0.5 * float(r @ r - model @ model)
        return Proposal(x + step, decrease, float(np.sqrt(gradient @ (gradient / diagonal))))

    def metric_step(self, x, metric, damping):
        """No parameters here: every metric is the damped Gauss-Newton step."""
        return self.damped_step(x, damping)

    def projected(self, x):
        return x


class Rosenbrock(LeastSquares):
    name = "rosenbrock"
    start = np.array([-1.2, 1.0, -1.2, 1.0])
    minimum = 0.0

    def residuals(self, x):
        return np.concatenate([10.0 * (x[1::2] - x[::2] ** 2), 1.0 - x[::2]])

    def jacobian(self, x):
        m = x.size // 2
        jac = np.zeros((2 * m, 2 * m))
        i = np.arange(m)
        jac[i, 2 * i] = -20.0 * x[::2]
        jac[i, 2 * i + 1] = 10.0
        jac[m + i, 2 * i] = -1.0
        return jac


class IllScaledQuadratic(LeastSquares):
    """Coupled in the middle, with curvatures over six decades."""

    name = "ill-scaled quadratic"
    start = np.array([1.0, -2.0, 3.0, -1.0, 2.0, 0.5])
    minimum = 0.0
    units = np.array([1e-1, 1.0, 10.0, 1e2, 3.0, 0.3])
    factor = np.eye(6) + 0.3 * np.eye(6, k=1) - 0.2 * np.eye(6, k=-2)

    def residuals(self, x):
        return self.factor @ (self.units * x)

    def jacobian(self, x):
        return self.factor * self.units


class CircleFit(LeastSquares):
    """A circle through noisy points: nonlinear, with a residual that stays."""

    name = "circle"
    start = np.array([0.5, -0.5, 1.0])
    angles = np.linspace(0.0, 5.0, 15)
    radii = 2.0 + 0.1 * np.cos(7.0 * angles)
    points = np.column_stack([3.0 + radii * np.cos(angles), 1.0 + radii * np.sin(angles)])
    minimum: float  # set below, from a dense Gauss-Newton solution

    def residuals(self, x):
        return np.hypot(self.points[:, 0] - x[0], self.points[:, 1] - x[1]) - x[2]

    def jacobian(self, x):
        d = self.points - x[:2]
        return np.column_stack([-d / np.hypot(d[:, 0], d[:, 1])[:, None], -np.ones(len(d))])


def _gauss_newton(problem, iterations=60):
    """Undamped reference solution from a start that is near enough for it."""
    x = np.array([3.0, 1.0, 2.0])
    for _ in range(iterations):
        x = x - np.linalg.lstsq(problem.jacobian(x), problem.residuals(x), rcond=None)[0]
    return problem.cost(x)


CircleFit.minimum = _gauss_newton(CircleFit())


class Rescaled:
    """The same problem in other units: x = units * z, cost multiplied."""

    def __init__(self, problem, units, cost_unit=1.0):
        self.problem, self.units, self.cost_unit = problem, units, cost_unit
        self.start = problem.start / units

    def cost(self, z):
        return self.cost_unit * self.problem.cost(self.units * z)

    def cost_and_gradient(self, z):
        cost, gradient = self.problem.cost_and_gradient(self.units * z)
        return self.cost_unit * cost, self.cost_unit * gradient * self.units

    def scale(self, z):
        return self.cost_unit * self.problem.scale(self.units * z) * self.units**2


class Slope:
    """Falls for ever: no curvature anywhere."""

    def cost(self, x):
        return -float(x.sum())

    def cost_and_gradient(self, x):
        return self.cost(x), -np.ones_like(x)

    def scale(self, x):
        return np.ones_like(x)


PROBLEMS = [Rosenbrock, IllScaledQuadratic, CircleFit]

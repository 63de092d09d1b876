"""The least-squares problem in control points and location parameters.

    minimise over P, t   1/2 sum_j w_j |C(t_j) - Q_j|^2                     (the paper's Eq. 3)

as a function of one flat vector: the control points, x and y interleaved, then the parameters. That
is orthogonal distance regression; its step eliminates the parameters by a Schur complement.
Cost, gradient, Gauss-Newton diagonal and the Levenberg-Marquardt step are O(n) each, in the kernel.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline import _kernels
from shapespline.errors import InvalidInputError
from shapespline.geometry import nearest, nondecreasing
from shapespline.solvers import Proposal
from shapespline.values import BSplineCurve

if TYPE_CHECKING:
    from shapespline.solvers import Metric
    from shapespline.typing import FloatArray

# Entries of the Gauss-Newton diagonal below this part of the largest are raised to it (LSQ-03).
DIAGONAL_FLOOR = 1e-12
ENDS = ("fixed", "fitted", "free")
# Newton steps towards a foot point nearby.
_FOOT_STEPS = 3
# Relative damping for control points that no data hold; the others do not notice.
_BARE_DAMPING = 1e-12
# The kernel's names for which parameters stay.
_HOLD_ENDS, _HOLD_ALL = 1, 2


class CurveProblem:
    """Data, knots and weights; what moves is the vector given to each method.

    Parameters
    ----------
    points : ndarray, shape (n, 2)
        Data, C-contiguous float64.
    template : BSplineCurve
        Gives knots, degree and number of control points; its control points are the start.
    weights : ndarray, shape (n,), optional
        One positive weight per point.
    ends : {"fixed", "fitted", "free"}
        Of an open curve. The paper leaves everything free; then the ends may fly. "fitted" holds
        the first and last parameter, "fixed" the first and last control point as well.
    stray_weight : float
        Weight, relative to that of a data point, of residuals that hold the curve to the data
        polyline where neighbours lie far apart on it; 0 is the plain problem.

    Examples
    --------
    >>> import numpy as np
    >>> line = BSplineCurve([0, 0, 1, 1], [(0, 0), (2, 0)], degree=1)
    >>> problem = CurveProblem(np.array([[0.0, 0], [1, 1], [2, 0]]), line)
    >>> problem.cost(problem.pack(line.control_points, np.array([0, 0.5, 1])))
    0.5
    """

    def __init__(
        self,
        points: FloatArray,
        template: BSplineCurve,
        weights: FloatArray | None = None,
        *,
        ends: str = "free",
        stray_weight: float = 0.0,
    ) -> None:
        if ends not in ENDS:
            raise InvalidInputError(f"ends must be one of {', '.join(ENDS)}, got {ends!r}")
        if not 0 <= stray_weight < np.inf:
            raise InvalidInputError(
                f"stray_weight must be 0 or a positive number, got {stray_weight!r}; try 0.1"
            )
        if ends != "free" and template.periodic:
            raise InvalidInputError("ends must be 'free' for a periodic curve: it has none")
        self.points = points
        self.template = template
        self.weights = weights
        self.ends = ends
        self.stray_weight = stray_weight
        self._split = 2 * template.n_control_points
        held = 0 if ends == "free" else _HOLD_ENDS
        self.kernel = _kernels.LeastSquares(
            *self._knots, points, weights, held, ends == "fixed", stray_weight
        )

    def on(self, template: BSplineCurve) -> CurveProblem:
        """The same data on other knots."""
        return CurveProblem(
            self.points, template, self.weights, ends=self.ends, stray_weight=self.stray_weight
        )

    def pack(self, control_points: FloatArray, parameters: FloatArray) -> FloatArray:
        """Control points (m, 2) and parameters (n,) as one vector."""
        return np.concatenate([control_points.ravel(), parameters])

    def unpack(self, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Views of the control points (m, 2) and the parameters (n,) in a vector."""
        return x[: self._split].reshape(-1, 2), x[self._split :]

    def curve(self, x: FloatArray) -> BSplineCurve:
        """The curve that a vector stands for."""
        template = self.template
        return BSplineCurve(template.knots, self.unpack(x)[0], template.degree, template.periodic)

    def cost(self, x: FloatArray) -> float:
        """Half the weighted sum of squared residuals."""
        control_points, parameters = self.unpack(x)
        return self.kernel.cost(control_points, parameters)

    def cost_and_gradient(self, x: FloatArray) -> tuple[float, FloatArray]:
        """Cost and its gradient; zero for what is fixed."""
        control_points, parameters = self.unpack(x)
        gradient = np.empty_like(x)
        cost = self.kernel.cost_and_gradient(control_points, parameters, *self.unpack(gradient))
        return cost, gradient

    def scale(self, x: FloatArray) -> FloatArray:
        """Gauss-Newton diagonal of the Hessian, each block floored at 1e-12 of its maximum.

        ``sum_j w_j N_i(t_j)^2`` for both coordinates of P_i, ``w_j |C'(t_j)|^2`` for t_j.
        """
        control_points, parameters = self.unpack(x)
        diagonal = np.empty_like(x)
        of_control_points = np.empty(len(control_points))
        of_parameters = diagonal[self._split :]
        self.kernel.gauss_newton_diagonal(
            control_points, parameters, of_control_points, of_parameters
        )
        for block in (of_control_points, of_parameters):
            largest = float(block.max())
            np.maximum(block, DIAGONAL_FLOOR * largest if largest > 0 else 1.0, out=block)
        diagonal[: self._split] = np.repeat(of_control_points, 2)
        return diagonal

    def damped_step(self, x: FloatArray, damping: float) -> Proposal | None:
        """Levenberg-Marquardt step with the parameters eliminated; None if it has no solution.

        The trial parameters are put back into data order: a trial that needs it is judged by its
        true cost like any other.
        """
        control_points, parameters = self.unpack(x)
        step = np.empty_like(x)
        solved, cost, predicted, gradient_norm = self.kernel.damped_step(
            control_points, parameters, damping, *self.unpack(step)
        )
        if not solved:
            return None
        step += x
        self._put_in_order(step[self._split :], parameters)
        return Proposal(step, cost - predicted, gradient_norm)

    def joint_step(self, x: FloatArray, parameter_damping: float) -> Proposal | None:
        """Gauss-Newton step of control points and parameters; None if it has no solution.

        The parameters alone are damped: ``(1 + damping) |T_j|^2`` on their diagonal. They may leave
        the order of the data.
        """
        control_points, parameters = self.unpack(x)
        step = np.empty_like(x)
        # Part of a residual along the tangent that a damped parameter leaves.
        along = np.full(len(parameters), parameter_damping / (1.0 + parameter_damping))
        solved, cost, predicted, gradient_norm = self.kernel.damped_step(
            control_points, parameters, _BARE_DAMPING, *self.unpack(step), along
        )
        step += x
        return Proposal(step, cost - predicted, gradient_norm) if solved else None

    def solved(self, x: FloatArray) -> FloatArray:
        """The vector with its parameters in data order and the control points that suit them."""
        ordered = x.copy()
        parameters = ordered[self._split :]
        self._put_in_order(parameters, parameters.copy())
        found = self.metric_step(ordered, "point", _BARE_DAMPING)
        return ordered if found is None else found.x

    def _put_in_order(self, parameters: FloatArray, held: FloatArray) -> None:
        """Sort parameters in place, between the ends of those before where ends are held."""
        begin, end = self.template.domain
        if self.ends != "free":
            np.clip(parameters, held[0], held[-1], out=parameters)
        parameters[:] = nondecreasing(parameters, end - begin if self.template.periodic else None)

    def metric_step(self, x: FloatArray, metric: Metric, damping: float) -> Proposal | None:
        """Control points that a quadratic model of the squared distances asks for.

        The parameters stay: `projected` finds them. None if the system has no solution.
        """
        control_points, parameters = self.unpack(x)
        step = np.zeros_like(x)
        solved, cost, predicted, gradient_norm = self.kernel.damped_step(
            control_points, parameters, damping, *self.unpack(step), self._along(x, metric)
        )
        if not solved:
            return None
        step[self._split :] = 0.0
        step += x
        return Proposal(step, cost - predicted, gradient_norm)

    def _along(self, x: FloatArray, metric: Metric) -> FloatArray:
        """Part of each squared residual along the tangent that a metric counts, shape (n,).

        All of it for the point distance, none for the tangent distance; for the squared distance
        d / (d + rho) where the point lies on the outer side of the curve, d away from it and with
        radius of curvature rho there, and none on the inner side (Wang et al., Eq. 16).
        """
        parameters = self.unpack(x)[1]
        if metric != "squared":
            return np.full(len(parameters), 1.0 if metric == "point" else 0.0)
        curve = self.curve(x)
        away = self.points - curve(parameters)
        velocity, acceleration = curve(parameters, derivative=1), curve(parameters, derivative=2)
        bend = velocity[:, 0] * acceleration[:, 1] - velocity[:, 1] * acceleration[:, 0]
        side = velocity[:, 0] * away[:, 1] - velocity[:, 1] * away[:, 0]
        speed = np.hypot(velocity[:, 0], velocity[:, 1])
        # d / rho = |away| |bend| / speed^3; side * bend < 0 on the outer side.
        ratio = np.hypot(away[:, 0], away[:, 1]) * np.abs(bend)
        total = ratio + speed**3
        outer = (side * bend < 0.0) & (total > 0.0)
        return np.divide(ratio, total, out=np.zeros_like(ratio), where=outer)

    def projected(self, x: FloatArray) -> FloatArray:
        """The vector with every parameter at a foot point; its cost is no higher.

        On the whole curve, for a foot point nearby stays on the wrong branch after a large step or
        at the start. But where the curve crosses itself the nearest branch need not be that of the
        neighbours, and the residuals between neighbours that drift apart tell so: then nearby.
        """
        cost = self.cost(x)
        for moved in (self._at_nearest_feet(x), self.projected_nearby(x)):
            if self.cost(moved) <= cost:
                return moved
        return x.copy()

    def _at_nearest_feet(self, x: FloatArray) -> FloatArray:
        """The vector with every parameter at the nearest foot point; no point gets farther away."""
        moved = x.copy()
        parameters = self.unpack(moved)[1]
        curve = self.curve(x)
        feet = nearest(curve, self.points)
        lap = np.zeros(len(parameters))
        if curve.periodic:  # the foot's lap is the one nearest to where the parameter was
            lap = np.round(parameters - feet.parameters)
        nearer = feet.distances_sq < ((curve(parameters) - self.points) ** 2).sum(axis=1)
        if self.ends != "free":
            nearer[[0, -1]] = False
        parameters[nearer] = (feet.parameters + lap)[nearer]
        return moved

    def projected_nearby(self, x: FloatArray) -> FloatArray:
        """The vector with every parameter moved to a foot point near it; no residual grows."""
        moved = x.copy()
        control_points, parameters = self.unpack(moved)
        ends = parameters[[0, -1]]
        _kernels.near_feet(*self._knots, control_points, self.points, _FOOT_STEPS, parameters)
        if self.ends != "free":
            parameters[[0, -1]] = ends
        return moved

    def control_points_for(self, parameters: FloatArray, guess: FloatArray) -> FloatArray:
        """Least-squares control points with the parameters held, shape (m, 2).

        Control points that no data hold stay near their guess: the step from there is damped by
        a relative 1e-9, which the others do not notice.
        """
        control_points, unused = np.empty_like(guess), np.empty_like(parameters)
        held = _kernels.LeastSquares(
            *self._knots, self.points, self.weights, _HOLD_ALL, self.ends == "fixed"
        )
        solved, *_ = held.damped_step(guess, parameters, 1e-9, control_points, unused)
        return guess + control_points if solved else guess

    @property
    def _knots(self) -> tuple[FloatArray, int, bool]:
        template = self.template
        return template.knots, template.degree, template.periodic

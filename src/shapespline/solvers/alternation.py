"""Point-, tangent- and squared-distance minimisation: control points and foot points in turn.

With every parameter at its foot point, the squared distance of a datum Q from the moving curve is
replaced by a quadratic form in the residual r = C(t) - Q,

    F = (r . N)^2 + c (r . T)^2,     T, N the unit tangent and normal at the foot point,

a linear system gives the control points that make the sum of F least, the data are projected again,
and so on. The metrics differ in c:

==========  =====================================================  ===============================
metric      c                                                      known as
==========  =====================================================  ===============================
point       1                                                      PDM: parameter correction, slow
tangent     0                                                      TDM: Gauss-Newton, may overshoot
squared     d / (d + rho) on the outer side of the curve, else 0   SDM: near the Newton step
==========  =====================================================  ===============================

where d is the distance of the datum and rho the radius of curvature. On the inner side the true
coefficient -d / (rho - d) is negative; 0 keeps the form positive semidefinite.

References
----------
.. [1] W. Wang, H. Pottmann, Y. Liu, Fitting B-spline curves to point clouds by curvature-based
   squared distance minimization, ACM Trans. Graph. 25(2), 2006: sections 3 and 4, the
   Levenberg-Marquardt damping of the tangent distance in section 5.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal, Protocol

from shapespline.solvers.iteration import State

if TYPE_CHECKING:
    from shapespline.solvers.levenberg_marquardt import Proposal
    from shapespline.typing import FloatArray

Metric = Literal["point", "tangent", "squared"]

# Damping after a first rejected step, its factor, and where it is given up; 0 is the pure method.
_FIRST_DAMPING, _FACTOR = 1e-4, 10.0
_LEAST_DAMPING, _MOST_DAMPING = 1e-6, 1e16


class FootPointProblem(Protocol):
    """A least-squares problem whose location parameters are foot points."""

    def cost(self, x: FloatArray, /) -> float:
        """Return the cost at ``x``."""

    def metric_step(self, x: FloatArray, metric: Metric, damping: float, /) -> Proposal | None:
        """Return a trial point with the parameters as they are, or None without a solution."""

    def projected(self, x: FloatArray, /) -> FloatArray:
        """Return the point with its parameters at their feet, its cost no higher."""


@dataclass(frozen=True, slots=True, kw_only=True)
class AlternationState(State):
    """The loop's fields and the damping of the next step."""

    damping: float = 0.0


@dataclass(frozen=True, slots=True)
class Alternation:
    """Quadratic steps of the control points, a projection of the data after each.

    A step that lowers the cost is taken and the damping divided by ten, down to none; one that does
    not is dropped and tried again with more.

    Parameters
    ----------
    metric : {"point", "tangent", "squared"}
        What stands for the squared distance.
    patience : int
        See `iteration.Solver.patience`.

    Examples
    --------
    >>> import numpy as np
    >>> from shapespline.solvers import minimize
    >>> from shapespline.solvers import Proposal
    >>> class Line:
    ...     def cost(self, x): return 0.5 * float((x[0] - 3.0) ** 2)
    ...     def projected(self, x): return x
    ...     def metric_step(self, x, metric, damping):
    ...         step = (3.0 - x) / (1.0 + damping)
    ...         return Proposal(x + step, float((x[0] - 3.0) ** 2) / 2, abs(float(x[0]) - 3.0))
    >>> float(minimize(Alternation("tangent"), Line(), [0.0]).x[0])
    3.0
    """

    metric: Metric
    patience: int = 3

    def init(self, problem: FootPointProblem, x: FloatArray) -> AlternationState:
        """Project the start."""
        x = problem.projected(x)
        proposal = problem.metric_step(x, self.metric, _FIRST_DAMPING)
        norm = 0.0 if proposal is None else proposal.gradient_norm
        return AlternationState(x=x, cost=problem.cost(x), gradient_norm=norm)

    def step(
        self, problem: FootPointProblem, state: AlternationState, max_evaluations: int
    ) -> AlternationState:
        """Try steps with rising damping until one lowers the cost."""
        damping, evaluations = state.damping, state.evaluations
        while evaluations < state.evaluations + max_evaluations and damping <= _MOST_DAMPING:
            evaluations += 1
            proposal = problem.metric_step(state.x, self.metric, damping)
            if proposal is not None:
                x = problem.projected(proposal.x)
                cost = problem.cost(x)
                if cost < state.cost:
                    lower = damping / _FACTOR
                    return AlternationState(
                        x=x,
                        cost=cost,
                        gradient_norm=proposal.gradient_norm,
                        evaluations=evaluations,
                        step=damping,
                        damping=lower if lower >= _LEAST_DAMPING else 0.0,
                    )
            damping = max(_FIRST_DAMPING, _FACTOR * damping)
        return replace(state, evaluations=evaluations, step=0.0, stalled=True)

"""Least squares with the parameters held: the linear problem that the others improve upon.

    minimise over P   1/2 sum_j w_j |C(t_j) - Q_j|^2,   t_j as they came

One linear system, ``(sum w N N') P = sum w N Q'``, and the run is over: what most libraries mean by
fitting a B-spline.

References
----------
.. [1] C. de Boor, A Practical Guide to Splines, rev. ed., 2001, chapter XIV.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from shapespline.solvers.iteration import State

if TYPE_CHECKING:
    from shapespline.solvers.alternation import FootPointProblem
    from shapespline.typing import FloatArray

# Relative damping for control points that no data hold; the others do not notice.
_DAMPING = 1e-12


@dataclass(frozen=True, slots=True)
class FixedParameters:
    """One linear step; a second one that gains nothing shows that the minimum is reached."""

    patience: int = 1

    def init(self, problem: FootPointProblem, x: FloatArray) -> State:
        """Evaluate the start."""
        proposal = problem.metric_step(x, "point", _DAMPING)
        norm = 0.0 if proposal is None else proposal.gradient_norm
        return State(x=x, cost=problem.cost(x), gradient_norm=norm)

    def step(self, problem: FootPointProblem, state: State, max_evaluations: int) -> State:
        """Solve for the control points."""
        proposal = problem.metric_step(state.x, "point", _DAMPING)
        evaluations = state.evaluations + 1
        if proposal is None:
            return replace(state, evaluations=evaluations, step=0.0, stalled=True)
        cost = problem.cost(proposal.x)
        lower = cost < state.cost
        return State(
            x=proposal.x if lower else state.x,
            cost=min(cost, state.cost),
            gradient_norm=proposal.gradient_norm,
            evaluations=evaluations,
            step=1.0 if lower else 0.0,
        )

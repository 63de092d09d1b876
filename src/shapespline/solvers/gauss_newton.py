"""Joint Gauss-Newton with a line search: all unknowns at once, no damping.

The residuals are linear in the control points for given parameters and nearly so in both; the step
solves the linearised problem for all of them, and its length is halved until the cost falls by a
part of what the slope promises (Armijo).

References
----------
.. [1] T. Speer, M. Kuppe, J. Hoschek, Global reparametrization for curve approximation, Computer
   Aided Geometric Design 15, 1998: section 3, Gauss-Newton on control points and parameters.
.. [2] J. Nocedal and S. J. Wright, Numerical Optimization, 2nd ed., 2006: Algorithm 3.1.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Protocol

from shapespline.solvers.iteration import State
from shapespline.solvers.line_search import dot

if TYPE_CHECKING:
    from shapespline.solvers.levenberg_marquardt import Proposal
    from shapespline.typing import FloatArray

_ARMIJO = 1e-4
_SHORTEST = 2.0**-30  # of the step: below, the direction does not descend but for rounding


class JointProblem(Protocol):
    """A least-squares problem that solves its own linearisation."""

    def cost(self, x: FloatArray, /) -> float:
        """Return the cost at ``x``."""

    def cost_and_gradient(self, x: FloatArray, /) -> tuple[float, FloatArray]:
        """Return the cost and a fresh gradient array at ``x``."""

    def joint_step(self, x: FloatArray, parameter_damping: float, /) -> Proposal | None:
        """Return where the linearised problem has its minimum, or None without a solution."""


@dataclass(frozen=True, slots=True)
class GaussNewton:
    """Steps of the linearised problem, halved until they lower the cost enough.

    Examples
    --------
    >>> import numpy as np
    >>> from shapespline.solvers import Proposal, minimize
    >>> class Line:
    ...     def cost(self, x): return 0.5 * float((x[0] - 3.0) ** 2)
    ...     def cost_and_gradient(self, x): return self.cost(x), x - 3.0
    ...     def joint_step(self, x, parameter_damping):
    ...         return Proposal(np.array([3.0]), self.cost(x), abs(float(x[0]) - 3.0))
    >>> float(minimize(GaussNewton(), Line(), [0.0]).x[0])
    3.0
    """

    patience: int = 2

    def init(self, problem: JointProblem, x: FloatArray) -> State:
        """Evaluate the start."""
        proposal = problem.joint_step(x, 0.0)
        norm = 0.0 if proposal is None else proposal.gradient_norm
        return State(x=x, cost=problem.cost(x), gradient_norm=norm)

    def step(self, problem: JointProblem, state: State, max_evaluations: int) -> State:
        """Search along the joint step."""
        proposal = problem.joint_step(state.x, 0.0)
        if proposal is None:
            return replace(state, evaluations=state.evaluations + 1, step=0.0, stalled=True)
        direction = proposal.x - state.x
        slope = dot(problem.cost_and_gradient(state.x)[1], direction)
        length, evaluations = 1.0, state.evaluations + 1
        most = state.evaluations + max_evaluations
        while evaluations < most and length >= _SHORTEST:
            evaluations += 1
            x = state.x + length * direction
            cost = problem.cost(x)
            if cost < state.cost and cost <= state.cost + _ARMIJO * length * min(slope, 0.0):
                return State(
                    x=x,
                    cost=cost,
                    gradient_norm=proposal.gradient_norm,
                    evaluations=evaluations,
                    step=length,
                )
            length *= 0.5
        return replace(state, evaluations=evaluations, step=0.0, stalled=True)

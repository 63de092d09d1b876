"""Variable projection: only the parameters are unknown, the control points follow.

For given location parameters t the best control points P(t) solve a linear problem. What is left,
r(t) = C(P(t), t) - Q, is minimised over t alone, by Levenberg-Marquardt with Kaufman's Jacobian
(I - Phi Phi^+) D: the derivatives of the curve by its parameters, freed of what a change of the
control points can take up. That is the step of the joint problem whose parameters alone are damped.

References
----------
.. [1] G. H. Golub, V. Pereyra, The differentiation of pseudo-inverses and nonlinear least squares
   problems whose variables separate, SIAM J. Numer. Anal. 10, 1973.
.. [2] L. Kaufman, A variable projection method for solving separable nonlinear least squares
   problems, BIT 15, 1975: the Jacobian without its second term.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from shapespline.solvers.levenberg_marquardt import LevenbergMarquardt, Proposal

if TYPE_CHECKING:
    from shapespline.solvers.levenberg_marquardt import LevenbergMarquardtState
    from shapespline.typing import FloatArray


class SeparableProblem(Protocol):
    """A problem that is linear in a part of its unknowns."""

    def cost(self, x: FloatArray, /) -> float:
        """Return the cost at ``x``."""

    def joint_step(self, x: FloatArray, parameter_damping: float, /) -> Proposal | None:
        """Return the minimum of the linearised problem, its non-linear unknowns damped."""

    def solved(self, x: FloatArray, /) -> FloatArray:
        """Return the point with its linear unknowns at their best; in the order of the data."""


@dataclass(frozen=True, slots=True)
class VariableProjection:
    """Levenberg-Marquardt on the parameters, the control points solved anew at every trial."""

    patience: int = 2

    def init(self, problem: SeparableProblem, x: FloatArray) -> LevenbergMarquardtState:
        """Solve for the control points of the start."""
        reduced = _Reduced(problem)
        return LevenbergMarquardt(patience=self.patience).init(reduced, problem.solved(x))

    def step(
        self, problem: SeparableProblem, state: LevenbergMarquardtState, max_evaluations: int
    ) -> LevenbergMarquardtState:
        """Try steps of the parameters with rising damping until one lowers the cost."""
        return LevenbergMarquardt(patience=self.patience).step(
            _Reduced(problem), state, max_evaluations
        )


@dataclass(frozen=True, slots=True)
class _Reduced:
    """The problem in the parameters alone."""

    problem: SeparableProblem

    def cost(self, x: FloatArray) -> float:
        return self.problem.cost(x)

    def damped_step(self, x: FloatArray, damping: float) -> Proposal | None:
        proposal = self.problem.joint_step(x, damping)
        if proposal is None:
            return None
        return Proposal(
            self.problem.solved(proposal.x), proposal.predicted_decrease, proposal.gradient_norm
        )

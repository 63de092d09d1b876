"""Levenberg-Marquardt: the damping policy, apart from what is damped.

The problem owns its linear algebra: it proposes a trial point for a damping and predicts what it
gains. This module compares promise and gain, and turns the damping up or down.

References
----------
.. [1] H. B. Nielsen, Damping parameter in Marquardt's method, IMM-REP-1999-05, TU Denmark: the
   smooth update of the damping.
.. [2] K. Madsen, H. B. Nielsen, O. Tingleff, Methods for non-linear least squares problems,
   2nd ed., 2004, Algorithm 3.16: start damping, gain ratio.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Protocol

import numpy as np

from shapespline.errors import InvalidInputError
from shapespline.solvers.iteration import State

if TYPE_CHECKING:
    from shapespline.typing import FloatArray

_EPS = float(np.finfo(np.float64).eps)
_LEAST_DAMPING = 1e-15  # below, it is lost in the undamped diagonal
_MOST_DAMPING = 1e16  # beyond, a step is lost in the rounding of x
_LARGEST_CUT = 1.0 / 3.0  # of the damping in one step, [1]


@dataclass(frozen=True, slots=True)
class Proposal:
    """A trial point, the decrease of the cost that the linear model predicts there.

    ``gradient_norm`` is that of the point the step starts from, in a norm of the problem's
    choice, best one without units: solving for the step has computed the gradient anyway.
    """

    x: FloatArray
    predicted_decrease: float
    gradient_norm: float


class DampedProblem(Protocol):
    """A least-squares problem that can solve its own damped normal equations."""

    def cost(self, x: FloatArray, /) -> float:
        """Return the cost at ``x``."""

    def damped_step(self, x: FloatArray, damping: float, /) -> Proposal | None:
        """Return a trial point, fresh, or None if the factorisation failed."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LevenbergMarquardtState(State):
    """The loop's fields, the damping, its next factor and the proposal to try next."""

    damping: float
    factor: float
    proposal: Proposal | None


@dataclass(frozen=True, slots=True)
class LevenbergMarquardt:
    """Damped Gauss-Newton steps with a damping that follows the gain ratio.

    The gain ratio is the decrease of the cost over the predicted one. A step that lowers the cost
    is taken, and the damping multiplied by ``max(1/3, 1 - (2 ratio - 1)^3)``; one that does not
    is dropped, and the damping multiplied by 2, 4, 8, ... ([1], Eq. 2.5 of [2]).

    Parameters
    ----------
    start_damping : float
        The first damping, relative to the problem's own diagonal.
    patience : int
        See `iteration.Solver.patience`.

    Notes
    -----
    An iteration is one step taken; its rejected trials are part of it, and each proposal counts
    as one evaluation, failed or not. The run stalls where the predicted decrease is below the
    rounding of the cost and the trial is no lower, or the damping has passed 1e16.
    The proposal for the next step is made at once, as it brings the gradient norm; the last one
    of a run is made in vain.

    Examples
    --------
    >>> import numpy as np
    >>> from shapespline.solvers import minimize
    >>> class Sine:
    ...     def cost(self, x): return 0.5 * float(np.sin(x[0])) ** 2
    ...     def damped_step(self, x, damping):
    ...         f, J = np.sin(x[0]), np.cos(x[0])
    ...         s = -J * f / (J * J * (1.0 + damping))
    ...         return Proposal(x + s, -s * J * f - 0.5 * (J * s) ** 2, abs(J * f))
    >>> result = minimize(LevenbergMarquardt(), Sine(), [0.5])
    >>> result.stop.name, bool(abs(result.x[0]) < 1e-6)
    ('GRADIENT', True)
    """

    start_damping: float = 1e-3
    patience: int = 2

    def __post_init__(self) -> None:
        if not 0.0 < self.start_damping < _MOST_DAMPING:
            msg = f"start_damping must be positive and finite, got {self.start_damping}; try 1e-3"
            raise InvalidInputError(msg)

    def init(self, problem: DampedProblem, x: FloatArray) -> LevenbergMarquardtState:
        """Evaluate the start and make the first proposal, raising the damping until one comes."""
        state = LevenbergMarquardtState(
            x=x,
            cost=problem.cost(x),
            gradient_norm=math.nan,
            damping=self.start_damping,
            factor=2.0,
            proposal=None,
        )
        while True:
            state = _proposed(problem, state)
            if state.proposal is not None:
                return state
            state = _raised(state)
            if state.damping > _MOST_DAMPING:
                msg = "damped_step failed at x0 with every damping; start elsewhere"
                raise InvalidInputError(msg)

    def step(
        self, problem: DampedProblem, state: LevenbergMarquardtState, max_evaluations: int
    ) -> LevenbergMarquardtState:
        """Try proposals with rising damping until one lowers the cost."""
        most = state.evaluations + max_evaluations
        state = replace(state, step=0.0)
        while state.evaluations < most:
            proposal = state.proposal
            state = replace(state, evaluations=state.evaluations + 1)
            if proposal is not None:
                cost = problem.cost(proposal.x)
                if cost < state.cost:
                    return _accepted(problem, state, proposal, cost)
                if proposal.predicted_decrease <= _EPS * abs(state.cost):
                    return replace(state, stalled=True)
            state = _raised(state)
            if state.damping > _MOST_DAMPING:
                return replace(state, stalled=True)
            state = _proposed(problem, state)
        return replace(state, stalled=True)


def _proposed(problem: DampedProblem, state: LevenbergMarquardtState) -> LevenbergMarquardtState:
    """Ask for a step with the state's damping."""
    proposal = problem.damped_step(state.x, state.damping)
    norm = state.gradient_norm if proposal is None else proposal.gradient_norm
    return replace(state, proposal=proposal, gradient_norm=norm)


def _raised(state: LevenbergMarquardtState) -> LevenbergMarquardtState:
    """Turn the damping up, faster each time."""
    return replace(
        state, damping=state.damping * state.factor, factor=2.0 * state.factor, proposal=None
    )


def _accepted(
    problem: DampedProblem, state: LevenbergMarquardtState, proposal: Proposal, cost: float
) -> LevenbergMarquardtState:
    """Take a trial point and turn the damping by its gain ratio."""
    gain, promise = state.cost - cost, proposal.predicted_decrease
    ratio = gain / promise if promise > 0.0 else 0.0
    turn = max(_LARGEST_CUT, 1.0 - (2.0 * min(ratio, 1.0) - 1.0) ** 3)
    moved = replace(
        state,
        x=proposal.x,
        cost=cost,
        step=state.damping,
        damping=max(state.damping * turn, _LEAST_DAMPING),
        factor=2.0,
        proposal=None,
    )
    return _proposed(problem, moved)

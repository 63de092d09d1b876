"""The one loop that runs every solver: stopping rules, history, cancelling.

A solver is two functions over an immutable state: `init` and `step`. It proposes points and never
decides when enough is enough; this module does, in one place, and always says why. Running out of
a budget is a result and no error.
"""

from __future__ import annotations

import math
import time
from dataclasses import dataclass
from enum import Enum
from itertools import pairwise
from typing import TYPE_CHECKING, Protocol, TypeVar

import numpy as np

from shapespline.errors import InvalidInputError
from shapespline.monitor import Iteration

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapespline.typing import ArrayLike, FloatArray


class Problem(Protocol):
    """A cost to minimise over a flat float64 vector, with its gradient and natural scale."""

    def cost(self, x: FloatArray, /) -> float:
        """Return the cost at ``x``."""

    def cost_and_gradient(self, x: FloatArray, /) -> tuple[float, FloatArray]:
        """Return the cost and a fresh gradient array at ``x``."""

    def scale(self, x: FloatArray, /) -> FloatArray:
        """Return a positive estimate of the Hessian's diagonal at ``x`` (Gauss-Newton)."""


class Stop(Enum):
    """Why a run ended; the value is a sentence that tells what to do about it."""

    GRADIENT = "converged: the gradient is down to the requested fraction of its start"
    DECREASE = "converged: the cost hardly falls any more; lower relative_decrease to go on"
    TARGET = "the requested target is reached; ask for a lower one to go on"
    NO_DECREASE = (
        "no lower point could be found: round-off is reached, so take x as it is; "
        "far from a minimum, check the gradient and the scale of the variables"
    )
    ITERATIONS = "the iterations ran out before convergence; raise max_iterations"
    EVALUATIONS = "the evaluations ran out before convergence; raise max_evaluations"
    CANCELLED = "the callback cancelled the run; x is the best point so far"

    @property
    def converged(self) -> bool:
        """Whether a convergence test or the target was met (`NO_DECREASE` claims neither)."""
        return self in (Stop.GRADIENT, Stop.DECREASE, Stop.TARGET)


@dataclass(frozen=True, slots=True, kw_only=True)
class Limits:
    """When to stop.

    Parameters
    ----------
    max_iterations : int
        Iterations at most; 0 evaluates the start and returns it.
    max_evaluations : int
        Evaluations of the problem at most, the one at the start included.
    relative_decrease : float
        Stop when the cost falls by no more than this fraction of itself in each of the last
        few iterations (the solver's ``patience``).
    gradient_tolerance : float
        Stop when the gradient norm is at most this fraction of the norm at the start.
    target_cost : float, optional
        Stop as soon as the cost is no larger.
    reached : callable, optional
        ``reached(x)`` tells that the tolerance of the problem itself is met; called once an
        iteration.

    Notes
    -----
    The two tests of convergence are fractions, so that they do not depend on the unit of the
    data; 0 turns each of them off but for an exact standstill.
    """

    max_iterations: int = 1000
    max_evaluations: int = 10_000
    relative_decrease: float = 1e-9
    gradient_tolerance: float = 1e-6
    target_cost: float | None = None
    reached: Callable[[FloatArray], bool] | None = None

    def __post_init__(self) -> None:
        for name, least in (("max_iterations", 0), ("max_evaluations", 1)):
            value = getattr(self, name)
            if not value >= least:
                msg = f"{name} must be at least {least}, got {value}; raise it"
                raise InvalidInputError(msg)
        for name in ("relative_decrease", "gradient_tolerance"):
            value = getattr(self, name)
            if not 0.0 <= value < 1.0:
                msg = f"{name} is a fraction and must be in [0, 1), got {value}; try 1e-6"
                raise InvalidInputError(msg)
        if self.target_cost is not None and math.isnan(self.target_cost):
            msg = "target_cost must be a number, got nan; leave it None for no target"
            raise InvalidInputError(msg)


@dataclass(frozen=True, slots=True)
class Result:
    """The best point found, its cost, why the run ended and how it went."""

    x: FloatArray
    cost: float
    stop: Stop
    history: tuple[Iteration, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class State:
    """What the loop reads of a solver's state; solvers add their own fields.

    ``evaluations`` is cumulative, the one at the start included. ``stalled`` says that the solver
    found no lower point and would find none by trying again.
    """

    x: FloatArray
    cost: float
    gradient_norm: float
    evaluations: int = 1
    step: float = 0.0
    stalled: bool = False


StateT = TypeVar("StateT", bound=State)
ProblemT = TypeVar("ProblemT")
ProblemT_contra = TypeVar("ProblemT_contra", contravariant=True)


class Solver(Protocol[ProblemT_contra, StateT]):
    """A method of minimisation over an immutable state."""

    @property
    def patience(self) -> int:
        """Iterations in a row whose small decrease means convergence.

        A line search step can be short, for one bad direction, in the middle of a descent, so
        one small decrease proves nothing about a quasi-Newton method: 3. A Levenberg-Marquardt
        step is short by accident only when the damping has just been raised: 2.
        """

    def init(self, problem: ProblemT_contra, x: FloatArray) -> StateT:
        """Evaluate the start; the solver may keep ``x`` and must not write to it."""

    def step(self, problem: ProblemT_contra, state: StateT, max_evaluations: int) -> StateT:
        """Return the next state: never a higher cost, never more than the evaluations given."""


def minimize(
    solver: Solver[ProblemT, StateT],
    problem: ProblemT,
    x0: ArrayLike,
    *,
    limits: Limits | None = None,
    callback: Callable[[Iteration], bool | None] | None = None,
    observer: Callable[[Iteration, FloatArray], None] | None = None,
) -> Result:
    """Minimise a problem's cost from a start.

    Parameters
    ----------
    solver : Solver
        From `quasi_newton.make_solver` or `levenberg_marquardt.LevenbergMarquardt`.
    problem : object
        What the solver asks for: `Problem`, or `levenberg_marquardt.DampedProblem`.
    x0 : array_like, shape (n,)
        The start; it is copied.
    limits : Limits, optional
        When to stop.
    callback : callable, optional
        Called with every record, the start's included; a true answer cancels the run.
    observer : callable, optional
        Called with every record and the point that it is about, before the callback.

    Returns
    -------
    Result
        The cost never rises from one record to the next, so the last point is the best.

    Raises
    ------
    InvalidInputError
        If ``x0`` is no flat array of finite numbers, or the cost or gradient there is not finite.

    Examples
    --------
    >>> import numpy as np
    >>> from shapespline.solvers import make_solver
    >>> class Parabola:
    ...     def cost(self, x): return float(x @ x)
    ...     def cost_and_gradient(self, x): return float(x @ x), 2.0 * x
    ...     def scale(self, x): return np.full_like(x, 2.0)
    >>> result = minimize(make_solver("l-bfgs"), Parabola(), [3.0, -4.0])
    >>> result.stop.name, result.cost
    ('GRADIENT', 0.0)
    """
    limits = Limits() if limits is None else limits
    began = time.perf_counter()
    state = solver.init(problem, _checked_start(x0))
    if not (math.isfinite(state.cost) and math.isfinite(state.gradient_norm)):
        msg = (
            f"the cost and gradient at x0 must be finite, got {state.cost} and a gradient norm "
            f"of {state.gradient_norm}; start elsewhere"
        )
        raise InvalidInputError(msg)
    history: list[Iteration] = []
    while True:
        record = Iteration(
            iteration=len(history),
            cost=state.cost,
            paper_error=math.nan,
            gradient_norm=state.gradient_norm,
            evaluations=state.evaluations,
            step=state.step,
            seconds=time.perf_counter() - began,
        )
        history.append(record)
        if observer is not None:
            observer(record, state.x)
        stop = _stop(limits, state, history, solver.patience)
        if callback is not None and callback(record) and stop is None:
            stop = Stop.CANCELLED
        if stop is not None:
            return Result(state.x, state.cost, stop, tuple(history))
        state = solver.step(problem, state, limits.max_evaluations - state.evaluations)


def _checked_start(x0: ArrayLike) -> FloatArray:
    """Return a flat, finite float64 copy."""
    x = np.array(x0, dtype=np.float64)
    if x.ndim != 1 or x.size == 0:
        msg = f"x0 must have shape (n,) with n >= 1, got {x.shape}; flatten it?"
        raise InvalidInputError(msg)
    if not np.isfinite(x).all():
        msg = "x0 must be finite, got nan or infinity; leave out or repair those entries"
        raise InvalidInputError(msg)
    return x


def _stop(limits: Limits, state: State, history: list[Iteration], patience: int) -> Stop | None:
    """Return the reason to stop now; what was achieved comes before what ran out."""
    if limits.target_cost is not None and state.cost <= limits.target_cost:
        return Stop.TARGET
    if limits.reached is not None and limits.reached(state.x):
        return Stop.TARGET
    if state.gradient_norm <= limits.gradient_tolerance * history[0].gradient_norm:
        return Stop.GRADIENT
    if state.stalled and state.evaluations < limits.max_evaluations:
        return Stop.NO_DECREASE
    if state.evaluations >= limits.max_evaluations:
        return Stop.EVALUATIONS
    if _hardly_falls(history, limits.relative_decrease, patience):
        return Stop.DECREASE
    if history[-1].iteration >= limits.max_iterations:
        return Stop.ITERATIONS
    return None


def _hardly_falls(history: list[Iteration], fraction: float, patience: int) -> bool:
    """Whether each of the last ``patience`` iterations lowered the cost by so little."""
    if len(history) <= patience:
        return False
    recent = history[-patience - 1 :]
    return all(
        before.cost - after.cost <= fraction * abs(before.cost)
        for before, after in pairwise(recent)
    )

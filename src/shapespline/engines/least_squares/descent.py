"""A run of a solver on a curve problem: one call of the kernel where nobody listens in between.

The kernel's Levenberg-Marquardt takes the same steps as that of `solvers`, bit for bit. What asks
for every iteration, a callback or a tolerance to be met, and the other methods take the loop there.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from shapespline import _kernels
from shapespline.monitor import Iteration
from shapespline.solvers import (
    LevenbergMarquardt,
    Limits,
    Result,
    Solver,
    Stop,
    minimize,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapespline.engines.least_squares.problem import CurveProblem
    from shapespline.typing import FloatArray

# As the kernel numbers them; what comes after is a start that it cannot begin with.
_STOPS = tuple(Stop)


def go_on(_: int) -> bool:
    """Nobody wants to end."""
    return False


def descend(
    solver: Solver[Any, Any],
    problem: CurveProblem,
    x: FloatArray,
    *,
    limits: Limits,
    callback: Callable[[Iteration], bool | None] | None = None,
    observer: Callable[[Iteration, FloatArray], None] | None = None,
    ask: Callable[[int], bool] = go_on,
) -> Result:
    """What `minimize` finds from a start.

    Parameters
    ----------
    solver : Solver
    problem : CurveProblem
    x : ndarray
        The start.
    limits : Limits
    callback : callable, optional
        Called with every record; a true answer cancels the run.
    observer : callable, optional
        Called with every record and its point.
    ask : callable
        Asked now and then, without a callback, whether to end, and told the number of control
        points.
    """
    size = problem.template.n_control_points
    unheard = callback is None and observer is None and limits.reached is None
    if unheard and isinstance(solver, LevenbergMarquardt):
        result = _descended(solver, problem, x, limits, ask)
        if result is not None:
            return result
    heard = callback or (None if ask is go_on else lambda _: ask(size))
    return minimize(solver, problem, x, limits=limits, callback=heard, observer=observer)


def _descended(
    solver: LevenbergMarquardt,
    problem: CurveProblem,
    x: FloatArray,
    limits: Limits,
    ask: Callable[[int], bool],
) -> Result | None:
    """The run in the kernel; None from a start that is no start, of which `minimize` tells."""
    moved = np.array(x, dtype=np.float64)
    if not np.isfinite(moved).all():
        return None
    stop, history = problem.kernel.descend(
        *problem.unpack(moved),
        _kernels.DescentLimits(
            max_iterations=limits.max_iterations,
            max_evaluations=limits.max_evaluations,
            relative_decrease=limits.relative_decrease,
            gradient_tolerance=limits.gradient_tolerance,
            target_cost=-np.inf if limits.target_cost is None else limits.target_cost,
            start_damping=solver.start_damping,
            patience=solver.patience,
        ),
        ask,
    )
    if stop >= len(_STOPS):
        return None
    records = tuple(
        Iteration(k, cost, np.nan, norm, evaluations, step, seconds)
        for k, (cost, norm, evaluations, step, seconds) in enumerate(history)
    )
    return Result(moved, records[-1].cost, _STOPS[stop], records)

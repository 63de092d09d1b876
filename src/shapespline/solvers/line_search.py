"""Wolfe line searches, strong and weak.

References
----------
.. [1] J. Nocedal and S. J. Wright, Numerical Optimization, 2nd ed., 2006: Algorithms 3.5 and 3.6,
   Eq. 3.6 (weak), 3.7 (strong) and 3.59 (cubic interpolation).
.. [2] J. J. Moré and D. J. Thuente, Line search algorithms with guaranteed sufficient decrease,
   ACM TOMS 20, 1994: the limits of extrapolation and the rule that a bracket must shrink.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from shapespline.errors import InvalidInputError

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapespline.typing import FloatArray

Wolfe = Literal["strong", "weak"]

_EPS = float(np.finfo(np.float64).eps)
_EXTRAPOLATION = (1.1, 4.0)  # times the last interval, [2] section 4
_MARGIN = 0.01  # of the bracket: nearer to an end a trial point teaches nothing
_SHRINKAGE = 0.66  # a bracket must lose a third in two trials, else it is halved, [2] section 4
_RETREAT = 0.1  # of the way to a point where the cost is not finite
_CHUNK = 8192  # below the size at which OpenBLAS splits a dot product among threads


@dataclass(frozen=True, slots=True)
class LineSearchResult:
    """Where a search ended.

    ``success`` says that the Wolfe conditions hold at ``step``. Without it the step still gives
    sufficient decrease and a lower cost, or is 0 (``cost`` and ``gradient`` then as at the start).
    """

    step: float
    cost: float
    gradient: FloatArray
    evaluations: int
    success: bool


class _Point(NamedTuple):
    """The cost along the direction and its derivative, at one step."""

    step: float
    cost: float
    slope: float


def dot(a: FloatArray, b: FloatArray) -> float:
    """Return the inner product of two flat arrays: the same bits with any number of threads.

    Long arrays are summed in fixed chunks and fixed order, each too short for a threaded BLAS to
    split.
    """
    if a.size <= _CHUNK:
        return float(a @ b)
    total = 0.0
    for i in range(0, a.size, _CHUNK):
        total += float(a[i : i + _CHUNK] @ b[i : i + _CHUNK])
    return total


def wolfe_search(
    function: Callable[[FloatArray], tuple[float, FloatArray]],
    x: FloatArray,
    cost: float,
    gradient: FloatArray,
    direction: FloatArray,
    *,
    wolfe: Wolfe = "strong",
    c1: float = 1e-4,
    c2: float = 0.9,
    first_step: float = 1.0,
    max_evaluations: int = 30,
) -> LineSearchResult:
    """Find a step along a descent direction that satisfies the Wolfe conditions.

    The step is bracketed by extrapolation and the bracket narrowed by cubic interpolation
    (Algorithms 3.5 and 3.6 of [1], merged into one loop). Weak and strong differ in one test.

    Parameters
    ----------
    function : callable
        ``function(x)`` returns the cost and a fresh gradient.
    x : ndarray, shape (n,)
        The start of the search.
    cost, gradient : float and ndarray, shape (n,)
        The values at ``x``.
    direction : ndarray, shape (n,)
        The direction; ``gradient @ direction`` must be negative.
    wolfe : {"strong", "weak"}
        ``|slope| <= c2 |slope at 0|``, or ``slope >= c2 * slope at 0`` (Eq. 6 of the paper).
    c1, c2 : float
        Constants of sufficient decrease and of curvature, ``0 < c1 < c2 < 1``.
    first_step : float
        The first trial, positive.
    max_evaluations : int
        Trials at most.

    Returns
    -------
    LineSearchResult
        Without success where the evaluations run out, or where the bracket is so narrow that the
        decrease left in it is below the rounding of the cost.

    Raises
    ------
    InvalidInputError
        If the constants are out of order, the first step is not positive, or the direction does
        not descend.

    Notes
    -----
    A trial with a cost or slope that is not finite counts as too long and is answered by a tenth
    of the way. At most two gradients are kept besides the caller's: that of the best point and
    that of the trial.

    Examples
    --------
    >>> import numpy as np
    >>> x = np.array([2.0])
    >>> found = wolfe_search(lambda x: (float(x @ x), 2.0 * x), x, 4.0, 2.0 * x, -4.0 * x)
    >>> found.success, round(found.step, 12)
    (True, 0.25)
    """
    if not 0.0 < c1 < c2 < 1.0:
        msg = f"c1 and c2 must satisfy 0 < c1 < c2 < 1, got {c1} and {c2}; try 1e-4 and 0.9"
        raise InvalidInputError(msg)
    if not 0.0 < first_step < math.inf:
        msg = f"first_step must be positive and finite, got {first_step}; try 1"
        raise InvalidInputError(msg)
    start = _Point(0.0, cost, dot(gradient, direction))
    if not start.slope < 0.0:
        msg = f"direction must descend, got a slope of {start.slope}; use minus the gradient"
        raise InvalidInputError(msg)

    best, best_gradient = start, gradient
    far: _Point | None = None  # the other end of the bracket, once there is one
    widths = [math.inf, math.inf]  # of the last two brackets
    step = first_step
    evaluations = 0
    while evaluations < max_evaluations:
        evaluations += 1
        point = direction * step
        point += x
        trial_cost, trial_gradient = function(point)
        del point
        trial = _Point(step, trial_cost, dot(trial_gradient, direction))
        if _too_long(trial, start, best, c1):
            far = trial
        elif _curvature_holds(trial, start, c2, wolfe):
            return LineSearchResult(step, trial_cost, trial_gradient, evaluations, True)
        else:
            previous = best
            if (trial.slope >= 0.0) if far is None else _passes(trial, best, far):
                far = previous
            best, best_gradient = trial, trial_gradient
        del trial_gradient
        if far is None:
            step = _extrapolate(previous, best)
        elif _below_rounding(best, far):
            break
        else:
            step = _interpolate(best, far, halve=_stuck(widths, abs(far.step - best.step)))
    if best.cost >= cost:  # sufficient decrease by rounding alone is none
        return LineSearchResult(0.0, cost, gradient, evaluations, False)
    return LineSearchResult(best.step, best.cost, best_gradient, evaluations, False)


def _too_long(trial: _Point, start: _Point, best: _Point, c1: float) -> bool:
    """Whether a trial is no fit end for the lower side of the bracket."""
    if not (math.isfinite(trial.cost) and math.isfinite(trial.slope)):
        return True
    if trial.cost > start.cost + c1 * trial.step * start.slope:
        return True
    return best.step > 0.0 and trial.cost >= best.cost


def _curvature_holds(trial: _Point, start: _Point, c2: float, wolfe: Wolfe) -> bool:
    """Eq. 3.7b of [1] (strong) or 3.6b (weak)."""
    if wolfe == "strong":
        return abs(trial.slope) <= -c2 * start.slope
    return trial.slope >= c2 * start.slope


def _passes(trial: _Point, best: _Point, far: _Point) -> bool:
    """Whether the minimum lies between the old and the new best (Algorithm 3.6 of [1])."""
    return trial.slope * (far.step - best.step) >= 0.0


def _below_rounding(best: _Point, far: _Point) -> bool:
    """Whether the decrease that the slope promises in the bracket cannot show in the cost."""
    width = abs(far.step - best.step)
    if width <= _EPS * max(best.step, far.step):
        return True
    return width * abs(best.slope) <= _EPS * abs(best.cost)


def _stuck(widths: list[float], width: float) -> bool:
    """Note the bracket's width; tell whether two trials failed to narrow it by a third."""
    stuck = width > _SHRINKAGE * widths[0]
    widths[:] = [widths[1], width]
    return stuck


def _extrapolate(previous: _Point, best: _Point) -> float:
    """Return a longer step from two points on a descent."""
    interval = best.step - previous.step
    least, most = (best.step + factor * interval for factor in _EXTRAPOLATION)
    step = _cubic_minimum(previous, best)
    return min(max(step, least), most) if step > best.step else most


def _interpolate(best: _Point, far: _Point, *, halve: bool) -> float:
    """Return a step inside the bracket."""
    width = far.step - best.step
    if not (math.isfinite(far.cost) and math.isfinite(far.slope)):
        return best.step + _RETREAT * width
    fraction = 0.5 if halve else (_cubic_minimum(best, far) - best.step) / width
    if math.isnan(fraction):
        fraction = 0.5
    return best.step + min(max(fraction, _MARGIN), 1.0 - _MARGIN) * width


def _cubic_minimum(a: _Point, b: _Point) -> float:
    """Minimiser of the cubic through two values and slopes (Eq. 3.59 of [1]), nan if none."""
    interval = b.step - a.step
    if interval == 0.0:
        return math.nan
    d1 = a.slope + b.slope + 3.0 * (a.cost - b.cost) / interval
    radicand = d1 * d1 - a.slope * b.slope
    if not 0.0 <= radicand < math.inf:
        return math.nan
    d2 = math.copysign(math.sqrt(radicand), interval)
    denominator = b.slope - a.slope + 2.0 * d2
    if denominator == 0.0:
        return math.nan
    return b.step - interval * (b.slope + d2 - d1) / denominator

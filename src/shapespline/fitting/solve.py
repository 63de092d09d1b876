"""solve: one way from a request to a verified Fit, for sizes, tolerances and estimates alike.

The plan names strategies, each proposes candidates, each candidate is verified in one place, one
order of preference chooses, then repairs ask for parts of the curve anew in the same way.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from shapespline.fitting.choose import Shortlist
from shapespline.fitting.plan import plan
from shapespline.fitting.problem import Problem
from shapespline.fitting.repair import respect_weights, told, uncross, unhook
from shapespline.fitting.streamed import MANY_POINTS, streamed
from shapespline.fitting.verify import finished, verify

if TYPE_CHECKING:
    from shapespline.fitting.request import Request
    from shapespline.fitting.verify import Verified
    from shapespline.monitor import Monitor
    from shapespline.values import Fit


def solve(request: Request, monitor: Monitor) -> Fit:
    """The fit that a request asks for.

    Examples
    --------
    >>> from shapespline.fitting import Request, Settings
    >>> from shapespline.monitor import Monitor
    >>> corner = Request.of([(0, 0), (1, 0), (2, 0), (2, 1)], False, Settings(tolerance=0.1))
    >>> solve(corner, Monitor()).n_stored_points
    3
    """
    fit = answer(request, monitor) if request.tolerance is None else _within(request, monitor)
    return replace(fit, outliers=request.left_out) if len(request.left_out) else fit


def _within(request: Request, monitor: Monitor) -> Fit:
    """The fit within a tolerance after all repairs."""
    fit = _streamed(request, monitor)
    if fit is not None and (fit.kept or monitor.ended):
        return fit
    fit = _repaired(request, monitor)
    if monitor.ended:
        return fit
    return unhook(fit, request, *(partial(one, monitor=monitor) for one in (answer, _repaired)))


def _streamed(request: Request, monitor: Monitor) -> Fit | None:
    """The fit of very many points in chunks, where nothing asks for more."""
    if not request.is_plain or request.style.smoothness != 1 or len(request.contour) < MANY_POINTS:
        return None
    fit = streamed(request, monitor, search)
    if fit is None:
        return None
    fit = told(fit)
    if request.weights is None or not (fit.kept or monitor.ended):
        return fit
    return told(respect_weights(fit, request, partial(answer, monitor=monitor)))


def _repaired(request: Request, monitor: Monitor) -> Fit:
    """The fit within a tolerance, parted where it crosses, and as near to heavy points as asked."""
    ask = partial(answer, monitor=monitor)
    fit = ask(request)
    fit = told(fit) if monitor.ended else uncross(fit, request, ask)
    if request.weights is not None:
        fit = told(respect_weights(fit, request, ask))
    return fit


def answer(request: Request, monitor: Monitor) -> Fit:
    """The fit of a request or a sub-request by the plan alone, nothing repaired.

    With its ends held where free ones stray: both distances allow an end of the curve to be more
    than the tolerance from that of the data, if it is beside them and they pass beside it (FIT-32).
    """
    fit = finished(search(Problem(request), monitor), monitor)
    if monitor.ended or not _end_strays(fit, request):
        return fit
    held = replace(request, constraints=request.constraints._replace(ends=True))
    found = finished(search(Problem(held), monitor), monitor)
    return found if found.kept else fit


def _end_strays(fit: Fit, request: Request) -> bool:
    """Whether a free end of a curve is farther than the tolerance from that of open data."""
    if request.tolerance is None or request.contour.closed or request.constraints.ends:
        return False
    away = fit.control_points[[0, -1]] - request.contour.points[[0, -1]]
    return bool((np.hypot(away[:, 0], away[:, 1]) > request.tolerance).any())


def search(problem: Problem, monitor: Monitor) -> Verified:
    """The best of what the strategies of the plan propose, each verified."""
    shortlist = Shortlist(problem)
    for strategy in plan(problem, shortlist, monitor, search):
        proposals = strategy.propose(problem, monitor)
        with suppress(StopIteration):
            candidate = next(proposals)
            while True:
                verified = verify(candidate, problem.request)
                shortlist.add(verified)
                candidate = proposals.send(verified)
        if monitor.ended and len(shortlist):
            break
    return shortlist.best

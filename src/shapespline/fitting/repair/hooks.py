"""Hooks that a search has left: the pieces about them are asked for again, closer, or everything.

Moves of the search make none (PIE-27); joints that had to be made smooth, tangents and points that
are kept exactly, and single splines of data that turn back do.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from shapespline.fitting.repair.assignment import PieceAssignment, distances_sq
from shapespline.fitting.repair.crossings import CROSSES, FOLLOWING, NEARLY_ALL, told
from shapespline.fitting.repair.reading import Reading
from shapespline.fitting.repair.refit import (
    Refit,
    Window,
    fitted_again,
    turned_apart,
    verified_row,
    windows_around,
)
from shapespline.fitting.verify import verified_anew
from shapespline.geometry import chords_for_hooks, hooks

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapespline.fitting.request import Request
    from shapespline.typing import FloatArray
    from shapespline.values import Fit

# Parts of the tolerance that windows are fitted within, and how many neighbours on each side go
# with them; parts for everything, of curves of no more stored points, or of no more data, where one
# spline was asked for and has no windows of more (FIT-27).
STEPS = ((0.75, 0), (0.75, 1), (0.5, 1), (0.25, 1))
WHOLE, MOST_POINTS, MOST_OF_ONE_SPLINE = (0.97, 0.9, 0.65, 0.35), 300, 1000
# Windows that take more than so many times the points before compete with everything fitted again,
# within no less than this part (FIT-29).
CHEAP, CLOSEST_FOR_FEWER = 1.03, 0.9
# Pieces this near to a hook, in tolerances, are fitted again.
ABOUT = 0.5
# Boxes of pieces are looked at first, so much farther: distances are rounded.
BOXES = 1.001
TURNS_BACK = "it turns back where the data do not"


def unhook(
    fit: Fit, request: Request, ask: Callable[[Request], Fit], whole: Callable[[Request], Fit]
) -> Fit:
    """A fit that turns back no more than its data, as far as other pieces bring that about.

    ``ask`` answers sub-requests by the plan alone, ``whole`` with all other repairs. Where a hook
    is left the status says so.
    """
    if not fit.kept or not len(_hooks_of(fit, request)):
        return fit
    best = fit
    most = MOST_OF_ONE_SPLINE if request.style.form == "spline" else MOST_POINTS
    few = min(fit.n_stored_points, len(fit.contour)) <= most
    is_rough = not few and fit.n_stored_points > NEARLY_ALL * len(fit.contour)
    is_plain = request.is_plain and request.weights is None and request.style.smoothness == 1
    if is_plain and not is_rough:
        best = _better(best, _windows_again(best, request, ask), request)
    for part in WHOLE if few else ():
        if not len(_hooks_of(best, request)) and (
            best.n_stored_points <= CHEAP * fit.n_stored_points or part < CLOSEST_FOR_FEWER
        ):
            break
        closer = replace(request.closer(part * fit.tolerance), weights=request.weights)
        best = _better(best, verified_anew(fit, whole(closer)), request)
    if not len(_hooks_of(best, request)):
        return best
    return replace(fit, status=fit.status.saying(f"{fit.status.value}; {TURNS_BACK}"))


def _hooks_of(fit: Fit, request: Request) -> FloatArray:
    """Where the curve of a fit has hooks, but for tangents at its ends that were asked for.

    In canonical order: where a hook is in a turn must not depend on the direction of the data.
    """
    reading, line = Reading.of(fit.contour), chords_for_hooks(fit.spline, fit.tolerance)
    way = -1 if reading.is_backwards else 1
    data = reading.contour(fit.contour)
    places = hooks(line[::way], data.polyline, fit.tolerance, closed=data.closed)
    for wanted, end in zip(request.constraints.tangents, line[[0, -1]], strict=True):
        if wanted is not None:
            places = places[np.hypot(*(places - end).T) > fit.tolerance]
    return places


def _better(fit: Fit, found: Fit, request: Request) -> Fit:
    """What was found, if it is kept, has fewer hooks, or points, and crosses no more."""

    def rank(one: Fit) -> tuple[int, int]:
        return len(_hooks_of(one, request)), one.n_stored_points

    if not found.kept or rank(found) >= rank(fit):
        return fit
    found = told(found)
    if found.status.value.endswith(CROSSES) and not fit.status.value.endswith(CROSSES):
        return fit
    return found


def _windows_again(fit: Fit, request: Request, ask: Callable[[Request], Fit]) -> Fit:
    """A fit in pieces with those about its hooks fitted closer, in the canonical order."""
    if fit.method not in FOLLOWING or not fit.sections or fit.regularities:
        return fit
    reading, refit = Reading.of(fit.contour), Refit(request, ask)
    read = reading.fit(fit)
    row = PieceAssignment.of(0, read)
    for part, beside in STEPS:
        found = _hooked_parts(row)
        if not found:
            break
        if fit.contour.closed and beside:
            row, found = turned_apart(row, found)
        windows = [
            Window(begin, end, part * fit.tolerance)
            for begin, end in windows_around(found, beside, len(row.parts))
        ]
        row = fitted_again(row, windows, refit)
    return reading.restored(fit, read, verified_row(row))


def _hooked_parts(row: PieceAssignment) -> list[int]:
    """The parts of a row about its hooks."""
    tolerance = row.fit.tolerance
    data = row.fit.contour
    places = hooks(row.line, data.polyline, tolerance, closed=data.closed)
    reach = ABOUT * tolerance
    low = np.array([part.line.min(axis=0) for part in row.parts]) - BOXES * reach
    high = np.array([part.line.max(axis=0) for part in row.parts]) + BOXES * reach
    found = set()
    for place in places:
        for k in np.flatnonzero(((place >= low) & (place <= high)).all(axis=1)).tolist():
            if distances_sq(place, row.parts[k].line).min() <= reach**2:
                found.add(k)
    return sorted(found)

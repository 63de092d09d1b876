"""Points that weigh more than one are kept within a smaller distance than the tolerance.

A curve goes through a few such points. Of many only the pieces that hold them are fitted closer,
where the fit allows it; one spline, and pieces that hold more than their data, as a whole.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.engines.least_squares import given_weights
from shapespline.fitting.repair.assignment import PieceAssignment
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
from shapespline.geometry import joined, nearest
from shapespline.values import Status

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from shapespline.fitting.request import Request
    from shapespline.typing import ArrayLike, FloatArray, IntArray
    from shapespline.values import BSplineCurve, Contour, Fit

    # Everything within a distance, through some of the points.
    Whole = Callable[[float, "IntArray | None"], Fit]

# So many neighbours on each side are fitted again with a piece that holds heavy points: none at
# first, then those that share its nodes, for a node may be what is too far away.
BESIDE = (0, 1, 2)
# One curve is fitted closer as a whole for a few points only if their limits are at least this part
# of the tolerance.
MODEST = 0.1
# A window goes through up to so many points that are too far away; beyond, it comes closer to all
# of its points.
FEW = 8
# Parts of the tolerance within which everything is fitted; at last within the least limit.
CLOSER = (0.7, 0.5, 0.25, 0.0)


class Limits(NamedTuple):
    """How near the curve is to come to each point of a contour: tolerance / weight, or less."""

    lengths: FloatArray
    tolerance: float

    @classmethod
    def of(cls, weights: ArrayLike, contour: Contour, tolerance: float) -> Limits:
        """Of points that coincide the heaviest counts; a weight below one loosens nothing.

        Examples
        --------
        >>> from shapespline import Contour
        >>> contour = Contour([(0, 0), (1, 0), (1, 1)], closed=False)
        >>> Limits.of([0.5, 1, 4], contour, 0.2).lengths.tolist()
        [0.2, 0.2, 0.05]
        """
        given = given_weights(weights, contour)
        heaviest = np.ones(len(contour))
        np.maximum.at(heaviest, contour.source, given)
        return cls(tolerance / heaviest, tolerance)

    def missed(self, curve: BSplineCurve, contour: Contour) -> NDArray[np.bool_]:
        """Which points are farther from a curve than their limit, among those that have one."""
        missed = np.zeros(len(contour), dtype=bool)
        heavy = np.flatnonzero(self.lengths < self.tolerance)
        distances_sq = nearest(curve, contour.points[heavy]).distances_sq
        missed[heavy] = distances_sq > self.lengths[heavy] ** 2
        return missed


def respect_weights(fit: Fit, request: Request, ask: Callable[[Request], Fit]) -> Fit:
    """A fit within a tolerance that comes as near to heavy points as their weights say."""
    if request.weights is None or request.tolerance is None:
        return fit
    limits = Limits.of(request.weights, request.contour, request.tolerance)
    # In canonical order: what is held does not depend on which point of the data is the first.
    reading = Reading.of(request.contour, limits.lengths)
    limits = limits._replace(lengths=limits.lengths[reading.order])
    asked = request.read(reading.order, is_backwards=reading.is_backwards)
    style = request.style
    apart = request.is_plain and style.form != "spline" and style.smoothness == 1

    def whole(within: float, through: IntArray | None) -> Fit:
        return ask(asked.closer(within, through))

    read = reading.fit(fit)
    found = weighted(read, limits, Refit(asked, ask) if apart else None, whole)
    return reading.restored(fit, read, found)


def weighted(fit: Fit, limits: Limits, refit: Refit | None, whole: Whole) -> Fit:
    """A fit that keeps its tolerance and comes as near to heavy points as their limits say.

    ``refit`` is that of `fitted_again`, None if pieces cannot be fitted apart; ``whole`` fits
    everything within a distance. The smallest that follows is taken.
    """
    missed = np.flatnonzero(limits.missed(fit.spline, fit.contour))
    if not fit.kept or not len(missed):
        return fit
    tried = []
    if refit is not None:
        tried += [verified_row(_closer(fit, limits, refit, few)) for few in (FEW, 0)]
        if len(missed) <= FEW:
            tried.append(whole(fit.tolerance, missed))
    # What is smooth everywhere may stay so for as few points, unless a few ask for very much.
    modest = len(missed) > FEW or limits.lengths.min() >= MODEST * fit.tolerance
    if (not fit.sections and modest) or not any(_follows(found, limits) for found in tried):
        tried.append(_closer_whole(fit, limits, whole))
    following = [found for found in tried if _follows(found, limits)]
    if following:
        return min(following, key=lambda found: found.n_stored_points)
    return replace(
        fit,
        status=Status.EXCEEDED.saying(
            f"{fit.status.value}; but {len(missed)} points are farther away than tolerance /"
            " weight: take a larger tolerance or smaller weights"
        ),
    )


def _follows(fit: Fit, limits: Limits) -> bool:
    """Whether a fit keeps its tolerance and all limits."""
    return fit.kept and not limits.missed(fit.spline, fit.contour).any()


def _closer_whole(fit: Fit, limits: Limits, whole: Whole) -> Fit:
    """Everything fitted closer, as far as need be."""
    again, least = fit, float(limits.lengths.min())
    for part in CLOSER:
        within = max(part * fit.tolerance, least)
        again = verified_anew(fit, whole(within, None))
        if within <= least or _follows(again, limits):
            break
    return again


def _closer(fit: Fit, limits: Limits, refit: Refit, few: int) -> PieceAssignment:
    """The row of the fit with the pieces that miss a limit fitted again, and those beside them.

    Up to ``few`` points of a window that are missed are gone through.
    """
    row = PieceAssignment.of(0, fit)
    for beside in BESIDE:
        missed, found = _missed(row, limits)
        if not found:
            break
        if fit.contour.closed and beside:
            row, _ = turned_apart(row, found)
            missed, found = _missed(row, limits)
        windows = [
            _window(row, begin, end, missed, limits, few if beside < BESIDE[-1] else 0)
            for begin, end in windows_around(found, beside, len(row.parts))
        ]
        row = fitted_again(row, windows, refit)
    return row


def _window(
    row: PieceAssignment, begin: int, end: int, missed: NDArray[np.bool_], limits: Limits, few: int
) -> Window:
    """Parts to fit again: through the points that are missed if they are few, or else closer."""
    first, last = row.parts[begin].begin, row.parts[end - 1].end
    far = first + np.flatnonzero(missed[first:last])
    if len(far) <= few:
        return Window(begin, end, limits.tolerance, tuple(far.tolist()))
    return Window(begin, end, float(_along(row, limits)[first:last].min()))


def _missed(row: PieceAssignment, limits: Limits) -> tuple[NDArray[np.bool_], list[int]]:
    """Which points are too far from the curve, in the order of a row; and in which parts."""
    curve = joined([part.piece for part in row.parts], row.fit.degree)
    missed = np.roll(limits.missed(curve, row.fit.contour), -_first(row))
    found = [k for k, part in enumerate(row.parts) if missed[part.begin : part.end].any()]
    return missed, found


def _along(row: PieceAssignment, limits: Limits) -> FloatArray:
    """The limits in the order of a row."""
    return np.roll(limits.lengths, -_first(row))


def _first(row: PieceAssignment) -> int:
    """The contour's index of the first point of a row."""
    contour = row.fit.contour
    return int(np.abs(contour.arc_length - row.data.along[0] % contour.length).argmin())

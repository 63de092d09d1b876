"""Pieces fitted again between their nodes, closer, where something is asked of them only.

A closer fit of everything would cost points everywhere; here a window of pieces is taken out of the
row of a fit and fitted to its own points, or to points that were moved, with its outer nodes and
the tangents there held.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.fitting.repair.assignment import AssignedPiece, PieceAssignment, located, pieces_of
from shapespline.fitting.verify import verified_fit
from shapespline.geometry import hooks, joined, turn_between
from shapespline.values import SMOOTH_TURN, Contour

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapespline.fitting.repair.assignment import DataRun
    from shapespline.fitting.request import Request, Tangents
    from shapespline.typing import FloatArray
    from shapespline.values import Fit

    # The points of a window, of its row and data, as they are to be fitted.
    TargetPoints = Callable[[PieceAssignment, Sequence[AssignedPiece], DataRun], FloatArray]


@dataclass(frozen=True, eq=False)
class Refit:
    """Asks for some points of a request to be fitted again, by a sub-request."""

    request: Request
    ask: Callable[[Request], Fit]

    @property
    def holds_ends(self) -> bool:
        """Whether the ends of open data are kept."""
        return self.request.constraints.ends

    def __call__(
        self, contour: Contour, within: float, tangents: Tangents, through: Sequence[int]
    ) -> Fit:
        """An open row of points within a distance, its ends kept, through some of the points."""
        return self.ask(self.request.part(contour, within, tangents, through))


class Window(NamedTuple):
    """Neighbours ``begin`` up to ``end`` in a row, and the distance to fit them within.

    They go through the points ``through`` of its data.
    """

    begin: int
    end: int
    within: float
    through: tuple[int, ...] = ()


def turned_apart(row: PieceAssignment, found: Sequence[int]) -> tuple[PieceAssignment, list[int]]:
    """The row of a closed fit, beginning away from the parts found; and these in it."""
    count = len(row.parts)

    def found_beside(at: int) -> tuple[int, int]:
        # Of equals another than it begins with now.
        return (at in found) + ((at - 1) % count in found), abs(at - count // 2)

    first = min(range(count), key=found_beside)
    return row.turned(first), [(at - first) % count for at in found]


def windows_around(found: Sequence[int], beside: int, count: int) -> list[tuple[int, int]]:
    """Runs of neighbours (begin, end) around some of so many parts, each once.

    Examples
    --------
    >>> windows_around([0, 2, 7], beside=1, count=9)
    [(0, 4), (6, 9)]
    """
    windows: list[tuple[int, int]] = []
    for at in sorted(found):
        begin, end = max(at - beside, 0), min(at + beside + 1, count)
        if windows and beside and begin <= windows[-1][1]:
            begin = windows.pop()[0]
        windows.append((begin, end))
    return windows


def fitted_again(
    row: PieceAssignment,
    windows: Sequence[Window],
    refit: Refit,
    target_points: TargetPoints | None = None,
) -> PieceAssignment:
    """The row with some windows of its parts fitted again.

    ``refit`` fits an open row of points within a distance, with its ends and, where given, its end
    tangents, through some of the points.
    """
    parts = list(row.parts)
    for window in reversed(windows):
        parts[window.begin : window.end] = _window_again(row, window, refit, target_points)
    return row._replace(parts=tuple(parts))


def _window_again(
    row: PieceAssignment, window: Window, refit: Refit, target_points: TargetPoints | None
) -> tuple[AssignedPiece, ...]:
    """Parts fitted again, with their outer nodes and the smooth tangents there."""
    parts, within = row.parts[window.begin : window.end], window.within
    first, last = parts[0].piece.control_points, parts[-1].piece.control_points
    data = row.data.part(parts[0].begin, parts[-1].end)
    points = data.points if target_points is None else target_points(row, parts, data)
    # What is so near to an outer node is kept by it, and may lie behind it.
    begin, beyond = first[:1], _beyond(data.points, first[0], within)
    end, before_last = last[-1:], _beyond(data.points[::-1], last[-1], within)
    # A free end goes with its points: held beside them it would be a hook.
    if not row.fit.contour.closed and not refit.holds_ends and len(points):
        if window.begin == 0:
            begin, beyond = points[:0], 0
        if window.end == len(row.parts):
            end, before_last = points[:0], 0
    inner = points[beyond : len(points) - before_last]
    row_of_points = np.concatenate([begin, inner, end])
    contour = Contour.silently(row_of_points, closed=False)
    before = parts[0].begin + beyond - len(begin)
    among = [at - before for at in window.through if 0 < at - before < len(row_of_points) - 1]
    through = contour.source[among].tolist() if among else []
    free: Tangents = (None, None)
    as_it_was = _hooks(row, window, parts)
    for tangents in (_tangents(row, window), free):
        fit = refit(contour, within, tangents, through)
        found = located(data, pieces_of(fit), row.fit.tolerance, parts[0].begin)
        if (fit.kept or tangents is free) and _hooks(row, window, found) <= as_it_was:
            return found
    return parts


def _hooks(row: PieceAssignment, window: Window, parts: tuple[AssignedPiece, ...]) -> int:
    """Hooks of parts in the place of a window, those where they meet its neighbours among them."""
    beside = row.parts[max(window.begin - 1, 0) : window.begin], row.parts[window.end :][:1]
    chain = [*beside[0], *parts, *beside[1]]
    data = row.data.part(max(chain[0].begin - 1, 0), chain[-1].end + 1)
    line = np.concatenate([part.line for part in chain])
    closed = row.fit.contour.closed
    return len(hooks(line, data.points, row.fit.tolerance, closed=closed))


def _beyond(points: FloatArray, node: FloatArray, within: float) -> int:
    """How many points from the first on are this near to a node; none if all are."""
    return int(np.argmax(np.hypot(*(points - node).T) > within)) if len(points) else 0


def _tangents(row: PieceAssignment, window: Window) -> Tangents:
    """The tangents at the outer nodes of a window, where its neighbours go on smoothly."""
    pieces, closed = [part.piece for part in row.parts], row.fit.contour.closed
    begin, end = window.begin, window.end
    tangents: list[FloatArray | None] = [None, None]
    if (begin > 0 or closed) and abs(turn_between(pieces[begin - 1], pieces[begin])) < SMOOTH_TURN:
        tangents[0] = np.diff(pieces[begin].control_points[:2], axis=0)[0]
    after = pieces[end % len(pieces)]
    if (end < len(pieces) or closed) and abs(turn_between(pieces[end - 1], after)) < SMOOTH_TURN:
        tangents[1] = np.diff(pieces[end - 1].control_points[-2:], axis=0)[0]
    return tangents[0], tangents[1]


def verified_row(row: PieceAssignment) -> Fit:
    """The fit of a row, unless it breaks the promise that was kept."""
    fit, pieces = row.fit, tuple(part.piece for part in row.parts)
    again = verified_fit(
        fit.contour,
        joined(pieces, fit.degree),
        tolerance=fit.tolerance,
        method=fit.method,
        sections=pieces,
        history=fit.history,
    )
    # Where data overlap a piece may have been given the points of another: the promise comes first.
    return fit if fit.kept and not again.kept else again

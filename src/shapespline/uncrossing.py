"""Curves that cross where their data do not: the pieces that cross are fitted again, closer.

A slit that is narrower than the tolerance closes when both of its sides may move by it. A closer
fit of everything would keep it open at the price of points everywhere; here only the pieces beside
it are fitted to their own data again, between their nodes and with their tangents, a quarter of
the distance away, until they no longer cross.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.contour import Contour
from shapespline.crossings import crossing_pairs, self_crossings
from shapespline.curve import BSplineCurve
from shapespline.drawing import Piece
from shapespline.exact import sampled
from shapespline.joining import joined, turn_between
from shapespline.verification import verified_fit

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from shapespline.drawing import Fit
    from shapespline.typing import FloatArray

# Curves are looked at as polylines within this part of their tolerance.
SAMPLING_PART = 0.02
# Pieces that cross are fitted so many times again, each time within this part of the distance.
ROUNDS, CLOSER = 5, 0.25
# A node belongs to the nearest of the points whose arc length is this near to its own, in parts of
# the piece before it and in tolerances. Joints that turn less than this, radians, are smooth.
ALONG, TOLERANCES, SMOOTH = 0.3, 4.0, np.radians(1.0)

# Searches that follow the points. What was estimated from noisy ones would follow their noise.
FOLLOWING = ("sections", "removal")
CROSSES = "it crosses a curve where the data do not"

Tangents = tuple["FloatArray | None", "FloatArray | None"]


class Part(NamedTuple):
    """A piece, the points that it stands for with its nodes at both ends, and its distance."""

    piece: Piece
    points: FloatArray
    within: float

    @property
    def line(self) -> FloatArray:
        """The piece as a polyline."""
        piece = self.piece
        curve = BSplineCurve(piece.knots, piece.control_points, piece.degree)
        return sampled(curve, SAMPLING_PART * self.within)[0].polyline


def uncrossed(
    contours: Sequence[Contour],
    fits: Sequence[Fit],
    refit: Callable[[Contour, float, Tangents], Fit],
) -> list[Fit]:
    """Fits whose curves cross no more than their data, as far as closer pieces bring that about.

    ``refit`` fits an open row of points within a distance, with its ends and, where given, its end
    tangents. Fits that cross after all say so in their status.
    """
    lines = [sampled(fit.spline, SAMPLING_PART * fit.tolerance)[0].polyline for fit in fits]
    if not _new_crossings(contours, lines):
        return list(fits)
    parts = [_parts(fit.contour, _pieces(fit), fit.tolerance) for fit in fits]
    changed: set[int] = set()
    crossing: list[tuple[int, int]] = []
    for turn in range(ROUNDS + 1):
        crossing = _crossing_parts(contours, parts)
        owners = {owner for owner, _ in crossing if fits[owner].method in FOLLOWING}
        if turn == ROUNDS or not owners:
            break
        for owner in owners:
            row, closed = parts[owner], fits[owner].closed
            found = [at for other, at in crossing if other == owner]
            # Where that was not enough a node is to blame, which goes with both of its pieces.
            for begin, end in reversed(_windows(found, int(turn > 0), len(row))):
                row[begin:end] = _closer(row, begin, end, closed, refit)
            changed.add(owner)
    still = {owner for owner, _ in crossing}
    result = [_told(fit) if i in still else fit for i, fit in enumerate(fits)]
    for owner in changed:
        fit = fits[owner]
        pieces = tuple(part.piece for part in parts[owner])
        again = verified_fit(
            fit.contour,
            joined(pieces, fit.degree),
            tolerance=fit.tolerance,
            method=fit.method,
            sections=pieces,
            history=fit.history,
        )
        # Where data overlap a piece may have been given the points of another: the promise comes
        # first.
        broken = fit.kept and not again.kept
        result[owner] = fit if broken else again
        if broken or owner in still:
            result[owner] = _told(result[owner])
    return result


def _told(fit: Fit) -> Fit:
    sentence = fit.status.value
    if sentence.endswith(CROSSES):
        return fit
    return replace(fit, status=fit.status.saying(f"{sentence}; {CROSSES}"))


def _pieces(fit: Fit) -> tuple[Piece, ...]:
    """The pieces of a fit; the Beziers of a single spline."""
    if fit.sections:
        return fit.sections
    knots = np.repeat([0.0, 1.0], fit.degree + 1)
    beziers = fit.spline.beziers().points
    return tuple(Piece("bezier", fit.degree, knots, points.copy()) for points in beziers)


def _parts(contour: Contour, pieces: Sequence[Piece], within: float) -> list[Part]:
    """Pieces with the points between their nodes, found along the arc lengths of both."""
    points = contour.polyline
    nodes = np.array([piece.control_points[0] for piece in pieces])
    if contour.closed:
        first = int(((contour.points - nodes[0]) ** 2).sum(axis=1).argmin())
        points = np.roll(contour.points, -first, axis=0)
        points = np.concatenate([points, points[:1]])
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    lengths = np.array([_length(piece) for piece in pieces])
    stretch = along[-1] / lengths.sum()
    begins = [0]
    for node, length in zip(nodes[1:], lengths[:-1] * stretch, strict=True):
        reach = ALONG * length + TOLERANCES * within
        target = along[begins[-1]] + length
        low, high = np.searchsorted(along, [target - reach, target + reach])
        low = min(max(int(low), begins[-1]), len(points) - 1)
        near = points[low : max(int(high), low + 1)]
        begins.append(low + int(((near - node) ** 2).sum(axis=1).argmin()))
    begins.append(len(points) - 1)
    return [
        Part(
            piece,
            np.concatenate(
                [piece.control_points[:1], points[i + 1 : k], piece.control_points[-1:]]
            ),
            within,
        )
        for piece, (i, k) in zip(pieces, pairwise(begins), strict=True)
    ]


def _length(piece: Piece) -> float:
    if piece.degree == 1:
        return float(np.hypot(*np.diff(piece.control_points, axis=0).T).sum())
    return BSplineCurve(piece.knots, piece.control_points, piece.degree).length()


def _crossing_parts(
    contours: Sequence[Contour], parts: Sequence[Sequence[Part]]
) -> list[tuple[int, int]]:
    """Contour and index of the parts that cross others, or themselves, where no data cross."""
    lines = [[part.line for part in row] for row in parts]
    whole = [np.concatenate([*(line[:-1] for line in row), row[-1][-1:]]) for row in lines]
    found: set[tuple[int, int]] = set()
    for i, j in _new_crossings(contours, whole):
        mine = [(i, k) for k in range(len(lines[i]))]
        yours = [] if i == j else [(j, k) for k in range(len(lines[j]))]
        places = mine + yours
        for a, b in crossing_pairs([lines[owner][k] for owner, k in places]):
            if i == j or places[a][0] != places[b][0]:
                found |= {places[a], places[b]}
        if i == j:
            found |= {(i, k) for _, k in mine if self_crossings(lines[i][k])}
    return sorted(found)


def _new_crossings(
    contours: Sequence[Contour], lines: Sequence[FloatArray]
) -> set[tuple[int, int]]:
    """Pairs of contours whose lines cross but not their data; (i, i) of one that crosses itself."""
    data = [contour.polyline for contour in contours]
    pairs = {
        pair for pair in crossing_pairs(lines) if not crossing_pairs([data[pair[0]], data[pair[1]]])
    }
    return pairs | {
        (index, index)
        for index, line in enumerate(lines)
        if self_crossings(line) > self_crossings(data[index])
    }


def _windows(found: Sequence[int], beside: int, count: int) -> list[tuple[int, int]]:
    """Runs of neighbours (begin, end) around some indices, each once."""
    windows: list[tuple[int, int]] = []
    for at in sorted(found):
        begin, end = max(at - beside, 0), min(at + beside + 1, count)
        if windows and beside and begin <= windows[-1][1]:
            begin = windows.pop()[0]
        windows.append((begin, end))
    return windows


def _closer(
    row: Sequence[Part],
    begin: int,
    end: int,
    closed: bool,
    refit: Callable[[Contour, float, Tangents], Fit],
) -> list[Part]:
    """Parts fitted again to their own points, with their outer nodes and smooth tangents there."""
    window = row[begin:end]
    within = CLOSER * min(part.within for part in window)
    first, last = window[0].piece.control_points, window[-1].piece.control_points
    inner = [part.points[1:-1] for part in window]
    contour = Contour.silently(np.concatenate([first[:1], *inner, last[-1:]]), closed=False)
    before = row[begin - 1].piece if begin > 0 or closed else None
    after = row[end % len(row)].piece if end < len(row) or closed else None
    tangents: list[FloatArray | None] = [None, None]
    if before is not None and abs(turn_between(before, window[0].piece)) < SMOOTH:
        tangents[0] = first[1] - first[0]
    if after is not None and abs(turn_between(window[-1].piece, after)) < SMOOTH:
        tangents[1] = last[-1] - last[-2]
    fit = refit(contour, within, (tangents[0], tangents[1]))
    if not fit.kept:
        fit = refit(contour, within, (None, None))
    return _parts(contour, _pieces(fit), within)

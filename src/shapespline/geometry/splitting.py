"""Curves cut at parameters, exactly, by blossoms (Ramshaw 1989)."""

from __future__ import annotations

from itertools import pairwise
from math import ceil
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.geometry.joining import blossom
from shapespline.values import FULL_TURN, BSplineCurve, Piece

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.values import Arc


class PlacedPiece(NamedTuple):
    """A piece and the parameters of the whole curve where it begins and ends."""

    piece: Piece
    begin: float
    end: float


def placed_pieces(pieces: Sequence[Piece], curve: BSplineCurve) -> list[PlacedPiece]:
    """Where the pieces lie that a curve was made of by `joined`.

    Every piece gives the curve one span for each of its own.
    """
    counts = [piece.n_beziers for piece in pieces]
    ends = curve.breakpoints[np.concatenate([[0], np.cumsum(counts)])].tolist()
    return [PlacedPiece(*item) for item in zip(pieces, ends[:-1], ends[1:], strict=True)]


def cut_pieces(pieces: Sequence[PlacedPiece], cuts: Sequence[float]) -> list[tuple[Piece, ...]]:
    """The pieces from each cut to the next, those that a cut meets cut in two.

    Parameters
    ----------
    pieces : sequence of PlacedPiece
        End to end.
    cuts : sequence of float
        Increasing, within what the pieces cover.
    """
    parts = []
    for begin, end in pairwise(cuts):
        within = [item for item in pieces if item.end > begin and item.begin < end]
        part = [_between(item, max(begin, item.begin), min(end, item.end)) for item in within]
        parts.append(tuple(part))
    return parts


def _between(item: PlacedPiece, begin: float, end: float) -> Piece:
    """What lies of a piece between two parameters of the whole curve."""
    piece, width = item.piece, item.end - item.begin
    if begin == item.begin and end == item.end:
        return piece
    first, last = piece.knots[[0, -1]].tolist()
    a, b = (first + (last - first) * (at - item.begin) / width for at in (begin, end))
    return part_of(piece, a, b)


def part_of(piece: Piece, begin: float, end: float) -> Piece:
    """A piece between two of its parameters, over [0, 1].

    Of an arc that is an arc between the angles of the twin there. Of other kinds its inner knots
    stay; control point i is the blossom at the knots i + 1 to i + degree of any polynomial in its
    support (Ramshaw 1989).

    Examples
    --------
    >>> line = Piece("line", 1, np.array([0.0, 0, 1, 1]), np.array([(0.0, 0), (4, 0)]))
    >>> part_of(line, 0.25, 0.5).control_points.tolist()
    [[1.0, 0.0], [2.0, 0.0]]
    """
    if piece.arc is not None:
        return _arc_between(piece, piece.arc, begin, end)
    p = piece.degree
    inner = piece.knots[(piece.knots > begin) & (piece.knots < end)]
    knots = np.concatenate([np.full(p + 1, begin), inner, np.full(p + 1, end)])
    points = np.empty((len(knots) - p - 1, 2))
    for i in range(len(points)):
        support = knots[i : i + p + 2]
        j = int(np.argmax(np.diff(support)))
        span = int(np.searchsorted(piece.knots, 0.5 * (support[j] + support[j + 1]))) - 1
        points[i] = blossom(piece, span, tuple(knots[i + 1 : i + p + 1]))
    kind = "line" if p == 1 and not len(inner) else "spline" if len(inner) else "bezier"
    return Piece(kind, p, (knots - begin) / (end - begin), points)


def _arc_between(piece: Piece, arc: Arc, begin: float, end: float) -> Piece:
    """The part of an arc whose twin is no farther from it."""
    cuts = [begin, end]
    curve = BSplineCurve(piece.knots, piece.control_points, piece.degree)
    from_centre = curve(cuts) - arc.centre
    angles = np.arctan2(from_centre[:, 1], from_centre[:, 0])
    # A Bezier's parameter runs almost as the angle does: that tells the turn.
    near = arc.start_angle + arc.sweep * np.array(cuts)
    angles += FULL_TURN * np.round((near - angles) / FULL_TURN)
    first, last = ((angles - arc.start_angle) / arc.sweep).tolist()
    first, last = (0.0 if begin == 0 else first), (1.0 if end == 1 else last)
    part = arc.part(first, last)
    knots, points = part.twin(max(1, ceil((last - first) * piece.n_beziers - 1e-9)))
    ends = [
        given if cut in (0, 1) else arc.at(share)
        for given, cut, share in zip(
            piece.control_points[[0, -1]], (begin, end), (first, last), strict=True
        )
    ]
    return Piece("arc", 3, knots, points, part).meeting(*ends)

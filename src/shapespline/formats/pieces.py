"""Pieces that readers make of points, and outlines closed where they were meant to be."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from shapespline.values import FULL_TURN, Arc, Piece

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.typing import ArrayLike

# Ends closer than this part of an outline's size are the same point, written with few digits or
# reached over many additions.
SAME_END = 1e-9


def bezier(points: ArrayLike) -> Piece:
    """A line or Bezier of its control points, shape (degree + 1, 2)."""
    control_points = np.array(points, dtype=np.float64)
    degree = len(control_points) - 1
    kind = "line" if degree == 1 else "bezier"
    return Piece(kind, degree, np.repeat([0.0, 1.0], degree + 1), control_points)


def closed_up(pieces: Sequence[Piece]) -> list[Piece]:
    """The pieces but for those without extent; ends that all but meet are made to meet.

    Arcs of one circle that follow each other become one arc: formats cut what turns too far.
    """
    kept = [piece for piece in pieces if np.ptp(piece.control_points, axis=0).any()]
    if not kept:
        return []
    near = SAME_END * size_of(kept)
    while len(kept) > 1 and _reach(kept[-1]) <= near:  # such as the line that closes a path
        kept.pop()
    gap = kept[-1].control_points[-1] - kept[0].control_points[0]
    if (len(kept) > 1 or kept[0].degree > 1) and np.hypot(*gap) <= near:
        kept = ring(kept)
    return joined_arcs(kept)


def ring(pieces: Sequence[Piece]) -> list[Piece]:
    """The pieces with the end of the last one at the beginning of the first, an arc alone whole."""
    begin, arc = pieces[0].control_points[0], pieces[0].arc
    if len(pieces) > 1 or arc is None:
        return [*pieces[:-1], pieces[-1].meeting(end=begin)]
    whole = replace(arc, sweep=float(np.copysign(FULL_TURN, arc.sweep)))
    return [Piece.of_arc(whole, begin=begin, end=begin)]


def joined_arcs(pieces: list[Piece]) -> list[Piece]:
    """The same pieces with neighbouring arcs of one circle made one, up to a whole circle."""
    found = pieces[:1]
    for piece in pieces[1:]:
        whole = _one_arc(found[-1], piece)
        if whole is None:
            found.append(piece)
        else:
            found[-1] = whole
    return found


def _one_arc(before: Piece, after: Piece) -> Piece | None:
    """Two neighbouring arcs as one, None where they are not on one circle."""
    one, two = before.arc, after.arc
    if one is None or two is None or one.sweep * two.sweep < 0:
        return None
    near, sweep = SAME_END * one.radius, one.sweep + two.sweep
    apart = np.hypot(one.centre[0] - two.centre[0], one.centre[1] - two.centre[1])
    if abs(sweep) > FULL_TURN + SAME_END or max(apart, abs(one.radius - two.radius)) > near:
        return None
    begin, end = before.control_points[0], after.control_points[-1]
    if (begin == end).all():
        sweep = float(np.copysign(FULL_TURN, sweep))
    if abs(sweep) > FULL_TURN:
        return None
    return Piece.of_arc(Arc(one.centre, one.radius, one.start_angle, sweep), begin=begin, end=end)


def size_of(pieces: Sequence[Piece]) -> float:
    """Diagonal of the box around all control points."""
    points = np.concatenate([piece.control_points for piece in pieces])
    return float(np.hypot(*np.ptp(points, axis=0)))


def _reach(piece: Piece) -> float:
    return float(np.hypot(*np.ptp(piece.control_points, axis=0)))

"""Edges of a pen: each side of the ink tells alone where the middle of the pen went.

A round pen of radius r leaves ink whose outline is r away from its middle. So the middle lies r
inside of each point of the outline, also where other ink hides the other side: next to junctions,
within corners, in what is filled because a bend is narrow. Round ends and the outer sides of sharp
corners are half discs and parts of discs: all of their points tell the same middle.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.tracing.strokes.ink import OUTLINE_STEP

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from scipy.spatial import cKDTree

    from shapespline.tracing.strokes.pen import Pen
    from shapespline.typing import BoolArray, FloatArray, IntArray

# Directions are taken over this part of the radius to both sides.
SMOOTHED = 0.12
# While an outline goes a pixel its pen goes between these: less in a corner or end, more where two
# strokes meet in a notch of the outline (TRC-26).
SLOWEST, FASTEST = 0.25, 3.0
# The pen stood still if it is found again within this part of its radius and a pixel; what turned
# by more than LEAST_CORNER meanwhile is a corner, by more than LEAST_END the end of a stroke.
STILL, LEAST_CORNER, LEAST_END = 0.3, np.radians(20.0), np.radians(140.0)
# What turns by so much where it stands still, between two notches, is the end of a stroke whose
# sides are hidden: so many points inward are its beginning, a pixel apart.
LEAST_STUB, STUB_POINTS = np.radians(60.0), 3
# Points that tell that it stands still are of one place if fewer are between them.
MOST_APART = 3
# Points of an outline that tell where a pen went follow each other; fewer are rounding.
LEAST_RUN = 2
# What ends where other ink hides the stroke.
HIDDEN = -1


class PenEdge(NamedTuple):
    """Where a pen went, as one side of its ink tells.

    Attributes
    ----------
    middles, directions : ndarray, shape (n, 2)
        Where it was and went, the visible side on its right.
    corners : list of int
        Indices of middles at which it turned.
    ends : tuple of int
        Numbers of the ends of strokes at both ends, `HIDDEN` where other ink begins. The end of one
        edge is the beginning of another.
    closed : bool
    """

    middles: FloatArray
    directions: FloatArray
    corners: list[int]
    ends: tuple[int, int] = (HIDDEN, HIDDEN)
    closed: bool = False


class _Side(NamedTuple):
    """What each point of an outline tells: directions, middles, turns to the next point."""

    directions: FloatArray
    middles: FloatArray
    speeds: FloatArray
    turns: FloatArray
    reached: FloatArray  # how far the outline is from the middle
    moving: BoolArray

    def beginning(self, first: int) -> _Side:
        """The same from another point on."""
        return _Side(
            directions=np.roll(self.directions, -first, axis=0),
            middles=np.roll(self.middles, -first, axis=0),
            speeds=np.roll(self.speeds, -first),
            turns=np.roll(self.turns, -first),
            reached=np.roll(self.reached, -first),
            moving=np.roll(self.moving, -first),
        )


class _Gap(NamedTuple):
    """What is between two runs of points at which the pen moved.

    ``ends`` are the numbers with which the run before ends and that after begins, None if it goes
    on; ``corner`` is a row for where it turned; of strokes that are ``stubs`` nothing else is seen.
    """

    ends: tuple[int, int] | None = None
    corner: tuple[FloatArray, FloatArray] | None = None
    stubs: Sequence[PenEdge] = ()


def pen_edges(outline: FloatArray, pen: Pen, tree: cKDTree, first_end: int) -> list[PenEdge]:
    """What an outline tells of the way of a pen, in its order.

    Parameters
    ----------
    outline : ndarray, shape (n, 2)
        Points at even steps, closed, the ink on their left.
    pen : Pen
    tree : cKDTree
        Points of all outlines.
    first_end : int
        A number: ends of strokes have it and those that follow, as many as there are points.
    """
    side = _side(outline, pen, tree)
    if side.moving.all():
        return [PenEdge(side.middles, side.directions, [], closed=True)]
    before = ~np.roll(side.moving, 1)
    starts = np.flatnonzero(side.moving & before)
    if len(starts) == 0:
        return []
    side = side.beginning(int(starts[0]))
    bounds = np.flatnonzero(np.diff(np.concatenate([[0], side.moving.astype(int), [0]])))
    # At a square end the pen is within its slack for a moment between two corners.
    least = LEAST_RUN + 2.0 * pen.slack / OUTLINE_STEP
    runs = [(a, b) for a, b in bounds.reshape(-1, 2).tolist() if b - a >= least]
    return list(_linked(runs, side, pen, first_end)) if runs else []


def _side(outline: FloatArray, pen: Pen, tree: cKDTree) -> _Side:
    reach = max(1, round(SMOOTHED * pen.radius / OUTLINE_STEP))
    ahead = np.roll(outline, -reach, axis=0) - np.roll(outline, reach, axis=0)
    directions = ahead / np.maximum(np.hypot(*ahead.T), 1e-12)[:, None]
    middles = outline + pen.radius * np.column_stack([-directions[:, 1], directions[:, 0]])
    went = np.roll(middles, -1, axis=0) - np.roll(middles, 1, axis=0)
    step = np.roll(outline, -1, axis=0) - np.roll(outline, 1, axis=0)
    speeds = (went * directions).sum(axis=1) / np.maximum(np.hypot(*step.T), 1e-12)
    after = np.roll(directions, -1, axis=0)
    turns = np.arctan2(
        directions[:, 0] * after[:, 1] - directions[:, 1] * after[:, 0],
        (directions * after).sum(axis=1),
    )
    reached = tree.query(middles)[0]
    moving = (reached >= pen.radius - pen.slack) & (speeds > SLOWEST) & (speeds < FASTEST)
    return _Side(directions, middles, speeds, turns, reached, moving)


def _linked(
    runs: list[tuple[int, int]], side: _Side, pen: Pen, first_end: int
) -> Iterator[PenEdge]:
    """Runs of points at which the pen moved, linked where it stood still between them."""
    n, count = len(side.middles), len(runs)
    gaps = []
    for k, (_, end) in enumerate(runs):
        begin = runs[(k + 1) % count][0] + (n if k + 1 == count else 0)
        gaps.append(_gap(np.arange(end - 1, begin + 1) % n, side, pen, first_end))
    breaks = [k for k, gap in enumerate(gaps) if gap.ends is not None]
    start = breaks[0] + 1 if breaks else 0
    rows: list[tuple[FloatArray, FloatArray]] = []
    corners: list[int] = []
    before = gaps[start - 1].ends
    for k in ((start + i) % count for i in range(count)):
        own, gap = slice(*runs[k]), gaps[k]
        rows.append((side.middles[own], side.directions[own]))
        if before is not None and gap.ends is not None:
            yield PenEdge(*_joined(rows), corners, (before[1], gap.ends[0]))
            yield from gap.stubs
            rows, corners, before = [], [], gap.ends
        elif gap.corner is not None:
            corners.append(sum(len(middles) for middles, _ in rows))
            rows.append(gap.corner)
    if rows:
        yield PenEdge(*_joined(rows), corners, closed=True)


def _gap(across: IntArray, side: _Side, pen: Pen, first_end: int) -> _Gap:
    """What is between two runs; ``across`` begins with the last of one and ends with the first."""
    within, near = across[1:-1], STILL * pen.radius + 1.0
    end = first_end + int(across[0])
    first, last = side.middles[across[0]], side.middles[across[-1]]
    if np.hypot(*(last - first)) <= near:
        turn = float(side.turns[across[:-1]].sum())
        if turn >= LEAST_END:
            return _Gap(ends=(end, end))
        if abs(turn) <= LEAST_CORNER:
            return _Gap()
        here = within[side.reached[within] >= pen.radius - pen.slack]
        place = side.middles[here if len(here) else across[[0, -1]]].mean(axis=0)
        direction = side.directions[across[[0, -1]]].sum(axis=0)
        length = max(float(np.hypot(*direction)), 1e-12)
        return _Gap(corner=(place[None], direction[None] / length))
    ends, stubs = [HIDDEN, HIDDEN], []
    still = (side.reached[within] >= pen.radius - pen.slack) & (
        np.abs(side.speeds[within]) < SLOWEST
    )
    found = np.flatnonzero(still)
    for rows in np.split(found, np.flatnonzero(np.diff(found) > MOST_APART) + 1):
        own = within[rows[0] : rows[-1] + 1] if len(rows) else within[:0]
        if side.turns[own].sum() < LEAST_STUB:
            continue
        place = side.middles[within[rows]].mean(axis=0)
        if np.hypot(*(place - first)) <= near:
            ends[0] = end
        elif np.hypot(*(place - last)) <= near:
            ends[1] = end
        else:
            ahead = side.directions[own].sum(axis=0)
            stubs.append(_stub(place, ahead, first_end + int(own[0])))
    return _Gap((ends[0], ends[1]), stubs=stubs)


def _stub(place: FloatArray, ahead: FloatArray, end: int) -> PenEdge:
    """The end of a stroke of which other ink leaves no more to be seen."""
    inward = np.array([-ahead[1], ahead[0]]) / max(float(np.hypot(*ahead)), 1e-12)
    way = np.arange(STUB_POINTS)[:, None] * inward
    return PenEdge(place + way, np.tile(inward, (STUB_POINTS, 1)), [], (end, HIDDEN))


def _joined(rows: list[tuple[FloatArray, FloatArray]]) -> tuple[FloatArray, FloatArray]:
    middles, directions = zip(*rows, strict=True)
    return np.concatenate(middles), np.concatenate(directions)

"""Offset curves as dense polylines: every point at one distance from the curves, crossings removed.

The raw offset runs beside every Bezier piece, with an arc about each corner that turns away. Of it
stays what is no nearer to any of the curves than the distance, and on the right side: the boundary
of a dilation or an erosion by a disc (Tiller and Hanson 1984 offset; trimmed by distance instead of
by crossings). Where a stay begins or ends is found by bisection; ends that meet are chained.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import pi
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.errors import InvalidInputError
from shapespline.geometry.distances import CentredCurve
from shapespline.geometry.measures import bounds, contains
from shapespline.geometry.monotone import bezier_at
from shapespline.values import CORNER_TURN, EXACT_TURN

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from shapespline.geometry.measures import Box
    from shapespline.typing import FloatArray
    from shapespline.values import BSplineCurve

# A point of the raw offset counts as near as wanted if it misses by this part of the distance, or
# by so many units in the last place of the largest coordinate: rounding of its own foot.
NEAR, ROUNDING = 1e-9, 256 * float(np.finfo(float).eps)
# Halvings of a step of the raw offset, and of the step in which a stay ends.
MOST_HALVINGS, BISECTIONS = 24, 48
# Points of the raw offset; a caller who needs more has mistaken the unit of the tolerance.
MOST_POINTS = 2_000_000
# Where a derivative vanishes the tangent is taken beside.
BESIDE = 1e-6


class OffsetLine(NamedTuple):
    """Points (n, 2) on an offset, and the indices of those where it has a corner."""

    points: FloatArray
    corners: list[int]
    closed: bool


@dataclass(frozen=True, eq=False)
class Source:
    """The curves of an offset and how far to their left it runs, data units, for each.

    ``region`` says that they bound an area, whose inside is ``inside``: on which side of its
    boundary the offset lies. Else they are open, and one side is as good as the other.
    """

    curves: Sequence[BSplineCurve]
    to_the_left: Sequence[float]
    region: bool
    inside: bool

    @property
    def distance(self) -> float:
        """The distance without its sign."""
        return abs(self.to_the_left[0])

    @cached_property
    def boxes(self) -> list[Box]:
        """The box of each curve: most points are too far from most of them."""
        return [bounds([curve]) for curve in self.curves]

    def keeps(self, points: FloatArray) -> NDArray[np.bool_]:
        """Which points are no nearer to any curve than the distance, and on the right side."""
        far = np.ones(len(points), dtype=bool)
        largest = float(np.abs(points).max(initial=0.0))
        least = self.distance * (1 - NEAR) - ROUNDING * largest
        for curve, (x_min, y_min, x_max, y_max) in zip(self.curves, self.boxes, strict=True):
            x, y = points.T
            near = (x > x_min - least) & (x < x_max + least)
            near &= (y > y_min - least) & (y < y_max + least) & far
            if near.any():
                middle = 0.5 * np.array([x_min + x_max, y_min + y_max])
                moved = type(curve).trusted(
                    curve.knots, curve.control_points - middle, curve.degree, curve.periodic
                )
                found = CentredCurve(moved, middle).nearest(points[near])
                far[near] = np.sqrt(found.distances_sq) >= least
        if self.region and far.any():
            far[far] = contains(self.curves, points[far]) == self.inside
        return far


class Branch(NamedTuple):
    """A stretch of the raw offset over [0, 1]: beside a Bezier, or an arc about a corner."""

    bezier: FloatArray
    left: float
    begin: float
    turn: float

    def at(self, u: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Points and unit directions at parameters, both (k, 2)."""
        if len(self.bezier) == 1:
            angle = self.begin + u * self.turn
            along = np.column_stack([np.cos(angle), np.sin(angle)])
            foot = np.broadcast_to(self.bezier, along.shape)
        else:
            hodograph = np.diff(self.bezier, axis=0)[None]
            along = bezier_at(hodograph, u[None])[0]
            speed = np.hypot(along[:, 0], along[:, 1])
            still = speed <= BESIDE**2 * np.abs(hodograph).max()
            if still.any():
                beside = np.clip(u[still], BESIDE, 1 - BESIDE)
                along[still] = bezier_at(hodograph, beside[None])[0]
                speed = np.hypot(along[:, 0], along[:, 1])
            along = along / speed[:, None]
            foot = bezier_at(self.bezier[None], u[None])[0]
        normal = np.column_stack([-along[:, 1], along[:, 0]])
        return foot + self.left * normal, along


def _branches(curve: BSplineCurve, left: float, closed: bool) -> list[Branch]:
    """The raw offset of a curve: beside its pieces, and about its corners that turn away."""
    pieces = [piece for piece in curve.beziers().points if np.ptp(piece, axis=0).any()]
    beside = [Branch(piece, left, 0.0, 0.0) for piece in pieces]
    found = []
    for index, branch in enumerate(beside):
        found.append(branch)
        if index == len(beside) - 1 and not closed:
            break
        after = beside[(index + 1) % len(beside)]
        (ux, uy), (vx, vy) = branch.at(np.ones(1))[1][0], after.at(np.zeros(1))[1][0]
        turn = float(np.arctan2(ux * vy - uy * vx, ux * vx + uy * vy))
        if abs(turn) > pi - BESIDE:  # back on itself: around its end
            turn = -pi if left > 0 else pi
        if turn * left < 0 and abs(turn) > EXACT_TURN:
            corner = branch.bezier[-1:]
            found.append(Branch(corner, left, float(np.arctan2(uy, ux)), turn))
    return found


class _Samples(NamedTuple):
    """Samples of one raw offset in order: their branch, parameter, point and direction."""

    branch: NDArray[np.int64]
    u: FloatArray
    points: FloatArray
    along: FloatArray


def _sampled(branches: Sequence[Branch], step: float, deviation: float) -> _Samples:
    """Samples no farther apart than a step, with chords that deviate no more than asked."""
    parts = []
    for index, branch in enumerate(branches):
        u = np.linspace(0.0, 1.0, 5)
        points, along = branch.at(u)
        for _ in range(MOST_HALVINGS):
            middle = 0.5 * (u[:-1] + u[1:])
            between, direction = branch.at(middle)
            chord = np.hypot(*np.diff(points, axis=0).T)
            off = np.hypot(*(between - 0.5 * (points[:-1] + points[1:])).T)
            coarse = (chord > step) | (off > deviation)
            if not coarse.any():
                break
            if len(u) > MOST_POINTS:
                raise InvalidInputError(
                    f"tolerance asks for more than {MOST_POINTS} points on one outline, which is"
                    " much too fine for its size; raise it"
                )
            where = np.flatnonzero(coarse) + 1
            u = np.insert(u, where, middle[coarse])
            points = np.insert(points, where, between[coarse], axis=0)
            along = np.insert(along, where, direction[coarse], axis=0)
        parts.append((np.full(len(u), index), u, points, along))
    return _Samples(*(np.concatenate(column) for column in zip(*parts, strict=True)))


class _Run(NamedTuple):
    """A stay of a raw offset: points and directions; ``whole`` if it closes on itself."""

    points: FloatArray
    along: FloatArray
    whole: bool


def offset_lines(source: Source, step: float, deviation: float) -> list[OffsetLine]:
    """The offset of curves as polylines, those that are smaller than a step left out.

    Parameters
    ----------
    source : Source
    step : float
        Largest distance between samples of the raw offset, data units; details of the offset
        shorter than it may be missed.
    deviation : float
        Largest distance of the polylines from the offset elsewhere, data units.
    """
    runs: list[_Run] = []
    for curve, left in zip(source.curves, source.to_the_left, strict=True):
        branches = _branches(curve, left, source.region)
        runs += _stays(branches, _sampled(branches, step, deviation), source)
    lines = [_line([run], True, deviation) for run in runs if run.whole]
    for chain, closed in _chains([run for run in runs if not run.whole], step, source.region):
        lines.append(_line(chain, closed, deviation))
    return [line for line in lines if np.hypot(*np.ptp(line.points, axis=0)) > step]


def _stays(branches: Sequence[Branch], samples: _Samples, source: Source) -> list[_Run]:
    """What stays of one raw offset, in runs."""
    kept = source.keeps(samples.points)
    if not kept.any():
        return []
    if kept.all():
        return [_Run(samples.points, samples.along, source.region)]
    order = np.arange(len(kept))
    if source.region:  # around, from a sample that does not stay
        order = np.roll(order, -int(np.argmin(kept)))
    stays = kept[order]
    begins = np.flatnonzero(stays & ~np.concatenate([[False], stays[:-1]]))
    ends = np.flatnonzero(stays & ~np.concatenate([stays[1:], [False]]))
    firsts = _ends(branches, samples, source, order, begins, -1)
    lasts = _ends(branches, samples, source, order, ends, 1)
    runs = []
    for k, (begin, end) in enumerate(zip(begins, ends, strict=True)):
        inner = order[begin : end + 1]
        runs.append(
            _Run(
                np.concatenate([firsts[0][k : k + 1], samples.points[inner], lasts[0][k : k + 1]]),
                np.concatenate([firsts[1][k : k + 1], samples.along[inner], lasts[1][k : k + 1]]),
                False,
            )
        )
    return runs


def _ends(
    branches: Sequence[Branch],
    samples: _Samples,
    source: Source,
    order: NDArray[np.int64],
    where: NDArray[np.int64],
    side: int,
) -> tuple[FloatArray, FloatArray]:
    """Points and directions where runs end: by bisection to the next sample, that does not stay."""
    good = order[where]
    beyond = where + side
    there = order[np.clip(beyond, 0, len(order) - 1)]
    inside = (beyond >= 0) & (beyond < len(order))
    same = inside & (samples.branch[good] == samples.branch[there])
    low, high = samples.u[good], np.where(same, samples.u[there], samples.u[good])
    points, along = samples.points[good].copy(), samples.along[good].copy()
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        tried = [branches[samples.branch[g]].at(middle[k : k + 1]) for k, g in enumerate(good)]
        at = np.concatenate([point for point, _ in tried])
        stays = source.keeps(at)
        points[stays] = at[stays]
        along[stays] = np.concatenate([direction for _, direction in tried])[stays]
        low, high = np.where(stays, middle, low), np.where(stays, high, middle)
    return points, along


def _chains(runs: Sequence[_Run], step: float, region: bool) -> list[tuple[list[_Run], bool]]:
    """Runs put end to end, nearest ends first; ``True`` where they close."""
    n = len(runs)
    after = np.full(n, -1)
    if n:
        ends = np.array([run.points[-1] for run in runs])
        begins = np.array([run.points[0] for run in runs])
        gaps = np.hypot(*(ends[:, None] - begins[None]).transpose(2, 0, 1))
        if not region:  # an open run is no loop
            np.fill_diagonal(gaps, np.inf)
        taken = np.zeros(n, dtype=bool)
        for flat in np.argsort(gaps, axis=None, kind="stable"):
            i, j = divmod(int(flat), n)
            if gaps[i, j] > step:
                break
            if after[i] < 0 and not taken[j]:
                after[i], taken[j] = j, True
        if region and (after < 0).any():
            raise InvalidInputError(
                "the offset cannot be closed at this tolerance: parts of it are smaller than that;"
                " take a smaller tolerance"
            )
    done = np.zeros(n, dtype=bool)
    chains = []
    starts = [k for k in range(n) if k not in set(after.tolist())]
    for start in [*starts, *range(n)]:
        if done[start]:
            continue
        chain, k = [], start
        while k >= 0 and not done[k]:
            done[k] = True
            chain.append(runs[k])
            k = int(after[k])
        chains.append((chain, k == start))
    return chains


def _line(runs: Sequence[_Run], closed: bool, merged: float) -> OffsetLine:
    """Runs as one polyline; points nearer than ``merged`` are one, and may be a corner."""
    points = np.concatenate([run.points for run in runs])
    along = np.concatenate([run.along for run in runs])
    firsts, lasts = [0], [0]
    for k in range(1, len(points)):
        if np.hypot(*(points[k] - points[firsts[-1]])) > merged:
            firsts.append(k)
            lasts.append(k)
        else:
            lasts[-1] = k
    if closed and len(firsts) > 1 and np.hypot(*(points[firsts[-1]] - points[0])) <= merged:
        along[0] = along[firsts.pop()]
        lasts.pop()
    u, v = along[firsts], along[lasts]
    turn = np.arctan2(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0], (u * v).sum(axis=1))
    corners = np.flatnonzero(np.abs(turn) > CORNER_TURN)
    if not closed:
        corners = corners[(corners > 0) & (corners < len(firsts) - 1)]
    return OffsetLine(points[firsts], corners.tolist(), closed)

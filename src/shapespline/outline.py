"""A contour made ready for a search within a tolerance: order and unit, corners, straight runs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from shapespline import _kernels
from shapespline.arrays import median
from shapespline.contour import Contour
from shapespline.corners import GENTLE_TURN, find_corners
from shapespline.errors import InvalidInputError
from shapespline.frame import WorkingFrame
from shapespline.held import Held
from shapespline.noise import noise_level

if TYPE_CHECKING:
    from shapespline.typing import ArrayLike, FloatArray, IntArray

CornerChoice = Literal["auto", "free"]

# So many points that spread across a line by no more than this part of the tolerance are a straight
# run of the data, which one smooth spline would bend.
FEWEST_STRAIGHT, STRAIGHT_PART = 8, 0.1
# A chord is a run, and not one of a row along an arc, if most of it stays one chord within a
# fiftieth of the distance, where an arc makes seven and an inflection four. It is longer than some
# tolerances.
FINER, ONE_CHORD, LEAST_TOLERANCES = 0.02, 0.6, 10.0
# An edge so many times as long as the median was drawn as a line, not sampled.
LONG_EDGE = 8.0
# Of bends sixteen times as much is left at twice the distance, of scatter as much.
BEND_GROWTH = 4.0


class SearchOutline(NamedTuple):
    """What a search within a tolerance knows about a contour before it begins.

    ``frame`` holds the points in its order and unit, ``tolerance`` is in that unit too. ``corners``
    are indices of its points, ``gentle`` (n,) is 1 where the outline hardly turns, ``held`` is in
    its order and direction. ``dense`` are points as they came, in that unit, where the frame holds
    thinned ones.
    """

    frame: WorkingFrame
    tolerance: float
    corners: IntArray
    gentle: IntArray
    held: Held = Held()
    dense: Contour | None = None

    @classmethod
    def of(
        cls,
        contour: Contour,
        tolerance: float,
        corners: CornerChoice | ArrayLike | None,
        held: Held | None = None,
    ) -> SearchOutline:
        """The outline of a contour; corners as `fit_pieces` takes them.

        Examples
        --------
        >>> from shapespline import Contour
        >>> side = np.linspace(0, 1, 20, endpoint=False)
        >>> x = np.concatenate([side, 1 + 0 * side, 1 - side, 0 * side])
        >>> square = Contour(np.column_stack([x, np.roll(x, 20)]), closed=True)
        >>> outline = SearchOutline.of(square, 0.01, "auto")
        >>> len(outline.corners), outline.has_straight_runs
        (4, True)
        """
        frame = WorkingFrame.of(contour)
        aim, n = tolerance * frame.scale, len(contour)
        gentle = np.ones(n, dtype=np.int64)
        held = _in_frame(Held() if held is None else held, frame)
        if corners is None:
            return cls(frame, aim, np.empty(0, dtype=np.int64), gentle, held)
        if isinstance(corners, str):
            if corners not in ("auto", "free"):
                raise InvalidInputError(
                    f"corners must be 'auto', 'free', None or indices, got {corners!r}"
                )
            found = find_corners(frame.contour, aim)
            gentle = (found.turns < GENTLE_TURN).astype(np.int64)
            return cls(frame, aim, found.indices, gentle, held)
        given = np.asarray(corners)
        if given.ndim != 1 or (given.size and given.dtype.kind not in "iu"):
            raise InvalidInputError(f"corners must be one list of whole numbers, got {corners!r}")
        if given.size and (given.min() < 0 or given.max() >= n):
            raise InvalidInputError(f"corners must be indices below {n}, got {given.tolist()}")
        return cls(frame, aim, np.unique(frame.place[given.astype(np.int64)]), gentle, held)

    def thinned(self) -> SearchOutline:
        """The outline without the points that the search does not need, its tolerance less so."""
        stay = np.union1d(self.corners, self.held.through)
        frame = self.frame.thinned(self.tolerance, stay)
        if frame is self.frame:
            return self
        place = self.frame.place[frame.order]
        return self._replace(
            frame=frame,
            tolerance=self.tolerance - frame.slack,
            corners=np.flatnonzero(np.isin(place, self.corners)),
            gentle=self.gentle[place],
            held=self.held._replace(through=np.flatnonzero(np.isin(place, self.held.through))),
        )

    @property
    def has_straight_runs(self) -> bool:
        """Whether some of the data are straight, or too noisy to tell."""
        contour = filled(self.frame.contour if self.dense is None else self.dense)
        width = STRAIGHT_PART * self.tolerance
        if _is_noisy(contour, 0.5 * FINER * width):
            return True
        polyline = contour.polyline
        fine = _chords(polyline, FINER * width)
        coarse = fine[_chords(polyline[fine], width)]
        lengths = _lengths(polyline, coarse)
        longest = np.zeros(len(lengths))
        inside = np.searchsorted(coarse, 0.5 * (fine[1:] + fine[:-1]), side="right") - 1
        np.maximum.at(longest, inside, _lengths(polyline, fine))
        runs = (np.diff(coarse) > FEWEST_STRAIGHT) & (longest >= ONE_CHORD * lengths)
        return bool((runs & (lengths >= LEAST_TOLERANCES * self.tolerance)).any())


def filled(contour: Contour) -> Contour:
    """The contour with points along edges far longer than most: those were drawn as lines.

    Examples
    --------
    >>> x = np.append(np.linspace(0, 1, 50), 9.0)
    >>> len(filled(Contour(np.column_stack([x, 0 * x]), closed=False)))
    66
    """
    polyline = contour.polyline
    steps = np.hypot(*np.diff(polyline, axis=0).T)
    parts = np.where(steps > LONG_EDGE * median(steps), 2 * FEWEST_STRAIGHT, 1)
    if (parts == 1).all():
        return contour
    begins = np.repeat(np.arange(len(steps)), parts)
    share = np.concatenate([np.arange(count) / count for count in parts.tolist()])
    along = np.diff(polyline, axis=0)[begins]
    points = polyline[begins] + share[:, None] * along
    if not contour.closed:
        points = np.concatenate([points, polyline[-1:]])
    return Contour.trusted(points, contour.closed, contour.accuracy)


def _in_frame(held: Held, frame: WorkingFrame) -> Held:
    """What is held, in the order and direction of a frame."""
    begin, end = held.tangents
    if frame.reversed:
        begin, end = (None if t is None else -t for t in (end, begin))
    through = np.unique(frame.place[held.through]) if len(held.through) else held.through
    return held._replace(through=through, tangents=(begin, end))


def _is_noisy(contour: Contour, level: float) -> bool:
    """Whether the points scatter by more than a level.

    What a cubic leaves of few points on a smooth curve looks like scatter, but grows with the
    fourth power of their distance, which scatter does not.
    """
    found = noise_level(contour)
    if not found > level:
        return False
    half = Contour.trusted(contour.points[::2], contour.closed, contour.accuracy)
    return noise_level(half) < BEND_GROWTH * found


def _chords(polyline: FloatArray, distance: float) -> IntArray:
    """Indices of vertices whose chords lie within a distance of the polyline."""
    return np.array(_kernels.thinned(polyline, distance, np.inf, None), dtype=np.int64)


def _lengths(polyline: FloatArray, vertices: IntArray) -> FloatArray:
    return np.hypot(*np.diff(polyline[vertices], axis=0).T)

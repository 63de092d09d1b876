"""An outline as the drawn engine sees it: what its points weigh and how far they may be off."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from math import ceil
from typing import TYPE_CHECKING

import numpy as np

from shapespline.analysis import (
    GOING_ON,
    left_by_rounding,
    means_of,
    neighbours_to_average,
    noise_level,
    pixel_of,
    rounded,
    with_points_on_lines,
)
from shapespline.engines.drawn.told_arcs import told_arcs
from shapespline.validation import median
from shapespline.values import Contour

if TYPE_CHECKING:
    from shapespline.typing import FloatArray

# Of a picture: points within so many pixels of a node may be blunted, and systematic errors are
# that part of what its points are accurate to (DRA-02).
BLUNTED, SYSTEMATIC = 1.0, 0.75
# A picture's points are better than its accuracy where they scatter less: slow errors are so many
# times what shows between neighbours, and no picture is better than this part (DRA-02).
SLOW, BEST = 3.0, 0.3
# Errors of a renderer that draws curves as chords go on for so many pixels (DRA-22).
APART = 4.0
# Points less accurate than this part of their step are those of a picture of one bit: along its
# stairs they scatter by nothing, and are off by half a pixel (DRA-14).
ONE_BIT = 0.15
# Less accurate than this part of it are those of grainy pictures: what averaging along outlines
# leaves of noise goes on, and shows less between neighbours than it is (DRA-61).
SHAKEN = 0.075
# Points of a table are not known better than this part of the extent (DRA-02).
LAST_DIGIT = 1e-5
# Of points with so many decimals it is what rounding leaves, if as much of that shows between
# neighbours (DRA-46), or where these are not on level edges (DRA-59).
VISIBLE = 0.2
# Noise is so many times as large as last digits: edges whose ends alone are given are gaps then
# (DRA-57).
NOISY = 2.0
# Of more points than these every so many-th is looked at: of clean ones, of noisy ones, which are
# averaged first (DRA-03), and those of a picture, which all count (DRA-09).
MOST_POINTS, MOST_NOISY = 1000, 6000


@dataclass(frozen=True, eq=False)
class Observed:
    """Points of an outline in order, and what is known of their errors.

    Attributes
    ----------
    points : ndarray, shape (n, 2)
    closed : bool
    deviation : float
        Standard deviation of a point across the outline.
    largest_deviation : float
        What it may be at most, as far as the source knows; elements that miss it are none.
    floor : float
        What averaging does not take away: systematic errors of a picture.
    pixel : float
        0 for measured points.
    apart : float
        Pixels, or measured points, from one independent sample to the next.
    whole : ndarray, optional
        All points, of which so many are looked at.
    exact : bool
        Whether measured points have no noise but that of a table's last digits.
    rounding : float
        What their last digits leave, as far as they show it.
    precisions : ndarray, optional
        Of measured points, over that of most of them, where they are not alike.
    noisy : bool
        Whether measured points scatter by more than last digits: long steps are gaps then.
    """

    points: FloatArray
    closed: bool
    deviation: float
    largest_deviation: float
    floor: float
    pixel: float
    apart: float = 1.0
    whole: FloatArray | None = None
    exact: bool = False
    rounding: float = 0.0
    precisions: FloatArray | None = None
    noisy: bool = False

    @classmethod
    def of(cls, contour: Contour, accuracy: float | None) -> Observed:
        """A contour; ``accuracy`` is what its picture knows, None for measured points."""
        points, closed = contour.points, contour.closed
        step = median(np.diff(contour.arc_length))
        if accuracy:
            shown = noise_level(Contour.trusted(points, closed))
            deviation = min(max(SLOW * shown, BEST * accuracy), accuracy) if shown else accuracy
            if accuracy > SHAKEN * step:
                deviation = accuracy
            floor = SYSTEMATIC * deviation
            points = _thinned(points, closed, ceil(len(points) / MOST_NOISY))
            return cls(points, closed, deviation, accuracy, floor, step)
        extent = float(np.ptp(points, axis=0).max())
        # What they are said to be accurate to does not make lines of smooth points, unless they
        # are exact.
        exact = 0.0 if contour.accuracy == 0 else None
        measured = Contour.trusted(points, closed, exact)
        deviation = GOING_ON * pixel_of(measured) or noise_level(measured)
        rounding = rounded(points, closed, LAST_DIGIT * extent)
        is_noisy = deviation > NOISY * max(rounding, LAST_DIGIT * extent)
        if max(deviation, left_by_rounding(points, closed, rounding)) > VISIBLE * rounding:
            deviation = max(deviation, rounding)
        deviation = max(deviation, LAST_DIGIT * extent)
        k = neighbours_to_average(points, closed, deviation)
        every = len(points) // (max(k, 1) * MOST_POINTS)
        whole = None
        if k == 1 and every > 1:
            points, whole = _thinned(points, closed, every), points
        if k > 1:
            points = means_of(points, k)
            deviation = max(deviation / k**0.5, LAST_DIGIT * extent)
            points = _thinned(points, closed, ceil(len(points) / MOST_NOISY))
        if k == 1 and whole is None and not is_noisy:
            points = with_points_on_lines(points, closed)
        is_exact = k == 1 and deviation == LAST_DIGIT * extent
        return cls(
            points,
            closed,
            deviation,
            deviation,
            0.0,
            0.0,
            whole=whole,
            exact=is_exact,
            rounding=rounding,
            noisy=is_noisy,
        )

    def less_exact(self, deviation: float, *, exact: bool = False) -> Observed:
        """Measured points the same, supposed to have such errors; as good as exact or not."""
        return self._but(deviation=deviation, largest_deviation=deviation, exact=exact)

    def rougher(self, factor: float) -> Observed:
        """The same of a picture so many times less exact than its kind is."""
        deviation = factor * self.largest_deviation
        floor = SYSTEMATIC * deviation
        return self._but(deviation=deviation, largest_deviation=deviation, floor=floor)

    def slow(self) -> Observed:
        """The same of a picture with errors that go on for longer."""
        return self._but(apart=APART)

    def drifting(self, deviation: float, apart: float) -> Observed:
        """Measured points the same, with such errors that go on over so many points."""
        return replace(self.less_exact(deviation), apart=apart)

    def part(self, points: FloatArray) -> Observed:
        """An open stretch of it, in the same units."""
        other = replace(self, points=points, closed=False)
        other.__dict__["step"], other.__dict__["box"] = self.step, self.box
        return other

    def _but(self, **changes: float) -> Observed:
        """The same points otherwise; what is known of them alone is known."""
        other = replace(self, **changes)  # type: ignore[arg-type]
        for name in ("steps", "step", "box", "told_arcs"):
            if name in self.__dict__:
                other.__dict__[name] = self.__dict__[name]
        return other

    @property
    def one_bit(self) -> bool:
        """Whether they are those of a picture without grey."""
        return self.largest_deviation > ONE_BIT * self.pixel > 0.0

    @property
    def skip(self) -> float:
        """How near to a node points do not count."""
        return BLUNTED * self.pixel

    @cached_property
    def told_arcs(self) -> list[tuple[int, int]]:
        """First and last point of each arc of a few pixels that a picture's outline tells."""
        return told_arcs(self.points, self.pixel) if self.pixel and self.closed else []

    @cached_property
    def steps(self) -> FloatArray:
        """Distances from each point to the next, of a closed outline from the last to the first."""
        ahead = np.roll(self.points, -1, axis=0) if self.closed else self.points[1:]
        return np.hypot(*(ahead - self.points[: len(ahead)]).T)

    @cached_property
    def step(self) -> float:
        """Median distance of neighbours."""
        return median(self.steps[: len(self.points) - 1])

    @cached_property
    def box(self) -> tuple[FloatArray, float]:
        """The middle of the points' box, and half of its longer side."""
        low, high = self.points.min(axis=0), self.points.max(axis=0)
        return 0.5 * (low + high), 0.5 * float((high - low).max())


def _thinned(points: FloatArray, closed: bool, every: int) -> FloatArray:
    """Every so many-th point, and both ends of an open row."""
    rest = points[-1:] if not closed and (len(points) - 1) % every else points[:0]
    return np.concatenate([points[::every], rest])

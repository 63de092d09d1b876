"""Means of noisy points that scatter by more than their steps, in place of the points."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.analysis import means_of
from shapespline.geometry import nearest, two_sided_distance
from shapespline.values import Contour

if TYPE_CHECKING:
    from shapespline.typing import FloatArray
    from shapespline.values import BSplineCurve

# An open outline of means begins half a step before the first, as the next so many lead (FIT-23).
ENDS = 4


class Means(NamedTuple):
    """Means of so many neighbours each, and their standard deviation across.

    Points that scatter by more than their steps are nearest to a curve anywhere: one that winds
    through them seems to fit better, and one through their middle is drawn in where it bends.
    Points that are not averaged may have precisions of their own, over that of most.
    """

    contour: Contour
    noise: float
    precisions: FloatArray | None = None

    @classmethod
    def of(cls, contour: Contour, noise: float, width: int, ends: bool) -> Means:
        """Of a contour; its own ends, if they are kept, else where the means lead to."""
        if width == 1:
            return cls(contour, noise)
        points = contour.points
        means = means_of(points, width)
        if not contour.closed:
            first, last = points[0], points[-1]
            if not ends:
                first = means[0] + (means[0] - means[ENDS]) / (2 * ENDS)
                last = means[-1] + (means[-1] - means[-1 - ENDS]) / (2 * ENDS)
            means = np.concatenate([first[None], means, last[None]])
        return cls(Contour.silently(means, contour.closed), noise / width**0.5)

    def misfit(self, curve: BSplineCurve) -> float:
        """Chi squared of a curve."""
        if self.precisions is not None:
            return float(self.precisions @ self._away(curve) ** 2) / self.noise**2
        far = two_sided_distance(curve, self.contour).rms_distance
        return len(self.contour) * (far / self.noise) ** 2

    def farthest(self, curve: BSplineCurve) -> float:
        """How far a point is from a curve at most, each for how sure it is."""
        away = self._away(curve)
        if self.precisions is not None:
            away = away * np.sqrt(np.minimum(self.precisions, 1.0))
        return float(away.max())

    def _away(self, curve: BSplineCurve) -> FloatArray:
        away = curve(nearest(curve, self.contour.points).parameters) - self.contour.points
        return np.hypot(away[:, 0], away[:, 1])

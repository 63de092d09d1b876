"""Repairs read points in canonical order, whichever is first and whichever way they run."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.analysis import canonical_reading
from shapespline.fitting.verify import verified_anew
from shapespline.geometry import backwards, joined, reversed_curve
from shapespline.values import Contour

if TYPE_CHECKING:
    from shapespline.typing import FloatArray, IntArray
    from shapespline.values import Fit


class Reading(NamedTuple):
    """The canonical order of ``n`` points, by the first and the step to the next.

    ``is_backwards`` tells that the data run the other way.
    """

    first: int
    step: int
    n: int
    is_backwards: bool

    @classmethod
    def of(cls, contour: Contour, weights: FloatArray | None = None) -> Reading:
        """The order of a contour, its weights deciding where its points read alike both ways.

        Of such points a fit without weights has one direction only, whichever way weights run.
        """
        points, closed = contour.points, contour.closed
        start, step = _, direction = canonical_reading(points, closed=closed)
        if weights is not None:
            start, step = canonical_reading(points, closed=closed, weights=weights)
        return cls(start, step, len(contour), direction < 0)

    @property
    def order(self) -> IntArray:
        """Indices of the points in this order."""
        return (self.first + self.step * np.arange(self.n)) % self.n

    def contour(self, contour: Contour) -> Contour:
        """The contour with its points in this order."""
        return Contour.trusted(contour.points[self.order], contour.closed, contour.accuracy)

    def fit(self, fit: Fit) -> Fit:
        """A fit of the contour as one of the contour in this order."""
        return self.curve(replace(fit, contour=self.contour(fit.contour)))

    def restored(self, fit: Fit, read: Fit, found: Fit) -> Fit:
        """What a repair found for a fit that was ``read``, as one of the data as they are."""
        if found is read:
            return fit
        if found.sections is read.sections and found.spline is read.spline:
            return replace(fit, status=found.status)
        again = verified_anew(fit, self.curve(found))
        return replace(again, status=found.status, outliers=fit.outliers)

    def curve(self, fit: Fit) -> Fit:
        """The curve of a fit, run through the other way where the data are."""
        if not self.is_backwards:
            return fit
        pieces = backwards(fit.sections)
        # Joined anew: to the bit what pieces that were found in this order make.
        spline = joined(pieces, fit.degree) if pieces else reversed_curve(fit.spline)
        return replace(fit, spline=spline, sections=pieces)

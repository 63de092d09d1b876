"""compare: how far two sets of curves lie apart, both ways."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from shapespline.errors import InvalidInputError
from shapespline.geometry.nearest import nearest
from shapespline.geometry.polygons import polyline_curve
from shapespline.values import Arc, BSplineCurve, Contour, Drawing, Fit, Shape

if TYPE_CHECKING:
    from shapespline.typing import FloatArray

Curves = Drawing | Fit | Shape | Contour | BSplineCurve

# Samples of all curves of one side together, and for each Bezier piece at least.
SAMPLES = 20_000
SAMPLES_OF_A_PIECE = 4


@dataclass(frozen=True)
class Comparison:
    """Distances between two sets of curves, in their unit.

    Attributes
    ----------
    forward_max, forward_rms : float
        From the first set to the second, over samples at equal arc length.
    reverse_max, reverse_rms : float
        From the second to the first.
    spacing : float
        Largest distance between neighbouring samples. Between them a distance can exceed the
        largest one by half of it, no more.
    """

    forward_max: float
    forward_rms: float
    reverse_max: float
    reverse_rms: float
    spacing: float

    @property
    def hausdorff_distance(self) -> float:
        """The larger of both directions."""
        return max(self.forward_max, self.reverse_max)


def compare(first: Curves, second: Curves) -> Comparison:
    """How far two drawings, or outlines, lie apart: each from the other, whatever their pieces.

    Parameters
    ----------
    first, second : Drawing, Fit, Shape, Contour or BSplineCurve
        Of shapes and contours the polylines are compared.

    Returns
    -------
    Comparison
        Distances of about 20 000 samples of each to the exact curves of the other, arcs included.

    Examples
    --------
    >>> low = Contour([(0, 0), (4, 0)], closed=False)
    >>> high = Contour([(0, 1), (4, 1), (4, 3)], closed=False)
    >>> found = compare(low, high)
    >>> found.forward_max, found.reverse_max
    (1.0, 3.0)
    """
    a, b = _curves(first, "first"), _curves(second, "second")
    samples_a, spacing_a = _samples(a)
    samples_b, spacing_b = _samples(b)
    forward, reverse = _distances(samples_a, b), _distances(samples_b, a)
    return Comparison(
        float(forward.max()),
        float(np.sqrt((forward**2).mean())),
        float(reverse.max()),
        float(np.sqrt((reverse**2).mean())),
        max(spacing_a, spacing_b),
    )


def _curves(value: Curves, name: str) -> list[BSplineCurve | Arc]:
    if isinstance(value, BSplineCurve):
        return [value]
    if isinstance(value, Fit):
        return value.exact_parts
    if isinstance(value, Contour):
        return [polyline_curve(value)]
    if isinstance(value, Drawing):
        return [part for fit in value for part in fit.exact_parts]
    if isinstance(value, Shape):
        return [polyline_curve(contour) for contour in value]
    raise InvalidInputError(
        f"{name} must be a Drawing, Fit, Shape, Contour or BSplineCurve, got {type(value).__name__}"
    )


def _samples(curves: list[BSplineCurve | Arc]) -> tuple[FloatArray, float]:
    """Points at about equal arc length on all curves, and the largest step between two."""
    lengths = np.array([curve.length() for curve in curves])
    total = float(lengths.sum())
    parts, largest = [], 0.0
    for curve, length in zip(curves, lengths.tolist(), strict=True):
        count = int(SAMPLES * length / (total or 1.0))
        points = (
            curve.at(np.linspace(0.0, 1.0, SAMPLES_OF_A_PIECE + count + 1))
            if isinstance(curve, Arc)
            else _samples_of(curve, count)
        )
        largest = max(largest, float(np.hypot(*np.diff(points, axis=0).T).max()))
        parts.append(points)
    return np.concatenate(parts), largest


def _samples_of(curve: BSplineCurve, count: int) -> FloatArray:
    """Equal steps of the parameter within each piece, as many as its length asks for."""
    breakpoints = curve.breakpoints
    fine = SAMPLES_OF_A_PIECE * (len(breakpoints) - 1) + count
    ends = curve(breakpoints)
    chords = np.hypot(*np.diff(ends, axis=0).T)
    share = chords / (chords.sum() or 1.0)
    counts = np.maximum(SAMPLES_OF_A_PIECE, np.ceil(fine * share).astype(int))
    at = [
        np.linspace(begin, end, count, endpoint=False)
        for begin, end, count in zip(breakpoints[:-1], breakpoints[1:], counts, strict=True)
    ]
    return np.asarray(curve(np.concatenate([*at, breakpoints[-1:]])))


def _distances(points: FloatArray, curves: list[BSplineCurve | Arc]) -> FloatArray:
    """Distance of each point to the nearest of the curves."""
    nearest_sq = np.full(len(points), np.inf)
    for curve in curves:
        # A curve lies in the box of its control points, an arc in that of its circle: most points
        # need not ask it.
        box = (
            np.add.outer([-curve.radius, curve.radius], curve.centre)
            if isinstance(curve, Arc)
            else curve.control_points
        )
        outside = np.maximum(np.maximum(box.min(axis=0) - points, points - box.max(axis=0)), 0.0)
        near = np.flatnonzero((outside**2).sum(axis=1) < nearest_sq)
        if len(near) == 0:
            continue
        found = (
            curve.distances(points[near]) ** 2
            if isinstance(curve, Arc)
            else nearest(curve, points[near]).distances_sq
        )
        nearest_sq[near] = np.minimum(nearest_sq[near], found)
    return np.sqrt(nearest_sq)

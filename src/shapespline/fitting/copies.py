"""Outlines with free-form parts that are one but for their places: letters of a word, two ears.

What lines and arcs alone make up is solved together (`across`); of the others one curve, as it was
drawn or the smallest, stands for its copies, moved, turned by right angles or mirrored at an axis,
wherever it tells their points as well as its own (DRA-31).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.engines.drawn import Observed
from shapespline.fitting.across import MISSED, MOST_OUTLINES, WORSE_BY, WORSE_PART
from shapespline.fitting.verify import verified_fit
from shapespline.geometry import (
    backwards,
    joined,
    polyline_curve,
    reversed_curve,
    two_sided_distance,
)
from shapespline.values import BSplineCurve, Contour, Regularity

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from shapespline.typing import FloatArray
    from shapespline.values import Fit

    ComplexArray = NDArray[np.complex128]

# Places of an outline that are compared; an outline of fewer points tells no copies.
PLACES, FEWEST_POINTS = 1024, 12
# Lengths of copies differ by less than this part (DRA-31).
LENGTHS = 0.01


class _Motion(NamedTuple):
    """p -> ``linear`` (p - centre) + own centre; mirrors run through a curve backwards."""

    linear: FloatArray
    is_mirror: bool


@dataclass(frozen=True, eq=False)
class _Seen:
    """An outline, told by places at equal steps about its centre, and its fit."""

    fit: Fit

    @property
    def contour(self) -> Contour:
        """The data."""
        return self.fit.contour

    @cached_property
    def centre(self) -> FloatArray:
        """Of the line, not of the area that it encloses."""
        polyline = self.contour.polyline
        steps = np.hypot(*np.diff(polyline, axis=0).T)
        return np.average(0.5 * (polyline[1:] + polyline[:-1]), axis=0, weights=steps)

    @cached_property
    def places(self) -> ComplexArray:
        """About the centre."""
        at = np.linspace(0.0, self.contour.length, PLACES, endpoint=False)
        x, y = (self.contour.at(at) - self.centre).T
        return x + 1j * y

    @cached_property
    def spectrum(self) -> ComplexArray:
        """Of the places."""
        return np.fft.fft(self.places)

    @cached_property
    def deviation(self) -> float:
        """Of a point."""
        traced = self.contour.level_line is not None
        return Observed.of(self.contour, self.contour.accuracy if traced else None).deviation


def equal_copies(
    fits: Sequence[Fit], tolerance: float | None
) -> tuple[list[Fit], tuple[Regularity, ...]]:
    """The fits with one curve for all copies of an outline, and which these are.

    Parameters
    ----------
    fits : sequence of Fit
    tolerance : float or None
        The one asked for.
    """
    able = [k for k, fit in enumerate(fits) if _has_curves(fit)]
    if not 1 < len(able) <= MOST_OUTLINES:
        return list(fits), ()
    seen = {k: _Seen(fits[k]) for k in able}
    found = list(fits)
    heads: dict[int, dict[int, float]] = {}
    for k in sorted(able, key=lambda k: (fits[k].method != "drawn", fits[k].n_stored_points, k)):
        for head, copies in heads.items():
            motion = _motion(seen[head], seen[k])
            copy = None if motion is None else _copy(seen[head], seen[k], motion, tolerance)
            if motion is not None and copy is not None:
                found[k], copies[k] = copy, _miss(seen[head], seen[k], motion)
                break
        else:
            heads[k] = {}
    return found, tuple(
        Regularity("equal-copies", tuple(sorted((head, *copies))), max(copies.values()))
        for head, copies in heads.items()
        if copies
    )


def _has_curves(fit: Fit) -> bool:
    """Whether nothing but its own points shaped a fit of more than lines and arcs."""
    simple = all(piece.kind in ("line", "arc") for piece in fit.pieces)
    enough = len(fit.contour) >= FEWEST_POINTS and fit.closed and fit.kept
    return enough and not (simple or fit.uncertainty is not None or len(fit.outliers))


def _miss(head: _Seen, other: _Seen, motion: _Motion) -> float:
    """How far the data of one, moved, are from those of the other."""
    moved = (head.contour.points - head.centre) @ motion.linear.T + other.centre
    image = polyline_curve(Contour.silently(moved, closed=True))
    return two_sided_distance(image, other.contour).hausdorff_distance


def _copy(head: _Seen, other: _Seen, motion: _Motion, tolerance: float | None) -> Fit | None:
    """The curve of one as that of the other; None if it is not as good there."""
    linear, shift = motion.linear, other.centre - motion.linear @ head.centre
    pieces = tuple(piece.moved(linear, shift) for piece in head.fit.sections)
    if motion.is_mirror:
        pieces = backwards(pieces)
    if pieces:
        spline = joined(pieces, head.fit.degree)
    else:
        own = head.fit.spline
        points = np.ascontiguousarray(own.control_points @ linear.T + shift)
        spline = BSplineCurve(own.knots, points, own.degree, periodic=own.periodic)
        spline = reversed_curve(spline) if motion.is_mirror else spline
    old = other.fit
    fit = verified_fit(
        other.contour, spline, tolerance=tolerance, method=head.fit.method, sections=pieces
    )
    reach = MISSED * max(head.deviation, other.deviation)
    rms = max(old.rms_distance, head.fit.rms_distance)
    rms = max(WORSE_PART * rms, rms + WORSE_BY * other.deviation)
    far = max(old.hausdorff_distance, head.fit.hausdorff_distance) + reach
    if not fit.kept or fit.rms_distance > rms or fit.hausdorff_distance > far:
        return None
    n = len(pieces)
    kept = tuple(
        one._replace(pieces=tuple(sorted(n - 1 - k if motion.is_mirror else k for k in one.pieces)))
        for one in head.fit.regularities
    )
    return replace(fit, history=old.history, regularities=kept)


def _motion(head: _Seen, other: _Seen) -> _Motion | None:
    """The move, turn by right angles or mirror that maps one onto the other; None if none does."""
    if abs(head.contour.length - other.contour.length) > LENGTHS * head.contour.length:
        return None
    near = MISSED * max(head.deviation, other.deviation) + 0.5 * head.contour.length / PLACES
    squares = float((abs(head.places) ** 2).sum() + (abs(other.places) ** 2).sum())
    for is_mirror in (False, True):
        # A mirror image at the first axis, run through backwards: its spectrum is the conjugate.
        shown = head.spectrum.conj() if is_mirror else head.spectrum
        products = np.fft.ifft(other.spectrum * shown.conj())
        peak = products[int(abs(products).argmax())]
        turns = round(float(np.angle(peak)) / (0.5 * np.pi)) % 4
        together = 2.0 * float((peak * (-1j) ** turns).real)
        if squares - together > PLACES * near**2:
            continue
        linear = np.linalg.matrix_power(np.array([[0.0, -1.0], [1.0, 0.0]]), turns)
        if is_mirror:
            linear = linear @ np.diag([1.0, -1.0])
        return _Motion(linear, is_mirror)
    return None

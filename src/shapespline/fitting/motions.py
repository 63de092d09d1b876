"""Moves, turns and mirrors that map an outline onto another, by its line alone.

Places at equal steps of arc length about the middle of two outlines are compared at all beginnings
at once, by their spectra; a turn is what their products have in common.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.analysis import noise_level
from shapespline.engines.drawn import Observed, turn_matrix
from shapespline.fitting.verify import verified_fit
from shapespline.geometry import (
    backwards,
    joined,
    nearest,
    polyline_curve,
    reversed_curve,
    unit_normals,
)
from shapespline.values import BSplineCurve

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from shapespline.typing import FloatArray
    from shapespline.values import Contour, Fit, Piece

    ComplexArray = NDArray[np.complex128]

# Places of an outline that are compared (DRA-31).
PLACES = 1024
# Points that are looked at.
MOST_POINTS = 2000
# Rounds of Newton's method, which ends in two.
ROUNDS = 3
RIGHT = 0.5 * np.pi


class Motion(NamedTuple):
    """p -> ``linear`` (p - centre) + own centre + ``shift``.

    A mirror runs through a curve backwards.
    """

    linear: FloatArray
    shift: FloatArray
    is_mirror: bool

    def after(self, first: Motion) -> Motion:
        """Another one, then this."""
        linear, shift = self.linear @ first.linear, self.linear @ first.shift + self.shift
        return Motion(linear, shift, self.is_mirror != first.is_mirror)

    def back(self) -> Motion:
        """The one that undoes it."""
        return Motion(self.linear.T, -self.linear.T @ self.shift, self.is_mirror)

    def nearer(self, head: Placed, other: Placed) -> Motion:
        """Where the line of one is nearest to that of the other in the mean square.

        By Newton's method; without a turn where axes are kept.
        """
        motion, curve = self, polyline_curve(other.line)
        for _ in range(ROUNDS):
            points = head.images(head.some, motion, other)
            at = nearest(curve, points).parameters
            normals, middle = unit_normals(curve, at), points.mean(axis=0)
            x, y = (points - middle).T
            columns = [*normals.T, x * normals[:, 1] - y * normals[:, 0]]
            columns = columns[:2] if self.keeps_axes else columns
            off = ((curve(at) - points) * normals).sum(axis=1)
            moved, turn = np.split(np.linalg.lstsq(np.stack(columns, axis=1), off)[0], [2])
            turned = turn_matrix(float(turn.sum()))
            shift = turned @ (other.centre + motion.shift - middle) + middle + moved - other.centre
            motion = Motion(turned @ motion.linear, shift, self.is_mirror)
        return motion

    @property
    def keeps_axes(self) -> bool:
        """Whether level edges stay level."""
        return bool((self.linear == 0.0).any())


@dataclass(frozen=True, eq=False)
class Placed:
    """An outline, told by places at equal steps about its centre, and its fit."""

    fit: Fit
    line: Contour

    @cached_property
    def centre(self) -> FloatArray:
        """Of the line, not of the area that it encloses."""
        polyline = self.line.polyline
        steps = np.hypot(*np.diff(polyline, axis=0).T)
        return np.average(0.5 * (polyline[1:] + polyline[:-1]), axis=0, weights=steps)

    @cached_property
    def places(self) -> ComplexArray:
        """About the centre."""
        at = np.linspace(0.0, self.line.length, PLACES, endpoint=False)
        x, y = (self.line.at(at) - self.centre).T
        return x + 1j * y

    @cached_property
    def spectrum(self) -> ComplexArray:
        """Of the places."""
        return np.fft.fft(self.places)

    @cached_property
    def size(self) -> float:
        """Sum of the squares of the places."""
        return float((abs(self.places) ** 2).sum())

    @cached_property
    def deviation(self) -> float:
        """Of a point of the data."""
        contour = self.fit.contour
        if contour.level_line is not None:
            return Observed.of(contour, contour.accuracy).deviation
        # Of many noisy points means are looked at, which are less far off than each.
        return max(Observed.of(contour, None).deviation, noise_level(contour))

    @property
    def some(self) -> FloatArray:
        """Points of its line, every so many-th of very many."""
        return self.line.points[:: len(self.line) // MOST_POINTS + 1]

    def images(self, points: FloatArray, motion: Motion, other: Placed) -> FloatArray:
        """Points of its line as those of the other."""
        return (points - self.centre) @ motion.linear.T + other.centre + motion.shift

    def pieces_at(self, motion: Motion, other: Placed) -> tuple[Piece, ...]:
        """The pieces of its fit as those of the other."""
        shift = self._shift(motion, other)
        pieces = tuple(piece.moved(motion.linear, shift) for piece in self.fit.sections)
        return backwards(pieces) if motion.is_mirror else pieces

    def spline_at(self, motion: Motion, other: Placed) -> BSplineCurve:
        """The curve of its fit as that of the other."""
        if self.fit.sections:
            return joined(self.pieces_at(motion, other), self.fit.degree)
        own, shift = self.fit.spline, self._shift(motion, other)
        points = np.ascontiguousarray(own.control_points @ motion.linear.T + shift)
        spline = BSplineCurve(own.knots, points, own.degree, periodic=own.periodic)
        return reversed_curve(spline) if motion.is_mirror else spline

    def _shift(self, motion: Motion, other: Placed) -> FloatArray:
        """What is added to the linear image of a point."""
        return other.centre + motion.shift - motion.linear @ self.centre

    def as_fit_of(self, other: Placed, motion: Motion, tolerance: float | None) -> Fit:
        """Its curve as that of the other, verified there, with all that it keeps so moved."""
        fit = verified_fit(
            other.fit.contour,
            self.spline_at(motion, other),
            tolerance=tolerance,
            method=self.fit.method,
            sections=self.pieces_at(motion, other),
        )
        n = len(self.fit.sections)
        kept = tuple(
            one._replace(
                pieces=tuple(sorted(n - 1 - k if motion.is_mirror else k for k in one.pieces))
            )
            for one in self.fit.regularities
            if motion.keeps_axes or one.name != "axis-parallel"
        )
        return replace(fit, history=other.fit.history, regularities=kept)


def motion_between(head: Placed, other: Placed, near: float, lengths: float) -> Motion | None:
    """The motion that maps one onto the other; None if none does.

    Parameters
    ----------
    head, other : Placed
    near : float
        How far places may be from each other in the mean.
    lengths : float
        Part of the length by which that of copies may differ.
    """
    if abs(head.line.length - other.line.length) > lengths * head.line.length:
        return None
    frequencies = np.fft.fftfreq(PLACES, 1 / PLACES)
    free: list[tuple[float, Motion]] = []
    for is_mirror in (False, True):
        # A mirror image at the first axis, run through backwards: its spectrum is the conjugate.
        shown = head.spectrum.conj() if is_mirror else head.spectrum
        common = other.spectrum * shown.conj()
        products = abs(np.fft.ifft(common))
        first = int(products.argmax())
        less, most, more = products[[first - 1, first, (first + 1) % PLACES]].tolist()
        begin = first + 0.5 * (less - more) / min(less - 2.0 * most + more, -1e-300)
        product = complex((common * np.exp(2j * np.pi * frequencies * begin / PLACES)).mean())
        angle = float(np.angle(product))
        for settled in (round(angle / RIGHT) * RIGHT, angle):
            together = 2.0 * float((product * np.exp(-1j * settled)).real)
            miss_sq = (head.size + other.size - together) / PLACES
            if miss_sq > near**2:
                continue
            motion = Motion(turn_matrix(settled, is_mirrored=is_mirror), np.zeros(2), is_mirror)
            if motion.keeps_axes:
                return motion
            free.append((miss_sq, motion))
    return min(free, key=lambda one: one[0])[1] if free else None

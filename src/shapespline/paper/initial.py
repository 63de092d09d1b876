"""The initial curve: from an outline to control points in one pass, the paper's section 4.

CPDA finds the dominant points; each gives one control point, moved off the outline against the
normal so that the curve passes near it; the knots are uniform.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.analysis import Cpda, chord_to_point
from shapespline.errors import DegenerateContourError, InvalidInputError
from shapespline.geometry import greville_matched, parametrize
from shapespline.paper.reading import SENSIBLE, Reading
from shapespline.values import (
    BSplineCurve,
    Contour,
    check_degree,
    checked_contour,
    clamped_knots,
    greville_abscissae,
    periodic_knots,
)

if TYPE_CHECKING:
    from scipy.interpolate import BSpline

    from shapespline.typing import FloatArray, IntArray

DEFAULT_LENGTH = 8
# Steps between points may differ by this factor and still count as equal.
EVEN_SPACING = 1.5
# A chord given as an arc length is divided into this many steps, whatever the data's density: the
# work is then that of the outline's length in chords, not of n times L (PAP-02).
CHORD_STEPS = 16
# The curvature offset may push a control point this part of its distance to the next ones (PAP-03).
LARGEST_OFFSET = 0.25
# More CPDA points than this are no outline but a slip of the unit.
MOST_STEPS = 100_000_000


class Frames(NamedTuple):
    """Unit tangents and principal normals, (k, 2) each; the normal is zero on straight runs."""

    tangents: FloatArray
    normals: FloatArray


@dataclass(frozen=True, eq=False, kw_only=True)
class InitialCurve:
    """The initial curve and how it came about.

    Attributes
    ----------
    spline : BSplineCurve
        The curve; ``curve`` is the same as a scipy BSpline.
    parameters : ndarray, shape (n,)
        Location parameter of every point of the contour, increasing (unwrapped if periodic).
    samples : Contour
        The points that CPDA was taken on: the data, or the data at equal arc length.
    cpda : Cpda
        The accumulation along ``samples``.
    stations : ndarray, shape (k,)
        Indices in ``samples`` of the points that control points were made from.
    frames : Frames
        Tangents and normals there.
    dominant : ndarray, shape (k,)
        Indices of the nearest points of the contour.
    """

    spline: BSplineCurve
    parameters: FloatArray = field(repr=False)
    samples: Contour = field(repr=False)
    cpda: Cpda = field(repr=False)
    stations: IntArray = field(repr=False)
    frames: Frames = field(repr=False)
    dominant: IntArray = field(repr=False)

    @cached_property
    def curve(self) -> BSpline:
        """The curve as a ``scipy.interpolate.BSpline``."""
        return self.spline.to_scipy()

    @property
    def control_points(self) -> FloatArray:
        """Distinct control points, shape (m, 2)."""
        return self.spline.control_points

    @property
    def n_control_points(self) -> int:
        """Number of distinct control points."""
        return self.spline.n_control_points


def initial_curve(
    contour: Contour,
    length: int | None = None,
    *,
    arc_length: float | None = None,
    degree: int = 3,
    reading: Reading = SENSIBLE,
    n_control_points: int = 0,
) -> InitialCurve:
    """Control points, knots and parameters of an initial B-spline curve, without any solve.

    Parameters
    ----------
    contour : Contour
    length : int, optional
        CPDA chord length L in points (8 when neither length is given).
    arc_length : float, optional
        The same as a length in data units, independent of how densely the outline was sampled.
    degree : int
        1 to 9.
    reading : Reading
        ``SENSIBLE`` or ``LITERAL``, or one with fields of your own.
    n_control_points : int
        At least so many: where the maxima are too few, the widest gaps between them are halved.

    Raises
    ------
    InvalidInputError
        If L is below 2 or too long for the data.
    DegenerateContourError
        If there are too few points for the degree, or (literal reading) too few maxima.

    References
    ----------
    The paper's section 4; METHOD section 2 for what it leaves open.

    Examples
    --------
    >>> t = np.linspace(0, 2 * np.pi, 240, endpoint=False)
    >>> r = 10 + 2 * np.cos(5 * t)
    >>> flower = Contour(np.column_stack([r * np.cos(t), r * np.sin(t)]), closed=True)
    >>> start = initial_curve(flower, length=8)
    >>> start.n_control_points, start.dominant[:3].tolist()
    (10, [0, 24, 48])
    """
    checked_contour(contour, "contour")
    if not isinstance(reading, Reading):
        raise InvalidInputError(f"reading must be a Reading, got {reading!r}; SENSIBLE or LITERAL")
    degree = check_degree(degree)
    if len(contour) < degree + 1:
        raise DegenerateContourError(
            f"contour must have at least degree + 1 = {degree + 1} points, got {len(contour)};"
            " add points or lower the degree"
        )
    samples, steps = _sampled(contour, length, arc_length, reading)
    cpda = chord_to_point(
        samples,
        steps,
        signed=reading.signed,
        window=reading.window,
        prominence=reading.prominence,
        spacing=max(1, steps // 2) if reading.spacing is None else reading.spacing,
    )
    periodic = contour.closed and not reading.clamped
    needed = max(degree + 1, n_control_points) - (0 if periodic else 2)
    stations = cpda.maxima
    if not periodic:  # the ends have control points of their own
        stations = stations[(stations > 0) & (stations < len(samples) - 1)]
    if len(stations) < needed:
        if not reading.supplemented:
            raise DegenerateContourError(
                f"length {steps} finds {len(stations)} maxima, at least {needed} are needed for"
                f" degree {degree}; shorten the length or lower the degree"
            )
        stations = _supplemented(stations, needed, samples, periodic=periodic)
    frames = _frames(samples, cpda, reading)
    frames = Frames(frames.tangents[stations], frames.normals[stations])
    at = samples.arc_length[stations]
    inner = samples.points[stations] + _offsets(cpda, samples, stations, frames, degree, reading)
    spline, parameters = _curve_and_parameters(contour, inner, at, degree, periodic, reading)
    return InitialCurve(
        spline=spline,
        parameters=parameters,
        samples=samples,
        cpda=cpda,
        stations=stations,
        frames=frames,
        dominant=_nearest_index(contour, at),
    )


def _sampled(
    contour: Contour, length: int | None, arc_length: float | None, reading: Reading
) -> tuple[Contour, int]:
    """The points that CPDA is taken on, and its chord length in them."""
    if length is not None and arc_length is not None:
        raise InvalidInputError("length and arc_length say the same thing: give one of them")
    if arc_length is not None:
        if not 0 < arc_length < 0.5 * contour.length:
            raise InvalidInputError(
                "arc_length must be positive and below half the length of the outline"
                f" ({0.5 * contour.length:g}), got {arc_length!r}"
            )
        n_steps = round(contour.length * CHORD_STEPS / arc_length)
        if n_steps > MOST_STEPS:
            raise InvalidInputError(
                f"arc_length must be a length in data units, got {arc_length!r} on an outline of"
                f" length {contour.length:g}; lengthen it"
            )
        return contour.resampled(n_steps if contour.closed else n_steps + 1), CHORD_STEPS
    if length is None:
        length = DEFAULT_LENGTH
    if reading.resampled:
        steps = np.diff(contour.arc_length)
        if steps.max() > EVEN_SPACING * steps.min():
            return contour.resampled(len(contour)), length
    return contour, length


def _supplemented(stations: IntArray, needed: int, samples: Contour, *, periodic: bool) -> IntArray:
    """Stations halved into the widest gaps until there are as many as needed.

    A circle has no maxima; it still has a curve.
    """
    n = len(samples)
    chosen = stations.tolist()
    while len(chosen) < needed:
        if periodic:
            chosen = sorted(chosen) or [0]
            around = [*chosen, chosen[0] + n]
        else:
            around = [0, *sorted(chosen), n - 1]
        gaps = np.diff(around)
        widest = int(np.argmax(gaps))
        if gaps[widest] < 2:
            raise DegenerateContourError(
                f"contour must have more points for the degree: {n} points hold"
                f" {len(chosen)} control points apart from the ends, {needed} are needed"
            )
        chosen.append((around[widest] + int(gaps[widest]) // 2) % n)
    return np.array(sorted(chosen), dtype=np.int64)


def _frames(samples: Contour, cpda: Cpda, reading: Reading) -> Frames:
    """Unit tangents and principal normals (towards the centre of curvature) of every sample.

    Literally by differences of neighbours. Sensibly by differences over the chord length, with
    the side taken from the signed CPDA sum, and none where that is below its floor (reading 10).
    """
    points = samples.points
    if reading.normals == "neighbours":
        tangents = _unit(_central_difference(points, 1, samples.closed))
        return Frames(tangents, _unit(_central_difference(tangents, 1, samples.closed)))
    tangents = _unit(_central_difference(points, cpda.length, samples.closed))
    side = np.where(np.abs(cpda.signed) > cpda.floor, np.sign(cpda.signed), 0.0)
    normals = side[:, None] * np.column_stack([-tangents[:, 1], tangents[:, 0]])
    return Frames(tangents, normals)


def _central_difference(values: FloatArray, reach: int, closed: bool) -> FloatArray:
    """values[r + reach] - values[r - reach]; one-sided where open data end."""
    if closed:
        return np.roll(values, -reach, axis=0) - np.roll(values, reach, axis=0)
    index = np.arange(len(values))
    return values[np.minimum(index + reach, len(values) - 1)] - values[np.maximum(index - reach, 0)]


def _unit(vectors: FloatArray) -> FloatArray:
    """Vectors of length one, zero where there is no direction."""
    length = np.hypot(vectors[:, 0], vectors[:, 1])[:, None]
    return np.divide(vectors, length, out=np.zeros_like(vectors), where=length > 0)


def _offsets(
    cpda: Cpda,
    samples: Contour,
    stations: IntArray,
    frames: Frames,
    degree: int,
    reading: Reading,
) -> FloatArray:
    """From each station to its control point, shape (k, 2), data units."""
    if reading.offset == "none":
        return np.zeros((len(stations), 2))
    periodic = samples.closed and not reading.clamped
    if reading.offset == "difference":
        around = _with_neighbours(samples.points[stations], samples.points, periodic, 0.0)
        return -_bend_gain(degree) * (around[2:] - 2 * around[1:-1] + around[:-2])
    h = cpda.values[stations]
    if reading.offset == "squared":
        distance = float(cpda.values.max()) * h
    elif reading.offset == "cpda":
        distance = h
    else:
        step = samples.length / (len(samples) if samples.closed else len(samples) - 1)
        at = samples.arc_length[: len(samples)]
        around = _with_neighbours(at[stations], at, periodic, samples.length)
        spacing = 0.5 * (around[2:] - around[:-2])
        bend = np.abs(cpda.curvature(step)[stations])
        distance = np.minimum(bend * spacing**2 * _bend_gain(degree), LARGEST_OFFSET * spacing)
    return -distance[:, None] * frames.normals


def _with_neighbours(
    chosen: FloatArray, values: FloatArray, periodic: bool, period: float
) -> FloatArray:
    """The chosen values with those before the first and after the last of them."""
    if periodic:
        return np.concatenate([chosen[-1:] - period, chosen, chosen[:1] + period])
    return np.concatenate([values[:1], chosen, values[-1:]])


def _bend_gain(degree: int) -> float:
    """(p + 1) / 24: uniform B-splines of degree p lie k h^2 (p + 1) / 24 inside (reading 9)."""
    return 0.0 if degree == 1 else (degree + 1) / 24.0


def _curve_and_parameters(
    contour: Contour,
    inner: FloatArray,
    at: FloatArray,
    degree: int,
    periodic: bool,
    reading: Reading,
) -> tuple[BSplineCurve, FloatArray]:
    """The curve through its control points on uniform knots, and the data's parameters."""
    if periodic:
        knots = periodic_knots(len(inner), degree)
        control_points, anchors = inner, at
    else:
        knots = clamped_knots(len(inner) + 2, degree)
        control_points = np.concatenate([contour.points[:1], inner, contour.points[-1:]])
        end = contour.arc_length[len(contour) - 1]
        anchors = np.concatenate([[0.0], at, [end]])
    spline = BSplineCurve(knots, control_points, degree, periodic)
    if reading.parametrization == "greville":
        abscissae = greville_abscissae(knots, degree)[: len(control_points)]
        parameters = greville_matched(contour, anchors, abscissae, 1.0 if periodic else None)
    elif contour.closed and not periodic:
        # The clamped curve ends at the last point: it has no closing segment.
        parameters = parametrize(Contour(contour.points, closed=False), reading.parametrization)
    else:
        parameters = parametrize(contour, reading.parametrization)
        if periodic:  # the first control point, not the first data point, sits at its abscissa
            there = np.interp(at[0], contour.arc_length[: len(contour)], parameters)
            parameters += greville_abscissae(knots, degree)[0] - there
    return spline, parameters


def _nearest_index(contour: Contour, at: FloatArray) -> IntArray:
    """Index of the contour point nearest in arc length to each station."""
    middles = 0.5 * (contour.arc_length[1:] + contour.arc_length[:-1])
    return np.searchsorted(middles, at) % len(contour)

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
from shapespline.engines.least_squares import (
    STARTS,
    STATIONS,
    bend_gain,
    chosen_stations,
    even_samples,
    inner_maxima,
    own_number,
    path_of,
    placed_curve,
    quasi_interpolating,
    with_neighbours,
)
from shapespline.errors import DegenerateContourError, InvalidInputError
from shapespline.paper.reading import SENSIBLE, Reading
from shapespline.validation import whole_number
from shapespline.values import BSplineCurve, Contour, check_degree, checked_contour

if TYPE_CHECKING:
    from scipy.interpolate import BSpline

    from shapespline.engines.least_squares import RunSettings
    from shapespline.typing import FloatArray, IntArray

DEFAULT_LENGTH = 8
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
        Location parameter of every point of the contour, increasing (unwrapped if periodic); one
        more for the first point again where a closed contour gets a clamped curve.
    reading : Reading
        How it was made, and how `optimize` goes on from it.
    samples : Contour
        The points that CPDA was taken on: the data, or the data at equal arc length.
    cpda : Cpda
        The accumulation along ``samples``.
    stations : ndarray, shape (k,)
        Indices in ``samples`` of the points that control points were made from; the maxima of H
        where the reading's start solves for them.
    frames : Frames
        Tangents and normals there.
    dominant : ndarray, shape (k,)
        Indices of the nearest points of the contour.
    """

    spline: BSplineCurve
    parameters: FloatArray = field(repr=False)
    reading: Reading = field(repr=False)
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
    def settings(self) -> RunSettings:
        """What `optimize` takes from this start where its caller says nothing."""
        return self.reading.settings

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
    n_control_points: int | None = None,
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
    n_control_points : int, optional
        How many. When not given, the maxima alone if the reading takes only these; otherwise as
        many as there are once the gaps between maxima that are wider than half the mean one are
        halved, because a run without a maximum would get no control point of its own.

    Raises
    ------
    InvalidInputError
        If L is below 2 or too long for the data, or a field or count cannot be taken.
    DegenerateContourError
        If there are too few points for the degree, or (maxima alone) too few maxima.

    References
    ----------
    The paper's section 4; METHOD section 2 for what it leaves open.

    Examples
    --------
    >>> t = np.linspace(0, 2 * np.pi, 240, endpoint=False)
    >>> r = 10 + 2 * np.cos(5 * t)
    >>> flower = Contour(np.column_stack([r * np.cos(t), r * np.sin(t)]), closed=True)
    >>> start = initial_curve(flower, length=8)
    >>> start.n_control_points, start.cpda.maxima[:3].tolist()
    (20, [0, 24, 48])
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
    along, path = (
        path_of(data, periodic=periodic, closing_point=reading.closing_point)
        for data in (contour, samples)
    )
    count = _count(path, cpda, degree, reading, n_control_points)
    is_placed = reading.start in STATIONS
    stations = (
        chosen_stations(reading.start, path, cpda, count) if is_placed else inner_maxima(cpda, path)
    )
    frames = _frames(samples, cpda, reading)
    frames = Frames(frames.tangents[stations], frames.normals[stations])
    at = path.arc_length[stations]
    if is_placed:
        inner = path.points[stations] + _offsets(cpda, path, stations, frames, degree, reading)
        found = placed_curve(
            along, inner, at, degree, periodic=periodic, parametrization=reading.parametrization
        )
    else:
        found = STARTS[reading.start](along, count + (0 if periodic else 2), degree, None)
    return InitialCurve(
        spline=found.spline,
        parameters=found.parameters,
        reading=reading,
        samples=samples,
        cpda=cpda,
        stations=stations,
        frames=frames,
        dominant=_nearest_index(contour, at),
    )


def _count(path: Contour, cpda: Cpda, degree: int, reading: Reading, asked: int | None) -> int:
    """How many stations get a control point, apart from the ends."""
    ends = 0 if path.closed else 2
    if asked is not None:
        n = whole_number(asked)
        if n is None or not degree + 1 <= n <= len(path):
            raise InvalidInputError(
                f"n_control_points must be from degree + 1 = {degree + 1} to the number of points,"
                f" {len(path)}, got {asked!r}"
            )
        return n - ends
    alone = reading.start == "cpda-maxima"
    own = len(inner_maxima(cpda, path)) if alone else own_number(path, cpda)
    return max(degree + 1 - ends, own)


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
    if reading.resampled and reading.start != "every-nth":
        return even_samples(contour), length
    return contour, length


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
    path: Contour,
    stations: IntArray,
    frames: Frames,
    degree: int,
    reading: Reading,
) -> FloatArray:
    """From each station to its control point, shape (k, 2), data units."""
    if reading.offset == "none":
        return np.zeros((len(stations), 2))
    if reading.offset == "difference":
        ends = None if path.closed else path.points[[0, -1]]
        return quasi_interpolating(path.points[stations], ends, degree)
    h = cpda.values[stations]
    if reading.offset == "squared":
        distance = float(cpda.values.max()) * h
    elif reading.offset == "cpda":
        distance = h
    else:
        at = path.arc_length
        step = path.length / (len(at) - 1)
        around = with_neighbours(at[stations], at, path.length if path.closed else None)
        spacing = 0.5 * (around[2:] - around[:-2])
        bend = np.abs(cpda.curvature(step)[stations])
        distance = np.minimum(bend * spacing**2 * bend_gain(degree), LARGEST_OFFSET * spacing)
    return -distance[:, None] * frames.normals


def _nearest_index(contour: Contour, at: FloatArray) -> IntArray:
    """Index of the contour point nearest in arc length to each station."""
    middles = 0.5 * (contour.arc_length[1:] + contour.arc_length[:-1])
    return np.searchsorted(middles, at) % len(contour)

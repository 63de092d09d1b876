"""Mirror symmetry of a closed outline: found, one half fitted, the other one reflected.

With arc length from the axis on, z(s0 + t) = e^(2 i phi) conj(z(s0 - t)) about a centre on the
axis; so the correlation of an outline with its own conjugate reversal, one FFT, is largest where an
axis crosses it, and its phase is twice the axis's angle (Atallah 1985 for polygons).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline import _kernels
from shapespline.contour import Contour
from shapespline.distance import FLOOR
from shapespline.drawing import Piece
from shapespline.held import Held
from shapespline.joining import backwards, turn_between
from shapespline.sections import PiecesResult, fit_pieces, verified_pieces

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from shapespline.outline import SearchOutline
    from shapespline.progress import Watch
    from shapespline.section_search import Effort
    from shapespline.typing import FloatArray, IntArray

    Sampler = Callable[[FloatArray], NDArray[np.complex128]]

# Samples of an outline for the search of axes; axes that are looked at closely, and the part of a
# perfect correlation from which they are.
SAMPLES, MOST_AXES, NEARLY = 512, 3, 0.9999
# The error of an axis is known to this part of itself.
ERROR_GAP = 0.1
# At last so many times the samples place the axis: their error at corners is that of a quadrature.
REFINED = 16
# Parabolas find it: over what part of a step, with how many times the samples.
PARABOLAS = ((0.5, 2), (0.05, 2), (0.05, REFINED))
# The outline and its mirror image may differ by this part of the tolerance; the fit has the rest.
LARGEST_PART = 0.2
# A corner that is so near to the axis, in tolerances, lies on it.
ON_AXIS = 4.0
# Points nearer to a crossing along the outline, in parts of its length, are that crossing.
CLOSE = 1e-6
# Two lines that turn less at the axis are one, radians.
STRAIGHT = 1e-6


class Mirror(NamedTuple):
    """An axis of symmetry of a closed contour.

    ``centre`` (2,) lies on it, ``direction`` (2,) is its unit vector, ``crossings`` are the arc
    lengths at which the contour crosses it. ``error`` is the distance between the contour and its
    mirror image, either way.
    """

    centre: FloatArray
    direction: FloatArray
    crossings: tuple[float, float]
    error: float

    def reflected(self, points: FloatArray) -> FloatArray:
        """Points on the other side of the axis."""
        offset = points - self.centre
        return self.centre + 2.0 * np.outer(offset @ self.direction, self.direction) - offset

    def projected(self, point: FloatArray) -> FloatArray:
        """The nearest point of the axis."""
        return self.centre + ((point - self.centre) @ self.direction) * self.direction


def find_mirror(contour: Contour) -> Mirror | None:
    """The axis about which a closed contour is most nearly symmetric, None if it is not nearly so.

    Examples
    --------
    >>> kite = Contour([(0, -3), (2, 0), (0, 1), (-2, 0)], closed=True)
    >>> mirror = find_mirror(kite)
    >>> abs(mirror.direction).round(9).tolist(), mirror.error < 1e-9
    ([0.0, 1.0], True)
    """
    length, centre = contour.length, _centre(contour)
    # Three laps: what is asked for lies less than one beside the middle one.
    x, y = (contour.points - centre).T
    lap, stations = x + 1j * y, contour.arc_length[:-1]
    laps = np.concatenate([lap, lap, lap, lap[:1]])
    along = np.concatenate([stations - length, stations, stations + length, [2.0 * length]])

    def at(s: FloatArray) -> NDArray[np.complex128]:
        return np.array(np.interp(s, along, laps))

    step = float(length / SAMPLES)
    z = at(step * np.arange(SAMPLES, dtype=np.float64))
    spectrum = np.fft.fft(z)
    likeness = np.abs(np.fft.ifft(spectrum**2)) / float((np.abs(z) ** 2).sum())
    peaks = (likeness >= np.roll(likeness, 1)) & (likeness > np.roll(likeness, -1))
    peaks &= likeness > NEARLY
    best: Mirror | None = None
    # An axis crosses twice: k and k + SAMPLES are the same one.
    for k in sorted(np.flatnonzero(peaks), key=lambda k: -likeness[k])[:MOST_AXES]:
        mirror = _refined(contour, centre, at, 0.5 * k * step, step)
        if best is None or mirror.error < best.error:
            best = mirror
    return best


def _centre(contour: Contour) -> FloatArray:
    """Centre of gravity of the polyline as a wire."""
    polyline = contour.polyline
    weights = np.diff(contour.arc_length)
    return np.array(weights @ (0.5 * (polyline[1:] + polyline[:-1]))) / contour.length


def _refined(
    contour: Contour, centre: FloatArray, at: Sampler, start: float, step: float
) -> Mirror:
    """The axis near an arc length at which its direction agrees best."""

    def correlation(s: float, times: int) -> np.complex128:
        t = (np.arange(times * SAMPLES // 2, dtype=np.float64) + 0.5) * (step / times)
        return np.dot(at(s + t), at(s - t))

    # Through three values: the correlation is smooth about its maximum.
    s = start
    for part, times in PARABOLAS:
        width = part * step
        low, middle, high = (abs(correlation(s + k * width, times)) for k in (-1, 0, 1))
        bend = low - 2.0 * middle + high
        if bend < 0:
            s += float(np.clip(0.5 * (low - high) / bend, -1.0, 1.0)) * width
    s %= contour.length
    angle = 0.5 * float(np.angle(correlation(s, REFINED)))
    direction = np.array([np.cos(angle), np.sin(angle)])
    direction *= 1.0 if direction[1] > 0 or (direction[1] == 0 and direction[0] > 0) else -1.0
    mirror = Mirror(centre, direction, (s, (s + 0.5 * contour.length) % contour.length), np.inf)
    image = np.ascontiguousarray(mirror.reflected(contour.polyline))
    _, error, _ = _kernels.curve_deviation(
        np.concatenate([[0.0], np.arange(len(image)), [len(image) - 1.0]]),
        1,
        image,
        np.ascontiguousarray(contour.polyline),
        ERROR_GAP,
        FLOOR * contour.box_diagonal,
    )
    return mirror._replace(error=float(error))


def fit_mirrored(
    contour: Contour,
    tolerance: float,
    *,
    degree: int,
    effort: Effort,
    watch: Watch,
    outline: SearchOutline,
) -> PiecesResult | None:
    """Pieces of an outline that has a mirror symmetry, symmetric; None if it has none.

    Nor if the half cannot be fitted within what the asymmetry leaves of the tolerance, or meets the
    axis at an angle that is no corner of the outline.
    """
    if not contour.closed or watch.ended_as:
        return None
    work = outline.thinned()
    mirror = find_mirror(work.frame.contour)
    if mirror is None or mirror.error > LARGEST_PART * work.tolerance:
        return None
    half, corners, held = _half(work, mirror)
    found = fit_pieces(
        half,
        work.tolerance - mirror.error,
        corners=corners,
        degree=degree,
        effort=effort,
        held=held,
        watch=watch,
    )
    if not found.kept or found.tangent_error:
        return None
    other = tuple(
        piece._replace(control_points=mirror.reflected(piece.control_points))
        for piece in backwards(found.pieces)
    )
    other[0].control_points[0] = found.pieces[-1].control_points[-1]
    other[-1].control_points[-1] = found.pieces[0].control_points[0]
    pieces = _without_split_pieces([*found.pieces, *other])
    result = verified_pieces(outline.frame, pieces, contour, tolerance, degree, Held())
    return result if result.kept else None


def _half(work: SearchOutline, mirror: Mirror) -> tuple[Contour, IntArray, Held]:
    """The data from one crossing of the axis to the other, its corners, what it must keep."""
    contour = work.frame.contour
    stations, least = contour.arc_length[:-1], CLOSE * contour.length
    begin, end = sorted(mirror.crossings)
    first, last = (mirror.projected(point) for point in contour.at(np.array([begin, end])))
    inside = np.flatnonzero((stations > begin + least) & (stations < end - least))
    points = np.concatenate([[first], contour.points[inside], [last]])
    corners = contour.points[work.corners]

    def tangent(node: FloatArray, step: FloatArray) -> FloatArray | None:
        """Square to the axis, the way of a step; none where a corner lies on the axis."""
        if (np.hypot(*(corners - node).T) < ON_AXIS * work.tolerance).any():
            return None
        across = np.array([-mirror.direction[1], mirror.direction[0]])
        return across if step @ across > 0 else -across

    tangents = tangent(first, points[1] - first), tangent(last, last - points[-2])
    marked = 1 + np.flatnonzero(np.isin(inside, work.corners))
    apart = [
        np.hypot(*(points[marked] - node).T) >= ON_AXIS * work.tolerance for node in (first, last)
    ]
    return (
        Contour.silently(points, closed=False),
        marked[apart[0] & apart[1]],
        Held(True, tangents=tangents),
    )


def _without_split_pieces(pieces: list[Piece]) -> tuple[Piece, ...]:
    """The pieces, those that meet smoothly on the axis made one: two lines, or two like curves."""
    joined = pieces[:1]
    for piece in pieces[1:]:
        joined[-1:] = _united(joined[-1], piece)
    if len(joined) > 2 and len(seam := _united(joined[-1], joined[0])) == 1:
        joined = [*seam, *joined[1:-1]]
    return tuple(joined)


def _united(a: Piece, b: Piece) -> list[Piece]:
    """One piece instead of two where they go on with the same velocity, else both."""
    if a.degree != b.degree or not abs(turn_between(a, b)) < STRAIGHT:
        return [a, b]
    if a.degree == 1:
        return [a._replace(control_points=np.array([a.control_points[0], b.control_points[-1]]))]
    if len(a.control_points) != len(b.control_points):
        return [a, b]
    # Mirror images have the same parameters: the node between them is half-way, and a knot less.
    p = a.degree
    left, right = 0.5 * a.knots[: -p - 1], 0.5 + 0.5 * b.knots[p + 1 :]
    knots = np.concatenate([left, np.full(p - 1, 0.5), right])
    points = np.concatenate([a.control_points[:-1], b.control_points[1:]])
    return [Piece("spline", p, knots, points)]

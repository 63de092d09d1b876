"""Mirror symmetry of a closed outline: found, one half fitted, the other one reflected.

With arc length from the axis on, z(s0 + t) = e^(2 i phi) conj(z(s0 - t)) about a centre on the
axis; so the correlation of an outline with its own conjugate reversal, one FFT, is largest where an
axis crosses it, and its phase is twice the axis's angle (Atallah 1985 for polygons).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline import _kernels
from shapespline.geometry import FLOOR

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from shapespline.typing import FloatArray
    from shapespline.values import Contour

    Sampler = Callable[[FloatArray], NDArray[np.complex128]]

# Samples of an outline for the search of axes; axes that are looked at closely, and the part of a
# perfect correlation from which they are.
SAMPLES, MOST_AXES, NEARLY = 512, 3, 0.9999
# The error of an axis is known to this part of itself.
ERROR_GAP = 0.1
# At last so many times the samples place the axis: their error at corners is that of a quadrature
# (ANA-13).
REFINED = 16
# Parabolas find it: over what part of a step, with how many times the samples (ANA-13).
PARABOLAS = ((0.5, 2), (0.05, 2), (0.05, REFINED))


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
    >>> from shapespline.values import Contour
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

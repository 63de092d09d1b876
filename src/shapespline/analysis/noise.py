"""What neighbours tell by local cubics: noise across the outline, and how it bulges between them.

The cubics are those of Savitzky and Golay (1964); their residuals are read by a median, whose scale
is that of chi-squared.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline import _kernels
from shapespline.analysis.drawn_vertices import are_drawn_vertices
from shapespline.validation import median, smallest_of

if TYPE_CHECKING:
    from shapespline.typing import FloatArray
    from shapespline.values import Contour

# Points on each side of the middle of a local fit (ANA-01).
HALF_WINDOW = 3
# Below this part of the box diagonal noise sets nothing, and is not asked where it comes from.
NO_NOISE = 1e-4
# So many windows tell the median to 2 %; of more, every so many-th is looked at.
MOST_WINDOWS = 5_000
# Of fewer points nobody can tell noise from bends (ANA-01).
FEWEST_POINTS = 64
# Fewer vertices that turn evenly may be a polygon's.
FEWEST_OF_CURVE = 24
# Noise is along one direction if most points are off that way (the mean of their directions, twice
# the angle, is so long: a quarter may be across) and at least that part of it shows where the
# outline is steep to the direction (the sine of the angle). That, and level to it, so much of it is
# at least (ANA-23).
DIRECTED, STEEP_PART = 0.6, 0.5
STEEP, LEVEL, LEAST_SHARE = 0.5, 0.25, 0.1
# Points bend evenly if cubics leave less than this part of what chords leave (PIE-30). So many are
# one that its neighbours tell.
EVEN_PART, FEWEST_TO_PREDICT = 0.65, 5
# So many of the points are no corners.
PREDICTED_PART = 0.75
# A cubic fitted to a window: its slope in the middle, and what is left of every point.
_POWERS = np.vander(np.arange(-HALF_WINDOW, HALF_WINDOW + 1), 4)
_FIT = np.linalg.pinv(_POWERS)
_SLOPE_AND_REST = np.column_stack([_FIT[-2], np.eye(len(_POWERS)) - _POWERS @ _FIT])
# Median of a chi-squared variable with the 3 degrees of freedom that a cubic leaves of 7 points.
CHI_SQUARED_MEDIAN = 2.365974


class Scatter(NamedTuple):
    """Standard deviation across the outline, data units, and whether vertices look so scattered."""

    noise: float
    of_vertices: bool = False


def noise_level(contour: Contour) -> float:
    """Standard deviation of the points across the outline, data units.

    A cubic in the index is fitted to every 7 neighbours; what is left of them is read across the
    tangent of the cubic in the middle, so that uneven steps along the outline do not count. Under
    normal noise the tangent and what is left are independent, and the square of what is left is
    chi-squared: its median over all windows, which ignores corners, tells the deviation. Not less
    than the accuracy that the contour is known to have. That alone counts of fewer than 64 points,
    and where they are the vertices of what was drawn; 0 where none is known.

    Examples
    --------
    >>> from shapespline import Contour
    >>> points = np.column_stack([np.linspace(0, 10, 400), np.zeros(400)])
    >>> points += np.random.default_rng(1).normal(0, 0.1, points.shape)
    >>> bool(0.09 < noise_level(Contour(points, closed=False)) < 0.11)
    True
    """
    return scatter(contour).noise


def scatter(contour: Contour) -> Scatter:
    """The same, and whether the points are the vertices of what was drawn."""
    known = contour.accuracy or 0.0
    if not tells_noise(contour):
        return Scatter(known)
    windows = _windows_of(contour)
    level = max(known, _across(windows))
    if contour.accuracy is None:
        level = max(level, _along(windows, contour.closed))
    tells = level > max(known, NO_NOISE * contour.box_diagonal)
    if tells and are_drawn_vertices(contour.points, contour.closed, level):
        return Scatter(known, of_vertices=True)
    return Scatter(level)


def tells_noise(contour: Contour) -> bool:
    """Whether neighbours tell noise from bends: there are enough of them, and it is not known."""
    return len(contour) >= FEWEST_POINTS and contour.accuracy != 0


def left_of_cubics(contour: Contour) -> float:
    """What neighbours leave of local cubics across the outline: noise, and the bends of few points.

    0 for fewer than seven points of an open contour.

    Examples
    --------
    >>> from shapespline import Contour
    >>> t = 2 * np.pi * np.arange(24) / 24
    >>> circle = Contour(np.column_stack([np.cos(t), np.sin(t)]), closed=True)
    >>> 0.002 < left_of_cubics(circle) < 0.003
    True
    """
    few = len(contour) - (0 if contour.closed else 2 * HALF_WINDOW) < 1
    return 0.0 if few else _across(_windows_of(contour))


def left_in_windows(points: FloatArray, closed: bool, step: int = 1) -> FloatArray:
    """Sums of squares that cubics leave across the outline of every so many-th window of seven.

    Each has three degrees of freedom. Those of a closed outline are about its points, those of an
    open one about all but three at either end.

    Examples
    --------
    >>> points = np.column_stack([np.arange(8.0), np.zeros(8)])
    >>> left_in_windows(points, closed=False).round(12).tolist()
    [0.0, 0.0]
    """
    return _left(_windows(points, closed, step))


def along_one_direction(contour: Contour) -> float:
    """Standard deviation of noise that points have along one direction alone; 0 where none is.

    It shows in all windows, also where the outline runs that way and has none across, as half of
    it or more may do. Steps that are uneven on an outline that mostly runs one way show so, too,
    but where it is steep nothing is across it. Heights over even steps never run that way. The
    contour has seven points or more.

    Examples
    --------
    >>> from shapespline import Contour
    >>> t, zeros = np.arange(100) / 5, np.zeros(100)
    >>> around = np.concatenate([t, zeros + 20, 20 - t, zeros])
    >>> square = np.column_stack([around, np.roll(around, 100)])
    >>> along_one_direction(Contour(square, closed=True))
    0.0
    >>> square[:, 0] += np.random.default_rng(1).normal(0, 0.1, 400)
    >>> bool(0.09 < along_one_direction(Contour(square, closed=True)) < 0.11)
    True
    """
    return _along(_windows_of(contour), contour.closed)


def _along(windows: _Windows, closed: bool) -> float:
    """Standard deviation along the one direction, if there is one."""
    twice = complex(*_kernels.left_at_twice_the_angle(windows.rows))
    if abs(twice) < DIRECTED:
        return 0.0
    way = np.exp(-0.5j * np.angle(twice))
    rest, slope = ((part[0] + 1j * part[1]) * way for part in (windows.rests, windows.slopes))
    slope /= np.maximum(np.abs(slope), np.finfo(float).tiny)
    sine = np.abs(slope.imag)
    # All about it are steep: corners at the ends of a bar are no noise.
    wide = np.pad(sine > STEEP, HALF_WINDOW, mode="wrap" if closed else "edge")
    steep = np.lib.stride_tricks.sliding_window_view(wide, 2 * HALF_WINDOW + 1).all(axis=1)
    if min(steep.mean(), (sine < LEVEL).mean()) < LEAST_SHARE:
        return 0.0
    across = (rest * slope.conj()[:, None])[steep].imag / sine[steep, None]
    along, where_steep = (
        float(np.sqrt(median((part**2).sum(axis=1)) / CHI_SQUARED_MEDIAN))
        for part in (rest.real, across)
    )
    return along if where_steep >= STEEP_PART * along else 0.0


def _across(windows: _Windows) -> float:
    """Standard deviation across the outline."""
    return float(np.sqrt(median(_left(windows)) / CHI_SQUARED_MEDIAN))


def _left(windows: _Windows) -> FloatArray:
    """Sums of squares across the outline."""
    sums = np.empty(windows.rows.shape[1])
    _kernels.left_across(windows.rows, sums)
    return sums


class _Windows(NamedTuple):
    """What cubics tell of windows, ``rows`` (2, m, 8): slopes in the middle, what they leave."""

    rows: FloatArray

    @property
    def rests(self) -> FloatArray:
        """What is left of every point, shape (2, m, 7)."""
        return self.rows[:, :, 1:]

    @property
    def slopes(self) -> FloatArray:
        """Those in the middle, shape (2, m)."""
        return self.rows[:, :, 0]


def _windows_of(contour: Contour) -> _Windows:
    """As many windows of a contour as tell a median."""
    n_windows = len(contour) - (0 if contour.closed else 2 * HALF_WINDOW)
    return _windows(contour.points, contour.closed, max(1, n_windows // MOST_WINDOWS))


def _windows(points: FloatArray, closed: bool, step: int) -> _Windows:
    """Every so many-th window."""
    n_windows = len(points) - (0 if closed else 2 * HALF_WINDOW)
    windows = np.empty((2, len(range(0, n_windows, step)), 2 * HALF_WINDOW + 1))
    _kernels.windows_of_seven(np.ascontiguousarray(points), closed, step, windows)
    return _Windows(windows @ _SLOPE_AND_REST)


def largest_bulge(contour: Contour) -> float:
    """How far the smooth curve through points lies off their chords, at most; data units.

    Cubics through four neighbours tell it. 0 where the points are no smooth curve's: where their
    fourth differences, which corners and noise make large, exceed what bulges.

    Examples
    --------
    >>> from shapespline import Contour
    >>> t = 2 * np.pi * np.arange(60) / 60
    >>> circle = Contour(np.column_stack([np.cos(t), np.sin(t)]), closed=True)
    >>> bool(np.isclose(largest_bulge(circle), 1 - np.cos(np.pi / 60), rtol=0.01))
    True
    """
    if len(contour) < FEWEST_OF_CURVE:
        return 0.0
    return _kernels.largest_bulge(contour.points, contour.closed)


def left_out(contour: Contour) -> float:
    """How far from the outline three of four points are at most if their neighbours tell them.

    A cubic in the index through two neighbours on either side; across the outline, data units.
    Infinite for fewer than five points.

    Examples
    --------
    >>> from shapespline import Contour
    >>> t = 2 * np.pi * np.arange(60) / 60
    >>> circle = Contour(np.column_stack([np.cos(t), np.sin(t)]), closed=True)
    >>> bool(left_out(circle) < 1e-4)
    True
    """
    points = contour.points
    if len(points) < FEWEST_TO_PREDICT:
        return np.inf
    if contour.closed:
        points = np.concatenate([points[-2:], points, points[:2]])
    cubic, _ = left_of(points)
    along = points[3:-1] - points[1:-3]
    lengths = np.maximum(np.hypot(*along.T), np.finfo(float).tiny)
    across = np.abs(cubic[:, 0] * along[:, 1] - cubic[:, 1] * along[:, 0]) / (2.0 * lengths)
    return smallest_of(across, PREDICTED_PART)


def bends_evenly(points: FloatArray) -> bool:
    """Whether a row of points bends as a smooth curve does, rather than corners and noise.

    What a cubic through the two neighbours on either side leaves of a point is less than 0.65 of
    what a chord leaves, in the root mean square. A corner between edges leaves 0.82, noise 1.14.

    Examples
    --------
    >>> t = np.linspace(0, 2 * np.pi, 20)
    >>> bends_evenly(np.column_stack([np.cos(t), np.sin(t)]))
    True
    >>> bends_evenly(np.column_stack([t, np.abs(t - t[10])]))
    False
    """
    if len(points) < FEWEST_TO_PREDICT:
        return False
    cubic, chord = left_of(points)
    return float((cubic**2).sum()) < EVEN_PART**2 * float((chord**2).sum())


def bends_evenly_but_in_corners(points: FloatArray) -> bool:
    """The same of most points: told by medians, whatever a few corners between them leave.

    Examples
    --------
    >>> t = np.linspace(0, np.pi, 20)
    >>> half_disc = np.column_stack([[1.0, *np.cos(t), -1.0], [-1.0, *np.sin(t), -1.0]])
    >>> bends_evenly(half_disc), bends_evenly_but_in_corners(half_disc)
    (False, True)
    """
    if len(points) < FEWEST_TO_PREDICT:
        return False
    cubic, chord = (median((left**2).sum(axis=1)) for left in left_of(points))
    return cubic < EVEN_PART**2 * chord


def left_of(points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """What cubics and chords leave of each point but two at both ends, shape (n - 4, 2)."""
    a, b, c, d, e = (points[k : len(points) - 4 + k] for k in range(5))
    return (a - 4 * b + 6 * c - 4 * d + e) / 3, b - 2 * c + d

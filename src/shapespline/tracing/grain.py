"""Outlines without the grain of their picture: averaged along themselves as far as they are even.

Noise shakes every crossing for itself; a parabola through its neighbours takes most of that away.
How many of them is told for each place: those of the largest window that scatter about their
parabola by no more than noise lets them, and whose parabola agrees there with those of all smaller
windows (intersection of confidence intervals: Goldenshluger and Nemirovski, "On spatially adaptive
estimation of nonparametric regression", Mathematical Methods of Statistics 6, 1997). So corners
and small features keep to few neighbours, and long edges have many.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from shapespline.typing import BoolArray, FloatArray

# Points on either side that are averaged over, and the degree of what goes through them (TRC-44).
WINDOWS, DEGREE = (2, 4, 8, 16), 2
# Windows scatter by no more of their deviations, and differ from smaller ones by no more, than
# noise lets them (TRC-44).
SCATTERS, DIFFERS = 4.0, 4.0
# Where rows pass an edge more squarely than columns, their crossings tell its place, and those of
# the columns only lie between them; nearly at 45 degrees both do. Crossings on either side,
# averaged by threes, between which a shaken edge has its direction (TRC-44).
LEAST_ACROSS, CHORD = 0.65, 5
# Points whose windows are looked at together.
TOGETHER = 20_000


def squareness(points: FloatArray, upright: BoolArray, chord: int) -> FloatArray:
    """How squarely a closed outline passes the row or column of each crossing, 0 to 1.

    Parameters
    ----------
    points : ndarray, shape (n, 2)
    upright : ndarray of bool, shape (n,)
        Which of them lie in columns.
    chord : int
        Crossings on either side between which the outline has its direction.
    """
    along = np.roll(points, -chord, axis=0) - np.roll(points, chord, axis=0)
    length = np.maximum(np.hypot(along[:, 0], along[:, 1]), 1e-12)
    return np.asarray(np.abs(np.where(upright, along[:, 0], along[:, 1])) / length)


def squarely(points: FloatArray, upright: BoolArray) -> BoolArray:
    """Which crossings of a shaken outline lie in rows or columns that tell its place."""
    even = (np.roll(points, 1, axis=0) + points + np.roll(points, -1, axis=0)) / 3
    return squareness(even, upright, CHORD) >= LEAST_ACROSS


def without_grain(
    points: FloatArray, upright: BoolArray, scatter: float, stay: BoolArray
) -> FloatArray:
    """What tells the place of a closed outline, without most of its noise, as `averaged` tells."""
    told = squarely(points, upright) | stay
    return averaged(points[told], scatter, stay[told])


def averaged(points: FloatArray, scatter: float, stay: BoolArray) -> FloatArray:
    """A closed outline without most of its noise.

    Parameters
    ----------
    points : ndarray, shape (n, 2)
        About a pixel apart.
    scatter : float
        Standard deviation of their noise across the outline, pixels.
    stay : ndarray of bool, shape (n,)
        Points that are no part of it, as those at the rim of the picture: they stay, and nothing
        is averaged over them.
    """
    out, agree = points, np.ones(len(points), dtype=bool)
    windows: list[_Window] = []
    for half in WINDOWS:
        if 2 * (2 * half + 1) > len(points):
            break
        window = _Window.over(points, half, stay)
        agree = agree & window.free
        if windows:
            # The smallest one is taken as it is: what a pixel alone is off would keep it there.
            agree = agree & (window.scatters <= scatter * (1 + SCATTERS * window.uncertain))
        for other in windows:
            most = DIFFERS * scatter * np.sqrt(other.variance - window.variance)
            agree = agree & (np.abs(window.moves - other.moves) <= most)
        windows.append(window)
        out = np.where(agree[:, None], points + window.moves[:, None] * window.normals, out)
    return out


class _Window(NamedTuple):
    """What so many points on either side, by least squares, make of each point of an outline.

    Attributes
    ----------
    moves : ndarray, shape (n,)
        How far it moves along its normal.
    normals : ndarray, shape (n, 2)
    scatters : ndarray, shape (n,)
        Root mean square distance of the points from their parabola, unbiased.
    free : ndarray of bool, shape (n,)
        Whether none of them has to stay.
    variance : float
        That is left of a point's.
    uncertain : float
        Of scatters, part of them.
    """

    moves: FloatArray
    normals: FloatArray
    scatters: FloatArray
    free: BoolArray
    variance: float
    uncertain: float

    @classmethod
    def over(cls, points: FloatArray, half: int, stay: BoolArray) -> _Window:
        """Of all points of a closed outline."""
        offsets = np.arange(-half, half + 1)
        basis, _ = np.linalg.qr(offsets[:, None] ** np.arange(DEGREE + 1.0))
        freedom = len(offsets) - DEGREE - 1
        # What a coefficient of the basis is for the slope, and for the second derivative.
        slope, second = 1.0 / (basis[:, 1] @ offsets), 2.0 / (basis[:, 2] @ offsets**2)
        # A parabola through an arc passes inside its middle, by what it makes of the fourth power.
        quartic = -(offsets**4.0 @ basis) @ basis[half] / 24.0
        columns = []
        for some in np.array_split(np.arange(len(points)), len(points) // TOGETHER + 1):
            index = (some[:, None] + offsets) % len(points)
            around = points[index] - points[some, None]
            along = slope * np.einsum("nmc,m->nc", around, basis[:, 1])
            steps = np.maximum(np.hypot(along[:, 0], along[:, 1]), 1e-12)
            normals = np.column_stack([-along[:, 1], along[:, 0]]) / steps[:, None]
            off = np.einsum("nmc,nc->nm", around, normals)
            fitted = off @ basis
            left = np.maximum((off**2).sum(axis=1) - (fitted**2).sum(axis=1), 0.0)
            moves = fitted @ basis[half] - quartic * (second * fitted[:, 2]) ** 3 / steps**2
            free = ~stay[index].any(axis=1)
            columns.append((moves, normals, np.sqrt(left / freedom), free))
        moves, normals, scatters, free = map(np.concatenate, zip(*columns, strict=True))
        variance = float(basis[half] @ basis[half])
        uncertain = 1.0 / np.sqrt(2.0 * freedom)
        return cls(moves, normals, scatters, free, variance, uncertain)

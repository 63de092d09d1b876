"""What other programs need for the same tolerance, their knob at its best."""

from __future__ import annotations

import time
import warnings
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from scipy.interpolate import BSpline, make_splprep, splprep

from checks import two_sided

if TYPE_CHECKING:
    from collections.abc import Callable

    from checks.curves import Array

# Bisections of the smoothing factor, from tolerance^2 times these.
STEPS = 12
SMALLEST, LARGEST = 1e-3, 3.0


class Peer(NamedTuple):
    """Distinct points that a fit stores, and the seconds of the one call that made it."""

    n_points: int
    seconds: float
    knob: float


def splprep_points(points: Array, *, closed: bool, tolerance: float) -> Peer:
    """Scipy's splprep at the largest s that keeps the tolerance both ways."""
    track = np.concatenate([points, points[:1]]).T if closed else points.T

    def fit(s: float) -> BSpline:
        (knots, coefficients, degree), _ = splprep(track, s=s, per=closed)
        return BSpline(knots, np.transpose(coefficients), degree)

    return _best(fit, points, closed, tolerance)


def make_splprep_points(points: Array, *, closed: bool, tolerance: float) -> Peer:
    """Scipy's make_splprep at the largest s that keeps the tolerance both ways; open ends only."""
    track = np.concatenate([points, points[:1]]).T if closed else points.T

    def fit(s: float) -> BSpline:
        curve, _ = make_splprep(track, s=s)
        return BSpline(curve.t, curve.c.T if curve.c.shape[0] == 2 else curve.c, curve.k)

    return _best(fit, points, False, tolerance, polyline_closed=closed)


def occ_points(points: Array, *, closed: bool, tolerance: float) -> Peer | None:
    """OpenCASCADE's approximation by a C2 cubic; None where it is not installed."""
    try:
        from OCP.collections import Array1_gp_Pnt2d
        from OCP.Geom2dAPI import Geom2dAPI_PointsToBSpline
        from OCP.GeomAbs import GeomAbs_Shape
        from OCP.gp import gp_Pnt2d
    except ImportError:
        return None
    track = np.concatenate([points, points[:1]]) if closed else points
    given = Array1_gp_Pnt2d(1, len(track))
    for index, (x, y) in enumerate(track.tolist(), start=1):
        given.SetValue(index, gp_Pnt2d(x, y))

    def fit(s: float) -> BSpline:
        # Its own tolerance from the knob that the others have: a sum of squares.
        own = float(np.sqrt(s / len(points)))
        curve = Geom2dAPI_PointsToBSpline(given, 3, 3, GeomAbs_Shape.GeomAbs_C2, own).Curve()
        knots = np.repeat(
            [curve.Knot(i) for i in range(1, curve.NbKnots() + 1)],
            [curve.Multiplicity(i) for i in range(1, curve.NbKnots() + 1)],
        )
        poles = [curve.Pole(i) for i in range(1, curve.NbPoles() + 1)]
        return BSpline(knots, np.array([[pole.X(), pole.Y()] for pole in poles]), curve.Degree())

    return _best(fit, points, False, tolerance, polyline_closed=closed)


def _best(
    fit: Callable[[float], BSpline],
    points: Array,
    periodic: bool,
    tolerance: float,
    *,
    polyline_closed: bool | None = None,
) -> Peer:
    closed = periodic if polyline_closed is None else polyline_closed
    low, high = (len(points) * tolerance**2 * part for part in (SMALLEST, LARGEST))
    best: Peer | None = None
    for step in range(STEPS):
        s = low if step == 0 else float(np.sqrt(low * high))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            began = time.perf_counter()
            try:
                curve = fit(s)
            except (ValueError, TypeError):
                return best or Peer(len(points), float("nan"), s)
            seconds = time.perf_counter() - began
        found = two_sided(curve, points, closed=closed, step=tolerance / 4)
        if found.larger <= tolerance:
            n_points = len(curve.t) - curve.k - 1 - (curve.k if periodic else 0)
            if best is None or n_points <= best.n_points:
                best = Peer(n_points, seconds, s)
            low = s
        elif step == 0:
            return Peer(len(points), seconds, s)  # no smoothing keeps it: every point is stored
        else:
            high = s
    return best or Peer(len(points), float("nan"), low)


def polyline_points(points: Array, *, closed: bool, tolerance: float) -> Peer:
    """Vertices that Douglas and Peucker keep; closed outlines are cut at two far points."""
    began = time.perf_counter()
    if closed:
        first = int(np.argmax(((points - points.mean(axis=0)) ** 2).sum(axis=1)))
        points = np.roll(points, -first, axis=0)
        far = int(np.argmax(((points - points[0]) ** 2).sum(axis=1)))
        ring = np.concatenate([points, points[:1]])
        kept = _kept(ring[: far + 1], tolerance) + _kept(ring[far:], tolerance) - 2
    else:
        kept = _kept(points, tolerance)
    return Peer(kept, time.perf_counter() - began, tolerance)


def _kept(points: Array, tolerance: float) -> int:
    """Number of vertices of an open polyline simplified to a tolerance."""
    kept, stack = 2, [(0, len(points) - 1)]
    while stack:
        begin, end = stack.pop()
        if end - begin < 2:
            continue
        inside = points[begin + 1 : end]
        chord = points[end] - points[begin]
        along = (inside - points[begin]) @ chord / max(chord @ chord, np.finfo(float).tiny)
        foot = points[begin] + np.clip(along, 0.0, 1.0)[:, None] * chord
        off = np.hypot(*(inside - foot).T)
        worst = int(np.argmax(off))
        if off[worst] > tolerance:
            kept += 1
            stack += [(begin, begin + 1 + worst), (begin + 1 + worst, end)]
    return kept

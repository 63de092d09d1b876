"""What is wrong with a fit, by the outside checker: the columns of the table."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.interpolate import BSpline

import shapespline as ss
from checks import (
    hooks,
    polyline_of,
    self_crossings,
    smallest_radius,
    speed_ratio,
    two_sided,
)

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from benchmarks.attack.shapes import Drawn

    Array = NDArray[np.float64]

# What must not happen, and what is counted because nothing promises it.
FAULTS = (
    "error",
    "warning",
    "promise",
    "not kept",
    "unsaid crossing",
    "index",
    "end",
    "tangent",
    "tck end",
    "start",
    "direction",
)
COUNTED = ("hook", "near-cusp", "small radius")
# Distances that are found by samples exceed a bound by rounding only: of coordinates, in epsilons.
ROUNDING = 64 * np.finfo(float).eps
# Steps of samples: parts of the tolerance, or of a bound that is less, and at least so much of the
# box diagonal.
STEP, CROSSING_STEP, LEAST_STEP = 1 / 5, 1 / 20, 1 / 4000
# Hooks are looked for at tolerances from this part of the box diagonal on: each takes many chords.
HOOKS_FROM = 0.001
# A curve that stands still but for this part of its middle speed has a near-cusp.
NEAR_CUSP = 0.02
# Sides this near, in parts of the size, lie on each other.
TOUCHING = 1e-9
# Radii below this part of the tolerance are counted.
SMALL_RADIUS = 0.01
ALLOWED = (ss.DroppedPointsWarning, ss.ShuffledPointsWarning, ss.SparsePointsWarning)


def fitted(points: Array, options: dict[str, Any]) -> ss.Fit:
    """The fit; a warning that nobody is meant to see is an error."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for allowed in ALLOWED:
            warnings.simplefilter("ignore", allowed)
        return ss.fit_curve(points, **options)


def is_degenerate(drawn: Drawn) -> bool:
    """Whether the points are refused rightly: too few that differ."""
    return len(np.unique(drawn.points, axis=0)) < (3 if drawn.closed else 2)


def judged(drawn: Drawn, options: dict[str, Any], *, thorough: bool = True) -> set[str]:
    """The faults of one fit, and what is counted."""
    try:
        fit = fitted(drawn.points, options)
    except Warning:
        return {"warning"}
    except ss.DegenerateContourError:
        return set() if is_degenerate(drawn) else {"error"}
    except Exception:
        return {"error"}
    found = _promises(fit, drawn, options)
    if not fit.kept:
        found.add("not kept")
        return found
    found |= _constraints(fit, drawn.points, options)
    if thorough:
        found |= _looks(fit, options)
        if not ({"through", "corners", "end_tangents"} & options.keys()):
            found |= _invariance(fit, drawn, options)
    return found


def _promises(fit: ss.Fit, drawn: Drawn, options: dict[str, Any]) -> set[str]:
    tolerance, data = options["tolerance"], fit.contour.points
    slack = ROUNDING * float(np.abs(data).max())
    least = LEAST_STEP * float(np.hypot(*np.ptp(data, axis=0)))
    step = max(STEP * min(tolerance, fit.hausdorff_distance), least)
    sampled = two_sided(fit.curve, data, closed=fit.contour.closed, step=step)
    found = set()
    if sampled.larger > fit.hausdorff_distance * (1 + 1e-9) + slack:
        found.add("promise")
    if fit.kept and sampled.larger > tolerance * (1 + 1e-9) + slack:
        found.add("promise")
    curve = self_crossings(polyline_of(fit.curve, max(CROSSING_STEP * tolerance, least)))
    if curve and "crosses" not in fit.status.value:
        polyline = fit.contour.polyline
        if curve > self_crossings(polyline) and not lies_on_itself(polyline):
            found.add("unsaid crossing")
    ends = BSpline(*fit.curve.tck)(1.0), fit.spline.beziers().points[-1, -1]
    if np.abs(ends[0] - ends[1]).max() > 1e-9 * np.ptp(data, axis=0).max() + slack:
        found.add("tck end")
    return found


def lies_on_itself(polyline: Array) -> bool:
    """Whether a side of a polyline touches one that is not next to it: no count is right then."""
    begin, side = polyline[:-1], np.diff(polyline, axis=0)
    n, near = len(side), TOUCHING * float(np.ptp(polyline, axis=0).max())
    closed = bool((polyline[0] == polyline[-1]).all())
    for i, point in enumerate(polyline[:-1] + 0.5 * side):
        offset = point - begin
        share = (offset * side).sum(axis=1) / np.maximum((side**2).sum(axis=1), 1e-300)
        away = np.hypot(*(offset - np.clip(share, 0, 1)[:, None] * side).T)
        apart = np.abs(np.arange(n) - i)
        apart = np.minimum(apart, n - apart) if closed else apart
        # A neighbour that folds back lies on the middle of a side.
        if (away[apart > 0] <= near).any():
            return True
        offset = begin[i] - begin
        share = (offset * side).sum(axis=1) / np.maximum((side**2).sum(axis=1), 1e-300)
        away = np.hypot(*(offset - np.clip(share, 0, 1)[:, None] * side).T)
        if (away[apart > 1] <= near).any():
            return True
    return False


def _constraints(fit: ss.Fit, points: Array, options: dict[str, Any]) -> set[str]:
    found = set()
    ends = [piece.control_points[[0, -1]] for piece in fit.pieces]
    nodes = np.concatenate(ends)
    slack = ROUNDING * float(np.abs(points).max())  # points a rounding apart are one
    if not fit.contour.closed:
        away = np.hypot(*(nodes[[0, -1]] - fit.contour.points[[0, -1]]).T).max()
        if away > (0 if options.get("ends") == "fixed" else options["tolerance"]) + slack:
            found.add("end")
    for at in options.get("through", []):
        if np.abs(nodes - points[at]).max(axis=1).min() > slack:
            found.add("index")
    tangents = options.get("end_tangents", (None, None))
    first, last = fit.pieces[0].control_points, fit.pieces[-1].control_points
    for wanted, (a, b) in zip(tangents, (first[:2], last[-2:]), strict=True):
        if wanted is not None:
            (x, y), (u, v) = b - a, wanted
            rounding = ROUNDING * np.abs(b).max() / np.hypot(x, y)
            if abs(np.arctan2(u * y - v * x, u * x + v * y)) > 1e-6 + rounding:
                found.add("tangent")
    return found


def _looks(fit: ss.Fit, options: dict[str, Any]) -> set[str]:
    curve, data, tolerance = fit.pieces, fit.contour.points, options["tolerance"]
    found = set()
    if tolerance >= HOOKS_FROM * np.hypot(*np.ptp(data, axis=0)):
        places = hooks(curve, data, closed=fit.contour.closed, tolerance=tolerance)
        if len(_unasked(places, fit, options)):
            found.add("hook")
    if speed_ratio(curve) < NEAR_CUSP:
        found.add("near-cusp")
    if smallest_radius(curve) < SMALL_RADIUS * tolerance:
        found.add("small radius")
    return found


def _unasked(places: Array, fit: ss.Fit, options: dict[str, Any]) -> Array:
    """Those that are not within a tolerance of an end whose tangent was asked for."""
    ends = fit.pieces[0].control_points[0], fit.pieces[-1].control_points[-1]
    for wanted, end in zip(options.get("end_tangents", (None, None)), ends, strict=True):
        if wanted is not None:
            places = places[np.hypot(*(places - end).T) > options["tolerance"]]
    return places


def _points_of(fit: ss.Fit) -> list[tuple[float, ...]]:
    points = np.concatenate([piece.control_points for piece in fit.pieces])
    return sorted(map(tuple, points.tolist()))


def _invariance(fit: ss.Fit, drawn: Drawn, options: dict[str, Any]) -> set[str]:
    found, once = set(), _points_of(fit)
    orders = {"direction": np.arange(len(drawn.points))[::-1]}
    if drawn.closed:
        orders["start"] = np.roll(orders["direction"][::-1], len(drawn.points) // 3)
    for name, order in orders.items():
        asked = dict(options)
        if "weights" in options:
            asked["weights"] = options["weights"][order]
        if _points_of(fitted(drawn.points[order], asked)) != once:
            found.add(name)
    return found

"""Sketch: what the page draws of a fit, cubics and samples as small arrays."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from shapespline.geometry import nearest
from shapespline.values import CORNER_TURN, BSplineCurve

if TYPE_CHECKING:
    from collections.abc import Sequence

    from scipy.spatial import cKDTree

    from shapespline.typing import FloatArray, IntArray
    from shapespline.values import Contour, Fit, Piece, Regularity

# Samples of a curve for its colours, its comb and its graph: as many on the whole, so many a span.
SAMPLES, FEWEST, MOST = 3000, 4, 24
# Cubics that stand for a span of a degree above three, on the screen only.
PARTS = 4
# Curve to data is sampled against so many points of the data at most.
MOST_MEASURED = 60_000


class Sketch(NamedTuple):
    """Figures and arrays of a fit: what a message says and what comes behind it."""

    figures: dict[str, Any]
    arrays: dict[str, np.ndarray]

    @property
    def line(self) -> FloatArray:
        """The samples as a polyline, that of a closed curve to its beginning."""
        line: FloatArray = self.arrays["samples"][:, :2]
        return np.vstack([line, line[:1]]) if self.figures["closed"] else line


def sketch(fit: Fit, origin: FloatArray, drawn: IntArray | None = None) -> Sketch:
    """What the page draws of a fit, its coordinates relative to an origin.

    ``drawn`` are the indices of the points whose errors are wanted, all if not given. Distances are
    signed, positive where the point lies left of the curve.
    """
    from scipy.spatial import cKDTree

    contour = fit.contour
    beziers = [cubics(piece) for piece in fit.pieces]
    counts = np.array([len(one) for one in beziers])
    every = np.concatenate(beziers)
    firsts = np.concatenate([[0], np.cumsum(counts)[:-1]])
    tree = cKDTree(contour.points)
    nodes = every[firsts, 0]
    if not fit.closed:
        nodes = np.vstack([nodes, every[-1:, 3]])
    points = _points_at(tree, nodes, contour)
    corners = _points_at(tree, fit.spline(fit.corners).reshape(-1, 2), contour)
    polygons = [piece.control_points for piece in fit.pieces]
    arrays = {
        "cubics": every - origin,
        "counts": counts,
        "nodes": nodes - origin,
        "turns": _turns(every, firsts, fit.closed),
        "points": points,
        "corners": corners,
        "polygon": np.concatenate(polygons) - origin,
        "polygons": np.array([len(polygon) for polygon in polygons]),
        "samples": samples(fit, origin),
        "errors": point_errors(fit) if drawn is None else point_errors(fit)[drawn],
    }
    kinds = [piece.kind for piece in fit.pieces]
    figures = {
        "status": fit.status.name,
        "sentence": fit.status.value,
        "kept": fit.kept,
        "tolerance": fit.tolerance,
        "max_distance": fit.max_distance,
        "hausdorff_distance": fit.hausdorff_distance,
        "rms_distance": fit.rms_distance,
        "n_stored_points": fit.n_stored_points,
        "n_control_points": fit.n_control_points,
        "degree": fit.degree,
        "method": fit.method,
        "closed": fit.closed,
        "kinds": kinds,
        "n_kinds": Counter(kinds),
        "knots": len(fit.spline.breakpoints),
        "n_outliers": len(fit.outliers),
        "regularities": regularities(fit.regularities),
    }
    return Sketch(figures, arrays)


def regularities(found: Sequence[Regularity]) -> list[dict[str, Any]]:
    """Regularities of a fit or a drawing as the page lists them."""
    return [
        {
            "name": one.name,
            "noun": one.noun,
            "pieces": list(one.pieces),
            "off": one.off,
            "order": one.order,
        }
        for one in found
    ]


def cubics(piece: Piece) -> FloatArray:
    """The cubics that draw a piece, shape (c, 4, 2); of a degree above three within a hair.

    Examples
    --------
    >>> from shapespline.values import Piece
    >>> line = Piece("line", 1, np.array([0.0, 0, 1, 1]), np.array([(0.0, 0.0), (3.0, 3.0)]))
    >>> cubics(line)[0].tolist()
    [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [3.0, 3.0]]
    """
    knots, points = np.array(piece.knots), np.array(piece.control_points)
    curve = BSplineCurve.trusted(knots, points, piece.degree, False)
    return curve_cubics(curve)


def curve_cubics(curve: BSplineCurve) -> FloatArray:
    """The cubics that draw a curve, shape (c, 4, 2)."""
    if curve.degree > 3:
        at = curve.breakpoints
        parts = np.linspace(0, 1, PARTS, endpoint=False)
        cuts = np.append((at[:-1, None] + np.diff(at)[:, None] * parts).ravel(), at[-1])
        step = np.diff(cuts)[:, None] / 3
        place, speed = curve(cuts), curve(cuts, derivative=1)
        return np.stack(
            [place[:-1], place[:-1] + step * speed[:-1], place[1:] - step * speed[1:], place[1:]],
            axis=1,
        )
    points = curve.beziers().points
    while points.shape[1] < 4:
        # A Bezier of degree d as one of degree d + 1 (Farin, section 6.1).
        degree = points.shape[1] - 1
        share = (np.arange(1, degree + 1) / (degree + 1))[None, :, None]
        inner = share * points[:, :-1] + (1 - share) * points[:, 1:]
        points = np.concatenate([points[:, :1], inner, points[:, -1:]], axis=1)
    return points


def _points_at(tree: cKDTree, places: FloatArray, contour: Contour) -> IntArray:
    """Index of the nearest point of the contour."""
    return np.asarray(tree.query(places)[1]) % len(contour)


def _turns(every: FloatArray, firsts: IntArray, closed: bool) -> IntArray:
    """For each node 1 where the curve turns there, 0 where it is smooth; ends of open ones 1."""
    arriving = every[:, 3] - np.where(_far(every[:, 3] - every[:, 2]), every[:, 2], every[:, 0])
    leaving = np.where(_far(every[:, 1] - every[:, 0]), every[:, 1], every[:, 3]) - every[:, 0]
    before, after = arriving[firsts - 1], leaving[firsts]
    turn = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    found = (np.abs(np.arctan2(turn, (before * after).sum(axis=1))) > CORNER_TURN).astype(np.int64)
    if not closed:
        found[0] = 1
        found = np.append(found, 1)
    return found


def _far(vectors: FloatArray) -> np.ndarray:
    return (vectors != 0).any(axis=1)[:, None]


def samples(fit: Fit, origin: FloatArray) -> FloatArray:
    """x, y, the left normal's x and y, curvature and distance to the data, shape (m, 6).

    Each span has its own samples, both of its ends among them: curvature may jump there.
    """
    curve, at = fit.spline, fit.spline.breakpoints
    each = int(np.clip(SAMPLES // (len(at) - 1), FEWEST, MOST))
    # A knot belongs to the span on its right: the last sample of a span stays just before it.
    part = np.linspace(0, 1 - 1e-9, each)
    u = (at[:-1, None] + np.diff(at)[:, None] * part).ravel()
    place, speed = curve(u), curve(u, derivative=1)
    length = np.hypot(speed[:, 0], speed[:, 1])[:, None]
    tangent = np.divide(speed, length, out=np.zeros_like(speed), where=length > 0)
    normal = np.column_stack([-tangent[:, 1], tangent[:, 0]])
    curvature = np.nan_to_num(curve.curvature(u), nan=0.0, posinf=0.0, neginf=0.0)
    polyline = fit.contour.polyline
    error = np.zeros(len(u))
    if len(polyline) <= MOST_MEASURED:
        knots = np.concatenate(
            [[0.0], np.arange(len(polyline), dtype=float), [len(polyline) - 1.0]]
        )
        data = BSplineCurve.trusted(knots, polyline.copy(), 1, False)
        away = data(nearest(data, place).parameters) - place
        error = _signed(away, normal)
    return np.column_stack([place - origin, normal, curvature, error])


def point_errors(fit: Fit) -> FloatArray:
    """Distance of every point of the contour to the curve, signed, shape (n,)."""
    contour = fit.contour
    first = np.unique(contour.source, return_index=True)[1]
    at = fit.parameters[first]
    speed = fit.spline(at, derivative=1)
    normal = np.column_stack([-speed[:, 1], speed[:, 0]])
    return _signed(contour.points - fit.spline(at), normal)


def _signed(away: FloatArray, normal: FloatArray) -> FloatArray:
    side = np.where((away * normal).sum(axis=1) < 0, -1.0, 1.0)
    return side * np.hypot(away[:, 0], away[:, 1])

"""Independent checks of a structured fit: dense samples, no kernel and no bound of the package."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import BSpline
from scipy.spatial import cKDTree


def sampled(piece, count=400):
    """Points of a piece at many parameters, by scipy, knots included."""
    u = np.unique(np.concatenate([np.linspace(0, 1, count), piece.knots]))
    return BSpline(piece.knots, piece.control_points, piece.degree)(u)


def polyline_distances(points, vertices):
    """Distance of every point to a polyline, by brute force over all segments."""
    a, d = vertices[:-1], np.diff(vertices, axis=0)
    length_sq = np.maximum((d**2).sum(axis=1), 1e-300)
    nearest = np.full(len(points), np.inf)
    for start, along, size in zip(a, d, length_sq, strict=True):
        s = np.clip((points - start) @ along / size, 0, 1)
        gap = points - start - s[:, None] * along
        nearest = np.minimum(nearest, np.hypot(gap[:, 0], gap[:, 1]))
    return nearest


def sampled_distances(result, contour):
    """Data to curve and curve to data polyline; the first is too large by half a sample step."""
    curve = np.concatenate([sampled(piece) for piece in result.pieces])
    forward = polyline_distances(contour.points, curve)
    return forward.max(), polyline_distances(curve, contour.polyline).max()


def chord_error(result):
    """How far the sample chords may lie from the curve: what the forward distance may be off."""
    worst = 0.0
    for piece in result.pieces:
        fine, coarse = sampled(piece, 801), sampled(piece, 401)
        tree = cKDTree(fine)
        worst = max(worst, float(tree.query(0.5 * (coarse[1:] + coarse[:-1]))[0].max()))
    return worst


def end_gaps(result):
    """Distances between the end of every piece and the start of the next."""
    pairs = list(zip(result.pieces, result.pieces[1:], strict=False))
    if result.closed:
        pairs.append((result.pieces[-1], result.pieces[0]))
    return [float(np.hypot(*(a.control_points[-1] - b.control_points[0]))) for a, b in pairs]

"""Fits and drawings under affine maps, the other way, and in parts; what they say stays true.

A similarity multiplies every distance by its factor. Any other affine map multiplies distances by
at most its largest singular value, so that bounds and tolerance times that value hold; distances
are measured anew and may be smaller.
"""

from __future__ import annotations

from dataclasses import fields, replace
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.errors import InvalidInputError
from shapespline.geometry.distances import two_sided_distance
from shapespline.geometry.joining import joined
from shapespline.geometry.nearest import nondecreasing
from shapespline.geometry.reversal import backwards, reversed_curve
from shapespline.geometry.scaling import scaled_widths
from shapespline.geometry.splitting import cut_pieces, placed_pieces
from shapespline.validation import float_array
from shapespline.values import (
    SAME_FACTOR,
    BSplineCurve,
    Contour,
    Drawing,
    Fit,
    Piece,
    Status,
    ViewBox,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.typing import ArrayLike, FloatArray

# Of a map whose smaller singular value is below this part of the larger one nothing but a line is
# left.
FLAT = 1e-9


class AffineMap(NamedTuple):
    """The map ``p -> linear p + shift``; ``largest`` and ``smallest`` are its singular values."""

    linear: FloatArray
    shift: FloatArray
    largest: float
    smallest: float

    @classmethod
    def of(cls, matrix: ArrayLike) -> AffineMap:
        """The map of a matrix of shape (2, 2), (2, 3) or (3, 3), the last row then 0, 0, 1."""
        array = float_array(matrix, "matrix")
        if array.shape not in ((2, 2), (2, 3), (3, 3)) or not np.isfinite(array).all():
            raise InvalidInputError(
                "matrix must be finite and of shape (2, 2), (2, 3) or (3, 3), got shape"
                f" {array.shape}"
            )
        if array.size == 9 and array[2].tolist() != [0.0, 0.0, 1.0]:
            raise InvalidInputError(
                f"the last row of matrix must be 0, 0, 1, got {array[2].tolist()}; a perspective"
                " makes no splines of splines"
            )
        shift = array[:2, 2] if array.size > 4 else np.zeros(2)
        largest, smallest = np.linalg.svd(array[:2, :2], compute_uv=False).tolist()
        if not smallest > FLAT * largest:
            raise InvalidInputError(
                f"matrix must not flatten the plane, got singular values {largest:.3g} and"
                f" {smallest:.3g}"
            )
        return cls(array[:2, :2], shift, largest, smallest)

    @property
    def is_similarity(self) -> bool:
        """Whether all lengths are multiplied alike."""
        return self.largest - self.smallest <= SAME_FACTOR * self.largest

    def __call__(self, points: FloatArray) -> FloatArray:
        """The images of points, shape (n, 2)."""
        return np.ascontiguousarray(points @ self.linear.T + self.shift)


def transformed_drawing(drawing: Drawing, matrix: ArrayLike) -> Drawing:
    """A drawing whose fits are transformed; the frame becomes the box around its image."""
    affine, frame = AffineMap.of(matrix), drawing.frame
    if frame is not None:
        x, y = frame.x + frame.width * np.array([0, 0, 1, 1]), frame.y
        corners = affine(np.column_stack([x, y + frame.height * np.array([0, 1, 0, 1])]))
        frame = ViewBox(*corners.min(axis=0).tolist(), *np.ptp(corners, axis=0).tolist())
    fits = [transformed_fit(fit, matrix) for fit in drawing]
    # A pen that is stretched is none any more: its strokes stay as wide in the mean.
    factor = float(np.sqrt(affine.largest * affine.smallest))
    return Drawing(
        fits,
        drawing.parents,
        frame,
        drawing.unit,
        colors=drawing.colors,
        widths=scaled_widths(drawing.widths, factor),
        strokes=drawing.strokes,
    )


def transformed_fit(fit: Fit, matrix: ArrayLike) -> Fit:
    """The image of a fit under an affine map; see `Fit.transformed`."""
    affine, factor = AffineMap.of(matrix), AffineMap.of(matrix).largest
    spline = fit.spline
    accuracy = None if fit.contour.accuracy is None else factor * fit.contour.accuracy
    given = affine(fit.contour.points)[fit.contour.source]
    line = fit.contour.level_line
    contour = Contour.silently(
        given,
        fit.contour.closed,
        accuracy=accuracy,
        level_line=None if line is None else affine(line),
    )
    moved = replace(
        plain(fit),
        spline=BSplineCurve(spline.knots, affine(spline.control_points), spline.degree,
                            spline.periodic),
        contour=contour,
        max_distance=factor * fit.max_distance,
        rms_distance=factor * fit.rms_distance,
        hausdorff_distance=factor * fit.hausdorff_distance,
        tolerance=factor * fit.tolerance,
        history=(),
        sections=tuple(piece.moved(affine.linear, affine.shift) for piece in fit.sections),
    )  # fmt: skip
    # Of more points than a fit holds only the bounds are known.
    if not affine.is_similarity and type(fit) is Fit:
        moved = _measured(moved)
    status = Status.KEPT if moved.kept and not fit.kept else fit.status
    return replace(
        moved,
        status=status.saying(
            f"a fit moved: tolerance {moved.tolerance:.6g} {'kept' if moved.kept else 'not kept'},"
            f" both ways {moved.hausdorff_distance:.6g}"
        ),
    )


def _measured(fit: Fit) -> Fit:
    """The same with distances measured anew; where bounds hold that are smaller, these."""
    found = two_sided_distance(fit.spline, fit.contour)
    bound = min(found.hausdorff_distance, fit.hausdorff_distance)
    return replace(
        fit,
        parameters=found.parameters[fit.contour.source],
        max_distance=min(found.max_distance, fit.max_distance),
        rms_distance=min(found.rms_distance, fit.rms_distance),
        hausdorff_distance=bound,
        tolerance=bound if fit.tolerance == fit.hausdorff_distance else fit.tolerance,
    )


def plain(fit: Fit) -> Fit:
    """A fit of the points that it holds, without what is known of the problem that it solved."""
    held = {item.name: getattr(fit, item.name) for item in fields(Fit)}
    return Fit(**(held | {"snapshots": (), "uncertainty": None}))


def reversed_fit(fit: Fit) -> Fit:
    """The fit of the data in the other order, the same curve; see `Fit.reversed`."""
    contour = fit.contour
    return replace(
        plain(fit),
        spline=reversed_curve(fit.spline),
        contour=Contour.silently(
            contour.points[contour.source][::-1], contour.closed, accuracy=contour.accuracy
        ),
        parameters=1.0 - fit.parameters[::-1],
        outliers=(contour.n_given + len(fit.outliers) - 1 - fit.outliers)[::-1].copy(),
        sections=backwards(fit.sections),
    )


def split_fit(fit: Fit, at: ArrayLike) -> tuple[Fit, ...]:
    """The parts of a fit between parameters; see `Fit.split`."""
    cuts = np.unique(np.atleast_1d(float_array(at, "at")))
    if cuts.ndim != 1 or not len(cuts) or not ((cuts >= 0) & (cuts <= 1)).all():
        raise InvalidInputError(f"at must be parameters of the curve, 0 to 1, got {at!r}")
    pieces = fit.pieces
    if fit.spline.periodic and not fit.sections:
        clamped = fit.spline.clamped()
        pieces = (Piece("spline", clamped.degree, clamped.knots, clamped.control_points),)
    placed = placed_pieces(pieces, fit.spline)
    if fit.closed:
        cuts = np.unique(np.mod(cuts, 1.0))
        ends = [*cuts.tolist(), float(cuts[0]) + 1.0]
        placed += [item._replace(begin=item.begin + 1, end=item.end + 1) for item in placed]
    else:
        ends = [0.0, *cuts[(cuts > 0) & (cuts < 1)].tolist(), 1.0]
    parts = cut_pieces(placed, ends)
    data = _data_between(fit, ends)
    return tuple(_part(fit, *item) for item in zip(parts, data, strict=True))


def _part(fit: Fit, pieces: Sequence[Piece], points: FloatArray) -> Fit:
    """A part of a fit, measured against its part of the data."""
    spline = joined(pieces, fit.degree)
    contour = Contour.silently(points, False, accuracy=fit.contour.accuracy)
    found = two_sided_distance(spline, contour).beside(pieces)
    bound = found.hausdorff_distance
    kept = bound <= fit.tolerance
    status = Status.KEPT if kept else Status.EXCEEDED
    return Fit(
        spline=spline,
        contour=contour,
        parameters=found.parameters[contour.source],
        max_distance=found.max_distance,
        rms_distance=found.rms_distance,
        hausdorff_distance=bound,
        tolerance=fit.tolerance,
        status=status.saying(
            f"a part of a fit: tolerance {fit.tolerance:.6g} {'kept' if kept else 'not kept'}, both"
            f" ways {bound:.6g}"
        ),
        history=(),
        method=fit.method,
        sections=tuple(pieces),
    )


def _data_between(fit: Fit, ends: Sequence[float]) -> list[FloatArray]:
    """The data polyline from each end to the next, cut where it is nearest to the curve there."""
    line, s = fit.contour.polyline, fit.contour.arc_length
    first = np.unique(fit.contour.source, return_index=True)[1]
    u = fit.parameters[first]
    if fit.contour.closed:
        # Unwrapped from the first point on, around once.
        turns = np.concatenate([[0.0], np.cumsum(np.round(u[:-1] - u[1:]))])
        u = np.append(u + turns, u[0] + 1.0)
    u = nondecreasing(u)
    if fit.contour.closed:
        line = np.concatenate([line[:-1]] * 3 + [line[:1]])
        s = np.concatenate([s[:-1], s[:-1] + s[-1], s + 2 * s[-1]])
        u = np.concatenate([u[:-1] - 1, u[:-1], u + 1])
    places = [_nearest_place(fit.spline([end])[0], line, s, u, end) for end in ends]
    if fit.contour.closed:
        places[-1] = places[0] + fit.contour.length
    parts = []
    for a, b in pairwise(places):
        inner = line[(s > a) & (s < b)]
        cut = [[np.interp(end, s, line[:, axis]) for axis in (0, 1)] for end in (a, b)]
        parts.append(np.concatenate([cut[:1], inner, cut[1:]]))
    return parts


def _nearest_place(
    point: FloatArray, line: FloatArray, s: FloatArray, u: FloatArray, at: float
) -> float:
    """Arc length of the place of a polyline nearest to a point, near where parameters say."""
    around = int(np.searchsorted(u, at))
    low, high = max(around - 4, 0), min(around + 4, len(line) - 1)
    begin, leg = line[low:high], np.diff(line[low : high + 1], axis=0)
    squares = (leg**2).sum(axis=1)
    share = np.clip(((point - begin) * leg).sum(axis=1) / squares, 0.0, 1.0)
    away = ((begin + share[:, None] * leg - point) ** 2).sum(axis=1)
    k = int(np.argmin(away))
    return float(s[low + k] + share[k] * (s[low + k + 1] - s[low + k]))

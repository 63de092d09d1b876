"""A fit as lines and arcs end to end: what it has of them as it is, everything else as biarcs."""

from __future__ import annotations

from itertools import pairwise
from math import atan, tan
from typing import TYPE_CHECKING

import numpy as np

from shapespline.geometry.biarcs import ArcPolyline, arc_polyline
from shapespline.geometry.joining import joined
from shapespline.values import Arc, Piece

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from shapespline.typing import FloatArray
    from shapespline.values import BSplineCurve, Fit

# A node of a curve nearer to a point than this part of the size is that point.
SAME_PLACE = 1e-9
# An arc bows by half of this part of its chord at least: of a flatter one the radius costs as many
# digits as the line in its place.
FLAT_BULGE = 1e-8
LINE_KNOTS = np.array([0.0, 0.0, 1.0, 1.0])


def lines_and_arcs(
    fit: Fit, tolerance: float, nodes: FloatArray | None = None
) -> tuple[Piece, ...]:
    """Lines and arcs within a tolerance of a fit's curve, both ways, tangent where it is smooth.

    Parameters
    ----------
    fit : Fit
        Its lines and arcs stay as they are.
    tolerance : float
        Data units.
    nodes : ndarray, shape (k, 2), optional
        Points where pieces of the fit meet that the result has to go through, too.

    Raises
    ------
    InvalidInputError
        If the tolerance is not positive, or absurdly small for the curve.

    Examples
    --------
    >>> import shapespline as ss
    >>> x = np.linspace(0, 1, 50)
    >>> arch = ss.fit_curve(np.column_stack([x, x - x * x]), closed=False, tolerance=1e-3)
    >>> {piece.kind for piece in lines_and_arcs(arch, 1e-3)}
    {'arc'}
    """
    if fit.spline.periodic and not fit.sections:
        return tuple(_converted(fit.spline, tolerance, closed=True))
    found: list[Piece] = []
    run: list[Piece] = []
    pieces = fit.pieces
    for piece, after in zip(pieces, [*pieces[1:], None], strict=True):
        if piece.arc is None:
            run.append(piece)
        if run and (after is None or after.arc or _is_node(piece, nodes, fit)):
            found += _converted(joined(run), tolerance)
            run = []
        if piece.arc is not None:
            found.append(piece)
    if fit.closed:
        found[-1] = found[-1].meeting(end=found[0].control_points[0])
    return tuple(found)


def bulge_piece(
    begin: FloatArray, end: FloatArray, bulge: float, tolerance: float | None = None
) -> Piece:
    """A line, or an arc whose angle has four times the arc tangent of the bulge.

    Parameters
    ----------
    begin, end : ndarray, shape (2,)
        The ends of the piece, to the bit.
    bulge : float
        Positive where it turns left.
    tolerance : float, optional
        Of the fit that it is in; see `Arc.n_beziers`.

    Examples
    --------
    >>> arc = bulge_piece(np.array([1.0, 0.0]), np.array([-1.0, 0.0]), 1.0).arc
    >>> round(arc.radius, 9), round(arc.sweep / np.pi, 9)
    (1.0, 1.0)
    """
    if abs(bulge) < FLAT_BULGE or (begin == end).all():
        return Piece("line", 1, LINE_KNOTS, np.array([begin, end], dtype=np.float64))
    arc = Arc.through(begin, end, 4.0 * atan(bulge))
    return Piece.of_arc(arc, tolerance, begin=begin, end=end)


def bulged(pieces: Sequence[Piece], *, closed: bool) -> ArcPolyline:
    """Lines and arcs as vertices with bulges; a circle has two."""
    rows: list[tuple[float, float, float]] = []
    for piece in pieces:
        arc = piece.arc
        x, y = piece.control_points[0].tolist()
        if arc is None:
            rows += [(*point, 0.0) for point in piece.control_points[:-1].tolist()]
        elif arc.is_circle:
            half = float(np.copysign(1.0, arc.sweep))
            rows += [(x, y, half), (*arc.at(0.5).tolist(), half)]
        else:
            rows.append((x, y, tan(0.25 * arc.sweep)))
    if not closed:
        rows.append((*pieces[-1].control_points[-1].tolist(), 0.0))
    table = np.array(rows)
    return ArcPolyline(table[:, :2], table[:, 2], closed)


def _is_node(piece: Piece, nodes: FloatArray | None, fit: Fit) -> bool:
    """Whether a piece ends in a point that is to stay on the curve."""
    if nodes is None or not len(nodes):
        return False
    away = np.abs(nodes - piece.control_points[-1]).max(axis=1)
    return bool(away.min() <= SAME_PLACE * fit.contour.box_diagonal)


def _converted(curve: BSplineCurve, tolerance: float, *, closed: bool = False) -> Iterator[Piece]:
    """Lines and arcs as pieces."""
    found = arc_polyline(curve, tolerance, closed=closed)
    points = np.concatenate([found.points, found.points[:1]]) if closed else found.points
    if not closed:  # Beziers of a spline may miss its ends by a rounding
        points[[0, -1]] = curve.control_points[[0, -1]]
    for (begin, end), bulge in zip(pairwise(points), found.bulges.tolist(), strict=False):
        yield bulge_piece(begin, end, bulge, tolerance)

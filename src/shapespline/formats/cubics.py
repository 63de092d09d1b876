"""Curves as cubic Beziers, for formats that know no others.

Knot insertion cuts a B-spline into Beziers without changing it. Those of degree 1 to 3 are cubics
(or lines), so nothing is lost but a rounding. Cubics cannot hold degrees 4 to 9: such a piece is
replaced by cubics with the same ends and end tangents, halved until they are provably within
``CUBIC_TOLERANCE`` times the diagonal of the contour's bounding box.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.values import BSplineCurve

if TYPE_CHECKING:
    from collections.abc import Iterator

    from shapespline.typing import FloatArray
    from shapespline.values import Drawing, Fit, Piece

# Of the box diagonal: what a cubic may deviate from a piece of degree 4 or more.
CUBIC_TOLERANCE = 1e-6
EPS = float(np.finfo(np.float64).eps)


# Areas tile the view box if they leave no more than this part of it, or lie over each other by it.
TILED = 1e-6


def groups(drawing: Drawing) -> list[list[int]]:
    """Indices of the fits that bound an area together: an outline and its holes, or one alone."""
    return _in_turns(drawing, [drawing.is_area(index) for index in range(len(drawing))])


def painted(drawing: Drawing) -> list[list[int]]:
    """Indices of the fits that are painted together, in the order in which they are.

    Where areas have colours, those within others are painted upon them, and what has none is a hole
    of what it lies in.
    """
    colors, filled = drawing.colors, [drawing.is_filled(index) for index in range(len(drawing))]
    if not any(colors):
        return _in_turns(drawing, filled)
    holes = {
        index: parent
        for index, parent in enumerate(drawing.parents)
        if filled[index] and colors[index] is None and parent >= 0 and colors[parent]
    }
    return _with_holes(drawing, holes)


def _in_turns(drawing: Drawing, areas: list[bool]) -> list[list[int]]:
    """Some outlines within each other are areas and holes in turn; all others are alone."""
    holes = {}
    for index, parent in enumerate(drawing.parents):
        around = []
        while parent >= 0:
            around += [parent] if areas[parent] else []
            parent = drawing.parents[parent]
        if areas[index] and len(around) % 2 == 1:
            holes[index] = around[0]
    return _with_holes(drawing, holes)


def _with_holes(drawing: Drawing, holes: dict[int, int]) -> list[list[int]]:
    found = {index: [index] for index in range(len(drawing)) if index not in holes}
    for index, outline in holes.items():
        found[outline].append(index)
    return list(found.values())


def is_whole(drawing: Drawing, group: list[int]) -> bool:
    """Whether a coloured area without holes is filled wherever its outline runs around.

    What crosses itself was painted so, most often; everything else is filled by the even-odd rule.
    """
    return len(group) == 1 and drawing.colors[group[0]] is not None


def broadest(drawing: Drawing) -> float:
    """Width of the broadest stroke, 0 without one: so far a page reaches beyond its curves."""
    return max((width for width in drawing.widths if width), default=0.0)


def is_tiled(drawing: Drawing) -> bool:
    """Whether coloured areas fill the view box, so that what is drawn beneath them stays hidden."""
    if drawing.frame is None or not any(drawing.colors):
        return False
    covered = 0.0
    for group in painted(drawing):
        first, parent = group[0], drawing.parents[group[0]]
        beside = parent < 0 or drawing.colors[parent] is None  # and not upon another one
        plain = drawing.is_filled(first) and drawing.widths[first] is None
        if drawing.colors[first] is None or not (beside and plain):
            return False
        sizes = [drawing.fits[index].area for index in group]
        covered += sizes[0] - sum(sizes[1:])
    whole = drawing.frame.width * drawing.frame.height
    return abs(covered - whole) <= TILED * whole


def as_cubics(fit: Fit) -> FloatArray:
    """Cubic Beziers of a fit end to end, data coordinates, shape (s, 4, 2)."""
    cubics = _cubics_of(fit.spline, CUBIC_TOLERANCE * fit.contour.box_diagonal)
    if fit.closed:
        cubics[-1, -1] = cubics[0, 0]  # knot insertion may miss it by a rounding
    return cubics


def cubics_and_arcs(fit: Fit) -> list[FloatArray | Piece]:
    """The same with arcs as they are: cubics, shape (s, 4, 2), and arcs, in their order."""
    if not any(piece.arc for piece in fit.sections):
        return [as_cubics(fit)]
    tolerance = CUBIC_TOLERANCE * fit.contour.box_diagonal
    return [
        piece
        if piece.arc
        else _cubics_of(BSplineCurve(piece.knots, piece.control_points, piece.degree), tolerance)
        for piece in fit.sections
    ]


def _cubics_of(spline: BSplineCurve, tolerance: float) -> FloatArray:
    points = spline.beziers().points
    if spline.degree <= 3:
        cubics = points
        while cubics.shape[1] < 4:
            cubics = elevated(cubics)
    else:
        # Below the rounding of the coordinates no halving could reach the tolerance.
        rounding = 64 * EPS * float(np.abs(points).max())
        tolerance = max(tolerance, rounding)
        cubics = np.array([cubic for piece in points for cubic in _cubics(piece, tolerance)])
    return cubics


def elevated(points: FloatArray) -> FloatArray:
    """Raise the degree of Beziers by one, exactly: shape (s, degree + 2, 2).

    Q_i = i/(p+1) P_{i-1} + (1 - i/(p+1)) P_i, without a rounding where P_{i-1} = P_i.
    """
    share = (np.arange(1, points.shape[1]) / points.shape[1])[:, None]
    inner = points[:, 1:] + share * (points[:, :-1] - points[:, 1:])
    return np.concatenate([points[:, :1], inner, points[:, -1:]], axis=1)


def _cubics(piece: FloatArray, tolerance: float) -> Iterator[FloatArray]:
    """Cubics with the end points and end derivatives of a Bezier or of its halves.

    Two Beziers of one degree differ nowhere by more than their control points do, since the
    Bernstein polynomials are positive and sum to one: so the elevated cubic bounds the error.
    """
    degree = len(piece) - 1
    cubic = np.array(
        [
            piece[0],
            piece[0] + degree / 3 * (piece[1] - piece[0]),
            piece[-1] + degree / 3 * (piece[-2] - piece[-1]),
            piece[-1],
        ]
    )
    same_degree = cubic[None]
    while same_degree.shape[1] <= degree:
        same_degree = elevated(same_degree)
    if np.hypot(*(same_degree[0] - piece).T).max() <= tolerance:
        yield cubic
    else:
        for half in halves(piece):
            yield from _cubics(half, tolerance)


def halves(piece: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Cut a Bezier into its two halves (de Casteljau)."""
    first, last = [piece[0]], [piece[-1]]
    while len(piece) > 1:
        piece = 0.5 * (piece[:-1] + piece[1:])
        first.append(piece[0])
        last.append(piece[-1])
    return np.array(first), np.array(last[::-1])


def is_straight(cubic: FloatArray) -> bool:
    """Whether a cubic runs straight from end to end, to the rounding of its coordinates."""
    chord = cubic[3] - cubic[0]
    length = float(np.hypot(*chord))
    if length == 0.0:
        return bool((cubic == cubic[0]).all())
    inner = cubic[1:3] - cubic[0]
    offset = np.abs(inner[:, 0] * chord[1] - inner[:, 1] * chord[0]).max() / length
    along = inner @ chord / length**2
    # The cross product cancels: its rounding is that of the coordinates, not of the result.
    return bool(
        offset <= 4 * EPS * np.abs(cubic).max() and along.min() >= 0.0 and along.max() <= 1.0
    )


def turning_points(cubics: FloatArray) -> FloatArray:
    """End points and points where x or y turns, of cubics, shape (k, 2)."""
    first, second, third = (3 * np.diff(cubics, axis=1)).transpose(1, 0, 2)
    # Derivative a t^2 + b t + c; its roots without cancellation, q as in Numerical Recipes 5.6.
    a, b, c = first - 2 * second + third, 2 * (second - first), first
    with np.errstate(divide="ignore", invalid="ignore"):
        q = -0.5 * (b + np.copysign(np.sqrt(b * b - 4 * a * c), b))
        roots = np.stack([q / a, c / q])
    roots = np.where((roots > 0) & (roots < 1), roots, 0.0)[..., None]
    rest = 1 - roots
    p0, p1, p2, p3 = (cubics[None, :, None, i] for i in range(4))
    turns = rest**3 * p0 + 3 * rest**2 * roots * p1 + 3 * rest * roots**2 * p2 + roots**3 * p3
    return np.concatenate([cubics[:, 0], cubics[:, 3], turns.reshape(-1, 2)])

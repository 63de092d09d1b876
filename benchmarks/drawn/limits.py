"""Lines, arcs and corners of noisy points beside the least squares that are told the structure.

These know which points are whose, what is a line, what an arc, and which joints are tangent; they
do not know what is level, equal or a mirror image. An element's error is the root mean square
distance of its true inner points from the line or circle that was found, a corner's its distance.
"""

from __future__ import annotations

from collections import defaultdict
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import least_squares
from scipy.spatial import cKDTree

import shapespline as ss
from benchmarks.drawn.found import Found
from benchmarks.drawn.tables import PLATES, SAMPLINGS, SIZE, noisy_points, rendered
from benchmarks.drawn.truth import Arc, Line, turn_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from benchmarks.drawn.truth import Array, Element, Outline
    from shapespline.values import Piece

# Turns that are no corners, degrees; what a tangent joint weighs beside a point.
SMOOTH, EXACT = 1.0, 1e4
# Samples of an element, and the part of it that they lie on.
SAMPLES, INNER = 21, 0.9


def limits_table(draws: int = 10) -> str:
    """Our errors over theirs, of the fits that have the drawing's lines and arcs."""
    lines = [
        "Lines, arcs, corners | " + " | ".join(f"{noise} %, {n}" for noise, n in SAMPLINGS),
        "|".join(["---"] * (1 + len(SAMPLINGS))),
    ]
    for name in PLATES:
        ours: dict[tuple[float, int], list[list[Array]]] = defaultdict(list)
        theirs: dict[tuple[float, int], list[list[Array]]] = defaultdict(list)
        outline = rendered(name, SIZE)[0][0]
        own = sorted(type(one).__name__.lower() for one in outline)
        for seed in range(draws):
            for noise, points, dense, _ in noisy_points(name, np.random.default_rng(seed)):
                pieces = ss.fit_curve(points, closed=True).pieces
                if sorted(piece.kind for piece in pieces) != own:
                    continue
                clean = ss.Contour(dense, closed=True).resampled(len(points)).points
                found = [_of_piece(nearest(one, pieces)) for one in outline]
                ours[noise, len(points)].append(errors(outline, found))
                theirs[noise, len(points)].append(errors(outline, told(outline, points, clean)))
        cells = [_ratios(ours[key], theirs[key]) for key in SAMPLINGS]
        lines.append(f"{name} | " + " | ".join(cells))
    return "".join(f"| {line} |\n" for line in lines)


def _ratios(ours: Sequence[Sequence[Array]], theirs: Sequence[Sequence[Array]]) -> str:
    """Of lines, arcs and corners, root mean squares over all draws."""
    said = []
    for kind in range(3):
        a, b = (np.concatenate([draw[kind] for draw in side] or [[]]) for side in (ours, theirs))
        said.append(f"{np.sqrt((a**2).sum() / (b**2).sum()):.2f}" if len(a) else "")
    return ", ".join(one or "-" for one in said)


def nearest(element: Element, pieces: Sequence[Piece]) -> Piece:
    """The piece of the same kind that comes nearest to the middle of an element."""
    kind = "line" if isinstance(element, Line) else "arc"
    middle = _inner(element)[SAMPLES // 2]
    own = [piece for piece in pieces if piece.kind == kind] or list(pieces)
    samples = Found.of_pieces([own]).sampled
    return own[int(np.argmin([cKDTree(one).query(middle)[0] for one in samples]))]


def _of_piece(piece: Piece) -> Array:
    """Centre and radius of an arc; direction and offset of a line."""
    if piece.arc is not None:
        return np.array([*piece.arc.centre, piece.arc.radius])
    a, b = piece.control_points[[0, -1]]
    angle = np.arctan2(*(b - a)[::-1])
    return np.array([angle, np.cos(angle) * a[1] - np.sin(angle) * a[0]])


def told(outline: Outline, points: Array, clean: Array) -> list[Array]:
    """Least squares for all elements; each point belongs to that on which it lay without noise."""
    off = np.array([np.abs(_distances(_true(one), clean)) for one in outline])
    beside = [cKDTree(one.points(0.02)).query(clean)[0] for one in outline]
    owner = np.argmin(off + np.array(beside), axis=0)
    sizes = [len(_true(one)) for one in outline]
    begins = np.cumsum([0, *sizes])
    touching = [
        (k, (k + 1) % len(outline))
        for k, one in enumerate(outline)
        if abs(turn_of(one, outline[(k + 1) % len(outline)])) < SMOOTH
    ]

    def residuals(x: Array) -> Array:
        own = [x[i:j] for i, j in pairwise(begins)]
        parts = [_distances(own[k], points[owner == k]) for k in range(len(outline))]
        ends = [EXACT * _gap(own[k], own[m]) for k, m in touching]
        return np.concatenate([*parts, np.array(ends)])

    start = np.concatenate([_true(one) for one in outline])
    solved = least_squares(residuals, start, x_scale=np.maximum(np.abs(start), 1.0)).x
    return [solved[i:j] for i, j in pairwise(begins)]


def _true(element: Element) -> Array:
    if isinstance(element, Arc):
        return np.array([*element.centre, element.radius])
    angle = np.arctan2(*(element.end - element.begin)[::-1])
    x, y = element.begin
    return np.array([angle, np.cos(angle) * y - np.sin(angle) * x])


def _distances(unknowns: Array, points: Array) -> Array:
    """Signed distances from a whole line or circle."""
    if len(unknowns) == 2:
        angle, offset = unknowns
        return np.cos(angle) * points[:, 1] - np.sin(angle) * points[:, 0] - offset
    return np.hypot(*(points - unknowns[:2]).T) - unknowns[2]


def _gap(a: Array, b: Array) -> float:
    """By what a line and a circle miss tangency."""
    line, circle = (a, b) if len(a) == 2 else (b, a)
    side = float(_distances(line, circle[None, :2])[0])
    return abs(side) - float(circle[2])


def errors(outline: Outline, found: Sequence[Array]) -> list[Array]:
    """Of lines, of arcs and of corners."""
    said: list[list[float]] = [[], [], []]
    for k, one in enumerate(outline):
        off = _distances(found[k], _inner(one))
        said[0 if isinstance(one, Line) else 1].append(float(np.sqrt((off**2).mean())))
        after = outline[(k + 1) % len(outline)]
        if abs(turn_of(one, after)) >= SMOOTH:
            said[2].append(_corner(found[k], found[(k + 1) % len(outline)], one.end))
    return [np.array(part) for part in said]


def _inner(element: Element) -> Array:
    t = 0.5 + INNER * np.linspace(-0.5, 0.5, SAMPLES)
    if isinstance(element, Arc):
        return element.at(element.start + t * element.sweep)
    return element.begin + t[:, None] * (element.end - element.begin)


def _corner(a: Array, b: Array, place: Array) -> float:
    """How far from a place two elements meet."""
    met = least_squares(
        lambda p: np.concatenate([_distances(a, p[None]), _distances(b, p[None])]), place
    ).x
    return float(np.hypot(*(met - place)))

"""Unordered points to outlines: which point follows which.

Clean points. Neighbours along a curve are neighbours in the Delaunay triangulation where the curve
is sampled densely enough (Amenta, Bern and Eppstein 1998). Its edges are taken from the shortest
on, as long as no point gets a third one: chains grow from the dense parts. Points that were passed
over, at sharp corners, are put where they lengthen a chain least; ends of chains that are no
farther apart than a few of their own steps are joined; crossings are undone.

Noisy points, a band rather than a line, are first moved onto the middle of the band by local
parabolas (moving least squares, Lee 2000), then thinned to the width of the band.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from shapespline.analysis.drawn_vertices import are_drawn_vertices
from shapespline.analysis.reconstruction.chains import Links, complete, linked
from shapespline.errors import InvalidInputError, OrderError
from shapespline.geometry import parents_of
from shapespline.validation import float_array
from shapespline.values import Contour, Shape

if TYPE_CHECKING:
    from shapespline.typing import ArrayLike, FloatArray, IntArray

# A point is ambiguous if a point that is not its neighbour is nearer than this times its farther
# neighbour.
CLEAR = 1.25
# Below this part of clear points the order is a guess, and refused.
LEAST_CONFIDENCE = 0.5
# A chain of noisy points turns by more than this at most of its points, radians; far more than any
# joint of a curve that is smooth.
JAGGED = np.radians(50.0)
# Chains through noisy points are jagged at this part of their points and more, those through points
# moved onto the middle at this part and less.
NOISY, QUIET = 0.3, 0.1
# Radii tried for the local parabolas, in median distances to the nearest neighbour.
RADII = (4.0, 6.0, 9.0, 13.0, 20.0, 30.0)
PROJECTIONS = 4
# Points farther from their nearest neighbour than this many medians are outliers.
FAR = 6.0
# Points are shuffled if there are so many and a step is this part of the box diagonal in the mean.
# Shuffled outlines have 0.2 to 0.5, ordered ones of so many points less than 0.1.
FEWEST_SHUFFLED, ACROSS = 30, 0.15
MOST_LOOKED_AT = 20_000
# Chains of fewer points are outliers where there are longer ones.
FEWEST = 4


@dataclass(frozen=True, eq=False)
class Ordering:
    """Outlines found in a set of points.

    Attributes
    ----------
    shape : Shape
        The outlines, the longest first, nested by containment.
    indices : tuple of ndarray
        For each outline the points given that it runs through, in its order; for noisy points,
        which outlines do not run through, those it was made from, in order along it.
    outliers : ndarray
        Points given that belong to no outline.
    confidence : float
        Part of the points whose neighbours are clear: no other point is nearly as near. 1 for
        well-sampled curves.
    noise : float
        Half the width of the band that the points fill, data units; 0 if the outlines run through
        the points themselves.
    """

    shape: Shape
    indices: tuple[IntArray, ...]
    outliers: IntArray
    confidence: float
    noise: float


def order_points(points: ArrayLike, *, closed: bool | None = None) -> Ordering:
    """Find the outlines that unordered points were taken from.

    Parameters
    ----------
    points : array_like, shape (n, 2)
        In any order; repeated ones count once.
    closed : bool, optional
        Whether the outlines are closed; found for each of them if not given.

    Returns
    -------
    Ordering

    Raises
    ------
    InvalidInputError
        If the points are not a finite (n, 2) array of three different ones at least.
    OrderError
        If no order can be found; the message says what would help.

    Notes
    -----
    A curve can be found where its points lie closer than other parts of it, a few points to every
    bend. No order is certain: look at ``confidence``, and at the picture.

    Examples
    --------
    >>> t = np.linspace(0, 2 * np.pi, 50, endpoint=False)
    >>> circle = np.column_stack([np.cos(t), np.sin(t)])
    >>> shuffled = np.random.default_rng(1).permutation(50)
    >>> found = order_points(circle[shuffled])
    >>> order = shuffled[found.indices[0]]
    >>> found.confidence, set(np.unique(np.abs(np.diff(order))).tolist()) <= {1, 49}
    (1.0, True)
    """
    given = float_array(points, "points")
    if given.ndim != 2 or given.shape[1] != 2 or not np.isfinite(given).all():
        raise InvalidInputError(f"points must be a finite (n, 2) array, got shape {given.shape}")
    distinct, first = np.unique(given, axis=0, return_index=True)
    if len(distinct) < 3 or np.linalg.matrix_rank(distinct - distinct[0]) < 1:
        raise InvalidInputError(
            f"points must hold at least 3 different ones to be ordered, got {len(distinct)}"
        )
    size = float(np.ptp(distinct, axis=0).max())
    normal = (distinct - distinct.mean(axis=0)) / size
    links = linked(normal)
    if _jagged_part(normal, links) <= NOISY:
        return _ordering(distinct, first, complete(links), closed)
    return _noisy(distinct, normal, first, closed, size)


def looks_shuffled(contour: Contour) -> bool:
    """Whether the points of a contour are hardly in the order of an outline.

    Each step then leads across the whole, and not to one of the nearest points. Fewer than 30
    points may well lie like that. Of very many the first ones tell.

    Examples
    --------
    >>> t = np.linspace(0, 2 * np.pi, 50, endpoint=False)
    >>> circle = np.column_stack([np.cos(t), np.sin(t)])
    >>> shuffled = circle[np.random.default_rng(1).permutation(50)]
    >>> looks_shuffled(Contour(circle)), looks_shuffled(Contour(shuffled, closed=True))
    (False, True)
    """
    if len(contour) > MOST_LOOKED_AT:
        contour = Contour.trusted(contour.points[:MOST_LOOKED_AT], closed=False)
    n = len(contour)
    if n < FEWEST_SHUFFLED or contour.length < ACROSS * n * contour.box_diagonal:
        return False
    from scipy.spatial import cKDTree

    nearest = cKDTree(contour.points).query(contour.points, k=2)[0][:, 1]
    step = float(np.median(np.diff(contour.arc_length)))
    # Teeth of a comb are long, too, but alike.
    return bool(step > FAR * np.median(nearest)) and not are_drawn_vertices(
        contour.points, contour.closed, step
    )


def _ordering(points: FloatArray, first: IntArray, links: Links, closed: bool | None) -> Ordering:
    """The result for chains through the points themselves."""
    chains = [chain for chain in links.chains() if len(chain) >= FEWEST]
    if not chains:
        chains = [chain for chain in links.chains() if len(chain) > 1]
    if not chains:
        raise OrderError(
            "no order can be found in the points: no two of them are neighbours clearly; give more"
            " points of the outline, or points in order"
        )
    rings = [links.is_ring(chain) if closed is None else closed for chain in chains]
    rings = [ring and len(chain) > 2 for ring, chain in zip(rings, chains, strict=True)]
    contours = [
        Contour.silently(points[chain], closed=ring)
        for chain, ring in zip(chains, rings, strict=True)
    ]
    order = sorted(range(len(contours)), key=lambda i: -contours[i].length)
    contours = [contours[i] for i in order]
    used = np.zeros(len(points), dtype=bool)
    used[np.concatenate(chains)] = True
    confidence = _confidence(points, links, used)
    if confidence < LEAST_CONFIDENCE:
        raise OrderError(
            f"no order can be trusted: of only {100 * confidence:.0f} % of the points it is clear"
            " which are their neighbours; give more points of the outline, or points in order"
        )
    return Ordering(
        Shape(contours, parents_of(contours)),
        tuple(first[chains[i]] for i in order),
        first[~used],
        confidence,
        0.0,
    )


def _confidence(points: FloatArray, links: Links, used: FloatArray) -> float:
    """Part of the points in chains that have no stranger nearly as near as a neighbour."""
    from scipy.spatial import cKDTree

    n_near = min(len(points), 4)
    distances, near = cKDTree(points).query(points, k=n_near)
    clear = np.zeros(len(points), dtype=bool)
    for index in np.flatnonzero(used).tolist():
        own = links.neighbours[index]
        farther = max(float(np.hypot(*(points[index] - points[k]).T)) for k in own)
        strangers = [
            d for d, k in zip(distances[index, 1:], near[index, 1:], strict=True) if k not in own
        ]
        clear[index] = not strangers or len(own) == 1 or min(strangers) * CLEAR > farther
    return float(clear[used].mean())


def _jagged_part(points: FloatArray, links: Links) -> float:
    """Part of the points of all chains at which they turn sharply."""
    sharp, count = 0, 0
    for chain in links.chains():
        path = points[[*chain, *chain[:2]]] if links.is_ring(chain) else points[chain]
        steps = np.diff(path, axis=0)
        u, v = steps[:-1], steps[1:]
        turn = np.abs(np.arctan2(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0], (u * v).sum(axis=1)))
        sharp += int((turn > JAGGED).sum())
        count += len(turn)
    return sharp / max(count, 1)


def _noisy(
    distinct: FloatArray,
    points: FloatArray,
    first: IntArray,
    closed: bool | None,
    size: float,
) -> Ordering:
    """The result for a band of points: the narrowest parabolas that leave a smooth chain."""
    from scipy.spatial import cKDTree

    step = float(np.median(cKDTree(points).query(points, k=2)[0][:, 1]))
    for radius in RADII:
        moved = _onto_the_middle(points, radius * step)
        kept = _thinned(moved, 0.35 * radius * step)
        if len(kept) < 6:
            break
        links = complete(linked(moved[kept]))
        if _jagged_part(moved[kept], links) > QUIET:
            continue
        found = _ordering(moved[kept], np.arange(len(kept)), links, closed)
        if found.confidence < 0.8:
            continue
        noise = float(np.sqrt(((moved - points) ** 2).sum(axis=1).mean()))
        return _in_data_units(found, distinct, first, size, noise)
    raise OrderError(
        "no order can be found in the points: they fill a band in which no single curve shows;"
        " give points with less noise, more of them, or points in order"
    )


def _in_data_units(
    found: Ordering, given: FloatArray, first: IntArray, size: float, noise: float
) -> Ordering:
    """Outlines of thinned points back in data units, every point given told where it belongs."""
    middle = given.mean(axis=0)
    contours = [
        Contour.silently(size * contour.points + middle, contour.closed) for contour in found.shape
    ]
    places = []
    for contour in contours:
        vertices = contour.polyline
        a, d = vertices[:-1], np.diff(vertices, axis=0)
        length_sq = (d**2).sum(axis=1)
        best, at = np.full(len(given), np.inf), np.zeros(len(given))
        for k in range(len(a)):
            share = np.clip((given - a[k]) @ d[k] / length_sq[k], 0.0, 1.0)
            distance = np.hypot(*(given - a[k] - share[:, None] * d[k]).T)
            nearer = distance < best
            best[nearer], at[nearer] = distance[nearer], k + share[nearer]
        places.append((best, at))
    distances = np.array([best for best, _ in places])
    owner = distances.argmin(axis=0)
    outlying = distances.min(axis=0) > FAR * max(noise * size, 1e-300)
    indices = []
    for k, (_, at) in enumerate(places):
        mine = np.flatnonzero((owner == k) & ~outlying)
        indices.append(first[mine[np.argsort(at[mine], kind="stable")]])
    return Ordering(
        Shape(contours, found.shape.parents),
        tuple(indices),
        first[outlying],
        found.confidence,
        noise * size,
    )


def _onto_the_middle(points: FloatArray, radius: float) -> FloatArray:
    """Points projected some times onto parabolas through their neighbourhoods."""
    from scipy.spatial import cKDTree

    moved = points
    for _ in range(PROJECTIONS):
        tree = cKDTree(moved)
        near = tree.query_ball_point(moved, radius)
        result = moved.copy()
        for index, around in enumerate(near):
            if len(around) < 4:
                continue
            centred = moved[around] - moved[index]
            weight = np.maximum(1.0 - (centred**2).sum(axis=1) / radius**2, 0.0) ** 2 + 1e-12
            mean = weight @ centred / weight.sum()
            spread = (centred - mean) * np.sqrt(weight)[:, None]
            _, axes = np.linalg.eigh(spread.T @ spread)
            along, across = (centred - mean) @ axes[:, 1], (centred - mean) @ axes[:, 0]
            powers = np.vander(along, 3) * np.sqrt(weight)[:, None]
            fit, *_ = np.linalg.lstsq(powers, across * np.sqrt(weight), rcond=None)
            u = float(-mean @ axes[:, 1])
            v = float(np.polyval(fit, u))
            result[index] = moved[index] + mean + u * axes[:, 1] + v * axes[:, 0]
        moved = result
    return moved


def _thinned(points: FloatArray, spacing: float) -> IntArray:
    """Points of which no two are nearer than a spacing, taken in their order."""
    from scipy.spatial import cKDTree

    tree = cKDTree(points)
    free = np.ones(len(points), dtype=bool)
    kept = []
    for index in range(len(points)):
        if free[index]:
            kept.append(index)
            free[tree.query_ball_point(points[index], spacing)] = False
    return np.array(kept)

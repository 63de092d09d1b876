"""Outlines of lines and arcs that are one but for their places: moved, turned, mirrored.

The motion that maps the nodes of one best onto those of the other (Procrustes' problem in the
plane, closed form) is looked for over all beginnings at once. A mere move is preferred, then turns
and mirrors that keep level edges level, then those by steps that people use, within their error.
"""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.engines.drawn.joints import unit_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from shapespline.typing import BoolArray, FloatArray, IntArray

    ComplexArray = NDArray[np.complex128]

# Standard errors that an angle may be off a step.
LARGEST = 3.0
# People turn by multiples of this, radians.
STEP = pi / 12


class Outline(NamedTuple):
    """A closed row of lines and arcs: where each begins, its middle, whether it is an arc."""

    nodes: FloatArray
    middles: FloatArray
    is_arc: BoolArray

    @property
    def centre(self) -> FloatArray:
        """The mean of the nodes."""
        return self.nodes.mean(axis=0)


class Placement(NamedTuple):
    """How a copy lies: p -> ``linear`` (p - centre) + own centre.

    ``places[k]`` is its own piece that is the original's piece k, which it runs through backwards
    if ``is_reversed``. Its nodes and middles are off by ``miss`` at most, in the mean square by
    ``variance`` along each axis.
    """

    linear: FloatArray
    places: IntArray
    is_reversed: bool
    miss: float
    variance: float


def placement_of(
    head: Outline, other: Outline, deviation: float, reach: float, n_steps: int = 0
) -> Placement | None:
    """How another outline lies as a copy of one; None if it is none.

    Parameters
    ----------
    head, other : Outline
    deviation, reach : float
        Standard deviation of a node, and how far it may miss its image.
    n_steps : int, optional
        Turns by a whole number of that part of a turn are as likely as those by 15 degrees.

    Examples
    --------
    >>> nodes = np.array([(0, 0), (4, 0), (4, 1), (0, 3)], dtype=float)
    >>> turned = np.column_stack([9 - nodes[:, 1], nodes[:, 0]])
    >>> def outline(nodes):
    ...     return Outline(nodes, (nodes + np.roll(nodes, -1, axis=0)) / 2, np.zeros(4, bool))
    >>> own = outline(nodes), outline(np.roll(turned, 1, axis=0))
    >>> found = placement_of(*own, deviation=1e-6, reach=1e-5)
    >>> found.linear.tolist(), found.places.tolist()
    ([[0.0, -1.0], [1.0, 0.0]], [1, 2, 3, 0])
    """
    n = len(head.nodes)
    if len(other.nodes) != n or abs(_round(head) - _round(other)) > 2 * n * reach:
        return None
    own, its = _centred(head), _centred(other)
    inertia = float((abs(own) ** 2).sum())
    best: tuple[tuple[int, bool, float], Placement] | None = None
    for is_reversed in (False, True):
        nodes, places = _rolls(n, -1 if is_reversed else 1)
        able = np.flatnonzero((other.is_arc[places] == head.is_arc).all(axis=1))
        images = its[np.hstack([nodes, n + places])][able]
        for is_mirrored in (False, True):
            shown = own.conj() if is_mirrored else own
            angles = np.angle(images @ shown.conj())
            if not is_mirrored:  # a mere move needs no reason
                angles[abs(images - shown).max(axis=1, initial=0.0) <= reach] = 0.0
            for at, image, angle in zip(able.tolist(), images, angles.tolist(), strict=True):
                variance = max(deviation**2, _spread(shown, image, angle))
                error = LARGEST * (2.0 * variance / inertia) ** 0.5
                rank, settled = _settled(angle, error, n_steps)
                miss = float(abs(np.exp(1j * settled) * shown - image).max())
                key = (0 if settled == 0.0 and not is_mirrored else rank, is_mirrored, miss)
                if miss <= reach and (best is None or key < best[0]):
                    linear = turn_matrix(settled, is_mirrored=is_mirrored)
                    variance = _spread(shown, image, settled)
                    best = key, Placement(linear, places[at], is_reversed, miss, variance)
    return None if best is None else best[1]


def _round(outline: Outline) -> float:
    """The length of the polygon of its nodes."""
    return float(np.hypot(*(outline.nodes - np.roll(outline.nodes, 1, axis=0)).T).sum())


def _centred(outline: Outline) -> ComplexArray:
    """Nodes, then middles, about the centre."""
    x, y = (np.concatenate([outline.nodes, outline.middles]) - outline.centre).T
    return x + 1j * y


def _rolls(n: int, way: int) -> tuple[IntArray, IntArray]:
    """Of every beginning, shape (n, n): the nodes and the pieces that are those of the original."""
    nodes = (np.arange(n)[:, None] + way * np.arange(n)) % n
    return nodes, nodes if way > 0 else (nodes - 1) % n


def _spread(shown: ComplexArray, image: ComplexArray, angle: float) -> float:
    """The mean square of how far points are from their images along each axis."""
    return 0.5 * float((abs(np.exp(1j * angle) * shown - image) ** 2).mean())


def _settled(angle: float, error: float, n_steps: int) -> tuple[int, float]:
    """An angle as people would have chosen it, and how likely that is: 1 to 3, the least first."""
    steps: Sequence[float] = (pi / 2, STEP, *((2 * pi / n_steps,) if n_steps > 2 else ()))
    for rank, step in enumerate(steps):
        settled = round(angle / step) * step
        if abs(angle - settled) <= error:
            return min(rank, 1) + 1, settled
    return 3, angle


def turn_matrix(angle: float, *, is_mirrored: bool = False) -> FloatArray:
    """The matrix of a turn, after a mirror at the first axis; exact for right angles."""
    c, s = unit_of(angle).tolist()
    return np.array([[c, s], [s, -c]] if is_mirrored else [[c, -s], [s, c]])

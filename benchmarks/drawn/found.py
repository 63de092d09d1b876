"""What a tracer made of a picture: outlines of pieces, whoever made them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from shapespline.geometry import turn_between
from shapespline.values import BSplineCurve

if TYPE_CHECKING:
    from collections.abc import Sequence

    import shapespline as ss
    from benchmarks.drawn.truth import Array
    from shapespline.values import Piece

STEP = 0.05  # of samples, pixels
BREAK = 10.0  # degrees that a joint turns by at least
# A hook turns by so many degrees within so many pixels.
HOOK, HOOK_LENGTH = 60.0, 1.0


@dataclass(frozen=True, eq=False)
class Found:
    """Closed outlines of pieces, their stored points, and how many outlines break a promise."""

    outlines: tuple[tuple[Piece, ...], ...]
    n_points: int
    exceeded: int = 0

    @classmethod
    def of_fits(cls, fits: Sequence[ss.Fit]) -> Found:
        """Of this package."""
        return cls(
            tuple(fit.pieces for fit in fits),
            sum(fit.n_stored_points for fit in fits),
            sum(not fit.kept for fit in fits),
        )

    @classmethod
    def of_pieces(cls, outlines: Sequence[Sequence[Piece]]) -> Found:
        """Of lines and Beziers."""
        return cls(
            tuple(map(tuple, outlines)),
            sum(piece.n_stored for outline in outlines for piece in outline),
        )

    @cached_property
    def pieces(self) -> list[Piece]:
        """All pieces, one outline after the other."""
        return [piece for outline in self.outlines for piece in outline]

    @cached_property
    def sampled(self) -> list[Array]:
        """Dense points of each piece."""
        return [_points(piece) for piece in self.pieces]

    @cached_property
    def curve(self) -> Array:
        """Dense points of all pieces, shape (n, 2)."""
        return np.concatenate(self.sampled)

    @cached_property
    def owner(self) -> Array:
        """The piece that each point of the curve is of."""
        return np.repeat(np.arange(len(self.sampled)), [len(one) for one in self.sampled])

    @cached_property
    def lengths(self) -> Array:
        """Of the pieces."""
        return np.array([np.hypot(*np.diff(one, axis=0).T).sum() for one in self.sampled])

    @cached_property
    def breaks(self) -> Array:
        """Where joints turn, shape (n, 2)."""
        places = []
        for outline in self.outlines:
            if len(outline) == 1 and (outline[0].arc is not None or _is_periodic(outline[0])):
                continue
            for before, after in zip(outline[-1:] + outline[:-1], outline, strict=True):
                if abs(np.degrees(turn_between(before, after))) > BREAK:
                    places.append(after.control_points[0])
        return np.array(places).reshape(-1, 2)

    @cached_property
    def hooks(self) -> Array:
        """Where a curve turns sharply within a short way, one place for each, shape (n, 2)."""
        places: list[Array] = []
        at = 0
        for outline in self.outlines:
            points = np.concatenate(self.sampled[at : at + len(outline)])
            at += len(outline)
            steps = np.diff(np.vstack([points, points[:1]]), axis=0)
            length = np.hypot(*steps.T)
            points, steps, length = (one[length > 1e-6] for one in (points, steps, length))
            if len(points) < 3:
                continue
            angle = np.unwrap(np.arctan2(steps[:, 1], steps[:, 0]))
            angle = np.concatenate(
                [angle, angle + round((angle[-1] - angle[0]) / 2 / np.pi) * 2 * np.pi]
            )
            station = np.cumsum(np.concatenate([[0.0], length, length]))[:-1]
            ahead = np.searchsorted(station, station[: len(points)] + HOOK_LENGTH)
            turned = np.abs(angle[np.minimum(ahead, len(angle) - 1)] - angle[: len(points)])
            middle = points[(np.arange(len(points)) + ahead) // 2 % len(points)]
            for place in middle[turned > np.radians(HOOK)]:
                if not places or min(np.hypot(*(place - one)) for one in places) > 2 * HOOK_LENGTH:
                    places.append(place)
        return np.array(places).reshape(-1, 2)


def _is_periodic(piece: Piece) -> bool:
    return bool(piece.knots[0] != piece.knots[piece.degree])


def _points(piece: Piece) -> Array:
    n = max(3, int(piece.polygon_length / STEP))
    periodic = _is_periodic(piece)  # such a piece repeats its first points
    control = piece.control_points[: -piece.degree] if periodic else piece.control_points
    curve = BSplineCurve(piece.knots, control, piece.degree, periodic=periodic)
    points = curve(np.linspace(0, 1, n))
    if piece.kind == "line":  # to the bit where its ends agree
        a, b = piece.control_points
        points = np.where(a == b, a, points)
    return points

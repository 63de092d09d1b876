"""What the outlines of a drawing repeat: equal holes in rows and on rings, equal copies.

Outlines that were found as drawn, of lines and arcs alone, are looked at together. What they keep
is solved for all of them, each is verified anew, and one that its own points contradict stays as it
was while the others are solved without it.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from shapespline.engines.drawn import Feature, Observed, repeated_outlines
from shapespline.fitting.verify import verified_fit
from shapespline.geometry import joined
from shapespline.values import Arc, Piece, Regularity

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from shapespline.typing import FloatArray
    from shapespline.values import Fit

    # Pieces, and what they keep.
    _Told: TypeAlias = tuple[tuple[Piece, ...], tuple[Regularity, ...]]

# Copies miss each other by at most so many deviations; an outline fits badly if its root mean
# square grows by more than these allow, as an element does (DRA-12).
MISSED, WORSE_PART, WORSE_BY = 6.0, 1.5, 0.7
DRAWN = ("line", "arc")
# Each outline is compared with each: of more than these nothing is looked for (DRA-12).
MOST_OUTLINES = 300


class _Known(NamedTuple):
    """An outline of lines and arcs: where its pieces begin, and how well its points tell it."""

    fit: Fit
    nodes: FloatArray
    deviation: float
    centre_variance: float
    radius_variance: float

    @property
    def circle(self) -> Arc | None:
        """The circle that all of it is."""
        return self.fit.sections[0].arc if len(self.fit.sections) == 1 else None

    @property
    def has_centre(self) -> bool:
        """Whether it is a circle, or turned onto itself."""
        turned = any(one.name == "rotation" for one in self.fit.regularities)
        return self.circle is not None or turned

    @property
    def centre(self) -> FloatArray:
        """Of the circle, or of the nodes."""
        return self.nodes.mean(axis=0) if self.circle is None else np.array(self.circle.centre)

    @classmethod
    def of(cls, fit: Fit) -> _Known:
        """What the points of a fit tell."""
        contour = fit.contour
        traced = contour.level_line is not None
        seen = Observed.of(contour, contour.accuracy if traced else None)
        deviation = max(seen.deviation, fit.rms_distance if traced else 0.0)
        mean = deviation**2 / len(seen.points)
        nodes = np.array([piece.control_points[0] for piece in fit.sections])
        floor = seen.floor**2
        return cls(fit, nodes, deviation, 2 * mean + floor, mean + floor)


def across_outlines(
    fits: Sequence[Fit], allowed: Collection[str], tolerance: float | None
) -> tuple[list[Fit], tuple[Regularity, ...]]:
    """The fits under what they repeat, and what that is, by their places.

    Parameters
    ----------
    fits : sequence of Fit
    allowed : collection of str
        Names of regularities that may be taken.
    tolerance : float or None
        The one asked for.
    """
    able = [k for k, fit in enumerate(fits) if _is_drawn(fit)]
    if not allowed or not 1 < len(able) <= MOST_OUTLINES:
        return list(fits), ()
    known = {k: _Known.of(fits[k]) for k in able}
    while len(known) > 1:
        moved, found = _Joint(known, frozenset(allowed)).solved()
        fitted = {k: _refitted(known[k].fit, *now, tolerance) for k, now in moved.items()}
        worse = [k for k, fit in fitted.items() if _is_worse(fit, known[k])]
        if not worse:
            return [fitted.get(k, fit) for k, fit in enumerate(fits)], found
        for k in worse:
            del known[k]
    return list(fits), ()


def _is_drawn(fit: Fit) -> bool:
    pieces = fit.sections
    return (
        fit.method == "drawn"
        and fit.closed
        and fit.kept
        and bool(pieces)
        and all(piece.kind in DRAWN for piece in pieces)
    )


def _refitted(
    fit: Fit, pieces: tuple[Piece, ...], kept: tuple[Regularity, ...], tolerance: float | None
) -> Fit:
    spline = joined(pieces, fit.degree)
    found = verified_fit(
        fit.contour, spline, tolerance=tolerance, method=fit.method, sections=pieces
    )
    return replace(found, history=fit.history, outliers=fit.outliers, regularities=kept)


def _is_worse(fit: Fit, known: _Known) -> bool:
    old = known.fit.rms_distance
    allowed = max(WORSE_PART * old, old + WORSE_BY * known.deviation)
    return not fit.kept or fit.rms_distance > allowed


@dataclass(eq=False)
class _Joint:
    """Outlines by their places, and the equal ones among them."""

    known: dict[int, _Known]
    allowed: frozenset[str]
    # Of each copy the outline that it is one of, and its own first piece that is that one's.
    copies: dict[int, tuple[int, int]] = field(default_factory=dict)
    found: list[Regularity] = field(default_factory=list)

    def solved(self) -> tuple[dict[int, _Told], tuple[Regularity, ...]]:
        """Pieces of the outlines that change and what they keep; and what all of them do."""
        if "equal-copies" in self.allowed:
            self._copies()
        places = [k for k, one in self.known.items() if k in self.copies or one.has_centre]
        if not places:
            return {}, ()
        features = [self._feature(k) for k in places]
        corners = np.concatenate([one.nodes for one in self.known.values()])
        extent = max(float(np.ptp(corners, axis=0).max()), *(2 * one.radius for one in features))
        values, told = repeated_outlines(features, extent, self.allowed, self._angle())
        for one in told:
            self.found.append(one._replace(pieces=tuple(places[k] for k in one.pieces)))
        moved = {}
        for k, (x, y, radius), before in zip(places, values.tolist(), features, strict=True):
            if (x, y, radius) == before[:3] and k not in self.copies:
                continue
            moved[k] = self._pieces(k, np.array([x, y]), radius)
        return moved, tuple(self.found)

    def _copies(self) -> None:
        """Outlines that are one but for their places; the first of each set stands for it."""
        heads: dict[int, list[tuple[int, float]]] = {}
        for k, one in self.known.items():
            if one.circle is not None:
                continue
            for head, members in heads.items():
                roll, miss = _missed(self.known[head], one)
                if miss <= MISSED * max(one.deviation, self.known[head].deviation):
                    members.append((k, miss))
                    self.copies[k] = head, roll
                    break
            else:
                heads[k] = []
        for head, members in heads.items():
            if members:
                self.copies[head] = head, 0
                own = (head, *(k for k, _ in members))
                miss = max(miss for _, miss in members)
                self.found.append(Regularity("equal-copies", own, miss))

    def _feature(self, k: int) -> Feature:
        one = self.known[k]
        radius = 0.0 if one.circle is None else one.circle.radius
        copy = self.copies.get(k, (-1, 0))[0]
        x, y = one.centre.tolist()
        return Feature(x, y, radius, one.centre_variance, one.radius_variance, copy)

    def _angle(self) -> float:
        """Direction of the edges; of level ones exactly 0."""
        longest, angle = 0.0, 0.0
        for one in self.known.values():
            for piece in one.fit.sections:
                if piece.kind != "line":
                    continue
                x, y = (piece.control_points[1] - piece.control_points[0]).tolist()
                if x == 0.0 or y == 0.0:
                    return 0.0
                if x * x + y * y > longest:
                    longest, angle = x * x + y * y, float(np.arctan2(y, x))
        return float(np.remainder(angle, np.pi / 2))

    def _pieces(self, k: int, centre: FloatArray, radius: float) -> _Told:
        """The outline about a centre: the circle, or what it is a copy of."""
        own = self.known[k].circle
        if own is not None:
            arc = Arc((float(centre[0]), float(centre[1])), radius, own.start_angle, own.sweep)
            ends = {"begin": arc.begin, "end": arc.begin}
            return (Piece.of_arc(arc, self.known[k].fit.tolerance, **ends),), ()
        head, roll = self.copies.get(k, (k, 0))
        shown = self.known[head]
        pieces = [piece.moved(np.eye(2), centre - shown.centre) for piece in shown.fit.sections]
        n = len(pieces)
        kept = tuple(
            one._replace(pieces=tuple(sorted((p + roll) % n for p in one.pieces)))
            for one in shown.fit.regularities
        )
        return tuple(pieces[(p - roll) % n] for p in range(n)), kept


def _missed(head: _Known, other: _Known) -> tuple[int, float]:
    """The piece of another outline that is the first of one, and how far the two miss."""
    a, b = head.fit.sections, other.fit.sections
    best = 0, np.inf
    if len(a) != len(b):
        return best
    for roll in range(len(b)):
        turned = b[roll:] + b[:roll]
        if any(p.kind != q.kind for p, q in zip(a, turned, strict=True)):
            continue
        off = np.roll(other.nodes, -roll, axis=0) - other.centre - (head.nodes - head.centre)
        miss = float(np.hypot(*off.T).max())
        for p, q in zip(a, turned, strict=True):
            if p.arc is not None and q.arc is not None:
                if p.arc.sweep * q.arc.sweep < 0:
                    miss = np.inf
                miss = max(miss, abs(p.arc.radius - q.arc.radius))
        if miss < best[1]:
            best = roll, miss
    return best

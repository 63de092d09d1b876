"""What the outlines of a drawing repeat: equal holes in rows and on rings, equal copies.

Outlines that were found as drawn, of lines and arcs alone, are looked at together. What they keep
is solved for all of them, each is verified anew, and one that its own points contradict stays as it
was while the others are solved without it.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from shapespline.engines.drawn import (
    Feature,
    Observed,
    Outline,
    placement_of,
    repeated_outlines,
)
from shapespline.fitting.verify import verified_fit
from shapespline.geometry import backwards, joined
from shapespline.values import Arc, Piece, Regularity

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from shapespline.engines.drawn import Placement
    from shapespline.typing import FloatArray
    from shapespline.values import Fit

    # Pieces, and what they keep.
    _Told: TypeAlias = tuple[tuple[Piece, ...], tuple[Regularity, ...]]

# Copies miss each other by at most so many deviations, level edges of them by this part of the
# outline's size; an outline fits badly if its root mean square grows by more than these allow, as
# an element does (DRA-12).
MISSED, LEVEL, WORSE_PART, WORSE_BY = 6.0, 1e-9, 1.5, 0.7
DRAWN = ("line", "arc")
# Each outline is compared with each: of more than these nothing is looked for (DRA-12).
MOST_OUTLINES = 300


class _Known(NamedTuple):
    """An outline of lines and arcs: the nodes and sizes of its pieces, how well points tell it."""

    fit: Fit
    outline: Outline
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
        return self.outline.centre if self.circle is None else np.array(self.circle.centre)

    @property
    def level(self) -> list[int]:
        """The pieces that are parallel to an axis."""
        own = (one for one in self.fit.regularities if one.name == "axis-parallel")
        return [piece for one in own for piece in one.pieces]

    @classmethod
    def of(cls, fit: Fit) -> _Known:
        """What the points of a fit tell."""
        contour = fit.contour
        traced = contour.level_line is not None
        seen = Observed.of(contour, contour.accuracy if traced else None)
        deviation = max(seen.deviation, fit.rms_distance if traced else 0.0)
        mean = deviation**2 / len(seen.points)
        chords = np.array([piece.control_points[[0, -1]] for piece in fit.sections])
        middles = [
            chord.mean(axis=0) if piece.arc is None else piece.arc.at(0.5)
            for piece, chord in zip(fit.sections, chords, strict=True)
        ]
        is_arc = np.array([piece.arc is not None for piece in fit.sections])
        outline = Outline(chords[:, 0], np.array(middles), is_arc)
        floor = seen.floor**2
        return cls(fit, outline, deviation, 2 * mean + floor, mean + floor)


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
    # Of each copy the outline that it is one of, and how it lies; None of that one itself.
    copies: dict[int, tuple[int, Placement | None]] = field(default_factory=dict)
    # Of those that have copies: the variance of a coordinate of a node among them.
    spread: dict[int, float] = field(default_factory=dict)
    found: list[Regularity] = field(default_factory=list)

    def solved(self) -> tuple[dict[int, _Told], tuple[Regularity, ...]]:
        """Pieces of the outlines that change and what they keep; and what all of them do."""
        if "equal-copies" in self.allowed:
            self._copies()
        places = [k for k, one in self.known.items() if k in self.copies or one.has_centre]
        if not places:
            return {}, ()
        features = [self._feature(k) for k in places]
        corners = np.concatenate([one.outline.nodes for one in self.known.values()])
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
        """Outlines that are one but for their places; one of each set stands for it."""
        heads: dict[int, list[int]] = {}
        # Those with the most level edges first: where they are in others is told by them.
        for k in sorted(self.known, key=lambda k: (-len(self.known[k].level), k)):
            if self.known[k].circle is not None:
                continue
            head = next((head for head in heads if self._placement(head, k) is not None), None)
            heads.setdefault(k if head is None else head, []).append(k)
        for head, (_, *members) in heads.items():
            placed = {k: self._placement(head, k, 1 + len(members)) for k in members}
            own = {k: one for k, one in placed.items() if one is not None}
            if own:
                self.copies |= {head: (head, None)} | {k: (head, one) for k, one in own.items()}
                self.spread[head] = float(np.mean([one.variance for one in own.values()]))
                miss = max(one.miss for one in own.values())
                self.found.append(Regularity("equal-copies", tuple(sorted((head, *own))), miss))

    def _placement(self, head: int, k: int, n_steps: int = 0) -> Placement | None:
        """How an outline lies as a copy of another, if its level edges are level as one."""
        one, other = self.known[head], self.known[k]
        deviation = max(one.deviation, other.deviation)
        reach = MISSED * deviation
        found = placement_of(one.outline, other.outline, deviation, reach, n_steps)
        if found is not None and other.level:
            nodes = _nodes(_moved(one.fit.sections, found, one.centre, other.centre))
            sides = np.roll(nodes, -1, axis=0)[other.level] - nodes[other.level]
            if (np.abs(sides).min(axis=1) > LEVEL * np.hypot(*sides.T)).any():
                return None
        return found

    def _feature(self, k: int) -> Feature:
        one = self.known[k]
        radius = 0.0 if one.circle is None else one.circle.radius
        copy = self.copies.get(k, (-1, None))[0]
        x, y = one.centre.tolist()
        variance = max(one.centre_variance, self.spread.get(copy, 0.0) / len(one.outline.nodes))
        return Feature(x, y, radius, variance, one.radius_variance, copy)

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
        head, placement = self.copies.get(k, (k, None))
        shown = self.known[head]
        if placement is None:
            moved = tuple(p.moved(np.eye(2), centre - shown.centre) for p in shown.fit.sections)
            return moved, shown.fit.regularities
        pieces = _moved(shown.fit.sections, placement, shown.centre, centre)
        keeps_axes = (placement.linear == 0.0).any()
        kept = [
            one._replace(pieces=tuple(sorted(placement.places[list(one.pieces)].tolist())))
            for one in shown.fit.regularities
            if keeps_axes or one.name != "axis-parallel"
        ]
        if not keeps_axes:
            kept += [one for one in self.known[k].fit.regularities if one.name == "axis-parallel"]
        return _levelled(pieces, self.known[k].level), tuple(kept)


def _moved(
    pieces: Sequence[Piece], placement: Placement, begin: FloatArray, end: FloatArray
) -> tuple[Piece, ...]:
    """The pieces of a copy in its own order; the centre of the original goes to its own."""
    linear, shift = placement.linear, end - placement.linear @ begin
    images = [piece.moved(linear, shift) for piece in pieces]
    if placement.is_reversed:
        images = list(backwards(images))[::-1]
    return tuple(images[k] for k in np.argsort(placement.places))


def _levelled(pieces: tuple[Piece, ...], level: Sequence[int]) -> tuple[Piece, ...]:
    """Pieces with some edges level to the bit that were so but for rounding."""
    nodes, n = _nodes(pieces), len(pieces)
    for k in level:
        a, b = nodes[k], nodes[(k + 1) % n]
        axis = int(abs(a[1] - b[1]) < abs(a[0] - b[0]))
        b[axis] = a[axis]
    return tuple(p.meeting(nodes[k], nodes[(k + 1) % n]) for k, p in enumerate(pieces))


def _nodes(pieces: Sequence[Piece]) -> FloatArray:
    """Where each begins."""
    return np.array([piece.control_points[0] for piece in pieces])

"""What came back of a drawing: straight edges, arcs, corners, equal features, distances."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial import cKDTree

from benchmarks.drawn.found import STEP
from benchmarks.drawn.repeats import spreads
from benchmarks.drawn.truth import Arc, Cubic, Line, sampled, turn_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from benchmarks.drawn.found import Found
    from benchmarks.drawn.repeats import Spread
    from benchmarks.drawn.truth import Array, Element, Outline

# Pixels: straight and round within; nearest break of a corner, lost beyond; hooks lie farther from
# any true corner or arc that is as tight.
STRAIGHT, ROUND, NEAR, LOST, HOOK_AWAY, TIGHT = 0.02, 0.15, 0.5, 1.5, 2.0, 1.0
# A true turn, degrees; elements that are looked at, pixels, and their part.
TURN, SHORTEST, INNER = 20.0, 3.0, 0.9


@dataclass
class Figures:
    """Sums over drawings, lengths in pixels."""

    names: list[str] = field(default_factory=list)
    outlines: list[int] = field(default_factory=list)
    straight: list[tuple[float, bool, bool]] = field(default_factory=list)
    bows: list[float] = field(default_factory=list)
    directions: list[float] = field(default_factory=list)
    level: list[bool] = field(default_factory=list)
    arcs: list[tuple[float, bool]] = field(default_factory=list)
    radii: list[float] = field(default_factory=list)
    unround: list[float] = field(default_factory=list)
    corners: list[float] = field(default_factory=list)
    chamfered: list[bool] = field(default_factory=list)
    false: list[int] = field(default_factory=list)
    hooks: list[int] = field(default_factory=list)
    equal: list[Spread] = field(default_factory=list)
    points: list[float] = field(default_factory=list)
    farthest: list[float] = field(default_factory=list)
    rms: list[float] = field(default_factory=list)
    exceeded: int = 0
    seconds: float = 0.0

    @classmethod
    def together(cls, parts: Sequence[Figures]) -> Figures:
        """Of several drawings."""
        whole = cls()
        for one in fields(cls):
            values = [getattr(part, one.name) for part in parts]
            start = getattr(whole, one.name)
            setattr(whole, one.name, sum(values, start))
        return whole

    def add(self, name: str, truth: Sequence[Outline], found: Found) -> None:
        """One drawing."""
        self.names.append(name)
        self.outlines.append(len(found.outlines) - len(truth))
        self.exceeded += found.exceeded
        curve, owner = found.curve, found.owner
        tree = cKDTree(curve)
        for outline in truth:
            for element in outline:
                if isinstance(element, Cubic):
                    continue
                points = element.points(STEP)
                length = len(points) * STEP
                if length < SHORTEST:
                    continue
                cut = round(0.5 * (1 - INNER) * len(points))
                inner = points[cut : len(points) - cut]
                index = tree.query(inner)[1]
                if isinstance(element, Line):
                    self._line(element, curve[index], owner[index], length)
                else:
                    self._arc(element, curve[index], length)
        self._corners(truth, found)
        self.equal += spreads(truth, found, tree, SHORTEST)
        own = sum({Line: 1, Arc: 2, Cubic: 3}[type(e)] for outline in truth for e in outline)
        self.points.append(found.n_points / own)
        true = np.concatenate([sampled(outline, STEP) for outline in truth])
        there, back = cKDTree(true).query(curve)[0], tree.query(true)[0]
        self.farthest.append(max(float(there.max()), float(back.max())))
        self.rms.append(float(np.sqrt((back**2).mean())))

    def _line(self, line: Line, found: Array, owner: Array, length: float) -> None:
        off = found - found.mean(axis=0)
        along = np.linalg.svd(off, full_matrices=False)[2][0]
        bow = float(np.abs(off @ np.array([-along[1], along[0]])).max())
        true = line.end - line.begin
        turn = np.arctan2(along[0] * true[1] - along[1] * true[0], along @ true)
        error = abs(float((np.degrees(turn) + 90) % 180 - 90))
        self.straight.append((length, bow <= STRAIGHT, bool((owner == owner[0]).all())))
        self.bows.append(bow)
        self.directions.append(error)
        if np.abs(true).min() < 1e-9 * np.abs(true).max():
            axis = int(np.argmin(np.abs(true)))
            self.level.append(bool(np.ptp(found[:, axis]) == 0))

    def _arc(self, arc: Arc, found: Array, length: float) -> None:
        radius = np.hypot(*(found - arc.centre).T)
        # Least squares for centre and radius (Kasa), enough for curves this near to circles.
        off = found - arc.centre
        system = np.column_stack([2 * off, np.ones(len(off))])
        solved = np.linalg.lstsq(system, (off**2).sum(axis=1), rcond=None)[0]
        own = float(np.sqrt(max(solved[2] + solved[0] ** 2 + solved[1] ** 2, 1e-12)))
        good = float(np.abs(radius - arc.radius).max()) <= ROUND
        self.arcs.append((length, good and abs(arc.radius / own - 1) <= 0.1))
        if abs(arc.sweep) > 6:
            about = np.hypot(*(off - solved[:2]).T)
            self.unround.append(float(np.ptp(about)))
            self.radii.append(abs(own - arc.radius))

    def _corners(self, truth: Sequence[Outline], found: Found) -> None:
        breaks = found.breaks
        true: list[Array] = []
        long: list[bool] = []
        tight: list[Array] = []
        for outline in truth:
            for k, before in enumerate(outline):
                after = outline[(k + 1) % len(outline)]
                if abs(turn_of(before, after)) > TURN:
                    true.append(before.end)
                    long.append(min(_length(before), _length(after)) >= SHORTEST)
                if isinstance(before, Arc) and before.radius < TIGHT:
                    tight.append(before.at(before.start + 0.5 * before.sweep))
        self.corners += _nearest(breaks, true).tolist()
        ends = [
            one[[0, -1]]
            for one, s in zip(found.sampled, found.lengths, strict=True)
            if s < SHORTEST
        ]
        for place, counts in zip(true, long, strict=True):
            if counts:
                self.chamfered.append(
                    any(np.hypot(*(one - place).T).max() <= SHORTEST for one in ends)
                )
        self.false.append(int((_nearest(true, breaks) > LOST).sum()))
        self.hooks.append(int((_nearest([*true, *tight], found.hooks) > HOOK_AWAY).sum()))

    def row(self) -> dict[str, str]:
        """The figures of a table's row."""
        lengths = np.array([length for length, *_ in self.straight])
        flat = np.array([good for _, good, _ in self.straight], dtype=bool)
        whole = np.array([one for *_, one in self.straight], dtype=bool)
        arc = np.array([length for length, _ in self.arcs])
        round_ = np.array([good for _, good in self.arcs], dtype=bool)
        corner = np.array(self.corners)

        def part(values: Array, of: Array) -> str:
            return f"{100 * values.sum() / of.sum():.0f}" if len(of) and of.sum() else ""

        def middle(values: list[float], digits: int = 3) -> str:
            return f"{np.median(values):.{digits}f}" if values else ""

        return {
            "straight": part(lengths[flat], lengths),
            "one piece": f"{100 * whole.mean():.0f}" if len(whole) else "",
            "worst bow": f"{max(self.bows):.3f}" if self.bows else "",
            "direction": middle(self.directions),
            "level": f"{100 * np.mean(self.level):.0f}" if self.level else "",
            "arcs": part(arc[round_], arc),
            "unround": middle(self.unround),
            "radius": middle(self.radii),
            "corners": f"{100 * np.mean(corner <= NEAR):.0f}" if len(corner) else "",
            "lost": f"{100 * np.mean(corner > LOST):.0f}" if len(corner) else "",
            "chamfered": f"{100 * np.mean(self.chamfered):.0f}" if self.chamfered else "",
            "false": f"{np.mean(self.false):.1f}",
            "hooks": f"{np.mean(self.hooks):.1f}",
            "spread": middle([one.offsets for one in self.equal]),
            "same": f"{100 * np.mean([one.same_pieces for one in self.equal]):.0f}"
            if self.equal
            else "",
            "points": f"{np.exp(np.mean(np.log(self.points))):.2f}",
            "RMS": f"{np.mean(self.rms):.3f}",
            "H": f"{np.median(self.farthest):.2f}, {max(self.farthest):.2f}",
            "outlines": f"{sum(max(-n, 0) for n in self.outlines)},"
            f" {sum(max(n, 0) for n in self.outlines)}",
            "exceeded": str(self.exceeded),
            "seconds": f"{self.seconds:.1f}",
        }


def _nearest(places: Sequence[Array] | Array, points: Sequence[Array] | Array) -> Array:
    """How far each point is from the nearest place."""
    if not len(points):
        return np.empty(0)
    if not len(places):
        return np.full(len(points), np.inf)
    return cKDTree(np.asarray(places)).query(np.asarray(points))[0]


def _length(element: Element) -> float:
    points = element.points(STEP)
    return float(np.hypot(*np.diff(np.vstack([points, element.end]), axis=0).T).sum())

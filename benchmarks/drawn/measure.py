"""What came back of a drawing: straight edges, arcs, corners, distances."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial import cKDTree

from benchmarks.drawn.truth import Arc, Cubic, Line, sampled
from shapespline.geometry import turn_between
from shapespline.values import BSplineCurve

if TYPE_CHECKING:
    from collections.abc import Sequence

    import shapespline as ss
    from benchmarks.drawn.truth import Array, Outline

# Pixels: step of samples; straight and round within; nearest break of a corner, lost beyond.
STEP, STRAIGHT, ROUND, NEAR, LOST = 0.05, 0.02, 0.15, 0.5, 1.5
# A true turn, a break of the result, degrees; elements that are looked at, pixels, and their part.
TURN, BREAK, SHORTEST, INNER = 20.0, 10.0, 3.0, 0.9


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
    false: list[int] = field(default_factory=list)
    points: list[float] = field(default_factory=list)
    farthest: list[float] = field(default_factory=list)
    rms: list[float] = field(default_factory=list)
    exceeded: int = 0
    seconds: float = 0.0

    def add(self, name: str, truth: Sequence[Outline], fits: Sequence[ss.Fit]) -> None:
        """One drawing."""
        self.names.append(name)
        self.outlines.append(len(fits) - len(truth))
        self.exceeded += sum(not fit.kept for fit in fits)
        curve, owner, breaks = _traced(fits)
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
        self._corners(truth, breaks)
        own = sum({Line: 1, Arc: 2, Cubic: 3}[type(e)] for outline in truth for e in outline)
        self.points.append(sum(fit.n_stored_points for fit in fits) / own)
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

    def _corners(self, truth: Sequence[Outline], breaks: Array) -> None:
        true = np.array(
            [
                outline[k].end
                for outline in truth
                for k in range(len(outline))
                if abs(_turn(outline[k], outline[(k + 1) % len(outline)])) > TURN
            ]
        ).reshape(-1, 2)
        if len(true):
            far = cKDTree(breaks).query(true)[0] if len(breaks) else np.full(len(true), np.inf)
            self.corners += far.tolist()
        away = (
            cKDTree(true).query(breaks)[0]
            if len(true) and len(breaks)
            else np.ones(len(breaks)) * 9
        )
        self.false.append(int((away > LOST).sum()))

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
            "false": f"{np.mean(self.false):.1f}",
            "points": f"{np.exp(np.mean(np.log(self.points))):.2f}",
            "RMS": f"{np.mean(self.rms):.3f}",
            "H": f"{np.median(self.farthest):.2f}, {max(self.farthest):.2f}",
            "exceeded": str(self.exceeded),
            "seconds": f"{self.seconds:.1f}",
        }


def _turn(before: Line | Arc | Cubic, after: Line | Arc | Cubic) -> float:
    """Degrees between an element and the next."""
    a, b = _direction(before, end=True), _direction(after, end=False)
    return float(np.degrees(np.arctan2(a[0] * b[1] - a[1] * b[0], a @ b)))


def _direction(element: Line | Arc | Cubic, *, end: bool) -> Array:
    if isinstance(element, Line):
        return element.end - element.begin
    if isinstance(element, Arc):
        angle = element.start + (element.sweep if end else 0.0)
        return np.array([-np.sin(angle), np.cos(angle)]) * np.sign(element.sweep)
    legs = np.diff(element.control, axis=0)
    legs = legs[np.hypot(*legs.T) > 1e-9]
    return legs[-1] if end else legs[0]


def _traced(fits: Sequence[ss.Fit]) -> tuple[Array, Array, Array]:
    """Dense points of all curves, the piece that each is of, and places of breaks."""
    curve, owner = [], []
    breaks: list[Array] = []
    count = 0
    for fit in fits:
        for piece in fit.sections:
            n = max(3, int(piece.polygon_length / STEP))
            t = np.linspace(0, 1, n)
            points = BSplineCurve(piece.knots, piece.control_points, piece.degree)(t)
            if piece.kind == "line":  # to the bit where its ends agree
                a, b = piece.control_points
                points = np.where(a == b, a, points)
            curve.append(points)
            owner.append(np.full(n, count))
            count += 1
        if not fit.sections:
            n = int(fit.length / STEP)
            curve.append(fit.spline(np.linspace(0, 1, n)))
            owner.append(np.full(n, count))
            count += 1
        for before, after in zip(fit.sections[-1:] + fit.sections[:-1], fit.sections, strict=True):
            if abs(np.degrees(turn_between(before, after))) > BREAK:
                breaks.append(after.control_points[0])
    return np.concatenate(curve), np.concatenate(owner), np.array(breaks).reshape(-1, 2)

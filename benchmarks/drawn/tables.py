"""The tables: sizes, renderers, tolerances, measured points, other tracers."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

import numpy as np

import shapespline as ss
from benchmarks.drawn.catalogue import drawings, names_of
from benchmarks.drawn.found import Found
from benchmarks.drawn.measure import Figures
from benchmarks.drawn.renderers import BITS, CUT, RENDERERS, MissingError
from benchmarks.drawn.tracers import CHARACTERS, PEERS, ours
from benchmarks.drawn.truth import filling, placed, sampled

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

    from benchmarks.drawn.renderers import Picture
    from benchmarks.drawn.truth import Outline

WITHIN = 0.35
SIZE, SIZES, TOLERANCES = 256, (128, 512), (None, WITHIN)
EXACT, JPEG, SCANNED = "exact coverage", "JPEG 90", "badly scanned"
# As drawn, of areas of the paper and two inks.
IN_COLOURS = "drawn, in colours"
# Plates that are sampled, noise in per cent and numbers of points.
PLATES = ("slot", "box rounded", "bracket", "star 5", "keyhole")
SAMPLINGS = tuple((noise, n) for noise in (0.02, 0.1, 0.5) for n in (200, 1000))
HEADS = {
    "straight": "straight %",
    "one piece": "one piece %",
    "worst bow": "worst bow",
    "direction": "direction, deg",
    "level": "level exactly %",
    "arcs": "arcs %",
    "unround": "circles: unround",
    "corners": "corners %",
    "lost": "lost %",
    "chamfered": "chamfered %",
    "false": "false",
    "hooks": "hooks",
    "spread": "equal: spread",
    "same": "equal: same pieces %",
    "points": "points",
    "RMS": "RMS",
    "H": "H median, worst",
    "outlines": "outlines lost, false",
    "exceeded": "exceeded",
    "seconds": "s",
}
# What plates and icons are to reach at 256 pixels, by the table's columns.
AIMS = {
    None: "95 90 . 0.02 90 90 0.02 92 3 2 0.5 0 0.08 90 1.05 0.04",
    0.35: "93 90 . 0.02 90 85 0.02 90 3 2 0.5 0 0.08 90 1.05 0.05",
}


@cache
def rendered(name: str, size: int, renderer: str = EXACT) -> tuple[list[Outline], Picture]:
    """Outlines in pixels, and their picture."""
    drawing = drawings()[name]
    outlines = placed(drawing.outlines, size, drawing.turn, seed=1)
    if renderer.startswith(CUT):
        outlines = filling(outlines, size)
    return outlines, RENDERERS[renderer](outlines, size)


@cache
def measured(
    name: str, size: int, tolerance: float | None, tracer: str, renderer: str = EXACT
) -> Figures:
    """What a tracer makes of one drawing."""
    outlines, image = rendered(name, size, renderer)
    found = Figures()
    if tracer in PEERS:
        traced = PEERS[tracer](image)
    elif tracer == IN_COLOURS:
        n_colors = 2 if renderer.startswith(CUT) else 3  # paper, ink, that of the disc beside
        traced, found.seconds = ours(image, tolerance, "drawn", colors=n_colors)
    else:
        traced, found.seconds = ours(image, tolerance, tracer)
    found.add(name, outlines, traced)
    return found


class Tables:
    """Markdown, table by table, and what was left out."""

    def __init__(self) -> None:
        self.texts: list[str] = []
        self.left_out: dict[str, None] = {}

    def add(
        self,
        title: str,
        rows: Sequence[tuple[str, list[str], float | None, str, str]],
        size: int,
        aims: str = "",
    ) -> None:
        """A table; its rows are a label, drawings, tolerance, tracer, renderer."""
        lines = [f"**{title}**", "", "| | " + " | ".join(HEADS.values()) + " |"]
        lines.append("|---" * (len(HEADS) + 1) + "|")
        if aims:
            shown = ["" if one == "." else f"*{one}*" for one in aims.split()]
            shown += [""] * (len(HEADS) - len(shown))
            lines.append("| *aim* | " + " | ".join(shown) + " |")
        for label, names, tolerance, tracer, renderer in rows:
            try:
                each = [measured(name, size, tolerance, tracer, renderer) for name in names]
            except MissingError as error:
                self.left_out[f"{error}."] = None
                continue
            row = Figures.together(each).row()
            lines.append(f"| {label} | " + " | ".join(row[key] for key in HEADS) + " |")
        self.texts.append("\n".join(lines) + "\n")


def pictures_tables() -> Tables:
    """At 256 pixels with all tracers and renderers; other sizes; words by themselves."""
    tables = Tables()
    both = ("plate", "icon")
    for tolerance in TOLERANCES:
        said = _said(tolerance)
        every = (*CHARACTERS, *(PEERS if tolerance is None else ()))
        rows = [(f"all: {one}", names_of(*both), tolerance, one, EXACT) for one in every]
        rows += [
            (f"{label}: drawn", names, tolerance, "drawn", EXACT)
            for label, names in (
                ("seen", names_of(*both, aside=False)),
                ("kept aside", names_of(*both, aside=True)),
                ("plates", names_of("plate")),
                ("icons", names_of("icon")),
            )
        ]
        tables.add(f"Plates and icons, {SIZE} pixels, {said}", rows, SIZE, AIMS[tolerance])
        for title, kind in (
            ("Words", "word"),
            ("Single letters", "letter"),
            ("Organic outlines", "organic"),
        ):
            few = every if kind == "word" else CHARACTERS
            rows = [(one, names_of(kind), tolerance, one, EXACT) for one in few]
            tables.add(f"{title}, {SIZE} pixels, {said}", rows, SIZE)
    rows = [(one, names_of(*both), None, "drawn", one) for one in RENDERERS]
    rows += [
        (f"{one}, in colours", names_of(*both), None, IN_COLOURS, one)
        for one in (f"{CUT}, tinted", "printed", "printed, badly scanned", "photographed")
    ]
    tables.add(f"Plates and icons, {SIZE} pixels, drawn, renderers", rows, SIZE)
    # Steps of one bit are half a pixel off.
    others = [one for one in RENDERERS if one != EXACT and BITS not in one]
    rows = [(one, names_of(*both), WITHIN, "drawn", one) for one in others]
    rows += [
        (f"words and letters, {one}", names_of("word", "letter"), WITHIN, "drawn", one)
        for one in (EXACT, JPEG, SCANNED)
    ]
    tables.add(f"Drawn, renderers, {SIZE} pixels, {_said(WITHIN)}", rows, SIZE)
    for size in SIZES:
        rows = [(_said(one), names_of(*both), one, "drawn", EXACT) for one in TOLERANCES]
        tables.add(f"Plates and icons, {size} pixels, drawn", rows, size)
    return tables


def _said(tolerance: float | None) -> str:
    return "no tolerance" if tolerance is None else f"within {tolerance} pixels"


def noisy_points(
    name: str, random: np.random.Generator
) -> Iterator[tuple[float, NDArray[np.float64], NDArray[np.float64], int]]:
    """Noise in per cent, points, the drawing's own dense points and pieces."""
    outline = rendered(name, SIZE)[0][0]
    dense = sampled(outline, 0.02)
    size = float(np.hypot(*np.ptp(dense, axis=0)))
    for noise, n in SAMPLINGS:
        points = ss.Contour(dense, closed=True).resampled(n).points
        yield noise, points + random.normal(0, 0.01 * noise * size, (n, 2)), dense, len(outline)


def recovered_table(draws: int = 10) -> str:
    """How often the fit has the drawing's lines and arcs and nothing else."""
    rows = {name: dict.fromkeys(SAMPLINGS, 0) for name in PLATES}
    for name, right in rows.items():
        own = sorted(type(one).__name__.lower() for one in rendered(name, SIZE)[0][0])
        for seed in range(draws):
            for noise, points, _, _ in noisy_points(name, np.random.default_rng(seed)):
                pieces = ss.fit_curve(points, closed=True).pieces
                kinds = sorted(piece.kind for piece in pieces)
                right[noise, len(points)] += kinds == own
    lines = [
        f"Right of {draws} | " + " | ".join(f"{noise} %, {n}" for noise, n in SAMPLINGS),
        "|".join(["---"] * (1 + len(SAMPLINGS))),
        *(f"{name} | " + " | ".join(map(str, right.values())) for name, right in rows.items()),
    ]
    return "".join(f"| {line} |\n" for line in lines)


def sampled_table() -> str:
    """Points with noise on plates, structure and distance to the truth."""
    from scipy.spatial import cKDTree

    lines = ["| | noise % | n | pieces of the drawing | fewest: pieces, H | drawn: pieces, H |"]
    lines.append("|---|---|---|---|---|---|")
    random = np.random.default_rng(5)
    for name in (*PLATES, "pebble"):
        for noise, points, dense, count in noisy_points(name, random):
            said = []
            for character in CHARACTERS:
                fit = ss.fit_curve(points, closed=True, character=character)
                curve = Found.of_fits([fit]).curve
                far = max(
                    cKDTree(dense).query(curve)[0].max(), cKDTree(curve).query(dense)[0].max()
                )
                kinds = [piece.kind for piece in fit.pieces]
                counts = (
                    f"{kinds.count('line')} L {kinds.count('arc')} A"
                    f" {len(kinds) - kinds.count('line') - kinds.count('arc')} C"
                )
                said.append(f"{counts}, {far:.2f}")
            lines.append(f"| {name} | {noise} | {len(points)} | {count} | {said[0]} | {said[1]} |")
    return "\n".join(lines) + "\n"

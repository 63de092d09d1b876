"""Line drawings of known strokes, drawn, traced as centre lines, and measured against the strokes.

    python -m benchmarks.center_lines              a line for each drawing
    python -m benchmarks.center_lines -o DIR       and what was found, on the pictures

Icons have what pens fill or hide: pointed corners, narrow rings, what is crossed out, arcs that
leave a line at no angle, dots.

Strokes of digits, capitals, circuits and icons, with round ends. Distances in pixels between
samples of both: root mean square and largest. Ends and junctions: the largest distance of a true
one to the nearest found. Missed: part of the true length farther than a pixel from all found;
false: the reverse. Width: largest error of the strokes' widths.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from PIL import Image, ImageDraw
from scipy.spatial import cKDTree

import shapespline as ss

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

    Array = NDArray[np.float64]

FINE, HEIGHT, WIDTH = 8, 120, 160
FAR = 1.0


class StrokeDrawing(NamedTuple):
    """Polylines (y down) that meet in shared points, and the width of the pen."""

    name: str
    lines: list[Array]
    width: float


def _arc(x: float, y: float, rx: float, ry: float, begin: float, end: float) -> Array:
    t = np.radians(np.linspace(begin, end, 181))
    return np.column_stack([x + rx * np.cos(t), y + ry * np.sin(t)])


def _rounded(left: float, top: float, right: float, bottom: float, radius: float) -> Array:
    """A closed rectangle with round corners."""
    places = ((right, top, -90), (right, bottom, 0), (left, bottom, 90), (left, top, 180))
    corners = [
        _arc(
            x + (radius if x == left else -radius), y + (radius if y == top else -radius),
            radius, radius, begin, begin + 90,
        )
        for x, y, begin in places
    ]  # fmt: skip
    return np.concatenate([*corners, corners[0][:1]])


def drawings() -> Iterator[StrokeDrawing]:
    """Letters, digits and circuits with pens of several widths."""
    motifs: dict[str, list[Array]] = {
        "T X": [np.array(line, dtype=float) for line in (
            [(20, 25), (70, 25)], [(45, 25), (45, 95)],
            [(90, 25), (145, 95)], [(145, 25), (90, 95)],
        )],
        "A H": [np.array(line, dtype=float) for line in (
            [(15, 100), (45, 20), (75, 100)], [(26.25, 70), (63.75, 70)],
            [(95, 20), (95, 100)], [(145, 20), (145, 100)], [(95, 60), (145, 60)],
        )],
        "8 3": [
            _arc(45, 40, 20, 20, 90, 450), _arc(45, 80, 25, 20, -90, 270),
            _arc(110, 40, 20, 20, 180, 450), _arc(110, 80, 25, 20, -90, 180),
        ],
        "P D": [
            np.array([(20, 100), (20, 20), (50, 20)], dtype=float),
            np.concatenate([_arc(50, 40, 20, 20, -90, 90), [(20, 60)]]),
            np.array([(95, 100), (95, 20), (115, 20)], dtype=float),
            np.concatenate([_arc(115, 60, 30, 40, -90, 90), [(95, 100)]]),
        ],
        "circuit": [np.array(line, dtype=float) for line in (
            [(10, 60), (40, 60)], [(40, 45), (80, 45), (80, 75), (40, 75), (40, 45)],
            [(80, 60), (110, 60)], [(110, 30), (110, 60)], [(110, 60), (110, 90)],
            [(95, 90), (125, 90)], [(110, 60), (150, 60)], [(95, 30), (125, 30)],
        )],
    }  # fmt: skip
    for name, lines in motifs.items():
        for width in (1.5, 2.0, 3.0, 5.0, 8.0, 12.0, 16.0):
            yield StrokeDrawing(name, lines, width)
    icons: dict[str, list[Array]] = {
        "N arrow": [
            np.array([(20, 100), (20, 30), (60, 100), (60, 30)], dtype=float),
            np.array([(95, 70), (115, 95), (135, 70)], dtype=float),
            np.array([(115, 95), (115, 25)], dtype=float),
        ],
        "crossed ring": [
            _arc(80, 60, 42, 42, 0, 360), np.array([(20, 15), (140, 105)], dtype=float),
            np.array([(38, 60), (122, 60)], dtype=float),
        ],
        "two frames": [
            _rounded(30, 15, 130, 60, 16), _rounded(30, 60, 130, 105, 16),
        ],
        "dots": [
            _rounded(15, 15, 145, 105, 20), _arc(80, 60, 11, 11, 0, 360),
            *(np.array([(x, 60), (x + 0.01, 60)]) for x in (45.0, 115.0)),
        ],
    }  # fmt: skip
    for name, lines in icons.items():
        for width in (5.0, 8.0, 12.0, 16.0):
            yield StrokeDrawing(name, lines, width)


def rendered(drawing: StrokeDrawing) -> NDArray[np.uint8]:
    """Black on white, round ends and corners; parts of pixels counted by 64 samples."""
    rows, columns = np.mgrid[: HEIGHT * FINE, : WIDTH * FINE]
    points = (np.column_stack([columns.ravel(), rows.ravel()]) + 0.5) / FINE
    off, _ = cKDTree(_samples(drawing.lines)).query(
        points, distance_upper_bound=0.5 * drawing.width
    )
    ink = np.isfinite(off).reshape(HEIGHT, FINE, WIDTH, FINE).mean(axis=(1, 3))
    return np.rint(255 * (1 - ink)).astype(np.uint8)


def _samples(lines: list[Array], step: float = 0.05) -> Array:
    return np.concatenate(
        [
            ss.Contour(line, closed=False).resampled(max(2, round(_length(line) / step))).points
            for line in lines
        ]
    )


def _length(line: Array) -> float:
    return float(np.hypot(*np.diff(line, axis=0).T).sum())


def _special(lines: list[Array]) -> Array:
    """Ends and junctions of the truth: where a line ends, but for corners and closed lines."""
    found = []
    for place in np.unique(np.concatenate([line[[0, -1]] for line in lines]), axis=0):
        ends = sum(int((line[k] == place).all()) for line in lines for k in (0, -1))
        through = sum(
            cKDTree(_samples([line])).query(place)[0] < FAR / 10
            and not (line[[0, -1]] == place).all(axis=1).any()
            for line in lines
        )
        if ends + 2 * through != 2:
            found.append(place)
    return np.array(found).reshape(-1, 2)


def measured(drawing: StrokeDrawing, shape: ss.Shape) -> tuple[float, ...]:
    """Rms, largest distance, ends and junctions, missed, false, width."""
    true = _samples(drawing.lines)
    found = _samples([contour.polyline * (1, -1) + (0, HEIGHT) for contour in shape])
    there, back = cKDTree(found).query(true)[0], cKDTree(true).query(found)[0]
    both = np.concatenate([there, back])
    special = _special(drawing.lines)
    own = [c.points[[0, -1]] * (1, -1) + (0, HEIGHT) for c in shape if not c.closed]
    ends = cKDTree(np.concatenate(own)).query(special)[0].max() if own and len(special) else 0.0
    long = [w for c, w in zip(shape, shape.widths, strict=True) if c.length > 2 * drawing.width]
    width = max((abs((w or 0.0) - drawing.width) for w in long), default=0.0)
    return (
        float(np.sqrt((both**2).mean())), float(both.max()), float(ends),
        float((there > FAR).mean()), float((back > FAR).mean()), width,
    )  # fmt: skip


def picture(drawing: StrokeDrawing, shape: ss.Shape, zoom: int = 6) -> Image.Image:
    """What was found, on the drawing, six times enlarged."""
    ground = Image.fromarray(255 - (255 - rendered(drawing)) // 3).convert("RGB")
    ground = ground.resize((zoom * WIDTH, zoom * HEIGHT), Image.Resampling.NEAREST)
    pen = ImageDraw.Draw(ground)
    for contour in shape:
        own = zoom * (contour.polyline * (1, -1) + (0, HEIGHT))
        pen.line([tuple(point) for point in own.tolist()], fill="#D55E00", width=2)
        for x, y in own[[0, -1]].tolist():
            pen.ellipse((x - 4, y - 4, x + 4, y + 4), outline="#0072B2", width=2)
    return ground


def _cells(row: Sequence[float]) -> str:
    """Figures of a line of the table."""
    rms, largest, ends, missed, false, width = row
    return (
        f"{rms:.3f} | {largest:.2f} | {ends:.2f} | {100 * missed:.1f} | {100 * false:.1f}"
        f" | {width:.2f}"
    )


def main() -> None:
    """Read the arguments and print."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("-o", "--output", type=Path, help="folder for pictures")
    chosen = parser.parse_args()
    if chosen.output is not None:
        chosen.output.mkdir(parents=True, exist_ok=True)
    print("| drawing | pen | strokes | rms | largest | ends and junctions | missed % | false %"
          " | width off |")  # fmt: skip
    print("|---|---|---|---|---|---|---|---|---|")
    rows = []
    for drawing in drawings():
        shape = ss.trace(rendered(drawing), centerline=True)
        row = measured(drawing, shape)
        rows.append(row)
        print(f"| {drawing.name} | {drawing.width:g} | {len(shape)} | {_cells(row)} |")
        if chosen.output is not None:
            name = f"{drawing.name.replace(' ', '')}_{drawing.width:g}.png"
            picture(drawing, shape).save(chosen.output / name)
    median, worst = np.median(rows, axis=0), np.max(rows, axis=0)
    for name, row in (("median", median), ("worst", worst)):
        print(f"| {name} | | | {_cells(row)} |")


if __name__ == "__main__":
    main()

"""Draws docs/figures/rooms.svg: the rooms of the package and the arrows between them.

The table is that of tests/architecture/test_rooms.py; a test compares the picture with it. Arrows
that follow from others are left out (transitive reduction).

python scripts/rooms_picture.py
"""

from __future__ import annotations

import ast
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TARGET = ROOT / "docs" / "figures" / "rooms.svg"
TABLE = ROOT / "tests" / "architecture" / "test_rooms.py"
SAYS = {
    "ground": ("errors, typing, units,", "validation, monitor"),
    "values": ("contours, curves, pieces,", "fits: immutable"),
    "geometry": ("distances, crossings,", "joining, biarcs"),
    "solvers": ("one loop, vectors only:", "Levenberg-Marquardt, BFGS"),
    "analysis": ("noise, corners, outliers,", "order and unit, thinning"),
    "tracing": ("picture to shape", ""),
    "streaming": ("points too many", "for memory"),
    "formats": ("one file and one line", "of the registry each"),
    "engines.drawn": ("lines, arcs, what", "a drawing repeats"),
    "engines.pieces": ("lines, Beziers, splines", "between nodes"),
    "engines.spline": ("one B-spline,", "knot removal"),
    "engines.least_squares": ("a given size,", "parameters free"),
    "plotting": ("pictures of fits", ""),
    "fitting": ("request, plan, solve,", "verify, choose, repair"),
    "paper": ("the published method", ""),
    "cli": ("commands", ""),
    "studio": ("local page: see, steer,", "take away"),
}
# Column and row of each room, the lowest row first: so that no arrow passes behind a room.
PLACES = {
    "ground": (1.0, 0),
    "solvers": (-0.1, 1),
    "values": (2.1, 1),
    "geometry": (2.1, 2),
    "analysis": (2.1, 3),
    "streaming": (0.95, 4),
    "formats": (3.9, 4),
    "tracing": (5.0, 4),
    "engines.least_squares": (0.0, 5),
    "engines.pieces": (1.0, 5),
    "engines.spline": (2.0, 5),
    "engines.drawn": (3.0, 5),
    "plotting": (4.0, 5),
    "fitting": (1.6, 6),
    "paper": (2.4, 7),
    "cli": (2.9, 8),
    "studio": (1.9, 8),
}
COLORS = ("#EDEDED", "#E8F1FA", "#E3F3EC", "#E3F3EC", "#FFF4DC", "#FBE6DA", "#F6E3F0")
WIDTH, HEIGHT, ACROSS, DOWN, MARGIN = 176, 62, 216, 104, 20


def table() -> dict[str, set[str]]:
    """What each room may import, the files of the ground as one room."""
    tree = ast.parse(TABLE.read_text("utf-8"))
    names: dict[str, object] = {}
    for node in tree.body:
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            name = node.targets[0].id
            if name in {"GROUND", "ENGINES", "MAY_IMPORT"}:
                code = compile(ast.Expression(node.value), str(TABLE), "eval")
                names[name] = eval(code, {}, names)
    ground, arrows = names["GROUND"], names["MAY_IMPORT"]
    return {
        room: {"ground" if name in ground else name for name in allowed} - {""}
        for room, allowed in arrows.items()
    } | {"ground": set()}


def reduced(arrows: dict[str, set[str]]) -> list[tuple[str, str]]:
    """The arrows that do not follow from others."""

    def below(room: str) -> set[str]:
        return arrows[room].union(*(below(other) for other in arrows[room]))

    return sorted(
        (room, other)
        for room, others in arrows.items()
        for other in others
        if not any(other in below(third) for third in others - {other})
    )


def picture(arrows: dict[str, set[str]]) -> str:
    """The SVG, the same bytes for the same table."""
    columns = [column for column, _ in PLACES.values()]
    rows = 1 + max(row for _, row in PLACES.values())
    width = round(MARGIN * 2 + ACROSS * (max(columns) - min(columns)) + WIDTH)
    height = MARGIN * 2 + DOWN * (rows - 1) + HEIGHT
    places = {
        room: (
            MARGIN + 0.5 * WIDTH + ACROSS * (column - min(columns)),
            height - MARGIN - 0.5 * HEIGHT - DOWN * row,
            row,
        )
        for room, (column, row) in PLACES.items()
    }
    assert places.keys() == arrows.keys(), f"place these rooms: {places.keys() ^ arrows.keys()}"
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}"'
        f' width="{width}" height="{height}" font-family="DejaVu Sans, Arial, sans-serif">',
        '<marker id="tip" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7"'
        ' orient="auto"><path d="M0 0 8 4 0 8z" fill="#666666"/></marker>',
        f'<rect width="{width}" height="{height}" fill="#FFFFFF"/>',
    ]
    for room, other in reduced(arrows):
        (x, y, rank), (u, v, lower) = places[room], places[other]
        assert lower < rank, f"{room} imports {other}, which stands higher"
        # Arrows leave and arrive apart.
        shift = max(-60.0, min(60.0, 0.25 * (u - x)))
        y, v = y + 0.5 * HEIGHT, v - 0.5 * HEIGHT
        x, u = x + shift, u - shift
        bend = 0.5 * (v - y)
        out.append(
            f'<path d="M{x:.0f} {y:.0f}C{x:.0f} {y + bend:.0f} {u:.0f} {v - bend:.0f}'
            f' {u:.0f} {v:.0f}" fill="none" stroke="#666666" stroke-width="1.3"'
            ' marker-end="url(#tip)"/>'
        )
    for room, (x, y, rank) in places.items():
        color = COLORS[min(rank, len(COLORS) - 1)]
        first, second = SAYS[room]
        lines = [line for line in (first, second) if line]
        top = y - 7 * len(lines) + 3
        out += [
            f'<rect x="{x - 0.5 * WIDTH:.0f}" y="{y - 0.5 * HEIGHT:.0f}" width="{WIDTH}"'
            f' height="{HEIGHT}" rx="7" fill="{color}" stroke="#666666"/>',
            f'<text x="{x:.0f}" y="{top:.0f}" font-size="13" font-weight="bold"'
            f' text-anchor="middle">{room}</text>',
        ]
        out += [
            f'<text x="{x:.0f}" y="{top + 16 + 14 * i:.0f}" font-size="11.5" fill="#444444"'
            f' text-anchor="middle">{line}</text>'
            for i, line in enumerate(lines)
        ]
    return "\n".join([*out, "</svg>", ""])


if __name__ == "__main__":
    TARGET.write_text(picture(table()), "utf-8")
    print(f"{TARGET.relative_to(ROOT)}: {len(reduced(table()))} arrows")

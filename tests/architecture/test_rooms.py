"""The rooms and the arrows between them, read from the sources."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from tests.support.each import each
from tests.support.places import ROOT

if TYPE_CHECKING:
    from pathlib import Path

PACKAGE = ROOT / "src" / "shapespline"

GROUND = {"errors", "typing", "units", "validation", "monitor", "_kernels", "_version"}
ENGINES = {"engines.drawn", "engines.pieces", "engines.spline", "engines.least_squares"}
# A room -> the rooms that it may import. A room is imported by its own name, never past it.
MAY_IMPORT = {
    "values": GROUND,
    "geometry": GROUND | {"values"},
    "solvers": {"errors", "typing", "monitor"},
    "analysis": GROUND | {"values", "geometry"},
    "tracing": GROUND | {"values", "geometry", "analysis"},
    "streaming": GROUND | {"values", "geometry", "analysis"},
    "formats": GROUND | {"values", "geometry", "analysis"},
    "engines.drawn": GROUND | {"values", "geometry", "analysis"},
    "engines.pieces": GROUND | {"values", "geometry", "analysis"},
    "engines.spline": GROUND | {"values", "geometry", "analysis"},
    "engines.least_squares": GROUND | {"values", "geometry", "analysis", "streaming", "solvers"},
    "plotting": GROUND | {"values", "geometry", "formats"},
    "fitting": GROUND | ENGINES | {"values", "geometry", "analysis", "streaming", "solvers"},
    "paper": GROUND
    | ENGINES
    | {"values", "geometry", "analysis", "solvers", "formats", "plotting", "fitting"},
    # The command that starts the studio asks the face for it: the two never import each other.
    "cli": GROUND
    | {"", "values", "geometry", "analysis", "tracing", "formats", "plotting", "fitting", "paper"},
    "studio": GROUND | {"values", "geometry", "analysis", "formats", "fitting", "paper"},
}
# Single arrows beside the table: file -> room.
ALSO = {("formats/image.py", "tracing"), ("__main__.py", "cli"), ("__main__.py", "_version")}
# Methods that people expect on a value: file -> method -> the public name of a higher room that it
# calls inside its body.
EXPECTED_METHODS = {
    "values/drawing.py": {
        "Drawing.bounds": ("geometry", "bounds"),
        "Drawing.contains": ("geometry", "contains"),
        "Drawing.offset": ("fitting", "offset_drawing"),
        "Drawing.plot": ("plotting", "plot_on_axes"),
        "Drawing.transformed": ("geometry", "transformed_drawing"),
    },
    "values/fit.py": {"Fit.band": ("geometry", "confidence_band")},
    "values/fit_methods.py": {
        "FitMethods.area": ("geometry", "enclosed_area"),
        "FitMethods.source_distance": ("geometry", "two_sided_distance"),
        "FitMethods.bounds": ("geometry", "bounds"),
        "FitMethods.contains": ("geometry", "contains"),
        "FitMethods.points": ("geometry", "evenly_spaced"),
        "FitMethods.offset": ("fitting", "offset_drawing"),
        "FitMethods.plot": ("plotting", "plot_on_axes"),
        "FitMethods.transformed": ("geometry", "transformed_fit"),
        "FitMethods.reversed": ("geometry", "reversed_fit"),
        "FitMethods.split": ("geometry", "split_fit"),
    },
    "values/exchanged.py": {
        "Exchanged.__geo_interface__": ("formats", "geometry_of"),
        "Exchanged.to_shapely": ("formats", "shapely_geometry"),
        "Exchanged.to_geopandas": ("formats", "geopandas_series"),
        "Exchanged.draw": ("formats", "draw_with_pen"),
    },
    "values/shown.py": {
        "Shown._repr_svg_": ("formats", "svg_preview"),
        "Shown._repr_html_": ("formats", "html_preview"),
    },
}
# What such methods return, named in their signatures.
EXPECTED_TYPES = {
    "values/drawing.py": {("geometry", "Box")},
    "values/fit_methods.py": {("geometry", "Box")},
}
SOURCES = sorted(PACKAGE.rglob("*.py"))


def room_of(module: str) -> str:
    """The room of a dotted name below the package; a file at the top is a room of its own."""
    parts = module.split(".")
    return ".".join(parts[: 2 if parts[0] == "engines" else 1])


def climbing(path: Path) -> dict[str, tuple[str, str]]:
    """Method -> (room, name) of what methods of a value import inside their bodies."""
    return {
        f"{holder.name}.{method.name}": (
            (node.module or "").removeprefix("shapespline").lstrip("."),
            ", ".join(alias.name for alias in node.names),
        )
        for holder in ast.parse(path.read_text(encoding="utf-8")).body
        if isinstance(holder, ast.ClassDef)
        for method in holder.body
        if isinstance(method, ast.FunctionDef)
        for node in ast.walk(method)
        if isinstance(node, ast.ImportFrom)
        and (node.module or "").startswith("shapespline")
        and room_of((node.module or "").removeprefix("shapespline").lstrip(".")) != "values"
    }


def arrows(path: Path) -> list[tuple[str, str]]:
    """(module, name) of every import of this package in a file, at load, call or typing time."""
    found = []
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found += [(alias.name, "") for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path.name}: write absolute imports"
            found += [(node.module or "", alias.name) for alias in node.names]
    return [
        (module.removeprefix("shapespline").lstrip("."), name)
        for module, name in found
        if module.split(".")[0] == "shapespline"
    ]


@each(SOURCES)
def test_arrows_run_down_the_table_and_stop_at_the_door(path):
    where = path.relative_to(PACKAGE).as_posix()
    here = room_of(where.removesuffix(".py").removesuffix("/__init__").replace("/", "."))
    expected = set(EXPECTED_METHODS.get(where, {}).values()) | EXPECTED_TYPES.get(where, set())
    for module, name in arrows(path):
        if (module, name) in expected:
            continue  # the next test looks at these
        if module == "" and name in GROUND:
            module = name
        there = room_of(module)
        if here in GROUND | {"__init__", "engines"}:
            assert there in GROUND or here == "__init__", f"{where} imports {module}"
        elif there != here and (where, there) not in ALSO:
            assert there in MAY_IMPORT[here], f"{where} imports {module}"
            assert module == there, f"{where} reaches past the door of {there}: {module}"


@each(sorted(path.name for path in (PACKAGE / "values").glob("*.py")))
def test_methods_of_values_that_climb_are_the_expected_ones(where):
    where = f"values/{where}"
    assert climbing(PACKAGE / where) == EXPECTED_METHODS.get(where, {})


@each(sorted(MAY_IMPORT))
def test_a_room_names_what_it_offers(room):
    tree = ast.parse((PACKAGE / room.replace(".", "/") / "__init__.py").read_text("utf-8"))
    offered = [
        ast.literal_eval(node.value)
        for node in tree.body
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__"
    ]
    assert len(offered) == 1
    assert not [name for name in offered[0] if name.startswith("_")]


def test_the_house_has_few_rooms():
    top = [path for path in PACKAGE.iterdir() if path.suffix != ".so" and path.name[0] != "."]
    folders = [path for path in top if path.is_dir() and path.name != "__pycache__"]
    assert len(folders) <= 14
    assert len(top) - len([p for p in top if p.is_dir()]) <= 10

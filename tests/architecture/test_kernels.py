"""The kernels: who may include whom, the namespaces, and how wide their border is."""

from __future__ import annotations

import ast
import re
from typing import TYPE_CHECKING

from tests.support.each import each
from tests.support.places import ROOT

if TYPE_CHECKING:
    from pathlib import Path

KERNELS = ROOT / "kernels"
STUB = ROOT / "src" / "shapespline" / "_kernels.pyi"
INCLUDE = KERNELS / "include"
FOLDERS = INCLUDE / "shapespline"
GROUND = ("base", "curve", "distance")
# Each folder may include itself and these; the rooms on the ground never each other.
MAY_INCLUDE = {
    "base": (),
    "curve": ("base",),
    "distance": ("base", "curve"),
    "analysis": GROUND,
    "drawn": GROUND,
    "least_squares": GROUND,
    "pieces": GROUND,
    "spline": GROUND,
}
HEADERS = sorted(FOLDERS.rglob("*.hpp"))


def included(path: Path) -> list[str]:
    return re.findall(r'^#include "(.+)"', path.read_text(encoding="utf-8"), re.MULTILINE)


def forbidden(folder: str, includes: list[str]) -> list[str]:
    allowed = {folder, *MAY_INCLUDE[folder]}
    return [name for name in includes if name.split("/")[1] not in allowed]


def test_the_table_names_the_folders():
    assert {path.name for path in FOLDERS.iterdir()} == set(MAY_INCLUDE)
    assert forbidden("curve", ["shapespline/base/vec2.hpp", "shapespline/spline/state.hpp"]) == [
        "shapespline/spline/state.hpp"
    ]


@each(HEADERS)
def test_arrows_run_one_way(path):
    includes = included(path)
    assert all((INCLUDE / name).is_file() for name in includes)
    assert not forbidden(path.parent.name, includes)


@each(HEADERS)
def test_the_namespace_is_that_of_the_folder(path):
    folder = path.parent.name
    wanted = "shapespline" if folder in GROUND else f"shapespline::{folder}"
    opened = re.findall(r"^namespace ([\w:]+) \{", path.read_text(encoding="utf-8"), re.MULTILINE)
    assert opened == [wanted]


def test_no_header_includes_itself_by_a_detour():
    arrows = {path.relative_to(INCLUDE).as_posix(): included(path) for path in HEADERS}
    while free := [name for name, to in arrows.items() if not set(to) & set(arrows)]:
        for name in free:
            del arrows[name]
    assert not arrows


def test_only_the_bindings_know_nanobind():
    for path in KERNELS.rglob("*.[ch]pp"):
        if "nanobind" in path.read_text(encoding="utf-8"):
            assert path.parent.name == "bindings", path.name


def test_nothing_crosses_the_border_with_more_than_eight_arguments():
    functions = [
        node
        for node in ast.walk(ast.parse(STUB.read_text(encoding="utf-8")))
        if isinstance(node, ast.FunctionDef)
    ]
    assert len(functions) > 30
    for function in functions:
        arguments = [*function.args.posonlyargs, *function.args.args, *function.args.kwonlyargs]
        names = [argument.arg for argument in arguments if argument.arg != "self"]
        assert len(names) <= 8, f"{function.name}: {', '.join(names)}"
        assert function.args.vararg is None
        assert function.args.kwarg is None

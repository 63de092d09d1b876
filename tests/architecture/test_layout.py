"""The tests lie where the code lies that they test."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.support.each import each
from tests.support.places import ROOT

if TYPE_CHECKING:
    from pathlib import Path

PACKAGE = ROOT / "src" / "shapespline"
UNIT = ROOT / "tests" / "unit"


@each(sorted(UNIT.rglob("test_*.py")))
def test_a_unit_test_is_named_after_the_module_it_tests(path: Path):
    room = PACKAGE / path.parent.relative_to(UNIT)
    modules = {module.stem for module in room.glob("*.py")}
    name = path.stem.removeprefix("test_")
    assert any(name == module or name.startswith(f"{module}_") for module in modules)

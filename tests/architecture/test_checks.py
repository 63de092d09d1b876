"""The outside checker is outside: it knows numbers, and nothing of the package."""

from __future__ import annotations

import ast
import sys

from tests.support.places import ROOT

SOURCES = sorted((ROOT / "checks").glob("*.py"))


def test_the_checker_shares_nothing_with_the_package():
    known = {"checks", "numpy", "scipy", *sys.stdlib_module_names}
    assert len(SOURCES) > 3
    for path in SOURCES:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom):
                assert node.level == 0
                imported = [node.module]
            elif isinstance(node, ast.Import):
                imported = [alias.name for alias in node.names]
            else:
                continue
            assert {name.split(".")[0] for name in imported} <= known, path.name

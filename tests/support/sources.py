"""The package's sources, and what they import when."""

from __future__ import annotations

import ast
from functools import cache

from tests.support.places import ROOT

PACKAGE = ROOT / "src" / "shapespline"
SOURCES = sorted(PACKAGE.rglob("*.py"))


def module_name(path):
    """Dotted name below the package, '' for the package itself."""
    parts = path.relative_to(PACKAGE).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


MODULES = {module_name(path): path for path in SOURCES}


class Imports(ast.NodeVisitor):
    """Every import of a file: (module, name or None, when): 'load', 'call' or 'types'."""

    def __init__(self):
        self.found = []
        self.when = "load"

    def _within(self, when, nodes):
        before, self.when = self.when, when if self.when != "types" else "types"
        for node in nodes:
            self.visit(node)
        self.when = before

    def generic_visit(self, node):
        # No import is inside an expression, which are most of a file.
        if not isinstance(node, ast.expr):
            super().generic_visit(node)

    def visit_FunctionDef(self, node):
        self._within("call", node.body)

    def visit_AsyncFunctionDef(self, node):
        self._within("call", node.body)

    def visit_If(self, node):
        name = node.test.id if isinstance(node.test, ast.Name) else None
        self._within("types" if name == "TYPE_CHECKING" else self.when, node.body)
        self._within(self.when, node.orelse)

    def visit_Import(self, node):
        self.found += [(alias.name, None, self.when) for alias in node.names]

    def visit_ImportFrom(self, node):
        assert node.level == 0, "write absolute imports"
        self.found += [(node.module, alias.name, self.when) for alias in node.names]


@cache
def text_of(path):
    return path.read_text(encoding="utf-8")


@cache
def tree_of(path):
    return ast.parse(text_of(path))


@cache
def imports(path):
    visitor = Imports()
    visitor.visit(tree_of(path))
    return visitor.found

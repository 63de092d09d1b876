"""No module is loaded before it is ready: imports at load time run in no circle."""

from __future__ import annotations

from tests.support.sources import MODULES, imports


def arrows():
    """Module -> modules of the package that it imports while it is loaded."""
    found = {}
    for name, path in MODULES.items():
        found[name] = set()
        for module, imported, when in imports(path):
            if when != "load" or module.split(".")[0] != "shapespline":
                continue
            there = module.removeprefix("shapespline").lstrip(".")
            inner = f"{there}.{imported}".lstrip(".")
            found[name].add(inner if inner in MODULES else there)
    return found


def circles(graph):
    """Sets of nodes that reach each other, and nodes that reach themselves."""
    reached = {}
    for start in graph:
        seen, ahead = set(), list(graph[start])
        while ahead:
            node = ahead.pop()
            if node not in seen:
                seen.add(node)
                ahead += graph.get(node, ())
        reached[start] = seen
    return {frozenset(b for b in reached[a] if a in reached.get(b, ())) for a in graph} - {
        frozenset()
    }


def test_circles_by_hand():
    graph = {"a": {"b"}, "b": {"c"}, "c": {"b", "d"}, "d": set(), "e": {"e"}}
    assert circles(graph) == {frozenset("bc"), frozenset("e")}


def test_loading_runs_in_no_circle():
    graph = arrows()
    assert sum(map(len, graph.values())) > 100
    assert circles(graph) == set()

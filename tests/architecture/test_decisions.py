"""Constants and the decisions that explain them name each other."""

from __future__ import annotations

import re
from itertools import pairwise
from typing import TYPE_CHECKING

from tests.support.each import each
from tests.support.places import ROOT

if TYPE_CHECKING:
    from pathlib import Path

PAGES = ROOT / "docs" / "decisions"
PREFIXES = [
    "ANA",
    "DRA",
    "FIT",
    "FMT",
    "GEO",
    "KER",
    "LSQ",
    "PAP",
    "PIE",
    "PKG",
    "SPL",
    "STR",
    "STU",
    "TRC",
    "VAL",
]
ID = re.compile(rf"\b(?:{'|'.join(PREFIXES)})-\d\d\b")
HEAD = re.compile(r"^## (\S+) ", re.MULTILINE)
CONSTANTS = re.compile(r"^Constants: (.*?)$(?=\n\n|\n?\Z)", re.MULTILINE | re.DOTALL)
SOURCES = sorted(
    path
    for folder in ("src", "kernels", "tests", "benchmarks", "scripts")
    for path in (ROOT / folder).rglob("*")
    if path.suffix in {".py", ".pyi", ".hpp", ".cpp"}
)


def decisions() -> dict[str, str]:
    """Text of every decision by its ID."""
    found: dict[str, str] = {}
    for page in sorted(PAGES.glob("*.md")):
        for part in page.read_text("utf-8").split("\n## ")[1:]:
            ident = part.split()[0]
            assert ident not in found, f"{ident} is given twice"
            found[ident] = part
    return found


DECISIONS = decisions()
EXPLAINED = [
    (ident, name, where)
    for ident, text in DECISIONS.items()
    for block in CONSTANTS.findall(text)
    for name, where in re.findall(r"`(\w+)` in `([^`]+)`", block)
]


def file_of(where: str) -> Path:
    """A Python file counts from the package, a header from the kernels' include folder."""
    if where.endswith(".py"):
        return ROOT / "src" / "shapespline" / where
    return ROOT / "kernels" / "include" / "shapespline" / where


def comment_of(name: str, path: Path) -> str:
    """What the lines around the definition of a constant say.

    The comment beside it, and that above it; constants in a row share the comment above the first.
    """
    mark = "#" if path.suffix == ".py" else "//"
    lines = path.read_text("utf-8").splitlines()
    start = r"^(\w+, )*" if path.suffix == ".py" else r"\bconstexpr\b.*\b"
    defined = re.compile(rf"{start}{name}\b(?!\.)[^=({{]*[={{]")
    at = next((i for i, line in enumerate(lines) if defined.search(line)), None)
    assert at is not None, f"{path.name} defines no {name}"
    said = [lines[at].partition(mark)[2]]
    above = at - 1
    while above >= 0 and lines[above].strip() and not lines[above].lstrip().startswith(mark):
        above -= 1
    while above >= 0 and lines[above].lstrip().startswith(mark):
        said.append(lines[above])
        above -= 1
    return "\n".join(said)


def test_every_page_is_in_the_index_with_its_prefix():
    index = (PAGES / "README.md").read_text("utf-8")
    for page in sorted(PAGES.glob("*.md")):
        if page.name == "README.md":
            continue
        found = {ident.partition("-")[0] for ident in HEAD.findall(page.read_text("utf-8"))}
        (prefix,) = found
        assert f"({page.name}) | {prefix} |" in index
    assert sorted({ident.partition("-")[0] for ident in DECISIONS}) == PREFIXES


def test_ids_of_a_page_count_up_without_gaps():
    for prefix in PREFIXES:
        numbers = [int(ident[4:]) for ident in DECISIONS if ident.startswith(prefix)]
        assert numbers == list(range(1, len(numbers) + 1)), prefix


def test_every_id_that_is_cited_exists():
    texts = [*SOURCES, *(ROOT / "docs").rglob("*.md"), ROOT / "README.md", ROOT / "CONTRIBUTING.md"]
    unknown = {
        (path.name, ident)
        for path in texts
        for ident in ID.findall(path.read_text("utf-8"))
        if ident not in DECISIONS
    }
    assert not unknown


def test_some_constants_are_explained():
    assert len(EXPLAINED) > 25


@each(EXPLAINED)
def test_an_explained_constant_cites_its_decision(ident, name, where):
    assert ident in comment_of(name, file_of(where)), f"{name} in {where} does not cite {ident}"


def cited_by_constants(path: Path) -> set[str]:
    """IDs in the line above the definition of a constant."""
    lines = path.read_text("utf-8").splitlines()
    constant = re.compile(r"[A-Z_]+\b.*=|.*constexpr \w+ k[A-Z]")
    above = [before for before, line in pairwise(lines) if constant.match(line)]
    return {ident for line in above for ident in ID.findall(line)}


@each(["src", "kernels"])
def test_the_decision_that_a_constant_cites_names_the_file(folder):
    named = {(ident, file_of(where)) for ident, _, where in EXPLAINED}
    for path in SOURCES:
        if path.is_relative_to(ROOT / folder):
            assert {(ident, path) for ident in cited_by_constants(path)} <= named

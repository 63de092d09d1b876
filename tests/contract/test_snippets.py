"""Every snippet of README and documentation runs, page by page, as a reader would run it."""

from __future__ import annotations

import re
import shlex
import shutil
import warnings
from typing import TYPE_CHECKING

import matplotlib as mpl
import pytest
from tests.support.desk import laid_out
from tests.support.places import ROOT

# Every snippet is a run of its own.
pytestmark = pytest.mark.slow

if TYPE_CHECKING:
    from pathlib import Path

PAGES = sorted(
    [
        ROOT / "README.md",
        *(
            path
            for folder in (".", "tutorial", "howto", "coming-from", "reference")
            for path in (ROOT / "docs" / folder).glob("*.md")
        ),
    ]
)
# What needs another program, a cluster, or minutes, or waits for somebody, is not run.
ELSEWHERE = re.compile(
    r"\||tcp://|--(?:install|show)-completion|^pip |^make |^python -m benchmarks"
    r"|^shapespline (?:paper|studio)"
)
# A curve that keeps less than it was asked for is no failure of a page, but a failed call is.
GOOD = (0,)


def snippets(text: str) -> list[tuple[str, str]]:
    """(language, code) of every snippet: fences, indented commands, commands in tables."""
    found = []
    fence = re.compile(r"^```(\w+)\n(.*?)^```", re.MULTILINE | re.DOTALL)
    for match in fence.finditer(text):
        if match[1] == "python":
            found.append((match.start(), "python", match[2]))
        elif match[1] == "bash":
            lines = enumerate(match[2].splitlines(), start=match.start())
            found += [(place, "shell", line) for place, line in lines if line]
    for match in re.finditer(r"^    ((?:shapespline|cp) [^\n]*)", text, re.MULTILINE):
        found.append((match.start(), "shell", match[1]))
    for match in re.finditer(r"^\|.*`(shapespline [^`]*)` \|$", text, re.MULTILINE):
        found.append((match.start(), "shell", match[1]))
    return [(language, code) for _, language, code in sorted(found)]


def is_run(language: str, code: str) -> bool:
    return language == "python" or not ELSEWHERE.search(code)


WITH_SNIPPETS = [
    page
    for page in PAGES
    if any(is_run(*snippet) for snippet in snippets(page.read_text(encoding="utf-8")))
]


def test_the_three_kinds_are_found():
    text = (
        "Text.\n\n    shapespline fit a.csv\n\n```python\nx = 1\n```\n\n"
        "| a | `shapespline info b` |\n\n```bash\ncp b c\ncp a b\n```\n"
    )
    assert snippets(text) == [
        ("shell", "shapespline fit a.csv"),
        ("python", "x = 1\n"),
        ("shell", "shapespline info b"),
        ("shell", "cp b c"),
        ("shell", "cp a b"),
    ]
    assert len(WITH_SNIPPETS) >= 16


@pytest.mark.parametrize("page", WITH_SNIPPETS, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_snippets_run(page, tmp_path, monkeypatch, shapespline):
    monkeypatch.chdir(laid_out(tmp_path))
    monkeypatch.setattr(mpl, "rcParams", mpl.rcParams.copy())
    mpl.use("agg")
    names: dict[str, object] = {}
    for language, code in snippets(page.read_text(encoding="utf-8")):
        if not is_run(language, code):
            continue
        if language == "python":
            exec(compile(code, page.name, "exec"), names)
        else:
            run_line(code, shapespline)


def run_line(line: str, shapespline) -> None:
    """Run one line of a shell: the program itself, or a copy."""
    command, *arguments = shlex.split(line.partition("  #")[0])
    if command == "cp":
        shutil.copy(*arguments)
        return
    assert command == "shapespline", line
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        code, _, err = shapespline(*arguments)
    assert code in GOOD, f"{line}: {err}"


def files_of(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir()}


def test_the_first_command_writes_beside_its_input(tmp_path, monkeypatch, shapespline):
    monkeypatch.chdir(laid_out(tmp_path))
    before = files_of(tmp_path)
    assert shapespline("fit", "logo.png")[0] == 0
    assert files_of(tmp_path) - before == {"logo.svg"}

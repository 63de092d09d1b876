"""What docs name exists: files, links, the first file of each room; the picture is up to date."""

from __future__ import annotations

import re
from runpy import run_path

from tests.support.each import each
from tests.support.places import ROOT

PACKAGE = ROOT / "src" / "shapespline"
PAGES = sorted(
    [
        *(ROOT / "docs").rglob("*.md"),
        *PACKAGE.rglob("README.md"),
        ROOT / "README.md",
        ROOT / "CONTRIBUTING.md",
    ]
)
# A room with more files than this says in a README which to read first.
FEW_FILES = 5
# Pages about the code as it is; others may tell of what was.
ABOUT_CODE = [
    *sorted((ROOT / "docs" / "engines").glob("*.md")),
    ROOT / "docs" / "architecture.md",
    ROOT / "docs" / "glossary.md",
    *sorted(PACKAGE.rglob("README.md")),
]
NAMES = {
    path.name
    for folder in ("src", "kernels", "tests", "benchmarks", "checks")
    for path in (ROOT / folder).rglob("*.*pp" if folder == "kernels" else "*.py")
}


@each(PAGES)
def test_links_lead_somewhere(page):
    links = re.findall(r"\]\(([^)#\s]+)(?:#[^)]*)?\)", page.read_text("utf-8"))
    for link in links:
        if "://" not in link:
            assert (page.parent / link).exists(), link


@each(ABOUT_CODE)
def test_files_that_are_named_exist(page):
    # `a/b.py` counts from the package, `b.py` and `b.hpp` may lie anywhere.
    for name in re.findall(r"`([\w/]+\.(?:py|hpp))`", page.read_text("utf-8")):
        if "/" not in name:
            assert name in NAMES, name
        else:
            places = (
                page.parent / name,
                PACKAGE / name,
                ROOT / name,
                ROOT / "kernels" / "include" / "shapespline" / name,
            )
            assert any(place.exists() for place in places), name


@each(sorted((ROOT / "docs" / "engines").glob("*.md")))
def test_formulas_in_the_text_stand_on_one_line(page):
    # A formula that a line break cuts is shown as its source.
    text = re.sub(r"\$\$.*?\$\$", "", page.read_text("utf-8"), flags=re.DOTALL)
    assert not [line for line in text.splitlines() if line.count("$") % 2]


WORDS = {
    word
    for folder in ("src", "kernels", "tests", "benchmarks", "checks")
    for path in (ROOT / folder).rglob("*")
    if path.suffix in {".py", ".pyi", ".hpp", ".cpp"}
    for word in re.findall(r"\w+", path.read_text("utf-8"))
}


@each(ABOUT_CODE)
def test_names_of_code_exist(page):
    # `Class.method`, `Class::method`, `a_name(...)`: the last part is a word of some source.
    text = re.sub(r"(?m)^(    .*|!\[.*)$", "", page.read_text("utf-8"))
    for name in re.findall(r"`((?:\w+(?:\.|::))*\w+)(?:\([^`]*\))?`", text):
        if not name.endswith((".py", ".hpp", ".cpp", ".md")):
            assert re.split(r"\.|::", name)[-1] in WORDS, name


@each(
    [
        folder
        for folder in sorted(PACKAGE.rglob("*"))
        if folder.is_dir()
        and len([path for path in folder.glob("*.py") if path.name != "__init__.py"]) > FEW_FILES
    ]
)
def test_a_large_room_has_a_readme_that_names_its_files(room):
    named = re.findall(r"`([\w/]+)(?:\.py)?`", (room / "README.md").read_text("utf-8"))
    assert any((room / f"{name}.py").exists() for name in named)


def test_the_picture_of_the_rooms_is_that_of_the_table():
    drawn = run_path(str(ROOT / "scripts" / "rooms_picture.py"))
    text = drawn["picture"](drawn["table"]())
    assert drawn["TARGET"].read_text("utf-8") == text, "run python scripts/rooms_picture.py"

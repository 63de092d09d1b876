"""README and the site are whole: every name, option and page is there; shapes are our own."""

from __future__ import annotations

import re

from tests.support.each import each
from tests.support.places import DATA, ROOT

import shapespline as ss
from shapespline.fitting import Settings

DOCS = ROOT / "docs"
GALLERY = sorted((DOCS / "gallery").glob("[0-9]*.py"))
SECTIONS = [page.parent for page in sorted(DOCS.glob("*/README.md"))]


def test_readme_is_one_screen_and_a_half():
    assert len((ROOT / "README.md").read_text("utf-8").splitlines()) <= 110


def test_the_reference_names_every_public_name_once():
    page = (DOCS / "reference" / "python.md").read_text("utf-8")
    named = re.findall(r"^   ([A-Za-z]\w+)$", page, re.MULTILINE)
    assert sorted(named) == sorted(set(ss.__all__) - {"__version__"})


def test_the_table_of_options_names_every_setting():
    page = (DOCS / "reference" / "options.md").read_text("utf-8")
    for name in Settings.__dataclass_fields__:
        assert f"`{name}`" in page or f"`{name}=`" in page, name


def test_the_page_of_statuses_names_all_and_every_error():
    page = (DOCS / "reference" / "statuses.md").read_text("utf-8")
    for name in ("KEPT", "EXCEEDED", "BUDGET", "CANCELLED"):
        assert f"| `{name}` |" in page
    for name in ss.__all__:
        if name.endswith(("Error", "Warning")):
            assert f"`{name}`" in page, name


@each(SECTIONS)
def test_the_first_page_of_a_section_leads_to_all_of_it(section):
    # The site takes its contents from these links (docs/conf.py).
    linked = set(re.findall(r"\]\(([\w-]+\.md)", (section / "README.md").read_text("utf-8")))
    assert {page.name for page in section.glob("*.md")} - {"README.md"} <= linked


def test_every_page_is_in_the_contents_of_the_site():
    named = "\n".join(
        (DOCS / f"{name}.md").read_text("utf-8") for name in ("index", "using", "explanation")
    )
    for page in DOCS.glob("*.md"):
        if page.stem != "index":
            assert re.search(rf"^(.*<)?{re.escape(page.stem)}>?$", named, re.MULTILINE), page.stem


def test_the_gallery_has_two_dozen_shapes():
    assert len(GALLERY) >= 24


@each(GALLERY)
def test_a_script_of_the_gallery_is_short_and_its_shapes_come_along(script):
    text = script.read_text("utf-8")
    assert len(text.splitlines()) <= 60
    assert text.startswith('"""\n')
    for name in re.findall(r'image\("([^"]+)"\)', text):
        assert (DATA / "images" / name).exists()
    for name in re.findall(r'outline\("([^"{]+)"\)', text):
        assert (DATA / "outlines" / f"{name}.csv").exists()

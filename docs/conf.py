"""The documentation as a site: ``make docs``."""

from __future__ import annotations

import re
import sys
import warnings
from pathlib import Path
from typing import TYPE_CHECKING

import shapespline as ss
from shapespline.cli import help_pages

if TYPE_CHECKING:
    from sphinx.application import Sphinx

HERE = Path(__file__).parent
GENERATED = HERE / "_generated"
sys.path.insert(0, str(HERE / "gallery"))

project = "shapespline"
author = "The shapespline authors"
project_copyright = author
release = ss.__version__
version = release

extensions = [
    "myst_parser",
    "numpydoc",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx_design",
    "sphinx_gallery.gen_gallery",
    "sphinx-mathjax-offline",
]
exclude_patterns = ["gallery", "_generated/gallery/*.ipynb"]
myst_enable_extensions = ["colon_fence", "dollarmath"]
myst_heading_anchors = 3

html_theme = "pydata_sphinx_theme"
html_title = "shapespline"
html_theme_options = {
    "navigation_with_keys": False,
    "secondary_sidebar_items": ["page-toc"],
    "footer_start": ["copyright"],
    "footer_end": [],
}
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_sidebars = {"index": []}
html_show_sourcelink = False

autosummary_generate = True
autodoc_typehints = "none"
numpydoc_show_inherited_class_members = False
numpydoc_class_members_toctree = False

sphinx_gallery_conf = {
    "examples_dirs": ["gallery"],
    "gallery_dirs": ["_generated/gallery"],
    "filename_pattern": r"/\d\d_",
    "ignore_pattern": r"canvas\.py",
    "within_subsection_order": "FileNameSortKey",
    "download_all_examples": False,
    "show_signature": False,
    "write_computation_times": False,
    "min_reported_time": 1,
    "abort_on_example_error": True,
    "thumbnail_size": (400, 300),
    # What a line returns is no part of a picture.
    "capture_repr": (),
}
warnings.filterwarnings("ignore", category=DeprecationWarning)


def write_help(app: Sphinx) -> None:
    """What every command prints for ``--help``, for the page of the command line."""
    GENERATED.mkdir(exist_ok=True)
    for name, text in help_pages().items():
        (GENERATED / f"{name}.txt").write_text(text, encoding="utf-8")


def add_contents(app: Sphinx, page: str, source: list[str]) -> None:
    """Make a folder's README the first page of a section: the pages that it links are its parts.

    Where the files are browsed the links are enough; the site needs to be told.
    """
    if page.endswith("/README"):
        folder = HERE / page
        linked = dict.fromkeys(re.findall(r"\]\(([\w-]+)\.md", source[0]))
        parts = [name for name in linked if (folder.parent / f"{name}.md").exists()]
        source[0] += "\n\n```{toctree}\n:hidden:\n\n" + "\n".join(parts) + "\n```\n"


def keep_links_inside(app: Sphinx, page: str, source: list[str]) -> None:
    """Leave the name alone of a link to a file of the repository that is no page of the site."""
    source[0] = re.sub(r"\[([^\]]+)\]\((?:\.\./)+(?:examples|src)/[^)]*\)", r"\1", source[0])


def setup(app: Sphinx) -> None:
    """Connect what is generated."""
    app.connect("builder-inited", write_help)
    app.connect("source-read", add_contents)
    app.connect("source-read", keep_links_inside)

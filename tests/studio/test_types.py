"""The types of the page's modules, which stand in comments; and how large they are."""

import shutil
import subprocess
from pathlib import Path

import pytest
from tests.support.places import ROOT

PAGE = ROOT / "src" / "shapespline" / "studio" / "page"
# What the issue of the studio allows, without pictures.
MOST_BYTES = 400_000
MOST_LINES = 400


def test_the_page_is_small_and_needs_no_network():
    files = [file for file in PAGE.iterdir() if file.is_file()]
    assert sum(file.stat().st_size for file in files) < MOST_BYTES
    for file in files:
        text = file.read_text("utf-8")
        assert len(text.splitlines()) <= MOST_LINES, file.name
        assert "https://" not in text, file.name
        assert "eval(" not in text, file.name


@pytest.mark.slow
def test_the_types_of_the_page_are_right():
    compiler = shutil.which("tsc")
    if compiler is None:
        pytest.skip("there is no tsc: npm install --global typescript brings it")
    found = subprocess.run(
        [compiler, "-p", str(Path(__file__).parent)], capture_output=True, text=True, check=False
    )
    assert found.returncode == 0, found.stdout

"""The types of the page's modules, which stand in comments; and how large they are."""

import os
import shutil
import subprocess
import sys
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
    installed = Path(sys.prefix, "typescript", "node_modules", ".bin")
    compiler = shutil.which("tsc", path=installed) or shutil.which("tsc")
    if compiler is None:
        missing = f"there is no tsc: sh scripts/typescript.sh {sys.executable} brings it"
        (pytest.fail if os.environ.get("CI") else pytest.skip)(missing)
    command = [compiler, "-p", str(Path(__file__).parent)]
    found = subprocess.run(command, capture_output=True, text=True, check=False)
    assert found.returncode == 0, found.stdout

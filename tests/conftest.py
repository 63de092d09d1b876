"""What every test may use: the corpus of real shapes, and hypothesis's profile."""

from __future__ import annotations

import sys

import numpy as np
import pytest
from hypothesis import settings
from tests.support.places import OUTLINES, ROOT

from shapespline.__main__ import main
from shapespline.values.contour import Contour

MORE_OUTLINES = ROOT.parent / "shared" / "data"

# The same examples on every run: a failure in CI is a failure at the desk.
settings.register_profile("shapespline", deadline=None, derandomize=True, max_examples=50)
settings.load_profile("shapespline")


def read_outline(path, closed):
    if not path.exists():
        pytest.skip(f"{path.name} is not there: run this test where {path.parent} is")
    return Contour(np.loadtxt(path, delimiter=","), closed)


@pytest.fixture(scope="session")
def outline():
    """The contour of a file of examples/data/outlines by its name, open if the name says so."""
    return lambda name: read_outline(OUTLINES / f"{name}.csv", not name.endswith("_open"))


@pytest.fixture(scope="session")
def all_outlines():
    """(name, contour) of every file of examples/data/outlines."""
    return [
        (path.stem, read_outline(path, not path.stem.endswith("_open")))
        for path in sorted(OUTLINES.glob("*.csv"))
    ]


@pytest.fixture(scope="session")
def more_outlines():
    """Contours of a folder of the larger collection beside the project, None for any number."""

    def contours(folder, most=None):
        paths = sorted((MORE_OUTLINES / folder).glob("*.csv"))
        if not paths:
            pytest.skip(f"the larger collection of outlines is not at {MORE_OUTLINES}")
        return [(path.stem, read_outline(path, None)) for path in paths[:most]]

    return contours


@pytest.fixture(scope="session")
def blob():
    """A closed outline without symmetry, with maxima of irregular heights."""
    t = 2 * np.pi * np.arange(97) / 97
    r = 10 + 2 * np.cos(5 * t) + 0.7 * np.sin(3 * t + 0.4) + 0.1 * np.sin(17 * t)
    return Contour(np.column_stack([r * np.cos(t), r * np.sin(t)]), closed=True)


@pytest.fixture
def shapespline(monkeypatch, capsys):
    """Run the command line in this process: exit code, standard output, standard error."""

    def run(*arguments):
        monkeypatch.setattr(sys, "argv", ["shapespline", *map(str, arguments)])
        code = 0
        try:
            main()
        except SystemExit as stop:
            code = stop.code or 0
        captured = capsys.readouterr()
        return code, captured.out, captured.err

    return run

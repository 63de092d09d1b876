"""The notebook runs from its first cell to its last."""

from __future__ import annotations

import os
import sys

import pytest
from tests.support.places import ROOT

NOTEBOOK = ROOT / "examples" / "notebooks" / "the-published-method.ipynb"


@pytest.mark.slow
def test_the_notebook_of_the_published_method_runs(monkeypatch):
    nbformat, nbclient = (pytest.importorskip(name) for name in ("nbformat", "nbclient"))
    pytest.importorskip("ipykernel")
    pytest.importorskip("matplotlib")
    monkeypatch.setenv("MPLBACKEND", "agg")
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(ROOT / "src"), *sys.path]))
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    assert [cell.outputs for cell in notebook.cells if cell.cell_type == "code"] == [
        [] for cell in notebook.cells if cell.cell_type == "code"
    ], "a notebook is kept without its outputs"
    client = nbclient.NotebookClient(
        notebook, timeout=300, resources={"metadata": {"path": str(NOTEBOOK.parent)}}
    )
    client.execute()
    said = "".join(
        output.get("text", "")
        for cell in notebook.cells
        if cell.cell_type == "code"
        for output in cell.outputs
    )
    assert "sensible: E =" in said
    assert "curves on the way are kept" in said

"""The report of a run: complete, the same twice, whole or not at all."""

import csv
import io

import pytest
from PIL import Image

from shapespline import LITERAL
from shapespline.errors import FormatError, ShapesplineError
from shapespline.paper import report as paper_report
from shapespline.paper.files import DATA_FILES
from shapespline.paper.report import DRAWINGS, FIGURES, TABLES, check_folder, write_report
from shapespline.paper.run import run_paper
from shapespline.solvers.iteration import Limits

LENGTH = 4


@pytest.fixture(scope="module")
def literal(blob):
    return run_paper(blob, LENGTH, reading=LITERAL, limits=Limits(max_iterations=3))


@pytest.fixture(scope="module")
def sensible(blob):
    return run_paper(blob, LENGTH)


@pytest.mark.parametrize("which", ["literal", "sensible"])
@pytest.mark.slow
def test_report_is_complete_and_readable(which, tmp_path, request):
    pytest.importorskip("matplotlib")
    run = request.getfixturevalue(which)
    folder = tmp_path / "figures"
    paths = write_report(run, folder)
    assert [path.name for path in paths] == [*FIGURES, *DRAWINGS, *TABLES, *DATA_FILES]
    assert sorted(folder.iterdir()) == sorted(paths)
    for name in FIGURES:
        with Image.open(folder / name) as picture:
            picture.load()
            assert min(picture.size) > 400
    text = (folder / "report.md").read_text()
    assert all(f"]({name})" in text for name in FIGURES)
    for name in DRAWINGS:
        assert (folder / name).read_text(encoding="utf-8").rstrip().endswith("</svg>")
    rows = list(csv.reader(io.StringIO((folder / "table.csv").read_text())))
    table = {row[0]: row[1:] for row in rows}
    assert all(len(row) == 3 for row in rows)
    assert table["reading"][0] == which
    diagonal = run.contour.box_diagonal
    for quantity, value in (
        ("start error E_0", run.start_error),
        ("final error E", run.final_error),
        ("rms distance", run.fit.rms_distance),
        ("maximum distance", run.fit.max_distance),
        ("two-sided distance", run.fit.hausdorff_distance),
    ):
        absolute, relative = map(float, table[quantity])
        assert absolute == pytest.approx(value, rel=1e-5)  # six digits
        assert relative == pytest.approx(value / diagonal, rel=1e-5)
        assert f"| {quantity} | {table[quantity][0]} |" in text
    assert int(table["control points"][0]) == run.fit.n_control_points
    assert "iterations" in table["end"][0]


@pytest.mark.slow
def test_report_is_the_same_twice_and_replaces_an_older_one(sensible, tmp_path):
    pytest.importorskip("matplotlib")
    first = [path.read_bytes() for path in write_report(sensible, tmp_path / "a")]
    (tmp_path / "a" / "table.csv").write_text("old")
    assert first == [path.read_bytes() for path in write_report(sensible, tmp_path / "a")]


def test_missing_parent_is_one_sentence_and_leaves_nothing(sensible, tmp_path):
    with pytest.raises(FormatError, match="does not exist; create it first") as raised:
        write_report(sensible, tmp_path / "missing" / "figures")
    assert isinstance(raised.value, ShapesplineError)
    assert "\n" not in str(raised.value)
    assert not list(tmp_path.iterdir())


def test_file_in_the_place_of_the_folder_is_left_alone(sensible, tmp_path):
    file = tmp_path / "figures"
    file.write_text("mine")
    with pytest.raises(FormatError, match="it is a file"):
        write_report(sensible, file)
    assert file.read_text() == "mine"


def test_folder_that_cannot_be_written_is_refused_before_any_work(tmp_path, monkeypatch):
    monkeypatch.setattr(paper_report.os, "access", lambda *_: False)  # root may write everywhere
    with pytest.raises(FormatError, match="write-protected"):
        check_folder(tmp_path / "figures")
    with pytest.raises(FormatError, match="write-protected"):
        check_folder(tmp_path)


@pytest.mark.slow
def test_figure_that_fails_leaves_nothing(sensible, tmp_path, monkeypatch):
    from shapespline.paper import figures as figures

    pytest.importorskip("matplotlib")

    def fail(*_, **__):
        raise MemoryError

    monkeypatch.setattr(figures, "plot_convergence", fail)
    with pytest.raises(MemoryError):
        write_report(sensible, tmp_path / "figures")
    assert not list(tmp_path.iterdir())

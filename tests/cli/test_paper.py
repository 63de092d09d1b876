"""`shapespline paper`: the run that Python makes, one sentence for what is wrong."""

import csv
import io
from dataclasses import replace

import pytest
from click.testing import CliRunner

from shapespline import LITERAL, SENSIBLE, Contour, Drawing, initial_curve, optimize, read, write
from shapespline.cli.main import app
from shapespline.errors import ShapesplineError
from shapespline.paper.run import run_paper
from shapespline.solvers.iteration import Limits

LENGTH = 4


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "arguments"),
    [
        ([], {}),
        (
            ["--literal", "--reading", "max_evaluations=300"],
            {"reading": replace(LITERAL, max_evaluations=300)},
        ),
        (
            ["--reading", "window=7", "--reading", "start=cpda-halved", "--method", "sdm"],
            {"reading": replace(SENSIBLE, window=7, start="cpda-halved"), "method": "sdm"},
        ),
        (
            ["--control-points", "41", "--degree", "5", "--arc-length", "4"],
            {"n_control_points": 41, "degree": 5, "arc_length": 4.0},
        ),
    ],
)
def test_the_command_is_the_run(blob, words, arguments, tmp_path):
    pytest.importorskip("matplotlib")
    source = tmp_path / "blob.csv"
    write(source, blob)
    contour = read(source, closed=True).longest
    argument = [] if "arc_length" in arguments else ["--length", "4"]
    folder = tmp_path / "report"
    command = ["paper", str(source), "--closed", "-o", str(folder), *argument, *words]
    assert CliRunner().invoke(app, command).exit_code == 0
    run = run_paper(contour, None if "arc_length" in arguments else 4, **arguments)
    table = dict(row[:2] for row in csv.reader(io.StringIO((folder / "table.csv").read_text())))
    assert table["method"] == run.fit.method
    assert int(table["control points"]) == run.fit.n_control_points
    assert table["final error E"] == f"{run.final_error:.6g}"
    assert table["two-sided distance"] == f"{run.fit.hausdorff_distance:.6g}"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["--reading", "windows=7"], "reading must be set by FIELD=VALUE with a field of signed, "),
        (["--method", "newton"], "method must be one of levenberg-marquardt, "),
        (["--control-points", "2"], "n_control_points must be from degree + 1 = 4 to"),
        (["--length", "4", "--arc-length", "2"], "length and arc_length say the same thing"),
        (["--degree", "12"], "degree must be an integer from 1 to 9"),
    ],
)
def test_the_command_refuses_with_one_sentence(blob, words, sentence, tmp_path):
    pytest.importorskip("matplotlib")
    source = tmp_path / "blob.csv"
    write(source, blob)
    with pytest.raises(ShapesplineError) as raised:
        app(
            ["paper", str(source), "--closed", "-o", str(tmp_path / "out"), *words],
            standalone_mode=False,
        )
    assert sentence in str(raised.value)
    assert "\n" not in str(raised.value)
    assert not (tmp_path / "out").exists()


@pytest.mark.slow
def test_the_command_runs_on_every_outline(blob, tmp_path):
    pytest.importorskip("matplotlib")
    source = tmp_path / "two.json"
    hole = Contour(0.3 * blob.points, closed=True)
    fits = [
        optimize(c, initial_curve(c, LENGTH), limits=Limits(max_iterations=1)) for c in (blob, hole)
    ]
    write(source, Drawing(fits, [-1, 0]))
    folder = tmp_path / "report"
    app(["paper", str(source), "-L", "4", "-o", str(folder)], standalone_mode=False)
    for index, contour in enumerate((blob, hole), 1):
        [fit] = read(folder / f"outline-{index}" / "final-curve.json").fits
        expected = run_paper(contour, LENGTH).fit
        assert fit.control_points.tobytes() == expected.control_points.tobytes()

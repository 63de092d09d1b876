"""What a person meets first: names that are found, settings, sizes, help, exit codes, progress."""

import contextlib
import json
import sys
import time
from dataclasses import replace

import numpy as np
import pytest
from tests.cli.test_errors import HAND
from tests.support.command_line import one_line
from tests.support.desk import laid_out
from tests.support.shapes import flower

import shapespline as ss
from shapespline.cli import help_pages, settings_file, waiting
from shapespline.cli.jobs import run_all
from shapespline.cli.reports import Report


@pytest.fixture
def desk(tmp_path, monkeypatch):
    monkeypatch.chdir(laid_out(tmp_path))
    return tmp_path


def test_a_result_lies_beside_its_input_and_replaces_nothing(shapespline, desk):
    assert shapespline("fit", "logo.png")[0] == 0
    first = (desk / "logo.svg").read_bytes()
    code, out, err = shapespline("fit", "logo.png", "-t", 3)
    assert (code, out) == (1, "")
    assert one_line(err)
    assert "logo.svg exists; say --force to replace it" in err
    assert (desk / "logo.svg").read_bytes() == first
    assert shapespline("fit", "logo.png", "-t", 3, "--force")[0] == 0
    assert (desk / "logo.svg").read_bytes() != first
    assert shapespline("fit", "logo.png", "-t", 1, "-f", "dxf")[0] == 0
    assert (desk / "logo.dxf").exists()


def test_two_inputs_of_one_name_are_not_written_over_each_other(shapespline, desk):
    (desk / "logo.csv").write_bytes((desk / "scan.csv").read_bytes())
    code, _, err = shapespline("fit", "logo.png", "logo.csv")
    assert code == 1
    assert "several inputs would be written to logo.svg" in err
    assert not (desk / "logo.svg").exists()


def test_a_tolerance_that_is_not_kept_is_exit_code_3(shapespline, desk, monkeypatch):
    fit_shape = ss.fit_shape

    def missed(shape, **options):
        (fit,) = fit_shape(shape, **options)
        sentence = ss.Status.EXCEEDED.saying("tolerance 1e-9 not kept; take a larger one")
        return ss.Drawing([replace(fit, tolerance=1e-9, status=sentence)])

    assert shapespline("fit", "scan.csv", "-t", 0.5, "-o", "kept.svg")[0] == 0
    monkeypatch.setattr(ss, "fit_shape", missed, raising=False)
    code, out, err = shapespline("fit", "scan.csv", "-t", 0.5, "-o", "scan.svg")
    assert (code, out.count("\n")) == (3, 1)
    assert one_line(err)
    assert "not kept; take a larger one" in err
    assert (desk / "scan.svg").exists()
    code, _, _ = shapespline("fit", "scan.csv", "none.csv", "-t", 0.5, "-o", "out", "-f", "svg")
    assert code == 1


@pytest.mark.slow
def test_settings_are_saved_and_used_again(shapespline, desk):
    first = ("fit", "scan.csv", "-t", "0.5%", "--corners", "none", "--effort", "fast")
    for name in ("job.toml", "job.json"):
        code, _, _ = shapespline(*first, "--save-settings", name, "-o", "a.json")
        assert code == 0
        assert shapespline("fit", "scan.csv", "--settings", name, "-o", "b.json")[0] == 0
        (a,), (b,) = ss.read("a.json"), ss.read("b.json")
        np.testing.assert_array_equal(a.control_points, b.control_points)
        assert a.tolerance == b.tolerance < 3
        assert shapespline("fit", "scan.csv", "--settings", name, "-t", 3, "-o", "c.json")[0] == 0
        (fit,) = ss.read("c.json")
        assert fit.tolerance == pytest.approx(3)
    assert (desk / "job.toml").read_text() == (
        'version = 1\ntolerance = "0.5%"\ncorners = "none"\neffort = "fast"\n'
    )
    assert json.loads((desk / "job.json").read_text())["corners"] == "none"
    drawn = ("--character", "drawn", "--regularities", "none")
    shapespline("fit", "scan.csv", *drawn, "--save-settings", "drawn.toml", "-o", "a.json")
    assert settings_file.load(desk / "drawn.toml")["regularities"] is None


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("version = 7\n", "settings of version 7; this program reads version 1"),
        ("colour = 3\n", "colour is no setting; these are: tolerance"),
        ("tolerance = \n", "no settings in TOML"),
        ("degree = 40\n", "degree must be an integer from 1 to 9"),
        ('effort = "some"\n', "effort must be"),
    ],
)
def test_bad_settings(shapespline, desk, text, message):
    (desk / "job.toml").write_text(text)
    code, out, err = shapespline("fit", "scan.csv", "--settings", "job.toml", "-o", "x.svg")
    assert (code, out) == (1, "")
    assert one_line(err)
    assert message in err
    assert not (desk / "x.svg").exists()


@pytest.mark.slow
def test_a_known_width(shapespline, desk):
    assert shapespline("fit", "logo.png", "--width", 120, "--unit", "mm", "-o", "logo.dxf")[0] == 0
    drawing = ss.read("logo.dxf")
    assert drawing.unit == "mm"
    given = ss.read("logo.png")
    sides = [np.ptp(np.vstack([c.points for c in given]), axis=0)]
    sides += [np.ptp(np.vstack([fit.curve(np.linspace(0, 1, 3000)) for fit in drawing]), axis=0)]
    # The fit keeps a fifth of a pixel or so, of 256.
    assert sides[1][0] == pytest.approx(120, abs=120 / 256)
    assert sides[1] / sides[1][0] == pytest.approx(sides[0] / sides[0][0], rel=0.01)
    code, _, err = shapespline("fit", "logo.png", "--width", 120, "--dpi", 96, "-o", "x.svg")
    assert code == 1
    assert "exclude each other" in err


def test_columns_of_a_table(shapespline, desk):
    for columns in ("east,north", "2,3"):
        arguments = ("fit", "table.csv", "--columns", columns, "-t", 0.5, "-o", "track.json")
        assert shapespline(*arguments)[0] == 0
        (fit,) = ss.read("track.json")
        expected = np.loadtxt("scan.csv", delimiter=",")[::4]
        np.testing.assert_array_equal(fit.contour.points, expected)
    code, _, err = shapespline("fit", "table.csv", "--columns", "x,y", "-o", "x.svg")
    assert code == 1
    assert "no column 'x'; the table has 4: id, east, north" in err


@pytest.mark.parametrize(
    ("arguments", "said", "never"),
    [
        (["-n", 3], "--control-points must be at least", "n_control_points"),
        (["-n", 9, "-t", 1], "tolerance and --control-points exclude", "n_control_points"),
        (["--symmetric"], "--symmetric acts within a tolerance", "end_tangents"),
        (["-t", 1, "--time-limit", -1], "--time-limit must be", "time_limit"),
    ],
)
def test_messages_are_in_the_words_of_the_command_line(
    shapespline, tmp_path, arguments, said, never
):
    code, _, err = shapespline("fit", HAND, "-o", tmp_path / "x.svg", *arguments)
    assert code == 1
    assert one_line(err)
    assert said in err
    assert never not in err


@pytest.mark.parametrize("name", sorted(help_pages()))
def test_every_help_has_panels_examples_units_and_exit_codes(name):
    page = help_pages()[name]
    assert max(map(len, page.splitlines())) <= 80
    examples = page[page.index("Examples:") : page.index("Units:")]
    assert examples.count(f"shapespline {name}") == (1 if name == "doctor" else 5)
    assert "3  written, but a curve keeps less than its tolerance" in page
    if name == "fit":
        heads = ["Input:", "Pictures:", "Fit:", "Output:", "Run:"]
        assert [line for line in page.splitlines() if line in heads] == heads


def test_no_option_of_fit_is_without_a_panel():
    others = help_pages()["fit"].partition("\nOthers:\n")[2].partition("\n\n")[0]
    assert others.split()[0] == "--help"
    assert others.count("--") == 1


def test_doctor_says_that_all_is_well(shapespline):
    began = time.perf_counter()
    code, out, err = shapespline("doctor")
    assert (code, err) == (0, "")
    assert time.perf_counter() - began < 30
    assert f"shapespline {ss.__version__}" in out
    assert "tolerance" in out.splitlines()[-1]
    assert " kept" in out.splitlines()[-1]


def test_a_long_step_is_said_on_a_terminal(monkeypatch, capsys):
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    monkeypatch.setattr(waiting, "PATIENCE", 0.05)
    with waiting.said_when_long() as say:
        say("fitting 3 outlines")
        time.sleep(0.3)
    err = capsys.readouterr().err
    assert "fitting 3 outlines, 0 s" in err
    assert err.endswith("\r")  # and gone again


def test_a_line_that_stays_is_not_written_into_one_that_goes(monkeypatch, capsys):
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    monkeypatch.setattr(waiting, "PATIENCE", 0.02)
    monkeypatch.setattr(waiting, "EVERY", 0.01)
    pairs = [(HAND, HAND)] * 2
    for report in run_all(lambda *_: time.sleep(0.1) or Report("a file"), pairs):
        shown = capsys.readouterr().err
        assert "of 2 files, 0 s" in shown
        assert shown.endswith(" \r")
        time.sleep(0.05)
        assert capsys.readouterr().err == ""
        assert report.error is None


def test_a_short_step_and_a_pipe_stay_silent(monkeypatch, capsys):
    with waiting.said_when_long() as say:
        say("fitting")
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    with waiting.said_when_long() as say:
        say("fitting")
    assert capsys.readouterr().err == ""


def test_shell_completion_is_written(shapespline, monkeypatch):
    code, script, _ = shapespline("--show-completion", "bash")
    assert code == 0
    assert "_SHAPESPLINE_COMPLETE=bash_complete" in script
    monkeypatch.setenv("_SHAPESPLINE_COMPLETE", "bash_complete")
    for words, last, expected in (("fi", 1, "fit"), ("fit --toler", 2, "--tolerance")):
        monkeypatch.setenv("COMP_WORDS", f"shapespline {words}")
        monkeypatch.setenv("COMP_CWORD", str(last))
        assert shapespline()[1].split(",")[-1].strip() == expected


def test_a_temporary_name_is_never_said(shapespline, tmp_path, monkeypatch):
    import io

    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(b"1,2\n3,x\n")))
    code, _, err = shapespline("fit", "-", "-o", tmp_path / "x.svg")
    assert code == 1
    assert one_line(err)
    assert "standard input: line 2" in err
    assert "shapespline-stream" not in err


@pytest.mark.slow
def test_errors_of_points_are_a_length_or_a_column(shapespline, desk):
    points = flower(80).points
    rows = "".join(f"{x},{y},0.1,0.2\n" for x, y in points)
    (desk / "table.csv").write_text("x,y,ex,ey\n" + rows)
    common = ("table.csv", "--columns", "x,y", "--closed", "-n", 20)
    for number, sigma in enumerate(("0.1", "ex", "@3", "ex,ey")):
        target = f"{number}.json"
        assert shapespline("fit", *common, "--sigma", sigma, "-o", target)[0] == 0
    variances = [ss.read(desk / f"{n}.json").fits[0].covariance.trace() for n in range(4)]
    assert variances[0] == variances[1] == variances[2] < variances[3]
    assert shapespline("fit", *common, "--sigma", 0.1, "--band", 0.95, "-o", "b.svg")[0] == 0
    for wrong, said in (
        (("--sigma", "nothing"), "no column 'nothing'"),
        (("--sigma", "ex", "--width", 5), "--sigma with columns and --width"),
    ):
        code, _, err = shapespline("fit", *common, *wrong, "-o", "no.svg")
        assert code == 1
        assert one_line(err)
        assert said in err
    code, _, err = shapespline("fit", "table.csv", "--sigma", "ex", "-t", 1, "-o", "no.svg")
    assert code == 1
    assert "not within a tolerance" in err


@pytest.mark.slow
def test_a_picture_is_read_once_for_its_width(shapespline, desk, monkeypatch):
    read, seen = ss.read, []
    monkeypatch.setattr(ss, "read", lambda *a, **o: seen.append(a) or read(*a, **o), raising=False)
    assert shapespline("fit", "logo.png", "--width", 120, "--unit", "mm", "-o", "once.svg")[0] == 0
    assert len(seen) == 1


@pytest.mark.slow
def test_what_is_going_on_names_the_curve(shapespline, desk, monkeypatch):
    said = []
    monkeypatch.setattr(
        "shapespline.cli.fit.said_when_long", lambda on: contextlib.nullcontext(said.append)
    )
    assert shapespline("fit", "logo.png", "-o", "told.svg")[0] == 0
    n = len(ss.read("logo.png"))
    curves = [sentence.partition(",")[0] for sentence in said if sentence.startswith("curve")]
    assert curves == [f"curve {index + 1} of {n}" for index in range(n)]
    assert f"looking for the corners of {n} outlines" in said


def test_an_order_that_is_in_doubt_is_said(shapespline, desk):
    square = np.random.default_rng(1).permutation(flower(60).points)
    two = np.concatenate([square, square + 100])
    np.savetxt("one.csv", square, delimiter=",")
    np.savetxt("two.csv", two, delimiter=",")
    _, _, err = shapespline("fit", "one.csv", "--unordered", "--closed", "-t", "1%")
    assert err == ""
    _, _, err = shapespline("fit", "two.csv", "--unordered", "-t", "1%")
    assert "2 closed and 0 open outlines, confidence 1.00; --closed or --open says more" in err
    _, _, err = shapespline("fit", "one.csv", "-t", "1%", "--force")
    assert "the points look shuffled" in err
    assert "say --unordered" in err

"""The command line, as a user meets it: files, exit codes and one line of error."""

import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import shapespline as ss
from shapespline.__main__ import main

DATA = Path(__file__).parent.parent / "examples" / "data"
HAND = DATA / "outlines" / "hand620_closed.csv"


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


def one_line(error):
    return error.startswith("shapespline: ") and error.count("\n") == 1 and "Traceback" not in error


def test_fit_writes_what_it_says(shapespline, tmp_path):
    output, picture = tmp_path / "hand.json", tmp_path / "hand.png"
    code, out, err = shapespline("fit", HAND, "-n", 24, "-o", output, "--plot", picture)
    assert (code, err) == (0, "")
    assert out.startswith(f"{output}: 1 curve, 24 points")
    (fit,) = ss.read(output).fits
    assert fit.n_control_points == 24
    assert fit.closed
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert sorted(tmp_path.iterdir()) == [output, picture]


def test_fit_of_a_picture_keeps_its_frame_and_holes(shapespline, tmp_path):
    output = tmp_path / "glyph.svg"
    code, out, _ = shapespline(
        "fit", DATA / "images" / "NotoSerif-Regular_U0067_512.png", "-n", 24, "-o", output
    )
    assert code == 0
    assert "3 curves, 72 points" in out
    text = output.read_text()
    assert 'viewBox="0 0 512 512"' in text
    assert text.count("<path") == 1
    assert text.count("Z") == 3


def test_a_drawing_can_be_fitted_again(shapespline, tmp_path):
    first, second = tmp_path / "first.json", tmp_path / "second.json"
    assert shapespline("fit", HAND, "-n", 20, "-o", first)[0] == 0
    assert shapespline("fit", first, "-n", 30, "--degree", 4, "-o", second)[0] == 0
    (fit,) = ss.read(second).fits
    assert (fit.n_control_points, fit.degree) == (30, 4)
    np.testing.assert_array_equal(fit.contour.points, np.loadtxt(HAND, delimiter=","))


def test_open_and_y_down(shapespline, tmp_path):
    outline, output = tmp_path / "arc.csv", tmp_path / "arc.json"
    t = np.linspace(0, np.pi, 60)
    np.savetxt(outline, np.column_stack([np.cos(t), np.sin(t)]), delimiter=",")
    assert shapespline("fit", outline, "--open", "--y-down", "-n", 6, "-o", output)[0] == 0
    (fit,) = ss.read(output).fits
    assert not fit.closed
    assert fit.contour.points[30, 1] < 0.01  # the top of the arc has become its bottom


def test_paper_writes_its_report(shapespline, tmp_path):
    folder = tmp_path / "figures"
    code, out, err = shapespline(
        "paper", DATA / "paper" / "palm620.csv", "--length", 3, "-o", folder
    )
    assert (code, err) == (0, "")
    written = {Path(line) for line in out.split("\n") if line}
    assert written == set(folder.iterdir())
    assert len([path for path in written if path.suffix == ".png"]) == 6


def test_repeated_points_are_said(shapespline, tmp_path):
    outline, output = tmp_path / "twice.csv", tmp_path / "twice.svg"
    points = np.loadtxt(HAND, delimiter=",")
    np.savetxt(outline, np.repeat(points, 2, axis=0), delimiter=",")
    code, _, err = shapespline("fit", outline, "-n", 20, "-o", output)
    assert code == 0
    assert err == "shapespline: dropped 620 of 1240 points: equal to the point before them\n"


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("", "the file is empty"),
        ("1,2\n3,nan\n4,5\n", "line 2"),
        ("1,2\n3,x\n4,5\n", "line 2"),
        ("1,2,3\n4,5,6\n7,8,9\n", "expected 2 columns (x and y), found 3"),
        ("x,y\n", "no points: only a line of words, 'x,y'"),
        ("1,2\n1,2\n", "distinct points"),
    ],
)
def test_bad_outlines(shapespline, tmp_path, content, message):
    outline, output = tmp_path / "bad.csv", tmp_path / "bad.svg"
    outline.write_text(content)
    code, out, err = shapespline("fit", outline, "-o", output)
    assert (code, out) == (1, "")
    assert one_line(err.split("\n", 1)[1] if err.startswith("shapespline: dropped") else err)
    assert message in err
    assert not output.exists()


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        (["fit", "nothing.csv", "-o", "x.svg"], 1, "there is no such file"),
        (["fit", ".", "-o", "x.svg"], 1, "it is a folder; name a file in it"),
        (["fit", str(HAND), "-o", "."], 1, "it is a folder; name a file in it"),
        (["fit", str(HAND), "-o", "nowhere/x.svg"], 1, "does not exist; create it first"),
        (["fit", str(HAND), "-o", "x.foo"], 1, "writable endings: .json .svg"),
        (["fit", str(HAND), "-o", "x.svg", "--plot", "nowhere/x.png"], 1, "does not exist"),
        (["fit", str(HAND), "-n", "3", "-o", "x.svg"], 1, "at least degree + 1 = 4, got 3"),
        (["fit", str(HAND), "-n", "700", "-o", "x.svg"], 1, "at most the number of distinct"),
        (["fit", str(HAND), "--degree", "0", "-o", "x.svg"], 1, "degree must be an integer from 1"),
        (["fit", str(HAND), "--level", "3", "-o", "x.svg"], 1, "level is not an option"),
        (["paper", str(HAND), "--length", "1", "-o", "x"], 1, "length must be"),
        (["paper", str(HAND), "--length", "400", "-o", "x"], 1, "length must be at most 310"),
        (["paper", str(HAND), "--length", "3", "-o", "nowhere/x"], 1, "nowhere"),
        (["fit"], 2, "INPUT"),
        (["fit", str(HAND)], 2, "--output"),
        (["fit", str(HAND), "-n", "many", "-o", "x.svg"], 2, "--control-points"),
        (["carve", str(HAND)], 2, "carve"),
    ],
)
def test_wrong_calls(shapespline, tmp_path, monkeypatch, arguments, code, message):
    monkeypatch.chdir(tmp_path)
    found, out, err = shapespline(*arguments)
    assert (found, out) == (code, "")
    assert one_line(err)
    assert message in err
    assert list(tmp_path.iterdir()) == []


def test_a_failure_leaves_the_old_file(shapespline, tmp_path):
    output = tmp_path / "old.svg"
    output.write_text("old")
    assert shapespline("fit", HAND, "-n", 2, "-o", output)[0] == 1
    assert output.read_text() == "old"


def test_version_loads_nothing():
    code = (
        "import sys; sys.argv = ['shapespline', '--version'];"
        "from shapespline.__main__ import main; main();"
        "print([name for name in ('numpy', 'scipy', 'typer') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == f"shapespline {ss.__version__}\n[]\n"


def test_help_does_not_load_the_numerical_packages():
    code = (
        "import sys; sys.argv = ['shapespline', 'fit', '--help'];"
        "from shapespline.cli import run; run();"
        "print([name for name in ('numpy', 'scipy') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.endswith("[]\n")
    assert "--control-points" in done.stdout


@pytest.mark.slow
def test_interrupting_leaves_nothing(tmp_path):
    outline, output = tmp_path / "long.npy", tmp_path / "long.svg"
    t = np.linspace(0, 2 * np.pi, 1_000_000, endpoint=False)
    r = 10 + np.sin(37 * t)
    np.save(outline, np.column_stack([r * np.cos(t), r * np.sin(t)]))
    child = subprocess.Popen(
        [sys.executable, "-m", "shapespline", "fit", str(outline), "-o", str(output)],
        stderr=subprocess.PIPE,
        text=True,
        # Started in the background, as some runners do, the tests would hand on an ignored Ctrl-C.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    time.sleep(3)
    child.send_signal(signal.SIGINT)
    _, err = child.communicate(timeout=60)
    assert child.returncode == 130
    assert err == "shapespline: interrupted; nothing was left half written\n"
    assert sorted(tmp_path.iterdir()) == [outline]


@pytest.mark.parametrize("option", ["--output", "--plot"])
def test_the_input_is_never_overwritten(shapespline, tmp_path, option):
    picture = tmp_path / "leaf.png"
    picture.write_bytes((DATA / "images" / "fa_leaf_256.png").read_bytes())
    drawing = tmp_path / "leaf.json"
    assert shapespline("fit", picture, "-n", 12, "-o", drawing)[0] == 0
    source, target = (drawing, drawing) if option == "--output" else (picture, picture)
    before = source.read_bytes()
    arguments = ["-o", target] if option == "--output" else ["-o", tmp_path / "x.svg"]
    if option == "--plot":
        arguments += ["--plot", target]
    code, _, err = shapespline("fit", source, "-n", 12, *arguments)
    assert code == 1
    assert "is the input itself; choose another name" in err
    assert source.read_bytes() == before


def test_no_argument_shows_the_help(shapespline):
    code, out, err = shapespline()
    assert (code, err) == (0, "")
    assert out.startswith("Usage: ")

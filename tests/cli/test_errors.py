"""The command line when something is wrong: one line of error, and nothing a user had is lost."""

import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from tests.support.command_line import one_line
from tests.support.places import DATA

HAND = DATA / "outlines" / "hand620_closed.csv"


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
        (["fit", ".", "-o", "x.svg"], 1, ". holds no file that can be read"),
        (["fit", "*.csv", "-o", "x.svg"], 1, "no file matches *.csv"),
        (["fit", str(HAND), "-o", "."], 1, "say with --format which files to write into it"),
        (["fit", str(HAND), str(HAND.parent), "-o", "x.svg"], 1, "x.svg is one file for"),
        (["fit", str(HAND), "-o", "-"], 1, "say with --format what to write"),
        (["fit", str(HAND.parent), "-o", "-", "-f", "svg"], 1, "standard output takes one"),
        (["fit", str(HAND.parent), "-o", "out", "-f", "svg", "--plot", "x"], 1, "--plot must name"),
        (["fit", str(HAND), "-o", "out", "-f", "foo"], 1, "writable endings: .3dm .csv"),
        (["fit", str(HAND), "-o", "nowhere/out", "-f", "svg"], 1, "nowhere"),
        (["convert", str(HAND), "-o", "x.svg"], 1, "holds points, not curves: fit it"),
        (["compare", str(HAND), "nothing.csv"], 1, "there is no such file"),
        (["info", "nothing.csv"], 1, "there is no such file"),
        (["fit", str(HAND), "-o", "x.svg", "--jobs", "0"], 2, "--jobs"),
        (["fit", str(HAND), "-o", "nowhere/x.svg"], 1, "does not exist; create it first"),
        (["fit", str(HAND), "-o", "x.foo"], 1, "writable endings: .3dm .csv"),
        (["fit", str(HAND), "-o", "x.svg", "--plot", "nowhere/x.png"], 1, "does not exist"),
        (["fit", str(HAND), "-n", "3", "-o", "x.svg"], 1, "at least degree + 1 = 4, got 3"),
        (["fit", str(HAND), "-n", "700", "-o", "x.svg"], 1, "at most the number of distinct"),
        (["fit", str(HAND), "--degree", "0", "-o", "x.svg"], 1, "degree must be an integer from 1"),
        (["fit", str(HAND), "--level", "3", "-o", "x.svg"], 1, "level is not an option"),
        (["paper", str(HAND), "--length", "1", "-o", "x"], 1, "length must be"),
        (["paper", str(HAND), "--length", "400", "-o", "x"], 1, "length must be at most 310"),
        (["paper", str(HAND), "--length", "3", "-o", "nowhere/x"], 1, "nowhere"),
        (["fit"], 2, "INPUT"),
        (["trace", str(HAND)], 2, "--output"),
        (["fit", "-"], 1, "say with --output where the result of standard input goes"),
        (["fit", str(HAND), "-o", "x.svg", "--width", "-3"], 1, "--width must be a positive"),
        (
            ["fit", str(HAND), "-o", "x.svg", "--columns", "a,b"],
            1,
            "no column 'a'; the table has 2",
        ),
        (["fit", str(HAND), "-o", "x.svg", "--columns", "a"], 1, "must be two names or numbers"),
        (["fit", str(HAND), "-o", "x.svg", "--settings", "no.toml"], 1, "cannot read no.toml"),
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


@pytest.mark.slow
def test_interrupting_leaves_nothing(tmp_path):
    outline, output = tmp_path / "long.npy", tmp_path / "long.svg"
    t = np.linspace(0, 2 * np.pi, 1_000_000, endpoint=False)
    r = 10 + np.sin(37 * t)
    np.save(outline, np.column_stack([r * np.cos(t), r * np.sin(t)]))
    child = subprocess.Popen(
        # So many points and control points take several times the wait on any machine of today.
        [sys.executable, "-m", "shapespline", "fit", str(outline), "-o", str(output), "-n", "300"],
        stderr=subprocess.PIPE,
        text=True,
        # Started in the background, as some runners do, the tests would hand on an ignored Ctrl-C.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    time.sleep(3)
    child.send_signal(signal.SIGINT)
    _, err = child.communicate(timeout=60)
    assert child.returncode == 130
    assert err.strip() == "shapespline: interrupted; nothing was left half written"
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

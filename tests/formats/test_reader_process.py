"""Readers that call libraries in C++ run in a process of their own."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import warnings

import numpy as np
import pytest

import shapespline as ss
from shapespline.errors import MissingExtraError, SkippedContentWarning
from shapespline.formats import ChildProcess, reader_process
from shapespline.formats.reader_process import Question, ReaderProcess, can_begin

# A format's module whose "files" say what becomes of them.
MODULE = """
import os, time, warnings
from shapespline.errors import FormatError, SkippedContentWarning
from shapespline.formats import reader_process

def read(path, **options):
    assert not reader_process.can_begin()
    print("a library prints what it likes", flush=True)
    os.write(1, b"and past Python, too")
    asked = path.read_text()
    if asked == "die":
        os.abort()
    if asked == "hang":
        path.with_suffix(".begun").touch()
        time.sleep(600)
    if asked == "refuse":
        raise FormatError("no such luck")
    if asked == "break":
        raise KeyError("ours")
    warnings.warn("left out", SkippedContentWarning)
    return asked, options, os.getpid()
"""


@pytest.fixture
def process(tmp_path, monkeypatch):
    (tmp_path / "odd_format.py").write_text(MODULE)
    monkeypatch.syspath_prepend(tmp_path)
    process = ReaderProcess()
    yield process
    process.close()


@pytest.fixture
def asked(tmp_path, process):
    def ask(text, needs=(), **options):
        path = tmp_path / "file.odd"
        path.write_text(text)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", SkippedContentWarning)
            return process.read(Question("odd_format", needs, path, options))

    return ask


def test_one_process_reads_file_after_file(asked):
    first, second = asked("a", colour="red"), asked("b")
    assert first[:2] == ("a", {"colour": "red"})
    assert second[:2] == ("b", {})
    assert first[2] == second[2] != os.getpid()


def test_a_library_that_dies_is_said_and_the_next_file_is_read(asked):
    before = asked("a")[2]
    with pytest.raises(ss.FormatError, match="must be damaged; write it again, or as DXF or SVG"):
        asked("die")
    again = asked("b")
    assert again[0] == "b"
    assert again[2] != before


def test_warnings_and_errors_are_the_readers_own(tmp_path, process, asked):
    path = tmp_path / "file.odd"
    path.write_text("a")
    with pytest.warns(SkippedContentWarning, match=r"^left out$"):
        process.read(Question("odd_format", (), path, {}))
    with pytest.raises(ss.FormatError, match=r"^no such luck$"):
        asked("refuse")
    with pytest.raises(RuntimeError, match=r"KeyError\('ours'\)\nTraceback"):
        asked("break")
    with pytest.raises(FileNotFoundError, match="No such file"):
        process.read(Question("odd_format", (), tmp_path / "none.odd", {}))
    with pytest.raises(MissingExtraError, match=r'Odd files need the extra odd: pip install "'):
        asked("a", needs=(("no_such_module", "odd", "Odd files need"),))
    assert asked("still there")[0] == "still there"


class InterruptedByUserError(Exception):
    pass


def test_what_hangs_can_be_interrupted(tmp_path, process, asked):
    def interrupt(number, frame):
        if (tmp_path / "file.begun").exists():
            signal.setitimer(signal.ITIMER_REAL, 0)
            raise InterruptedByUserError

    waiting = asked("a")[2]
    before = signal.signal(signal.SIGALRM, interrupt)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.05, 0.05)
        with pytest.raises(InterruptedByUserError):
            asked("hang")
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
    with pytest.raises(ProcessLookupError):
        os.kill(waiting, 0)
    assert asked("b")[0] == "b"


def test_a_copy_of_the_program_reads_in_a_process_of_its_own(asked, process):
    first = asked("a")[2]
    kept = process._process
    process.forget()
    try:
        assert asked("b")[2] != first
        assert not kept.has_ended
    finally:
        kept.end()


def test_programs_that_have_python_within_are_not_begun_again(monkeypatch):
    assert can_begin()
    for program in ("C:/Rhino 8/Rhino.exe", "/usr/bin/freecad", "", None):
        monkeypatch.setattr(sys, "executable", program)
        assert not can_begin()
    monkeypatch.setattr(sys, "executable", "/usr/bin/pypy3")
    assert can_begin()
    with monkeypatch.context() as begun:
        begun.setattr(ChildProcess, "is_this", True)
        assert not can_begin()
    monkeypatch.setattr(sys, "frozen", True, raising=False)
    assert not can_begin()


@pytest.mark.parametrize(
    ("ending", "library"), [("step", "OCP"), ("iges", "OCP"), ("3dm", "rhino3dm")]
)
def test_libraries_stay_out_of_the_callers_process(tmp_path, ending, library):
    pytest.importorskip(library)
    path = tmp_path / f"plate.{ending}"
    triangle = ss.Contour(np.array([[0.0, 0], [4, 0], [4, 3]]), closed=True)
    ss.write(path, triangle)
    code = (
        f"import sys, shapespline as ss; print(len(ss.read({str(path)!r})));"
        f" print({library!r} in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert (done.stdout, done.stderr) == ("1\nFalse\n", "")


def test_without_a_process_files_are_read_here(tmp_path, monkeypatch):
    pytest.importorskip("rhino3dm")
    path = tmp_path / "triangle.3dm"
    ss.write(path, ss.Contour(np.array([[0.0, 0], [4, 0], [4, 3]]), closed=True))
    monkeypatch.setattr(sys, "executable", "/opt/Rhino")
    monkeypatch.setattr(reader_process, "_READER", None)
    assert len(ss.read(path)) == 1

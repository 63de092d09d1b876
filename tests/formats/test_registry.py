"""The registry finds the format, refuses what it does not take, and writes whole files only."""

from __future__ import annotations

import os
import stat
import subprocess
import sys
import threading
from importlib import import_module
from pathlib import Path
from types import ModuleType

import pytest

from shapespline.errors import (
    FormatError,
    InvalidInputError,
    MissingExtraError,
    UnknownFormatError,
)
from shapespline.formats import atomic
from shapespline.formats import registry as formats
from shapespline.formats.registry import (
    FORMATS,
    Format,
    check_output,
    read,
    readable,
    writable,
    write,
    write_atomically,
)

SQUARE = "0,0\n4,0\n4,4\n0,4\n0,0\n"


def names(folder):
    return [path.name for path in folder.iterdir()]


@pytest.fixture
def fake(monkeypatch):
    """A registered format whose encoder records its calls."""
    module = ModuleType("shapespline.formats.fake")
    module.calls = []

    def encode(drawing, *, colour="black", digits=17):
        module.calls.append((drawing, colour, digits))
        if isinstance(drawing, BaseException):
            raise drawing
        return f"{drawing} {digits} {colour}".encode()

    def bare(path):
        raise AssertionError("must not be read")

    module.encode, module.read = encode, bare
    monkeypatch.setitem(sys.modules, module.__name__, module)
    entry = Format("fake", (".fake",), "fake", reads=True, writes=True)
    monkeypatch.setattr(formats, "FORMATS", (*formats.FORMATS, entry))
    monkeypatch.setattr(formats, "as_drawing", lambda value: value)  # words will do here
    monkeypatch.setattr(formats, "in_unit", lambda value, *_: value)
    return module


@pytest.mark.parametrize("entry", formats.FORMATS, ids=lambda entry: entry.name)
def test_each_line_of_the_registry_is_true(entry):
    module = import_module(f"shapespline.formats.{entry.module}")
    assert entry.reads or entry.writes
    assert not entry.reads or callable(module.read)
    assert not entry.writes or callable(module.encode)
    assert all(suffix == suffix.lower() and suffix.startswith(".") for suffix in entry.suffixes)


def test_no_ending_is_registered_twice():
    for role in ("reads", "writes"):
        suffixes = [s for entry in formats.FORMATS if getattr(entry, role) for s in entry.suffixes]
        assert len(suffixes) == len(set(suffixes))


def test_the_ending_decides_whatever_its_case(tmp_path):
    for name in ("a.csv", "A.CSV", "b.Dat", "c.x.xy"):
        (tmp_path / name).write_text(SQUARE)
        assert len(read(tmp_path / name).longest) == 4
        assert len(read(str(tmp_path / name)).longest) == 4


@pytest.mark.parametrize("name", ["leaf.foo", "leaf", "leaf.csv.", ".csv"])
def test_unknown_endings_are_told_the_known_ones(name):
    with pytest.raises(UnknownFormatError, match="no reader") as caught:
        read(name)
    assert all(suffix in str(caught.value) for suffix in readable())
    with pytest.raises(UnknownFormatError, match="no writer") as caught:
        write(name, None)
    assert all(suffix in str(caught.value) for suffix in writable())


def test_options_are_checked_by_name(tmp_path, fake):
    path = tmp_path / "square.csv"
    path.write_text(SQUARE)
    with pytest.raises(
        InvalidInputError,
        match=r"level is not an option for square\.csv: \.csv files take closed, y_down",
    ):
        read(path, level=3)
    with pytest.raises(InvalidInputError, match="closed is not an option"):
        read(tmp_path / "leaf.png", closed=True)
    with pytest.raises(InvalidInputError, match="take no options"):
        read(tmp_path / "leaf.fake", y_down=True)
    with pytest.raises(InvalidInputError, match=r"colours .* take colour, digits"):
        write(tmp_path / "leaf.fake", "leaf", colours="red")
    assert fake.calls == []
    assert read(path, level=None, min_area=None).longest.closed  # None: not given


def test_what_cannot_be_read_is_said_in_a_sentence(tmp_path, monkeypatch):
    with pytest.raises(FormatError, match=r"gone\.csv: there is no such file"):
        read(tmp_path / "gone.csv")
    (tmp_path / "folder.csv").mkdir()
    with pytest.raises(FormatError, match=r"folder\.csv: it is a folder"):
        read(tmp_path / "folder.csv")
    for name in ("empty.csv", "empty.png", "empty.npy"):
        (tmp_path / name).touch()
        with pytest.raises(FormatError, match="the file is empty"):
            read(tmp_path / name)
    path = tmp_path / "secret.csv"
    path.write_text(SQUARE)

    def refuse(self):
        raise PermissionError(13, "Permission denied", str(self))

    monkeypatch.setattr(Path, "read_bytes", refuse)
    with pytest.raises(FormatError, match=r"cannot read .*secret\.csv: Permission denied$"):
        read(path)


def test_outlines_are_read_without_the_picture_library(tmp_path):
    (tmp_path / "square.csv").write_text(SQUARE)
    program = (
        "import sys; from shapespline import formats; formats.read('square.csv');"
        " sys.exit(any(name in sys.modules for name in ('PIL', 'contourpy', 'scipy')))"
    )
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    subprocess.run([sys.executable, "-c", program], cwd=tmp_path, env=environment, check=True)


def test_write_encodes_with_the_options_given(tmp_path, fake):
    path = tmp_path / "leaf.FAKE"
    write(path, "leaf", colour="red", digits=None)
    assert path.read_bytes() == b"leaf 17 red"
    assert names(tmp_path) == ["leaf.FAKE"]


def test_nothing_is_encoded_for_a_folder_that_does_not_exist(tmp_path, fake):
    with pytest.raises(FormatError, match=r"the folder .*out does not exist; create it first"):
        write(tmp_path / "out" / "leaf.fake", "leaf")
    (tmp_path / "file").touch()
    with pytest.raises(FormatError, match="is not a folder"):
        write(tmp_path / "file" / "leaf.fake", "leaf")
    (tmp_path / "leaf.fake").mkdir()
    with pytest.raises(FormatError, match="it is a folder"):
        write(tmp_path / "leaf.fake", "leaf")
    assert fake.calls == []


@pytest.mark.parametrize("failure", [FormatError("no"), KeyboardInterrupt(), MemoryError()])
def test_a_failing_encoder_leaves_the_old_file(tmp_path, fake, failure):
    path = tmp_path / "leaf.fake"
    path.write_bytes(b"old")
    with pytest.raises(type(failure)):
        write(path, failure)
    assert path.read_bytes() == b"old"
    assert names(tmp_path) == ["leaf.fake"]


@pytest.mark.parametrize("step", ["fsync", "replace"])
@pytest.mark.parametrize(
    ("failure", "raised"),
    [
        (OSError(28, "No space left on device"), FormatError),
        (KeyboardInterrupt(), KeyboardInterrupt),
    ],
)
def test_a_failing_write_leaves_the_old_file(tmp_path, monkeypatch, step, failure, raised):
    path = tmp_path / "leaf.bin"
    path.write_bytes(b"old")

    def fail(*_):
        assert len(names(tmp_path)) == 2  # the temporary is in the same folder
        raise failure

    monkeypatch.setattr(*((atomic.os, "fsync") if step == "fsync" else (Path, "replace")), fail)
    with pytest.raises(raised, match="No space left" if raised is FormatError else None):
        write_atomically(path, b"new")
    assert path.read_bytes() == b"old"
    assert names(tmp_path) == ["leaf.bin"]


def test_permissions_are_the_usual_ones_or_those_of_the_old_file(tmp_path):
    mask = os.umask(0o027)
    try:
        write_atomically(tmp_path / "new", b"new")
    finally:
        os.umask(mask)
    assert stat.S_IMODE((tmp_path / "new").stat().st_mode) == 0o640
    (tmp_path / "new").chmod(0o604)
    write_atomically(tmp_path / "new", b"newer")
    assert stat.S_IMODE((tmp_path / "new").stat().st_mode) == 0o604
    assert (tmp_path / "new").read_bytes() == b"newer"


def test_a_write_protected_file_is_left_alone(tmp_path, monkeypatch):
    path = tmp_path / "keep"
    path.write_bytes(b"old")
    monkeypatch.setattr(atomic.os, "access", lambda *_: False)  # the superuser may do anything
    with pytest.raises(FormatError, match="write-protected"):
        write_atomically(path, b"new")
    assert path.read_bytes() == b"old"


def test_a_link_keeps_pointing_to_its_target(tmp_path):
    (tmp_path / "real").mkdir()
    target, link = tmp_path / "real" / "leaf", tmp_path / "link"
    target.write_bytes(b"old")
    link.symlink_to(target)
    write_atomically(link, b"new")
    assert link.is_symlink()
    assert target.read_bytes() == b"new"


def test_a_pipe_is_written_to_and_not_replaced(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    received = []
    reader = threading.Thread(target=lambda: received.append(pipe.read_bytes()), daemon=True)
    reader.start()
    write_atomically(pipe, b"data")
    reader.join(timeout=10)
    assert received == [b"data"]
    assert stat.S_ISFIFO(pipe.stat().st_mode)


def test_a_format_of_a_missing_extra_is_refused_before_any_work(monkeypatch, tmp_path, shapespline):
    needed = [entry for entry in FORMATS if entry.needs]
    assert {entry.needs[1] for entry in needed} == {"dxf", "cad", "rhino", "fonts"}
    for entry in needed:
        module, extra = entry.needs
        with monkeypatch.context() as without:
            for name in (module.partition(".")[0], module):
                without.setitem(sys.modules, name, None)
            said = rf'need the extra {extra}: pip install "shapespline\[{extra}\]"'
            path = tmp_path / f"x{entry.suffixes[0]}"
            with pytest.raises(MissingExtraError, match=said):
                read(path) if entry.reads else check_output(path)
            # Said before the input is looked at, which is not there.
            code, _, err = shapespline("fit", tmp_path / "none.csv", "-o", path)
            assert (code, err.count("\n")) == (1, 1)
            assert "pip install" in err


def test_what_is_no_path_is_refused(blob):
    with pytest.raises(InvalidInputError, match="path must be a path, got Contour; the path comes"):
        write(blob, "x.svg")

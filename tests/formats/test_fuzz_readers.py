"""Damaged files: every reader returns something or says in a sentence why not."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import warnings
from importlib.util import find_spec
from types import SimpleNamespace

import numpy as np
import pytest
from benchmarks.fuzz import child
from benchmarks.fuzz.__main__ import fuzzed
from benchmarks.fuzz.child import outcome
from benchmarks.fuzz.mutate import mutated
from benchmarks.fuzz.seeds import endings
from benchmarks.fuzz.seeds import sound as sound_files
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image
from tests.support.make_fit import fit_of, nested, wave

import shapespline as ss
from shapespline.values.drawing import Drawing


def valid(folder, ending):
    """Bytes of a sound file."""
    path = folder / f"sound.{ending}"
    if ending == "npy":
        np.save(path, wave().control_points)
    elif ending in ("png", "jpg", "tif", "bmp"):
        image = np.full((24, 24), 255, dtype=np.uint8)
        image[6:18, 6:18] = 0
        Image.fromarray(image).save(path)
    else:
        ss.write(path, Drawing([fit_of(wave())]) if ending == "step" else nested())
    return path.read_bytes()


@st.composite
def damage(draw):
    """What to do to a file: cut it, overwrite, insert or take out some bytes, several times."""
    return draw(
        st.lists(
            st.tuples(
                st.sampled_from(["cut", "set", "insert", "remove", "repeat"]),
                st.floats(0, 1),
                st.binary(min_size=1, max_size=8),
            ),
            min_size=1,
            max_size=4,
        )
    )


def damaged(data, steps):
    for kind, part, new in steps:
        at = int(part * len(data))
        if kind == "cut":
            data = data[:at]
        elif kind == "set":
            data = data[:at] + new + data[at + len(new) :]
        elif kind == "insert":
            data = data[:at] + new + data[at:]
        elif kind == "remove":
            data = data[:at] + data[at + len(new) :]
        else:
            data = data[:at] + data[at // 2 : at] + data[at:]
    return data


PLAIN = ["csv", "npy", "json", "geojson", "png", "jpg", "tif", "bmp"]


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    folder = tmp_path_factory.mktemp("sound")
    return {ending: valid(folder, ending) for ending in PLAIN}


@pytest.mark.parametrize("ending", PLAIN)
@settings(max_examples=60)
@given(steps=damage())
@pytest.mark.slow
def test_damaged_files(sound, tmp_path_factory, ending, steps):
    path = tmp_path_factory.mktemp("damaged") / f"damaged.{ending}"
    path.write_bytes(damaged(sound[ending], steps))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        said = ""
        try:
            held = ss.read(path)
        except ss.ShapesplineError as error:
            held, said = (), str(error)
    assert len(held) >= 1 or len(said) > 10


# Libraries written in C++ read these: a crash would take the tests along, so they run elsewhere.
BATCH = """
import random, sys, pathlib, warnings
import shapespline as ss
warnings.simplefilter("ignore")
sound, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
data, rng, said = sound.read_bytes(), random.Random(7), 0
for example in range(40):
    broken = bytearray(data)
    for _ in range(rng.randint(1, 6)):
        kind, at = rng.choice("csir"), rng.randrange(len(broken))
        if kind == "c":
            del broken[max(at, 1):]
        elif kind == "s":
            broken[at] = rng.randrange(256)
        elif kind == "i":
            broken[at:at] = bytes([rng.randrange(256)])
        else:
            del broken[at:at + 3]
    path = folder / f"broken{sound.suffix}"
    path.write_bytes(bytes(broken))
    print("reading", example, flush=True)
    try:
        ss.read(path)
    except ss.ShapesplineError:
        said += 1
print("said", said)
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("ending", "module"), [("step", "OCP"), ("iges", "OCP"), ("3dm", "rhino3dm")]
)
def test_damaged_cad_files(tmp_path, ending, module):
    if find_spec(module) is None:
        pytest.skip(f"{module} is not installed")
    valid(tmp_path, ending)
    done = subprocess.run(
        [sys.executable, "-c", BATCH, str(tmp_path / f"sound.{ending}"), str(tmp_path)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout[-200:] + done.stderr[-500:]
    assert int(done.stdout.split("said")[1]) > 0


@pytest.mark.parametrize(
    "ending", ["csv", "npy", "json", "geojson", "svg", "dxf", "step", "iges", "3dm"]
)
def test_a_picture_under_another_name(tmp_path, sound, ending):
    path = tmp_path / f"picture.{ending}"
    path.write_bytes(sound["png"])
    with pytest.raises(ss.ShapesplineError) as caught:
        ss.read(path)
    assert "picture" in str(caught.value)


@pytest.mark.parametrize("ending", [*PLAIN, "svg", "dxf", "step", "iges", "3dm"])
def test_empty_files_and_folders(tmp_path, ending):
    path = tmp_path / f"empty.{ending}"
    path.write_bytes(b"")
    with pytest.raises(ss.FormatError, match="the file is empty"):
        ss.read(path)
    folder = tmp_path / f"folder.{ending}"
    folder.mkdir()
    with pytest.raises(ss.FormatError, match="it is a folder"):
        ss.read(folder)


def test_names_with_blanks_and_letters_of_any_script(tmp_path):
    folder = tmp_path / "Ordner mit Blättern 葉"
    folder.mkdir()
    for ending in ("json", "svg", "dxf", "csv", "pdf", "step"):
        path = folder / f"größe – 叶 no. 1.{ending}"
        ss.write(path, nested())
        if ending != "pdf":
            assert len(ss.read(path)) == len(nested())


def test_a_full_disk_leaves_the_old_file(tmp_path, monkeypatch):
    path = tmp_path / "old.svg"
    path.write_text("old")

    def no_space(descriptor):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.fsync", no_space)
    with pytest.raises(ss.FormatError, match="No space left on device"):
        ss.write(path, nested())
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


# A second for most formats: the process starts, and libraries with it.
@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("ending", endings())
def test_fuzzed_files(ending):
    assert all(len(ss.read(data, format=f".{ending}")) for data in sound_files(ending))
    counts, faults = fuzzed(ending, first=1_000_000, seconds=1.5)
    assert counts["said"] > 0
    assert not counts["FAULT"], faults


def test_the_fuzzer_sees_what_is_wrong(monkeypatch):
    def broken(data, format):
        raise KeyError("x")

    assert outcome(b"0,0\n1,0", "csv") == "read"
    assert outcome(b"\0", "csv") == "said"
    monkeypatch.setattr(ss, "read", broken)
    assert outcome(b"0,0", "csv") == "FAULT KeyError: 'x'"
    monkeypatch.setattr(ss, "read", lambda data, format: ())
    assert outcome(b"0,0", "csv").startswith("FAULT nothing was read")
    assert mutated([b"12,3"], "csv", 5) == mutated([b"12,3"], "csv", 5)
    assert len({mutated([b"12,3"], "csv", seed) for seed in range(30)}) > 10


# A clock of its own: the seconds of a busy machine decide nothing here.
@pytest.mark.parametrize(
    ("file", "calls", "seconds", "found"),
    [
        ("occ.py", 1, 15.0, "library"),  # one call, from which nothing is heard
        ("occ.py", 150, 0.1, "FAULT more than 10 s"),  # a loop of short calls
        ("csv.py", 1, 15.0, "FAULT more than 10 s"),  # a call that is ours
        ("occ.py", 1, 5.0, "said"),
    ],
)
def test_the_fuzzer_tells_a_slow_reader_from_a_library_that_hangs(
    monkeypatch, file, calls, seconds, found
):
    now = [0.0]
    held = {"now": now, "signal": signal, "Said": ss.FormatError}
    source = (
        "def read(data, format):\n"
        f"    for _ in range({calls}):\n"
        f"        now[0] += {seconds}\n"
        "        signal.raise_signal(signal.SIGALRM)\n"
        "    raise Said('refused in a sentence')"
    )
    exec(compile(source, f"/x/formats/{file}", "exec"), held)
    monkeypatch.setattr(child, "time", SimpleNamespace(monotonic=lambda: now[0]))
    monkeypatch.setattr(ss, "read", held["read"])
    assert outcome(b"0,0", "step") == found


# Where a process that ends stood is told by its innermost frame of Python.
END = """
import faulthandler, os
faulthandler.enable()
print("reading 7", flush=True)
exec(compile("def read(): os.abort()", {file!r}, "exec"), globals())
read()
"""


@pytest.mark.parametrize(("file", "blamed"), [("occ.py", "library"), ("svg_tree.py", "FAULT")])
def test_the_fuzzer_tells_whose_end_it_was(monkeypatch, file, blamed):
    code, run = END.format(file=f"/x/formats/{file}"), subprocess.run
    monkeypatch.setattr(
        subprocess, "run", lambda _, **how: run([sys.executable, "-c", code], **how)
    )
    counts, faults = fuzzed("step", first=7, seconds=1e-3)
    assert (set(counts), set(faults.values())) == ({blamed}, {7})


def test_json_of_absurd_depth_and_size(tmp_path):
    path = tmp_path / "deep.json"
    for text in ("[" * 200_000, json.dumps({"shapespline": 1, "fits": [{}] * 9}), "1e999", "null"):
        path.write_text(text)
        with pytest.raises(ss.ShapesplineError):
            ss.read(path)

"""Files are read in a process of their own: ended at once, within a time, without harm."""

import os
import signal
import tempfile
import threading
import time

import numpy as np
import pytest

import shapespline as ss
from shapespline.studio import reading
from shapespline.studio.documents import opened
from shapespline.studio.jobs import Cancelled, Ticket
from shapespline.studio.reading import Readers

pytestmark = pytest.mark.slow

SQUARE = b"0,0\n1,0\n1,1\n0,1\n"
# Three million points take more than a second.
T = np.linspace(0, 2 * np.pi, 3_000_000, endpoint=False)


@pytest.fixture
def readers():
    made = Readers()
    yield made
    made.close()


@pytest.fixture(scope="module")
def large():
    return "".join(f"{x:.6f},{y:.6f}\n" for x, y in zip(np.cos(T), np.sin(T), strict=True)).encode()


def test_a_file_is_read_as_ever_and_its_errors_are_the_programs_sentences(readers):
    expected = opened("square.csv", SQUARE, {})
    document = readers.opened("../square.csv", SQUARE, {}, Ticket(1))
    assert document.shape == expected.shape
    assert (document.name, document.sentences) == (expected.name, expected.sentences)
    process = readers._idle
    for name, content, said in [
        ("empty.csv", b"", r"^cannot read empty\.csv: the file is empty$"),
        ("logo.png", b"no picture", r"^logo\.png: not a PNG"),
        ("logo.exe", b"MZ", "no reader for this ending"),
    ]:
        with pytest.raises(ss.FormatError, match=said):
            readers.opened(name, content, {}, Ticket(1))
    # None of this was a reason to begin another process.
    assert readers._idle is process


def test_reading_that_is_not_wanted_ends_at_once_and_leaves_nothing(
    readers, large, tmp_path, monkeypatch
):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    said = []
    ticket = Ticket(1, said.append)

    def cancel():
        while not list(tmp_path.glob("*/*/large.csv")):
            time.sleep(0.01)
        time.sleep(0.5)
        cancelled.append(time.monotonic())
        ticket.end()

    cancelled = []
    threading.Thread(target=cancel).start()
    with pytest.raises(Cancelled):
        readers.opened("large.csv", large, {}, ticket)
    # Two looks at whether it is wanted, and the end of a process.
    assert time.monotonic() - cancelled[0] < 1.0
    assert said[0].startswith("reading large.csv for ")
    assert list(tmp_path.iterdir()) == []


def test_a_library_that_dies_or_hangs_ends_only_the_reading_of_that_file(
    readers, large, monkeypatch
):
    readers.prepare()
    first = readers._idle
    threading.Timer(0.1, lambda: os.kill(first.pid, signal.SIGKILL)).start()
    with pytest.raises(ss.FormatError, match=r"^large\.csv: a library ended while"):
        readers.opened("large.csv", large, {}, Ticket(1))
    monkeypatch.setattr(reading, "MOST_SECONDS", 0.3)
    with pytest.raises(ss.FormatError, match="must be read within 0 s"):
        readers.opened("large.csv", large, {}, Ticket(2))
    monkeypatch.setattr(reading, "MOST_SECONDS", 60.0)
    assert len(readers.opened("square.csv", SQUARE, {}, Ticket(3)).shape) == 1

"""A real cluster on this machine: two worker processes, one of them killed while it works."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from tests.support.shapes import outlines

import shapespline as ss
from shapespline.streaming.stream import CHUNK

pytestmark = [
    pytest.mark.slow,
    # A worker that is killed on purpose leaves its sockets to the garbage collector.
    pytest.mark.filterwarnings("ignore::ResourceWarning"),
    pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning"),
]


@pytest.fixture(scope="module")
def cluster():
    distributed = pytest.importorskip("dask.distributed", reason="needs shapespline[cluster]")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
    ) as running:
        yield running


class KillOneWorker:
    """A progress callback that kills a worker once, and sees that another took its place."""

    def __init__(self, client):
        self._client, self._killed = client, threading.Event()
        self._before = self._workers()

    def __call__(self, done, total):
        if not self._killed.is_set():
            self._killed.set()
            os.kill(next(iter(self._workers())), signal.SIGKILL)

    def check(self):
        self._client.wait_for_workers(2, timeout=60)
        assert self._killed.is_set()
        assert self._workers() != self._before

    def _workers(self):
        return set(self._client.run(os.getpid).values())


def test_a_killed_worker_loses_nothing(cluster):
    given = [*outlines(1200), np.zeros((2, 2))]
    alone = ss.fit_many(given, n_control_points=9)
    with cluster.get_client() as client:
        kill_one = KillOneWorker(client)
        together = ss.fit_many(given, executor=client, progress=kill_one, n_control_points=9)
        kill_one.check()
    assert sorted(together.failures) == sorted(alone.failures) == [1200]
    for mine, theirs in zip(alone.fits[:1200], together.fits[:1200], strict=True):
        assert_array_equal(mine.control_points, theirs.control_points)


@pytest.mark.parametrize("asked", [{"tolerance": 0.005}, {"n_control_points": 40}])
def test_one_outline_whose_blocks_lie_on_the_cluster(cluster, asked):
    dask_array = pytest.importorskip("dask.array")
    t = 2 * np.pi * dask_array.arange(3_000_000, chunks=CHUNK) / 3_000_000
    r = 3 + dask_array.cos(5 * t)
    blocks = dask_array.stack([r * dask_array.cos(t), r * dask_array.sin(t)], axis=1)
    alone = ss.fit_large(blocks.compute(), **asked)
    with cluster.get_client() as client:
        kill_one = KillOneWorker(client)
        together = ss.fit_large(blocks, progress=kill_one, **asked)
        kill_one.check()
    assert together.kept
    assert_array_equal(together.control_points, alone.control_points)
    assert together.max_distance == alone.max_distance
    assert together.rms_distance == alone.rms_distance


def test_the_command_line_uses_a_scheduler(cluster, tmp_path):
    folder = tmp_path / "in"
    folder.mkdir()
    for index, contour in enumerate(outlines(4)):
        np.savetxt(folder / f"{index}.csv", contour.points, delimiter=",")
    (folder / "broken.csv").write_text("1,2\n3,x\n")
    arguments = [sys.executable, "-m", "shapespline", "fit", str(folder), "-f", "svg", "-n", "9"]
    for name, extra in (
        ("alone", []),
        ("cluster", ["--scheduler", cluster.scheduler_address]),
    ):
        done = subprocess.run(
            [*arguments, "-o", str(tmp_path / name), *extra],
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 1
        assert "line 2" in done.stderr
        assert "Traceback" not in done.stderr
    names = sorted(path.name for path in (tmp_path / "alone").iterdir())
    assert len(names) == 4
    for name in names:
        alone, together = (Path(tmp_path, where, name) for where in ("alone", "cluster"))
        assert alone.read_bytes() == together.read_bytes()


def test_no_scheduler_is_a_sentence(tmp_path):
    done = subprocess.run(
        [sys.executable, "-m", "shapespline", "fit", __file__, "-o", str(tmp_path / "x.svg"),
         "--scheduler", "tcp://127.0.0.1:1"],
        capture_output=True,
        text=True,
        check=False,
    )  # fmt: skip
    assert done.returncode == 1
    assert "no scheduler answers at tcp://127.0.0.1:1" in done.stderr
    assert "Traceback" not in done.stderr

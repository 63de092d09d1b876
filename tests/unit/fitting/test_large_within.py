"""fit_large within a tolerance: the promise over all points, and little memory."""

import subprocess
import sys

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from tests.support.scattered import N, rose

import shapespline as ss
from checks import two_sided
from shapespline.streaming.stream import CHUNK


def square(n):
    side = np.linspace(0, 1, n // 4, endpoint=False)
    x = np.concatenate([side, 1 + 0 * side, 1 - side, 0 * side])
    return np.column_stack([x, np.roll(x, n // 4)])


def checked(fit, points, tolerance):
    """The promise from outside, on every so many-th point."""
    assert fit.kept, fit.status.value
    assert fit.hausdorff_distance <= tolerance == fit.tolerance
    some = points[:: len(points) // 4000]
    found = two_sided(fit.curve, some, closed=fit.closed, step=tolerance / 10)
    # Some points are a part of all: none of them may be farther away.
    assert found.forward <= fit.max_distance * (1 + 1e-9)
    return found


@pytest.mark.slow
def test_clean_points():
    points = rose(N)
    fit = ss.fit_large(points, tolerance=0.1)
    found = checked(fit, points, 0.1)
    # Chords between some of the points leave the outline by less than this.
    assert found.reverse <= fit.hausdorff_distance + 1e-3
    assert fit.closed
    assert fit.n_points == N
    assert len(fit.contour) < 5000
    assert fit.n_stored_points <= 1.1 * ss.fit_curve(points[::100], tolerance=0.1).n_stored_points


def test_corners_and_straight_sides():
    fit = ss.fit_large(square(400_000), tolerance=1e-3)
    assert fit.kept
    assert [piece.kind for piece in fit.pieces] == ["line"] * 4
    corners = np.array([piece.control_points[0] for piece in fit.pieces])
    true = np.array([(0, 0), (1, 0), (1, 1), (0, 1)])
    assert max(np.hypot(*(corners - corner).T).min() for corner in true) <= 1e-3


def test_open_points_with_a_corner():
    x = np.linspace(-1, 1, 300_001)
    points = np.column_stack([x, np.abs(x) + 0.1 * np.sin(3 * x)])
    fit = ss.fit_large(points, tolerance=0.002)
    checked(fit, points, 0.002)
    assert not fit.closed
    assert len(fit.corners) == 1
    assert fit.curve(fit.corners[0]) == pytest.approx([0, 0], abs=0.003)


@pytest.mark.parametrize("noise", [0.005, 0.02])
@pytest.mark.slow
def test_points_that_scatter(noise):
    points = rose(N, noise)
    fit = ss.fit_large(points, tolerance=0.15)
    checked(fit, points, 0.15)
    # The true outline lies deep inside of the band: the averages show it.
    truth = two_sided(fit.curve, rose(4000), closed=True, step=0.01)
    assert truth.larger <= 0.15
    assert fit.n_stored_points <= 60


@pytest.mark.slow
def test_points_that_scatter_by_more_than_the_tolerance():
    with pytest.raises(ss.InvalidInputError, match="they scatter by about 0"):
        ss.fit_large(rose(N, 0.1), tolerance=0.05)


@pytest.mark.slow
def test_the_curve_of_all_in_memory_is_no_other_promise():
    points = rose(60_000, 0.01)
    fit = ss.fit_curve(points, tolerance=0.1)
    found = two_sided(fit.curve, points, closed=True, step=0.01)
    assert found.larger <= fit.hausdorff_distance * (1 + 1e-9) <= 0.1


def test_feet_are_found_when_they_are_asked_for():
    points = rose(N)
    fit = ss.fit_large(points, tolerance=0.1)
    every = np.asarray(fit.feet)
    assert every.shape == fit.feet.shape == (N,)
    at = np.array([0, 1, 1000, CHUNK - 1, CHUNK, N - 1])
    off = np.hypot(*(fit.curve(every[at]) - points[at]).T)
    assert off.max() <= fit.max_distance
    # Newton's method begins elsewhere in another slice, and ends within its own last step.
    for part in (slice(10, 20), slice(CHUNK - 5, CHUNK + 5), slice(50, 10, -3), slice(5, 5)):
        assert fit.feet[part] == pytest.approx(every[part], abs=1e-9)
    assert fit.feet[-1] == pytest.approx(every[-1], abs=1e-9)
    assert next(iter(fit.feet)) == every[0]
    with pytest.raises(IndexError):
        fit.feet[N]


def test_progress_and_cancelling():
    points, seen = rose(N), []
    ss.fit_large(points, tolerance=0.1, progress=lambda done, total: seen.append((done, total)))
    assert [total for _, total in seen] == [3 * N] * 3 * -(-N // CHUNK)
    assert seen[-1][0] == 3 * N
    with pytest.raises(ss.ShapesplineError, match=f"cancelled by the callback after {CHUNK}"):
        ss.fit_large(points, tolerance=0.1, progress=lambda done, total: True)


@pytest.mark.slow
def test_it_can_be_written_and_read_again(tmp_path):
    fit = ss.fit_large(rose(N), tolerance=0.1)
    ss.write(tmp_path / "rose.json", ss.Drawing([fit]))
    (again,) = ss.read(tmp_path / "rose.json")
    assert_array_equal(again.control_points, fit.control_points)
    assert again.hausdorff_distance == fit.hausdorff_distance


@pytest.mark.parametrize(
    ("points", "options", "message"),
    [
        ([(0, 0), (1, 1)], {}, "must be an array in memory, on disk or of dask, got list"),
        (np.zeros((2, 5)), {}, r"shape \(n, 2\), got \(2, 5\)"),
        (np.zeros((5, 2), dtype=complex), {}, "real numbers, got dtype complex"),
        (np.zeros((0, 2)), {}, "at least 2 distinct points, got none"),
        (np.zeros((9, 2)), {}, r"at least 2 distinct points, got 1 \(of 9 given\)"),
        (np.array([(0.0, 0), (1, np.nan), (2, 0)]), {}, r"finite, got \[1.0, nan\] at index 1"),
        (square(400), {"tolerance": -1.0}, "tolerance must be a positive length"),
        (square(400), {"tolerance": "wide"}, "tolerance must be a positive length"),
        (square(400), {"corners": [1, 2]}, "corners must be 'auto', 'free' or None"),
        (square(400), {"form": "pearls"}, "form must be one of"),
        (square(400), {"degree": 12}, "degree"),
        (square(400), {"time_limit": 0}, "time_limit"),
    ],
)
def test_bad_arguments(points, options, message):
    with pytest.raises(ss.ShapesplineError, match=message):
        ss.fit_large(points, **{"tolerance": 0.1} | options)


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="peak memory is read from /proc")
def test_a_file_is_not_held_in_memory(tmp_path):
    path, n = tmp_path / "points.npy", 16_000_000
    shape = np.lib.format.open_memmap(path, mode="w+", dtype=np.float64, shape=(n, 2))
    shape[:] = rose(n)
    del shape
    code = (
        "import numpy as np, shapespline as ss\n"
        "def high():\n"
        "    lines = open('/proc/self/status').read().splitlines()\n"
        "    return 1024 * int(next(l for l in lines if l.startswith('VmHWM')).split()[1])\n"
        f"points = np.load({str(path)!r}, mmap_mode='r')\n"
        "ss.fit_large(points[:400_000], tolerance='0.1%')\n"
        "before = high()\n"
        "assert ss.fit_large(points, tolerance='0.1%').kept\n"
        "print(high() - before)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    # The file has 256 million bytes.
    assert int(done.stdout) < 64_000_000


def test_repeated_points_in_memory_have_parameters_too():
    points = np.repeat(rose(150_000), 2, axis=0)
    with pytest.warns(ss.DroppedPointsWarning):
        fit = ss.fit_curve(points, closed=True, tolerance=0.1)
    assert len(fit.parameters) == 300_000
    assert_array_equal(fit.parameters[::2], fit.parameters[1::2])

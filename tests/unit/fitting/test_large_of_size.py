"""fit_large at a number of control points: least squares over all points of a stream."""

import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from tests.support.scattered import N, ring, wave

import shapespline as ss
from checks import distance_to_polyline, polyline_of, two_sided
from shapespline.engines.least_squares.streamed import MOST_PASSES
from shapespline.geometry.nearest import nearest
from shapespline.streaming.stream import CHUNK
from shapespline.values.contour import Contour


def off(fit, truth):
    """Root mean square of the distances from places of the true curve."""
    return float(np.sqrt(nearest(fit.spline, truth).distances_sq.mean()))


@pytest.mark.slow
@pytest.mark.parametrize("closed", [True, False])
def test_all_points_tell_more_than_a_sample(closed):
    points, truth = ((ring if closed else wave)(n, noise) for n, noise in ((N, 0.1), (20_000, 0)))
    fit = ss.fit_large(points, n_control_points=60)
    sample = ss.fit_curve(points[:: -(-N // 20_000)], n_control_points=60, closed=closed)
    assert fit.closed == closed
    # 14 times as many points: 3.7 times nearer, were it for the noise alone.
    assert off(fit, truth) < 0.5 * off(sample, truth)
    assert fit.rms_distance == pytest.approx(0.1, rel=0.01)
    # It does not wind about in the band of the points to be near to each of them.
    line = np.concatenate([truth, truth[:1]]) if closed else truth
    assert distance_to_polyline(polyline_of(fit.curve), line).max() < 0.05
    # Certified for all of them, of which these are some.
    some = two_sided(fit.curve, points[::99], closed=closed, step=0.02)
    assert some.forward <= fit.max_distance * (1 + 1e-9)
    assert fit.max_distance <= fit.hausdorff_distance == fit.tolerance < 1.0


@pytest.mark.slow
def test_the_curve_does_not_fly_where_the_points_leave_a_gap():
    arc, span = ring(60_000)[:36_000], 20.0  # the closing side is as long
    fit = ss.fit_large(arc, n_control_points=20, closed=True)
    # The sample alone, held by the same residuals, strays as far.
    sample = ss.fit_curve(arc[::2], n_control_points=20, closed=True)
    assert fit.hausdorff_distance < 1.5 * sample.hausdorff_distance < 0.1 * span


@pytest.mark.slow
def test_clean_points_are_fitted_as_a_sample_of_them():
    fit = ss.fit_large(ring(N), n_control_points=40)
    sample = ss.fit_curve(ring(5000), n_control_points=40, closed=True)
    assert fit.n_control_points == 40
    assert fit.rms_distance == pytest.approx(sample.rms_distance, rel=0.01)
    assert fit.status == ss.Status.KEPT
    assert fit.n_points == N == len(fit.feet)


@pytest.mark.slow
def test_open_ends_do_not_turn_back_to_noisy_points():
    fit = ss.fit_large(wave(N, 0.1), n_control_points=50)
    begin, _, end = fit.curve([0.0, 0.5, 1.0])
    # The first and the last point miss these by 0.1 as a rule, and hundreds lie beyond.
    assert_allclose([begin[0], end[0]], [0, 20], rtol=0, atol=0.3)
    assert (np.diff(fit.curve(np.linspace(0, 1, 20_000))[:, 0]) > 0).all()


@pytest.mark.slow
def test_a_first_point_repeated_as_the_last_changes_nothing():
    points = ring(19_999)  # every point is one of the sample
    fit = ss.fit_large(points, n_control_points=40, closed=True)
    again = ss.fit_large(np.concatenate([points, points[:1]]), n_control_points=40, closed=True)
    assert_allclose(again.control_points, fit.control_points, rtol=0, atol=1e-3)
    assert again.max_distance == pytest.approx(fit.max_distance, rel=0.01)


@pytest.mark.slow
def test_threads_and_blocks_give_the_same_bits(tmp_path):
    points = ring(N, 0.05).astype(np.float32)
    np.save(tmp_path / "points.npy", points)
    alone = ss.fit_large(points, n_control_points=40)
    with ThreadPoolExecutor(3) as pool:
        others = [ss.fit_large(points, n_control_points=40, executor=pool)]
    mapped = np.load(tmp_path / "points.npy", mmap_mode="r")
    others.append(ss.fit_large(mapped, n_control_points=40))
    for other in others:
        assert_array_equal(other.control_points, alone.control_points)
        assert other.hausdorff_distance == alone.hausdorff_distance


@pytest.mark.slow
def test_progress_cancelling_and_time():
    points, seen = ring(N), []
    ss.fit_large(points, n_control_points=20, progress=lambda *done: seen.append(done))
    assert {total for _, total in seen} == {(3 + MOST_PASSES) * N}
    assert seen[-1][0] == seen[-1][1]
    assert seen == sorted(seen)
    with pytest.raises(ss.ShapesplineError, match=f"cancelled by the callback after {N + CHUNK}"):
        ss.fit_large(points, n_control_points=20, progress=lambda done, total: done > N)
    hurried = ss.fit_large(points, n_control_points=20, time_limit=1e-3)
    assert hurried.status == ss.Status.BUDGET
    assert "the time limit of 0.001 s ran out" in hurried.status.value


@pytest.mark.slow
def test_noise_of_which_no_polyline_of_few_vertices_keeps_near():
    points = ring(N, 0.5)
    fit = ss.fit_large(points, n_control_points=20)
    assert fit.max_distance <= fit.hausdorff_distance < 3 * fit.max_distance


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({}, "within a tolerance or with n_control_points, got none: give one"),
        ({"tolerance": 1.0, "n_control_points": 9}, "got both: give one"),
        ({"n_control_points": 3}, r"n_control_points must be at least degree \+ 1 = 4, got 3"),
        ({"n_control_points": 2.5}, "n_control_points must be an integer, got 2.5"),
        ({"n_control_points": 500}, "n_control_points must be at most 400, .* got 500"),
        ({"n_control_points": 9, "corners": "free"}, "corners does not act with n_control_points"),
        ({"n_control_points": 9, "effort": "fast"}, "effort does not act with n_control_points"),
    ],
)
def test_bad_arguments(options, message):
    with pytest.raises(ss.ShapesplineError, match=message):
        ss.fit_large(ring(400), closed=True, **options)


@pytest.mark.slow
def test_the_command_line_fits_a_large_file_in_passes(tmp_path):
    path, target = tmp_path / "ring.npy", tmp_path / "ring.json"
    np.save(path, ring(2_100_000, 0.05))
    command = [sys.executable, "-m", "shapespline", "fit", str(path), "-n", "40", "-o", str(target)]
    subprocess.run(command, check=True, capture_output=True)
    (fit,) = ss.read(target)
    assert fit.n_control_points == 40
    assert_array_equal(
        fit.control_points, ss.fit_large(ring(2_100_000, 0.05), n_control_points=40).control_points
    )
    assert isinstance(fit.contour, Contour)
    assert len(fit.contour) < 30_000

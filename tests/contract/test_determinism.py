"""The same input gives the same bits, whoever works and in which order."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from tests.support.scattered import N, rose

import shapespline as ss
from shapespline import fit_curve
from shapespline.streaming.stream import CHUNK


def test_repetition_gives_the_same_bits_at_a_size(outline):
    contour = outline("hand620_closed")
    one, two = (fit_curve(contour.points, closed=True, n_control_points=30) for _ in range(2))
    assert_array_equal(one.control_points, two.control_points)
    assert_array_equal(one.parameters, two.parameters)
    assert one.hausdorff_distance == two.hausdorff_distance


def test_repetition_gives_the_same_bits(outline):
    one, two = (fit_curve(outline("leaf840_closed"), tolerance=0.5) for _ in range(2))
    assert_array_equal(one.control_points, two.control_points)
    assert_array_equal(one.knots, two.knots)


@pytest.mark.slow
def test_threads_and_blocks_give_the_same_bits(tmp_path):
    points = rose(N, 0.004).astype(np.float32)
    alone = ss.fit_large(points, tolerance=0.1)
    with ThreadPoolExecutor(3) as pool:
        threads = ss.fit_large(points, tolerance=0.1, executor=pool)
    np.save(tmp_path / "points.npy", points)
    mapped = ss.fit_large(np.load(tmp_path / "points.npy", mmap_mode="r"), tolerance=0.1)
    others = [threads, mapped]
    dask_array = pytest.importorskip("dask.array", reason="needs shapespline[cluster]")
    others.append(ss.fit_large(dask_array.from_array(points, chunks=(CHUNK, 1)), tolerance=0.1))
    for other in others:
        assert_array_equal(other.control_points, alone.control_points)
        assert_array_equal(other.knots, alone.knots)
        assert other.max_distance == alone.max_distance
        assert other.rms_distance == alone.rms_distance
        assert_array_equal(other.feet[5:5000:7], alone.feet[5:5000:7])


@pytest.mark.slow
def test_zarr_arrays_give_the_same_bits(tmp_path):
    zarr = pytest.importorskip("zarr", reason="needs zarr")
    points = rose(N)
    stored = zarr.create_array(tmp_path / "points.zarr", data=points, chunks=(100_000, 2))
    fit = ss.fit_large(stored, tolerance=0.1)
    assert_array_equal(fit.control_points, ss.fit_large(points, tolerance=0.1).control_points)

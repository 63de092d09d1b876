"""fit_many: the same as one by one, whoever works; failures stay with their contour."""

from __future__ import annotations

import pickle
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from tests.support.shapes import outlines

import shapespline as ss
from shapespline.fitting.many import TASK_POINTS


@pytest.mark.parametrize("pool", [ThreadPoolExecutor, ProcessPoolExecutor])
@pytest.mark.slow
def test_an_executor_changes_nothing(pool):
    given = [*outlines(70), np.zeros((3, 2))]  # more than one task
    alone = ss.fit_many(given, n_control_points=9)
    with pool(2) as executor:
        together = ss.fit_many(given, executor=executor, n_control_points=9)
    assert len(alone) == len(together) == 71
    for index in range(70):
        assert_array_equal(alone[index].control_points, together[index].control_points)
    for batch in (alone, together):
        assert batch[70] is None
        assert sorted(batch.failures) == [70]
        assert isinstance(batch.failures[70], ss.DegenerateContourError)


def test_what_goes_between_processes_comes_back_as_it_was():
    contour = next(outlines(1))
    curve = ss.fit_curve(contour, tolerance=0.05, form="spline").spline
    assert curve.periodic
    fresh = next(outlines(1)), ss.BSplineCurve(curve.knots, curve.control_points, 3, periodic=True)
    sizes = [len(pickle.dumps(value)) for value in fresh]
    assert contour.length > 0
    assert len(curve.coefficients) > len(curve.breakpoints) - 1
    assert [len(pickle.dumps(value)) for value in (contour, curve)] == sizes  # nothing derived
    again, curve_again = pickle.loads(pickle.dumps((contour, curve)))
    assert_array_equal(again.points, contour.points)
    assert_array_equal(again.polyline, contour.polyline)
    assert (again.closed, again.n_given, again.accuracy) == (True, contour.n_given, None)
    assert_array_equal(curve_again([0.3, 0.7]), curve([0.3, 0.7]))
    assert curve_again.periodic == curve.periodic
    for array in (again.points, again.source, curve_again.knots, curve_again.control_points):
        assert not array.flags.writeable


def test_one_by_one_is_the_same():
    given = list(outlines(3))
    batch = ss.fit_many(iter(given), tolerance=0.05)
    for contour, fit in zip(given, batch, strict=True):
        assert_array_equal(fit.control_points, ss.fit_curve(contour, tolerance=0.05).control_points)


def test_progress_counts_and_cancels():
    seen = []

    def stop_at_two(done, total):
        seen.append((done, total))
        return done == 2

    batch = ss.fit_many(outlines(5), progress=stop_at_two, n_control_points=8)
    assert seen == [(1, 5), (2, 5)]
    assert [fit is not None for fit in batch] == [True, True, False, False, False]
    assert all("cancelled" in str(batch.failures[index]) for index in (2, 3, 4))


@pytest.mark.slow
def test_cancelling_a_pool_leaves_it_usable():
    with ThreadPoolExecutor(1) as executor:
        batch = ss.fit_many(
            outlines(300), executor=executor, progress=lambda done, total: True, n_control_points=8
        )
        assert executor.submit(int, "7").result() == 7
    done = [index for index, fit in enumerate(batch) if fit is not None]
    assert TASK_POINTS // 90 <= len(done) < 300  # one task of outlines of 90 points
    assert sorted([*done, *batch.failures]) == list(range(300))


def test_a_wrong_option_is_refused_before_any_work():
    with pytest.raises(ss.InvalidInputError, match="tolerence is not an option of a fit"):
        ss.fit_many(outlines(1), tolerence=1)


def test_nothing_to_fit():
    assert len(ss.fit_many([])) == 0


def _dies(contours, options):
    import os

    os._exit(1)


def test_a_worker_that_dies_is_a_failure_of_its_contours(monkeypatch):
    monkeypatch.setattr("shapespline.fitting.many._fit_all", _dies)
    with ProcessPoolExecutor(1) as executor:
        batch = ss.fit_many(outlines(2), executor=executor)
    assert sorted(batch.failures) == [0, 1]

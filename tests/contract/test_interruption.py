"""Progress, cancelling and time limits of a fit, and Ctrl-C inside its loops."""

import signal
import threading
import time

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from tests.support.shapes import flower

from checks import two_sided
from shapespline import Contour, InvalidInputError, Status, fit_curve


def wavy(n=6000):
    """A closed outline with many features: half a second of work at a small tolerance."""
    t = 2 * np.pi * np.arange(n) / n
    r = 10 + np.sin(37 * t) + 0.3 * np.cos(101 * t)
    return Contour(np.column_stack([r * np.cos(t), r * np.sin(t)]), closed=True)


def assert_promise(fit):
    found = two_sided(fit.curve, fit.contour.points, closed=fit.closed, step=fit.tolerance / 4)
    assert found.larger <= fit.hausdorff_distance + 1e-9 * fit.contour.box_diagonal
    assert fit.kept == (fit.hausdorff_distance <= fit.tolerance)


@pytest.mark.parametrize("form", ["pieces", "spline"])
def test_progress_within_a_tolerance_is_told_and_changes_no_bit(outline, form):
    seen = []
    contour = outline("hand620_closed")
    told = fit_curve(contour, tolerance=0.1, form=form, callback=seen.append)
    silent = fit_curve(contour, tolerance=0.1, form=form)
    assert_array_equal(told.control_points, silent.control_points)
    assert_array_equal(told.knots, silent.knots)
    assert 1 <= len(told.history) <= len(seen)
    assert [record.iteration for record in told.history] == list(range(len(told.history)))
    assert [record.cost for record in told.history] == [record.cost for record in silent.history]
    assert told.status == Status.KEPT


@pytest.mark.parametrize("form", ["pieces", "spline"])
@pytest.mark.parametrize("after", [1, 3])
@pytest.mark.slow
def test_a_true_answer_cancels_and_the_result_keeps_the_promise(form, after):
    calls = []

    def enough(record):
        calls.append(record)
        return len(calls) >= after

    fit = fit_curve(wavy(), closed=True, tolerance=0.01, form=form, callback=enough)
    assert fit.status == Status.CANCELLED
    assert "cancelled by the callback" in fit.status.value
    assert len(calls) == after
    assert fit.kept
    assert_promise(fit)


@pytest.mark.parametrize("form", ["pieces", "spline"])
@pytest.mark.slow
def test_a_time_limit_ends_the_search_with_what_there_is(form):
    begin = time.monotonic()
    fit = fit_curve(wavy(), tolerance=0.005, form=form, effort="smallest", time_limit=0.1)
    seconds = time.monotonic() - begin
    assert fit.status == Status.BUDGET
    assert "time limit of 0.1 s ran out" in fit.status.value
    assert fit.kept
    assert_promise(fit)
    # What comes on top, verifying above all, takes a second or two on a busy machine.
    assert seconds < 10


def test_a_time_limit_of_least_squares():
    fit = fit_curve(wavy(2000), n_control_points=200, time_limit=1e-9)
    assert fit.status == Status.BUDGET
    assert "time limit" in fit.status.value
    assert "callback" not in fit.status.value


def test_enough_time_changes_nothing():
    fit = fit_curve(flower(160), tolerance=0.1, time_limit=1e6)
    assert fit.status == Status.KEPT
    assert_array_equal(fit.control_points, fit_curve(flower(160), tolerance=0.1).control_points)


def test_an_error_in_the_callback_comes_through():
    def broken(record):
        if record.seconds > 0.1:
            raise RuntimeError("the window was closed")

    with pytest.raises(RuntimeError, match="the window was closed"):
        fit_curve(wavy(), tolerance=0.005, effort="smallest", callback=broken)


@pytest.mark.parametrize("form", ["pieces", "spline"])
def test_an_interrupt_reaches_into_the_loops(form):
    # Started in the background, as some runners do, the tests would inherit an ignored Ctrl-C.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    timer = threading.Timer(0.1, signal.raise_signal, (signal.SIGINT,))
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            fit_curve(wavy(), tolerance=0.003, form=form, effort="smallest")
    finally:
        timer.cancel()
        signal.signal(signal.SIGINT, before)


@pytest.mark.parametrize("limit", [0, -1.0, float("nan"), "1 s"])
def test_a_bad_time_limit(limit):
    with pytest.raises(InvalidInputError, match="time_limit must be a positive number of seconds"):
        fit_curve(flower(160), tolerance=0.1, time_limit=limit)

"""Monitor: what it tells, and when it ends a search."""

import time

import pytest

from shapespline.errors import InvalidInputError
from shapespline.monitor import End, Monitor


def test_stages_are_recorded_and_numbered():
    seen = []
    monitor = Monitor(seen.append)
    assert not monitor.stage(0)
    assert not monitor.stage(90)
    assert not monitor.ends(70)  # within the second stage: told, not recorded
    assert [(record.iteration, record.cost) for record in seen] == [(0, 0), (1, 90), (1, 70)]
    assert [record.cost for record in monitor.history] == [0, 90]
    assert monitor.ended is None
    seconds = [record.seconds for record in seen]
    assert seconds == sorted(seconds)


def test_a_true_answer_ends_and_nobody_is_asked_again():
    answers = iter([False, True])
    monitor = Monitor(lambda record: next(answers))
    assert [monitor.ends(5) for _ in range(4)] == [False, True, True, True]
    assert monitor.ended is End.CANCELLED


def test_time_runs_out():
    monitor = Monitor(time_limit=0.01)
    assert not monitor.ends(5)
    time.sleep(0.02)
    assert monitor.ends(5)
    assert monitor.ended is End.TIME


def test_who_neither_listens_nor_limits_is_not_called():
    assert Monitor().of_iterations is None
    assert Monitor(lambda record: None).of_iterations is not None
    assert Monitor(time_limit=1.0).of_iterations is not None


@pytest.mark.parametrize("limit", [0, -1.0, float("nan"), "1 s", True])
def test_a_time_limit_is_a_positive_number(limit):
    with pytest.raises(InvalidInputError, match="time_limit must be a positive number of seconds"):
        Monitor(time_limit=limit)

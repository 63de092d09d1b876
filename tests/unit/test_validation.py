"""Arguments: what is a number, an index, a choice; and the sentences for what is none."""

import numpy as np
import pytest

from shapespline.errors import InvalidInputError
from shapespline.validation import (
    checked_choice,
    checked_flag,
    checked_indices,
    float_array,
    is_number,
    median,
    whole_number,
)


@pytest.mark.parametrize(
    ("value", "whole"),
    [(3, 3), (3.0, 3), (np.int64(3), 3), (np.float32(3), 3), (3.5, None), (True, None),
     ("3", None), (None, None), (3 + 0j, None), (float("inf"), None), (float("nan"), None)],
)  # fmt: skip
def test_whole_numbers(value, whole):
    found = whole_number(value)
    assert found == whole
    assert type(found) is type(whole)


def test_numbers():
    assert all(map(is_number, (0, 1.5, np.float32(2), np.int8(3), float("nan"))))
    assert not any(map(is_number, (True, "1", None, 1j, [1])))


@pytest.mark.parametrize("n", [1, 2, 3, 8, 101])
def test_median_is_numpys(n):
    values = np.random.default_rng(n).normal(size=n)
    assert median(values) == np.median(values)


def test_an_array_is_fresh_and_double():
    given = np.arange(6, dtype=np.float64).reshape(3, 2)
    found = float_array(given[:, ::-1], "points")
    assert found.flags.c_contiguous
    assert found.flags.owndata
    assert float_array(np.array([1, 2], dtype=np.int8), "weights").dtype == np.float64
    with pytest.raises(InvalidInputError, match=r"weights must be an array of numbers, got list"):
        float_array([1, [2]], "weights")
    with pytest.raises(InvalidInputError, match="weights must be real, got complex numbers"):
        float_array([1j], "weights")
    with pytest.raises(InvalidInputError, match="weights must be an array of numbers"):
        float_array(np.array(["2024-01-01"], dtype="datetime64[D]"), "weights")


def test_indices_are_sorted_and_each_once():
    assert checked_indices("through", [4, 0, 4.0], "indices").tolist() == [0, 4]
    assert checked_indices("through", 3, "indices").tolist() == [3]
    assert checked_indices("through", [], "indices").dtype == np.int64
    for wrong in ([-1], [0.5], "all", [[1]]):
        with pytest.raises(InvalidInputError, match="through must be indices, got"):
            checked_indices("through", wrong, "indices")


def test_choices_and_flags():
    checked_choice("form", "pieces", ("pieces", "spline"))
    for wrong in ("arcs", None, 3):
        with pytest.raises(InvalidInputError, match="form must be one of pieces, spline, got"):
            checked_choice("form", wrong, ("pieces", "spline"))
    assert checked_flag("symmetric", np.bool_(True)) is True
    for wrong in (1, "yes", None):
        with pytest.raises(InvalidInputError, match="symmetric must be True or False, got"):
            checked_flag("symmetric", wrong)

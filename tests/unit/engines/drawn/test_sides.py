"""What neighbours are off by, on the same side or not."""

from __future__ import annotations

import numpy as np
import pytest

from shapespline.engines.drawn.sides import go_on


def going_on(part, n, seed):
    errors = np.random.default_rng(seed).normal(0, 1, n)
    for k in range(1, n):
        errors[k] = part * errors[k - 1] + (1 - part**2) ** 0.5 * errors[k]
    return errors


def elements(errors, n_each=50):
    return np.split(errors, np.arange(n_each, len(errors), n_each))


@pytest.mark.parametrize("seed", range(10))
def test_independent_errors_do_not_go_on(seed):
    assert not go_on(elements(np.random.default_rng(seed).normal(0, 1, 400)))


@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("part", [0.4, 0.7])
def test_errors_that_are_part_of_those_before_do(seed, part):
    assert go_on(elements(going_on(part, 1000, seed)))


def test_one_element_that_its_points_leave_is_no_error_that_goes_on():
    errors = np.random.default_rng(1).normal(0, 1, 400)
    errors[:120] += 5.0  # a bend read as an edge
    distances = elements(errors)
    alike = np.concatenate([own[1:] * own[:-1] > 0 for own in distances])
    assert alike.mean() > 0.55
    assert not go_on(distances)


def test_no_points_and_single_ones_are_on_no_side():
    assert not go_on([])
    assert not go_on([np.array([1.0])])

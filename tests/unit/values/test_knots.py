"""Knot vectors: by hand, and every way to get them wrong."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.support import reference
from tests.support.shapes import random_curve

from shapespline.errors import DegenerateContourError, InvalidInputError, OrderError
from shapespline.values.knots import (
    check_degree,
    check_knots,
    clamped_knots,
    greville_abscissae,
    periodic_knots,
)

EPS = reference.EPS
degrees = pytest.mark.parametrize("degree", range(1, 10))


def test_clamped_by_hand():
    assert clamped_knots(2, 1).tolist() == [0, 0, 1, 1]
    assert clamped_knots(6, 3).tolist() == [0, 0, 0, 0, 1 / 3, 2 / 3, 1, 1, 1, 1]
    assert clamped_knots(5, 2, [0.25, 0.25]).tolist() == [0, 0, 0, 0.25, 0.25, 1, 1, 1]


def test_periodic_by_hand():
    assert periodic_knots(2, 1).tolist() == [-0.5, 0, 0.5, 1, 1.5]
    assert periodic_knots(3, 2, [0, 0.25, 0.5, 1]).tolist() == [
        -0.75, -0.5, 0, 0.25, 0.5, 1, 1.25, 1.5,
    ]  # fmt: skip


@degrees
def test_periodic_knots_repeat_with_the_period(degree):
    m = degree + 3
    knots = periodic_knots(m, degree)
    assert len(knots) == m + 2 * degree + 1
    # One rounding of the shift by 1, one of the quotient.
    assert np.abs(knots[m:] - knots[:-m] - 1).max() <= 2 * EPS
    assert (knots[degree], knots[-degree - 1]) == (0, 1)


def test_greville_by_hand():
    assert greville_abscissae(np.array([0, 0, 0, 1, 2, 2, 2.0]), 2).tolist() == [0, 0.5, 1.5, 2]
    assert greville_abscissae(periodic_knots(4, 1), 1).tolist() == [0, 0.25, 0.5, 0.75, 1]


@degrees
@pytest.mark.parametrize("periodic", [False, True])
def test_a_spline_with_greville_abscissae_as_coefficients_is_the_identity(degree, periodic):
    curve = random_curve(np.random.default_rng(degree), degree, 15, periodic=periodic)
    knots = curve.knots
    abscissae = greville_abscissae(knots, degree)
    u = np.linspace(0, 1, 40)[:-1]
    values = reference.basis_matrix(knots, degree, u) @ abscissae
    # A running sum of len(knots) numbers below 2, one rounding each, in two entries.
    assert np.abs(values - u).max() <= 4 * len(knots) * 2 * EPS
    assert (np.diff(abscissae) > -4 * len(knots) * 2 * EPS).all()


@given(st.integers(1, 9), st.integers(0, 30), st.booleans())
def test_what_is_made_is_valid(degree, more, periodic):
    make = periodic_knots if periodic else clamped_knots
    knots = make(degree + 1 + more, degree)
    check_knots(knots, degree, periodic=periodic)
    domain = knots[degree : len(knots) - degree]
    # Equal spans: i / k carries half a unit of at most 1, in both ends.
    assert np.ptp(np.diff(domain)) <= 2 * EPS


@pytest.mark.parametrize("degree", [0, 10, -1, 2.5, True])
def test_bad_degree(degree):
    with pytest.raises(InvalidInputError, match=r"degree must be an integer from 1 to 9, got"):
        check_degree(degree)


@pytest.mark.parametrize("degree", ["3", None, float("nan"), float("inf"), [3]])
def test_a_degree_that_is_no_number(degree):
    with pytest.raises(InvalidInputError, match="degree must be an integer"):
        check_degree(degree)


def test_a_degree_that_is_a_whole_number_of_another_type_is_an_int():
    assert isinstance(check_degree(np.int64(3)), int)
    assert check_degree(3.0) == 3


@pytest.mark.parametrize("make", [clamped_knots, periodic_knots])
def test_too_few_control_points(make):
    with pytest.raises(
        DegenerateContourError,
        match=r"n_control_points must be at least degree \+ 1 = 4, got 3; raise it or lower",
    ):
        make(3, 3)
    with pytest.raises(InvalidInputError, match=r"n_control_points must be an integer, got 4\.5"):
        make(4.5, 3)


def test_wrong_number_of_knots():
    with pytest.raises(InvalidInputError, match=r"interior must hold 1 knots .* got shape \(2,\)"):
        clamped_knots(5, 3, [0.2, 0.4])
    with pytest.raises(InvalidInputError, match=r"breakpoints must be 5 knots from 0 to 1"):
        periodic_knots(4, 2, [0, 0.5, 1])
    with pytest.raises(InvalidInputError, match=r"breakpoints must be 3 knots from 0 to 1"):
        periodic_knots(2, 1, [0.1, 0.5, 1])


@pytest.mark.parametrize(
    ("knots", "degree", "periodic", "error", "message"),
    [
        ([0, 0, 1], 1, False, InvalidInputError, r"at least 2 \(degree \+ 1\) = 4 values"),
        ([[0, 0, 1, 1]], 1, False, InvalidInputError, r"knots must be one array .* \(1, 4\)"),
        ([0, 0, np.nan, 1, 1], 1, False, InvalidInputError, "knots must be finite"),
        ([0, 0, 0.6, 0.5, 1, 1], 1, False, OrderError, "0.6 before 0.5 at 2; sort them"),
        ([1, 1, 1, 1], 1, False, InvalidInputError, "knots must span a domain, got only 1.0"),
        ([0, 0.5, 1, 1], 1, False, InvalidInputError, r"repeat the first value degree \+ 1 = 2"),
        ([0, 0, 0.5, 1], 1, False, InvalidInputError, r"repeat the last value degree \+ 1 = 2"),
        ([0, 0, 0, 1, 1], 1, False, InvalidInputError, "exactly degree .* got more"),
        ([0, 0, 0.5, 0.5, 1, 1], 1, False, InvalidInputError, r"degree = 1 times inside.* 0\.5"),
        ([-0.4, 0, 0.5, 1, 1.5], 1, True, InvalidInputError, "repeat with the period"),
        ([-0.5, 0, 0.5, 0.5, 1, 1.5], 1, True, InvalidInputError, r"degree = 1 times inside"),
    ],
)  # fmt: skip
def test_bad_knots(knots, degree, periodic, error, message):
    with pytest.raises(error, match=message):
        check_knots(np.array(knots, dtype=float), degree, periodic=periodic)


def test_multiplicity_equal_to_the_degree_is_allowed_and_one_more_is_not():
    check_knots(clamped_knots(7, 3, [0.5, 0.5, 0.5]), 3, periodic=False)
    with pytest.raises(InvalidInputError, match="degree = 3 times inside"):
        clamped_knots(8, 3, [0.5] * 4)


def test_the_multiplicity_of_the_seam_counts_both_sides_of_it():
    periodic_knots(5, 2, [0, 0, 0.3, 0.6, 0.8, 1])
    periodic_knots(5, 2, [0, 0.3, 0.6, 0.8, 1, 1])
    for breakpoints in ([0, 0, 0, 0.3, 0.6, 1], [0, 0.3, 0.6, 1, 1, 1], [0, 0, 0.3, 0.6, 1, 1]):
        with pytest.raises(InvalidInputError, match="degree = 2 times inside"):
            periodic_knots(5, 2, breakpoints)

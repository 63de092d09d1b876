"""Curves that were read: the same curve, a contour on it, distances that hold."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import BSpline
from tests.support.pieces import bezier, square
from tests.support.shapes import random_curve

from checks import distance_to_polyline, polyline_of
from shapespline.errors import DegenerateContourError, InvalidInputError
from shapespline.geometry.exact import exact_fit
from shapespline.geometry.flattening import COARSEST, LONGEST_STEP, SAMPLING
from shapespline.values.piece import Piece


def random_pieces(seed, n_pieces, closed):
    """Lines, Beziers and splines of degrees 1 to 5 end to end."""
    rng = np.random.default_rng(seed)
    pieces, begin = [], rng.uniform(-9, 9, 2)
    first = begin
    for index in range(n_pieces):
        degree = int(rng.integers(1, 6))
        curve = random_curve(rng, degree, degree + 1 + int(rng.integers(0, 4)) * (degree > 1))
        points = curve.control_points.copy()
        points[0] = begin
        if closed and index == n_pieces - 1:
            points[-1] = first
        pieces.append(Piece("spline", degree, curve.knots, points))
        begin = points[-1]
    return pieces


@given(st.integers(0, 10_000), st.integers(2, 5), st.booleans(), st.sampled_from([1e-2, 1e-3]))
@pytest.mark.slow
def test_the_polyline_follows_the_pieces(seed, n_pieces, closed, sampling):
    """By dense samples of the pieces, by scipy: curve to polyline within what is reported."""
    pieces = random_pieces(seed, n_pieces, closed)
    fit = exact_fit(pieces, sampling=sampling)
    dense = polyline_of(pieces)
    assert distance_to_polyline(dense, fit.contour.polyline).max() <= fit.hausdorff_distance
    assert fit.hausdorff_distance <= sampling * 1.001 + 1e-9 * fit.contour.box_diagonal
    assert fit.max_distance < 1e-11
    assert fit.kept
    assert fit.method == "read"
    assert len(fit.parameters) == fit.contour.n_given


def test_every_piece_is_there_to_the_rounding():
    pieces = random_pieces(3, 5, closed=True)
    fit = exact_fit(pieces)
    full = [u for u in fit.spline.breakpoints if (fit.knots == u).sum() >= fit.degree]
    for piece, begin, end in zip(pieces, full, full[1:], strict=False):
        u = np.linspace(0, 1, 60)[:-1]
        expected = BSpline(piece.knots, piece.control_points, piece.degree)(u)
        assert np.abs(fit.spline(begin + u * (end - begin)) - expected).max() < 1e-10
    assert fit.pieces == tuple(pieces)
    assert fit.closed
    assert fit.contour.closed


def test_the_default_sampling_is_a_part_of_the_size():
    fit = exact_fit([bezier((0, 0), (0, 4), (3, 4))])
    diagonal = 5.0
    assert 0.1 * SAMPLING * diagonal < fit.hausdorff_distance <= SAMPLING * diagonal * 1.001
    coarse = exact_fit([bezier((0, 0), (0, 4), (3, 4))], sampling=100.0)
    assert coarse.hausdorff_distance <= COARSEST * diagonal * 1.001


def test_pieces_without_extent_are_left_out():
    fit = exact_fit([bezier((0, 0), (1, 0)), bezier((1, 0), (1, 0)), bezier((1, 0), (1, 1))])
    assert fit.n_stored_points == 3
    with pytest.raises(DegenerateContourError, match="single point"):
        exact_fit([bezier((1, 0), (1, 0))])


def test_a_line_to_and_fro_is_closed_and_no_step_is_long():
    fit = exact_fit([bezier((0, 0), (1, 0)), bezier((1, 0), (0, 0))])
    assert fit.contour.closed
    assert np.hypot(*np.diff(fit.contour.polyline, axis=0).T).max() <= LONGEST_STEP * (1 + 1e-12)


@pytest.mark.parametrize("sampling", [0.0, -1.0, np.inf, np.nan, "fine", True])
def test_a_sampling_that_is_no_length(sampling):
    with pytest.raises(InvalidInputError, match="sampling must be a positive length"):
        exact_fit(square(), sampling=sampling)


def test_a_sampling_that_nobody_can_mean():
    with pytest.raises(InvalidInputError, match=r"sampling asks for .* points .* raise it"):
        exact_fit([bezier((0, 0), (0, 4), (3, 4))], sampling=1e-15)

"""A contour made ready: its corners and constraints in the order of the search."""

import numpy as np
import pytest
from tests.support.shapes import flower, rectangle, wave

from shapespline.engines.pieces import Constraints, PiecesProblem
from shapespline.errors import InvalidInputError
from shapespline.values.contour import Contour


def points_of(problem, indices):
    """Points of the data by their indices in the problem."""
    return problem.normalized.order[indices].tolist()


@pytest.mark.parametrize("backwards", [False, True])
def test_corners_that_are_named_are_those_points(backwards):
    points = rectangle(60, 40).points[:: -1 if backwards else 1]
    problem = PiecesProblem.of(Contour(points, closed=True), 0.1, [7, 3, 3])
    assert sorted(points_of(problem, problem.corners)) == [3, 7]
    # Cut off behind 32 binary digits, so that rounding of the scale does not show.
    assert problem.tolerance <= 0.1 * problem.normalized.scale
    assert problem.tolerance == pytest.approx(0.1 * problem.normalized.scale, rel=2**-31, abs=0)


def test_corners_that_are_found_are_the_vertices():
    contour = rectangle(60, 40)
    problem = PiecesProblem.of(contour, 0.1, "auto")
    assert sorted(points_of(problem, problem.corners)) == [0, 60, 100, 160]
    # The sides hardly turn, the vertices do.
    assert not problem.low_turn[problem.corners].any()
    assert problem.low_turn[problem.normalized.new_index[[30, 80, 130, 180]]].all()
    none = PiecesProblem.of(contour, 0.1, None)
    assert len(none.corners) == 0
    assert none.low_turn.all()


@pytest.mark.parametrize("backwards", [False, True])
def test_constraints_turn_with_the_order(backwards):
    contour = wave(200) if not backwards else Contour(wave(200).points[::-1], closed=False)
    begin, end = np.array([1.0, 0.5]), np.array([0.2, -1.0])
    kept = Constraints(ends=True, through=np.array([5, 17]), tangents=(begin, end))
    problem = PiecesProblem.of(contour, 0.1, "auto", kept)
    found = problem.constraints
    assert sorted(points_of(problem, found.through)) == [5, 17]
    if problem.normalized.reversed:
        begin, end = -end, -begin
    # Turned as the points are, without their scale.
    turn = problem.normalized.turn
    assert np.array(found.tangents) == pytest.approx(np.array([begin, end]) @ turn.T, abs=1e-15)
    one_way = PiecesProblem.of(wave(200), 0.1, "auto", kept).normalized.reversed
    other = PiecesProblem.of(Contour(wave(200).points[::-1], closed=False), 0.1, "auto", kept)
    assert other.normalized.reversed is not one_way


def test_thinning_leaves_corners_and_points_to_go_through():
    contour = flower(4000)
    kept = Constraints(through=np.array([11, 1234]))
    problem = PiecesProblem.of(contour, 0.1, [500, 2500], kept)
    thin = problem.thinned()
    assert len(thin.normalized.contour) < 2000
    assert sorted(points_of(thin, thin.corners)) == [500, 2500]
    assert sorted(points_of(thin, thin.constraints.through)) == [11, 1234]
    assert thin.tolerance == problem.tolerance - thin.normalized.error_used
    assert len(thin.low_turn) == len(thin.normalized.contour)
    small = PiecesProblem.of(flower(300), 0.1, "auto")
    assert small.thinned() is small


@pytest.mark.parametrize(
    ("corners", "message"),
    [
        ("sharp", "corners must be 'auto', 'free', None or indices, got 'sharp'"),
        ([0.5], "corners must be one list of whole numbers"),
        ([[1]], "corners must be one list of whole numbers"),
        ([240], "corners must be indices below 240"),
        ([-1], "corners must be indices below 240"),
    ],
)
def test_what_names_no_corners(corners, message):
    with pytest.raises(InvalidInputError, match=message):
        PiecesProblem.of(flower(), 0.1, corners)

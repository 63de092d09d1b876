"""One run of the search: pieces end to end within the tolerance, and what they are told to keep."""

import numpy as np
import pytest
from tests.support.pieces import CUBIC, LINE, piece
from tests.support.promise import SMOOTH
from tests.support.shapes import flower, rectangle, wave

from checks import gaps, turns, two_sided
from shapespline.engines.pieces import Constraints, PiecesProblem
from shapespline.engines.pieces.search import (
    BUDGETS,
    PiecesSolver,
    n_points_of,
    without_degenerate,
)
from shapespline.monitor import Monitor


def run(contour, tolerance=0.05, *, kept=None, effort="fast"):
    """The pieces of one run, and the problem; everything in the unit of the problem."""
    problem = PiecesProblem.of(contour, tolerance, "auto", kept)
    solver = PiecesSolver(problem, 3, True, True, Monitor())
    return solver.run(problem.tolerance, BUDGETS[effort][0]), problem


@pytest.mark.parametrize("contour", [flower(), wave(), rectangle(60, 40)])
@pytest.mark.parametrize("effort", ["fast", "balanced"])
def test_pieces_are_end_to_end_within_the_tolerance(contour, effort):
    pieces, problem = run(contour, effort=effort)
    data = problem.normalized.contour
    found = two_sided(pieces, data.points, closed=data.closed, step=problem.tolerance / 10)
    assert found.larger <= problem.tolerance
    assert not gaps(pieces, closed=data.closed).any()
    assert n_points_of(pieces) == sum(len(p.control_points) - 1 for p in pieces)
    for one in pieces:
        assert one.kind == {1: "line"}.get(one.degree, one.kind)
        assert len(one.knots) == len(one.control_points) + one.degree + 1


def test_joints_are_smooth_where_there_is_no_corner():
    pieces, _ = run(flower(), 0.01)
    assert len(pieces) > 1
    assert np.abs(turns(pieces, closed=True)).max() < SMOOTH


def test_points_to_go_through_are_nodes():
    through = np.array([7, 150])
    pieces, problem = run(wave(), kept=Constraints(ends=True, through=through))
    nodes = np.array([one.control_points[0] for one in pieces])
    wanted = problem.normalized.contour.points[problem.constraints.through]
    for point in wanted:
        assert np.hypot(*(nodes - point).T).min() <= 1e-12 * 128
    ends = np.array([pieces[0].control_points[0], pieces[-1].control_points[-1]])
    assert ends == pytest.approx(problem.normalized.contour.points[[0, -1]], abs=1e-12 * 128)


def test_pieces_without_length_are_left_out():
    first = piece(LINE, [(0, 0), (4, 0)])
    dot = piece(CUBIC, [(4, 0), (4, 0), (4, 1e-14), (4, 2e-14)])
    last = piece(LINE, [(4, 2e-14), (4, 3)])
    found = without_degenerate([first, dot, last])
    assert [one.kind for one in found] == ["line", "line"]
    assert not gaps(found, closed=False).any()
    assert len(without_degenerate([first, last])) == 2

"""Tangents at the ends, kept by points that stand before the first and behind the last."""

import numpy as np
import pytest
from tests.support.pieces import CUBIC, LINE, piece
from tests.support.shapes import wave

from checks import turns
from shapespline.engines.pieces import Constraints, PiecesProblem
from shapespline.engines.pieces.end_tangents import (
    EXTENSION_LENGTH,
    N_EXTENSION,
    NEARLY,
    extended,
    turned_exactly,
    without_extensions,
)


def unit(angle):
    return np.array([np.cos(angle), np.sin(angle)])


def problem_of(begin, end, tolerance=0.1):
    kept = Constraints(ends=True, tangents=(begin, end), through=np.array([40]))
    return PiecesProblem.of(wave(200), tolerance, [90], kept)


def test_what_asks_for_no_tangent_is_as_it_was():
    problem = problem_of(None, None)
    assert extended(problem) is problem


@pytest.mark.parametrize("which", [(True, True), (True, False), (False, True)])
def test_extensions_are_straight_and_the_points_stay(which):
    wanted = [unit(a) if on else None for a, on in zip((0.4, -0.3), which, strict=True)]
    problem = problem_of(*wanted)
    begin, end = problem.constraints.tangents
    longer = extended(problem)
    points, before = longer.normalized.contour.points, problem.normalized.contour.points
    shift, n = N_EXTENSION * (begin is not None), len(before)
    assert len(points) == n + N_EXTENSION * sum(which)
    assert (points[shift : shift + n] == before).all()
    reach = EXTENSION_LENGTH * problem.tolerance
    if begin is not None:
        assert points[0] == pytest.approx(before[0] - reach * begin)
        steps = np.diff(points[: shift + 1], axis=0)
        assert steps == pytest.approx(np.tile(reach / N_EXTENSION * begin, (N_EXTENSION, 1)))
        assert longer.constraints.after_extension.tolist() == [shift]
    if end is not None:
        assert points[-1] == pytest.approx(before[-1] + reach * end)
        assert longer.constraints.before_extension.tolist() == [shift + n - 1]
    # What was named goes along, and the ends are nodes.
    assert longer.corners.tolist() == (problem.corners + shift).tolist()
    assert set(problem.constraints.through + shift) <= set(longer.constraints.through)
    assert len(longer.low_turn) == len(points)


def test_extensions_are_cut_off_and_tangents_made_exact():
    begin = unit(0.0)
    problem = problem_of(begin, None)
    begin, end = problem.constraints.tangents
    at_begin = begin is not None
    first = problem.normalized.contour.points[0 if at_begin else -1]
    direction = begin if at_begin else end
    across = np.array([-direction[1], direction[0]])
    sign = 1.0 if at_begin else -1.0

    def pieces(error):
        out = first - sign * 2.0 * direction
        leg = first + sign * (direction + np.tan(error) * across)
        far = [first + sign * 2 * direction + across, first + sign * 3 * direction + 2 * across]
        line = piece(LINE, [out, first])
        curve = piece(CUBIC, [first, leg, *far])
        if at_begin:
            return line, curve
        back = piece(CUBIC, curve.control_points[::-1])
        return back, piece(LINE, [first, out])

    (cut,) = without_extensions(pieces(0.5 * NEARLY), problem)
    turned_exactly((cut,), problem.constraints.tangents)
    ends = cut.control_points if at_begin else cut.control_points[::-1]
    leg = sign * (ends[1] - ends[0])
    assert leg @ across == pytest.approx(0.0, abs=1e-12)
    assert leg @ direction == pytest.approx(1.0)
    # What is not near is left, to be verified and said.
    (missed,) = without_extensions(pieces(3 * NEARLY), problem)
    turned_exactly((missed,), problem.constraints.tangents)
    whole = pieces(3 * NEARLY)
    assert abs(turns(whole, closed=False)[0]) == pytest.approx(3 * NEARLY, rel=1e-9)
    assert (missed.control_points == whole[1 if at_begin else 0].control_points).all()

"""Nodes: small turns made none."""

import numpy as np
import pytest
from tests.support.pieces import CUBIC, LINE, piece

from shapespline.engines.pieces.tangents import aligned
from shapespline.geometry.joining import turn_between


def test_aligned_removes_a_small_turn_and_leaves_a_large_one():
    line = piece(LINE, [(0, 0), (4, 0)])
    almost = piece(CUBIC, [(4, 0), (5, 0.01), (6, 1), (6, 3)])
    corner = piece(LINE, [(6, 3), (2, 3)])
    pieces = aligned([line, almost, corner], 0.02, closed=False)
    assert abs(turn_between(pieces[0], pieces[1])) < 1e-12
    assert pieces[0].control_points.tolist() == line.control_points.tolist()
    assert turn_between(pieces[1], pieces[2]) == pytest.approx(np.pi / 2)
    assert almost.control_points[1].tolist() == [5, 0.01]
    kept = aligned([line, almost], 0.005, closed=False)
    assert kept[1].control_points.tolist() == almost.control_points.tolist()

"""Which points belong to which piece."""

from __future__ import annotations

import numpy as np
import pytest
from tests.support.shapes import ribbon

import shapespline as ss
from shapespline.fitting.repair.assignment import (
    DataRun,
    PieceAssignment,
    curve_of,
    line_of,
    located,
)
from shapespline.geometry.nearest import nearest
from shapespline.values.piece import Piece


def test_parts_hold_every_point_once_from_any_of_them_on():
    contour = ss.Contour(ribbon(7, 0.002), closed=True)
    fit = ss.fit_curve(contour, tolerance=0.3)
    row = PieceAssignment.of(0, fit)
    for at in range(len(row.parts)):
        turned = row.turned(at)
        bounds = [part.begin for part in turned.parts] + [turned.parts[-1].end]
        assert bounds[0] == 0
        assert bounds[-1] == len(contour)
        assert bounds == sorted(bounds)
        assert (np.diff(turned.data.along) > 0).all()
        assert {tuple(p) for p in turned.data.points} == {tuple(p) for p in contour.points}


@pytest.mark.slow
def test_points_that_scatter_go_with_their_pieces():
    """Where data are far longer than the curve along them, and elsewhere not, none is misplaced."""
    x, tolerance = np.linspace(0, 100, 4000), 0.5
    y = 5 * np.sin(x / 3)
    fit = ss.fit_curve(np.column_stack([x, y]), tolerance=0.001, closed=False)
    pieces = [Piece("bezier", 3, np.repeat([0.0, 1.0], 4), p) for p in fit.spline.beziers().points]
    assert len(pieces) > 20
    scatter = 0.9 * tolerance * (-1.0) ** np.arange(len(x)) * (x < 50)
    data = ss.Contour(np.column_stack([x, y + scatter]), closed=False)
    assert data.length > 10 * fit.spline.length()
    parts = located(DataRun(data.points, data.arc_length), pieces, tolerance)
    for part in parts:
        own = data.points[part.begin : part.end]
        assert len(own)
        # A point beside a node may be given to the neighbour of its piece.
        off = np.sqrt(nearest(curve_of(part.piece), own).distances_sq)
        assert off.max() <= 3 * tolerance


def test_a_segment_without_length_is_no_zero_over_zero():
    """Open data that end where they begin have one, once they are read from another point on."""
    points = np.array([(0.0, 0), (4, 0), (4, 3), (0, 3), (0, 0)])
    contour = ss.Contour(points, closed=False)
    data = DataRun(points, contour.arc_length).turned(2, contour.length)
    knots = np.array([0.0, 0.0, 1.0, 1.0])
    nodes = np.array([(4.0, 3), (0, 3), (0, 0), (4, 0)])
    pieces = [Piece("line", 1, knots, nodes[i : i + 2]) for i in range(3)]
    parts = located(data, pieces, 0.1)
    assert [(part.begin, part.end) for part in parts] == [(0, 1), (1, 3), (3, 5)]


def test_a_corner_at_the_seam_is_seen_closely_on_both_sides():
    angle = np.linspace(0.5, 2 * np.pi - 0.5, 90)
    drop = np.concatenate([[(30.0, 0.0)], 10 * np.column_stack([np.cos(angle), np.sin(angle)])])
    fit = ss.fit_curve(drop, closed=True, tolerance=0.05)
    assert 0.0 in fit.corners
    line = line_of(fit.spline, fit.tolerance, fit.corners)
    steps = np.hypot(*np.diff(line, axis=0).T)
    finest = 1e-3 * np.median(steps)
    assert steps[0] < finest
    assert steps[-1] < finest

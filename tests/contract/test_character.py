"""Straight runs stay straight, and joints that are no corners hardly turn."""

import numpy as np
import pytest
from tests.support.shapes import moved

from checks import report, turns
from shapespline import Contour, fit_curve

# A turn below the first is a smooth joint; corners turn more than the second.
SMOOTH, CORNER = 1.01, 10.0


def slot(length, radius=2.0, n=400):
    """Two straight sides joined by half circles, evenly sampled."""
    s = np.arange(n) / n * (2 * length + 2 * np.pi * radius)
    arc = np.pi * radius
    points = np.empty((n, 2))
    for i, at in enumerate(s):
        half, along = divmod(at, length + arc)
        if along < length:
            point = np.array([along - length / 2, -radius])
        else:
            angle = (along - length) / radius - np.pi / 2
            point = np.array([length / 2 + radius * np.cos(angle), radius * np.sin(angle)])
        points[i] = point if half == 0 else -point
    return points


@pytest.mark.parametrize("length", [6.0, 20.0])
@pytest.mark.parametrize("tolerance", [0.003, 0.02])
def test_the_straight_sides_of_a_slot_are_lines(length, tolerance):
    points = moved(slot(length))
    fit = fit_curve(points, closed=True, tolerance=tolerance)
    lines = [piece for piece in fit.pieces if piece.kind == "line"]
    assert len(lines) == 2
    for line in lines:
        # A line can take from a circle what its sagitta allows, and give as much.
        spare = 4 * np.sqrt(2 * 2.0 * tolerance)
        assert abs(np.hypot(*np.diff(line.control_points, axis=0)[0]) - length) <= spare


@pytest.mark.slow
def test_joints_of_clean_outlines_are_corners_or_smooth(all_outlines):
    for name, contour in all_outlines:
        if "_n" in name:
            continue  # rougher than the tolerance: lines take over, and turn as the data do
        fit = fit_curve(contour, tolerance=0.002 * contour.box_diagonal, effort="fast")
        turn = np.abs(np.degrees(turns(fit.pieces, closed=fit.closed)))
        # Of a polygon that was drawn edges may meet at any angle: an aeroplane's at 1.8 degrees.
        is_line = np.array([piece.kind == "line" for piece in fit.pieces])
        edges = (is_line & np.roll(is_line, 1))[0 if fit.closed else 1 :]
        edges &= fit.method == "drawn"
        assert ((turn <= SMOOTH) | (turn >= CORNER) | edges).all(), name


def test_a_polyline_drawn_with_lines_is_lines():
    corners = Contour([(0, 0), (9, 1), (8, 7), (4, 3), (1, 8)], closed=True)
    fit = fit_curve(corners.resampled(300), tolerance=0.02)
    assert all(piece.kind == "line" for piece in fit.pieces)


@pytest.mark.slow
def test_curves_have_no_hooks_and_cross_no_more_than_their_data(all_outlines):
    for name, contour in all_outlines[::3]:
        if "_n" in name:
            continue  # noise has hooks of its own
        tolerance = 0.005 * contour.box_diagonal
        fit = fit_curve(contour, tolerance=tolerance)
        found = report(fit.pieces, contour.points, closed=contour.closed, tolerance=tolerance)
        assert found.hooks == 0, name
        assert found.crossings <= found.data_crossings, name
        assert found.gap <= 1e-12 * contour.box_diagonal, name

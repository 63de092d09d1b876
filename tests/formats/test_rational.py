"""Rational splines that are arcs of circles, as programs without arcs write them."""

from __future__ import annotations

import math

import ezdxf
import numpy as np
import pytest
from scipy.interpolate import BSpline

import shapespline as ss
from shapespline.formats.splines import spline_pieces

H = math.sqrt(0.5)
SQUARE = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)]
QUARTERS = [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4]


@pytest.mark.parametrize(("radius", "at"), [(1.0, 0.0), (5.0, 1e5), (1e-3, 3.0), (1e6, 0.0)])
@pytest.mark.parametrize("turn", [0.0, 0.3])
@pytest.mark.parametrize("quarters", [1, 2, 3, 4])
def test_arcs_of_any_length_are_one_arc(radius, at, turn, quarters):
    rotation = np.array([[math.cos(turn), math.sin(turn)], [-math.sin(turn), math.cos(turn)]])
    n = 2 * quarters + 1
    points = radius * np.array(SQUARE[:n]) @ rotation + at
    weights = [*([1, H] * 4)[: n - 1], 1]
    (piece,) = spline_pieces(2, [*QUARTERS[: n + 2], quarters], points, weights)
    # Rounding of the coordinates; a quarter of the circle tells its centre ten times less well.
    near = 1e-13 * (radius + at)
    assert np.hypot(*(np.array(piece.arc.centre) - at)) <= near
    assert abs(piece.arc.radius - radius) <= near
    assert piece.arc.sweep == pytest.approx(quarters * math.pi / 2, rel=1e-9)
    assert np.abs(piece.control_points[[0, -1]] - points[[0, -1]]).max() <= near


@pytest.mark.parametrize(
    ("degree", "points", "weights"),
    [
        (3, [(1, 0), (1, 2), (-1, 2), (-1, 0)], [1, 1 / 3, 1 / 3, 1]),  # half a circle
        (2, [(-1, 0), (-1, -1), (0, -1)], [2, 2 * H, 2]),
        (2, [(0, 1), (1, 1), (1, 0)], [1, H * 3, 9]),  # unevenly fast
    ],
)
def test_arcs_of_other_degrees_and_speeds(degree, points, weights):
    knots = [0] * (degree + 1) + [1] * (degree + 1)
    (piece,) = spline_pieces(degree, knots, points, weights)
    assert np.hypot(*piece.arc.centre) <= 1e-14
    homogeneous = np.column_stack([np.array(points) * np.array(weights)[:, None], weights])
    x, y, w = BSpline(np.array(knots, dtype=float), homogeneous, degree)(0.5)
    angle = math.atan2(y / w, x / w)
    assert 0 < (angle - piece.arc.start_angle) / piece.arc.sweep % (2 * math.pi) < 1


@pytest.mark.parametrize(
    ("points", "weights"),
    [
        ([(2, 0), (2, 1), (0, 1)], [1, H, 1]),  # of an ellipse
        ([(1, 0), (1, 1), (0, 1)], [1, H * (1 + 1e-6), 1]),
        ([(1, 0), (1.5, 0), (2, 0)], [1, H, 1]),
        ([(0, 0), (1e200, 1e200), (0, 3e200)], [1, H, 1]),
    ],
)
def test_what_is_no_circle_is_none(points, weights):
    assert all(piece.arc is None for piece in spline_pieces(2, [0] * 3 + [1] * 3, points, weights))


def test_a_circle_of_splines_is_a_circle_in_a_drawing(tmp_path):
    document = ezdxf.new("R2010")
    space = document.modelspace()
    circle = space.add_spline(degree=2)
    circle.control_points = [(3 * x + 7, 3 * y + 2, 0) for x, y in SQUARE]
    circle.knots, circle.weights = QUARTERS, [1, H] * 4 + [1]
    space.add_rational_spline([(21, 0), (21, 1), (20, 1)], [1, H, 1], degree=2)
    document.saveas(tmp_path / "a.dxf")
    whole, quarter = ss.read(tmp_path / "a.dxf")
    assert whole.closed
    assert [(len(fit.pieces), fit.pieces[0].kind) for fit in (whole, quarter)] == [(1, "arc")] * 2
    ss.write(tmp_path / "b.dxf", ss.Drawing([whole, quarter]))
    again = [entity.dxftype() for entity in ezdxf.readfile(tmp_path / "b.dxf").modelspace()]
    assert again == ["CIRCLE", "ARC"]

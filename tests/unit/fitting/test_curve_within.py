"""fit_curve within a tolerance: what the curve is made of, and what a caller may ask for."""

import numpy as np
import pytest
from tests.support.engines import fit_pieces
from tests.support.promise import assert_turns_with_the_data, checked
from tests.support.shapes import flower

from checks import distance_to_curve, gaps, polyline_of
from shapespline import Contour, InvalidInputError, fit_curve
from shapespline.analysis import find_corners
from shapespline.fitting.request import tolerance_length


def test_joints_turn_at_corners_only(outline):
    fit = fit_curve(outline("hand620_closed"), tolerance=0.1)
    n_sharp = assert_turns_with_the_data(fit.pieces, fit.contour, 0.1)
    assert 8 <= len(fit.corners) == n_sharp <= 20


def test_pieces_are_the_curve(outline):
    fit = fit_curve(outline("hand620_closed"), tolerance=0.1)
    assert len(fit.pieces) > 5
    for piece in fit.pieces:
        spans = len(piece.control_points) - piece.degree
        assert piece.kind == ("line" if piece.degree == 1 else "bezier" if spans == 1 else "spline")
    assert not gaps(fit.pieces, closed=True).any()
    step, size = 0.01, fit.contour.box_diagonal
    away = distance_to_curve(polyline_of(fit.pieces, step)[::50], fit.curve, step)
    assert away.max() <= 1e-9 * size
    joints = fit.spline(fit.spline.breakpoints)
    for piece in fit.pieces:
        assert np.hypot(*(joints - piece.control_points[0]).T).min() < 1e-9 * size
    # Where two pieces meet they store one point.
    stored = np.concatenate([piece.control_points for piece in fit.pieces])
    assert fit.n_stored_points == len(np.unique(stored, axis=0))


def test_a_polygon_becomes_its_corners():
    corners = np.array([(0.0, 0.0), (7.0, 1.0), (5.0, 6.0), (1.0, 4.0)])
    sides = zip(corners, np.roll(corners, -1, axis=0), strict=True)
    points = np.concatenate([np.linspace(a, b, 40, endpoint=False) for a, b in sides])
    fit = checked(fit_curve(points, closed=True, tolerance=0.01), 0.01)
    assert [piece.kind for piece in fit.pieces] == ["line"] * 4
    assert fit.n_stored_points == len(fit.corners) == 4


def test_a_smooth_closed_outline_is_one_periodic_spline():
    t = 2 * np.pi * np.arange(300) / 300
    fit = fit_curve(np.column_stack([3 * np.cos(t), np.sin(t)]), tolerance=0.005)
    assert fit.spline.periodic
    assert fit.corners.size == 0
    assert fit.n_stored_points == fit.n_control_points <= 10


@pytest.mark.parametrize("degree", [1, 2, 3, 4, 5])
@pytest.mark.parametrize("form", ["pieces", "spline"])
@pytest.mark.slow
def test_degrees(form, degree):
    fit = checked(fit_curve(flower(240), tolerance=0.05, degree=degree, form=form), 0.05)
    assert fit.degree == degree


def test_corners_given_by_their_indices(outline):
    contour = Contour([(0, 0), (4, 0), (4, 4), (0, 4)], closed=True).resampled(160)
    fit = checked(fit_curve(contour, tolerance=0.02, corners=[0, 40, 80, 120]), 0.02)
    assert len(fit.corners) == 4
    smooth = fit_curve(contour, tolerance=0.2, corners=None)
    assert smooth.n_stored_points > 4


@pytest.mark.slow
def test_more_effort_is_never_larger(outline):
    balanced, smallest = (
        fit_curve(outline("hand620_closed"), tolerance=0.1, effort=effort).n_stored_points
        for effort in ("balanced", "smallest")
    )
    assert smallest <= balanced


def test_a_tolerance_as_a_part_of_the_diagonal(outline):
    contour = outline("loop500_open")
    fit = fit_curve(contour, tolerance="0.5%")
    assert fit.tolerance == 0.005 * contour.box_diagonal
    assert tolerance_length("0.25", contour) == tolerance_length(0.25, contour) == 0.25


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"tolerance": 0}, r"tolerance must be a positive length in data units.* got 0$"),
        ({"tolerance": -1.0}, "tolerance must be a positive length"),
        ({"tolerance": np.nan}, "tolerance must be a positive length"),
        ({"tolerance": "a bit"}, "tolerance must be a positive length .* got 'a bit'"),
        ({"tolerance": "5 %%"}, "tolerance must be a positive length"),
        ({"tolerance": [1]}, "tolerance must be a positive length"),
        ({"tolerance": 0.1, "n_control_points": 9}, "exclude each other"),
        (
            {"tolerance": 0.1, "form": "rings"},
            "form must be one of pieces, spline, arcs, got 'rings'",
        ),
        ({"tolerance": 0.1, "effort": "max"}, "effort must be one of fast, balanced, smallest"),
        ({"tolerance": 0.1, "corners": "sharp"}, "corners must be 'auto', 'free', None or indices"),
        ({"tolerance": 0.1, "corners": [3, 160]}, "corners must be indices below 160"),
        ({"tolerance": 0.1, "corners": [0.5]}, "corners must be"),
        ({"tolerance": 0.1, "corners": [1], "form": "spline"}, "corners must be 'auto', 'free'"),
        ({"tolerance": 0.1, "weights": np.ones(159)}, r"weights must have shape \(160,\)"),
        ({"corners": None, "n_control_points": 12}, "corners does not act with n_control"),
        ({"form": "spline", "n_control_points": 12}, "form does not act with n_control"),
        ({"effort": "fast", "n_control_points": 12}, "effort does not act with n_control"),
        ({"corners": [200]}, "corners must be"),
    ],
)
def test_bad_arguments(arguments, message):
    with pytest.raises(InvalidInputError, match=message):
        fit_curve(flower(160), **arguments)


def test_no_facets_where_a_smooth_curve_is_no_larger():
    """Loops of a pen, coarsely recorded: pieces between data would be lines, a spline follows."""
    t = np.linspace(0, 6 * np.pi, 60)
    loops = np.column_stack([6 * t + 22 * np.sin(t), 25 * np.cos(t) + 6 * np.sin(0.4 * t)])
    contour = Contour(np.round(loops), closed=False)
    free = fit_pieces(contour, 0.2, corners="free")
    assert sum(piece.kind == "line" for piece in free.pieces) > 0.5 * len(free.pieces)
    fit = checked(fit_curve(contour, tolerance=0.2), 0.2)
    assert not len(fit.corners)
    assert fit.n_stored_points < 0.8 * free.n_stored_points
    # Pieces alone are such splines between what the data tell as corners.
    assert len(fit_pieces(contour, 0.2).corners) == len(find_corners(contour, 0.2).indices) == 2
    # Who names corners gets them.
    named = fit_curve(contour, tolerance=0.2, corners=[20, 40])
    assert named.sections


@pytest.mark.parametrize("tolerance", [0.01, 1.0, 100.0])
def test_a_way_back_to_its_first_point_is_a_curve_however_small(tolerance):
    points = [(0.0, 0.0), (0.3, -0.9), (0.6, -0.7), (0.9, 0.1), (0.0, 0.0)]
    fit = fit_curve(points, closed=False, tolerance=tolerance, ends="fixed")
    assert fit.kept
    assert fit.control_points[[0, -1]].tolist() == [[0.0, 0.0], [0.0, 0.0]]


def test_lines_of_rough_data_aim_lower_where_they_miss_the_tolerance():
    # The first search for lines misses it by a little; curves that keep it have more points.
    points = np.cumsum(np.random.default_rng(0).normal(0, 1, (500, 2)), axis=0)
    fit = fit_curve(points, closed=False, tolerance="0.5%")
    assert fit.kept
    assert {piece.kind for piece in fit.pieces} == {"line"}

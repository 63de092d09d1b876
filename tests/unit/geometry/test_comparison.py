"""compare: distances between sets of curves, by hand and by symmetry."""

from __future__ import annotations

import numpy as np
import pytest
from tests.support.shapes import on_circle

import shapespline as ss
from shapespline.geometry import compare as compare_curves


def test_circles_of_two_radii():
    small = ss.Contour(on_circle(4000), closed=True)
    large = ss.Contour(3 * on_circle(4000), closed=True)
    found = ss.compare(small, large)
    sagitta = 3 * (1 - np.cos(np.pi / 4000))  # of the polylines that stand for the circles
    for distance in (found.forward_max, found.reverse_max, found.forward_rms, found.reverse_rms):
        assert abs(distance - 2) <= sagitta
    assert found.hausdorff_distance == max(found.forward_max, found.reverse_max)


def test_other_pieces_of_the_same_curves_lie_on_them():
    square = ss.Contour([(0, 0), (4, 0), (4, 4), (0, 4)], closed=True)
    sides = [
        ss.Contour([(0, 0), (4, 0), (4, 4)], closed=False),
        ss.Contour([(4, 4), (0, 4), (0, 0)], closed=False),
    ]
    found = ss.compare(square, ss.Shape(sides))
    assert found.hausdorff_distance <= 8 * np.finfo(float).eps


def test_a_missing_outline_is_seen_from_one_side_only():
    near = ss.Contour([(0, 0), (1, 0)], closed=False)
    far = ss.Contour([(0, 9), (1, 9)], closed=False)
    found = ss.compare(ss.Shape([near, far]), near)
    assert abs(found.forward_max - 9) <= 9 * np.finfo(float).eps
    assert found.reverse_max == 0


def test_the_spacing_bounds_what_lies_between_samples():
    roof = ss.Contour([(0, 0), (1, 1), (2, 0)], closed=False)
    found = ss.compare(roof, ss.Contour([(0, 0), (2, 0)], closed=False))
    assert found.forward_max <= 1 <= found.forward_max + found.spacing / 2
    assert found.spacing < 1e-3


def test_fits_and_drawings_compare_by_their_curves():
    contour = ss.Contour(on_circle(200), closed=True)
    fit = ss.fit_curve(contour, tolerance=0.01, character="fewest")
    found = ss.compare(contour, fit)
    assert found == ss.compare(contour, ss.Drawing([fit])) == ss.compare(contour, fit.spline)
    assert found.hausdorff_distance <= fit.hausdorff_distance + found.spacing / 2


def test_anything_else_is_refused():
    with pytest.raises(ss.InvalidInputError, match="second must be a Drawing, Fit, Shape"):
        compare_curves(ss.Contour([(0, 0), (1, 0)]), 3)
    for wrong, sentence in (("nowhere.svg", "there is no such file"), (3, r"shape \(n, 2\)")):
        with pytest.raises(ss.ShapesplineError, match=sentence):
            ss.compare(ss.Contour([(0, 0), (1, 0)]), wrong)


def test_files_and_points_are_compared_as_what_they_hold(tmp_path):
    points = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0), (4.0, 0.0), (4.0, 1.0)]
    contour = ss.Contour(points, closed=False)
    lower = ss.Contour([(0, -1), (4, -1), (4, 3)], closed=False)
    expected = ss.compare(contour, lower)
    ss.write(tmp_path / "a.json", [contour])
    assert ss.compare(tmp_path / "a.json", lower) == expected
    assert ss.compare(str(tmp_path / "a.json"), lower) == expected
    assert ss.compare(points, lower) == ss.compare(np.array(points), lower) == expected


def test_a_list_of_fits_is_written_with_its_nesting(tmp_path):
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    fits = [ss.fit_curve(size * corners, closed=True, tolerance=0.1) for size in (1, 3)]
    ss.write(tmp_path / "two.json", fits)
    assert ss.read(tmp_path / "two.json").parents == (1, -1)
    for wrong in ([], [fits[0], 3], 3):
        with pytest.raises(ss.InvalidInputError, match="or a list of fits or contours"):
            ss.write(tmp_path / "no.json", wrong)


def test_arcs_are_compared_themselves_and_not_by_the_curves_that_stand_for_them(tmp_path):
    angle = np.pi * (np.arange(30) / 30 - 0.5)
    end = np.column_stack([20 + 8 * np.cos(angle), 8 * np.sin(angle)])
    side = np.column_stack([40 * np.arange(30) / 30 - 20, np.full(30, -8.0)])
    fit = ss.fit_curve(np.concatenate([side, end, -side, -end]), closed=True, tolerance=0.5)
    assert sorted(piece.kind for piece in fit.pieces) == ["arc", "arc", "line", "line"]
    assert ss.compare(fit, fit.spline).hausdorff_distance > 1e-4
    ss.write(tmp_path / "slot.json", fit)
    # Written with the shortest digits that read back the same; a dozen operations on numbers of 30.
    back = ss.compare(fit, tmp_path / "slot.json").hausdorff_distance
    assert back < 12 * 30 * np.finfo(float).eps

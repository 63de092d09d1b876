"""fit_shape: every contour, its place in the nesting, and what is common to all."""

import pytest
from numpy.testing import assert_array_equal
from tests.support.shapes import flower

from shapespline import Contour, DegenerateContourError, Shape, fit_shape, read, write


def test_a_shape_keeps_its_nesting_and_order():
    outer, inner = flower(160), Contour(0.4 * flower(120).points, closed=True)
    shape = Shape([outer, inner], parents=[-1, 0])
    drawing = fit_shape(shape, n_control_points=14, degree=4)
    assert drawing.parents == (-1, 0)
    assert [fit.contour for fit in drawing] == [outer, inner]
    assert [fit.degree for fit in drawing] == [4, 4]


def test_a_shape_names_the_contour_that_fails():
    tiny = Contour([(0, 0), (1, 0), (0, 1)], closed=True)
    with pytest.raises(DegenerateContourError, match="contour 1 of 2: points must hold at least"):
        fit_shape(Shape([flower(160), tiny]), n_control_points=14)


def test_a_shape_has_one_tolerance(tmp_path):
    outer, inner = flower(160), Contour(0.3 * flower(120).points, closed=True)
    drawing = fit_shape(Shape([outer, inner], parents=[-1, 0]), tolerance="1%")
    assert {fit.tolerance for fit in drawing} == {0.01 * outer.box_diagonal}
    assert all(fit.kept for fit in drawing)
    write(tmp_path / "flowers.json", drawing)
    again = read(tmp_path / "flowers.json")
    for fit, copy in zip(drawing, again, strict=True):
        assert [piece.kind for piece in fit.sections] == [piece.kind for piece in copy.sections]
        for piece, other in zip(fit.sections, copy.sections, strict=True):
            assert_array_equal(piece.knots, other.knots)
            assert_array_equal(piece.control_points, other.control_points)
        assert copy.n_stored_points == fit.n_stored_points

"""In another unit: converted where it is known, named where it is not, and never guessed."""

from __future__ import annotations

import numpy as np
import pytest
from tests.support.make_fit import nested
from tests.support.pieces import square

from shapespline.errors import InvalidInputError
from shapespline.geometry.exact import Outlines
from shapespline.geometry.scaling import in_unit
from shapespline.values.contour import Contour
from shapespline.values.drawing import Drawing
from shapespline.values.shape import Shape
from shapespline.values.view_box import ViewBox


def line(unit=None, length=1.0):
    return Shape([Contour([(0, 0), (length, 0)], accuracy=0.25)], None, ViewBox(0, 0, 2, 4), unit)


def length(shape):
    (contour,) = shape
    return contour.length


@pytest.mark.parametrize(
    ("unit", "wanted", "scale", "dpi", "expected"),
    [
        (None, None, None, None, (1.0, None)),
        (None, "mm", None, None, (1.0, "mm")),  # named
        (None, "mm", 0.1, None, (0.1, "mm")),
        (None, None, 0.1, None, (0.1, None)),
        (None, None, None, 254.0, (0.1, "mm")),
        ("in", "mm", None, None, (25.4, "mm")),  # converted
        ("in", "mm", 2.0, None, (50.8, "mm")),
        ("in", None, 2.0, None, (2.0, "in")),
        ("px", "mm", 0.1, None, (0.1, "mm")),  # the size of a pixel
        ("px", "mm", None, 254.0, (0.1, "mm")),
        ("px", "in", None, 200.0, (1 / 200, "in")),
        ("px", None, None, 254.0, (0.1, "mm")),
        ("px", "px", 3.0, None, (3.0, "px")),
        ("mm", "px", None, 254.0, (10.0, "px")),
        ("mm", "px", 4.0, None, (4.0, "px")),
    ],
)
def test_in_unit(unit, wanted, scale, dpi, expected):
    found = in_unit(line(unit), wanted, scale, dpi)
    assert (length(found), found.unit) == (pytest.approx(expected[0], rel=1e-15), expected[1])
    assert found.frame == pytest.approx(ViewBox(0, 0, 2 * expected[0], 4 * expected[0]))
    assert found.contours[0].accuracy == pytest.approx(0.25 * expected[0])


@pytest.mark.parametrize(
    ("unit", "options", "message"),
    [
        ("px", {"unit": "mm"}, "unit='mm' needs the size of a pixel: give dpi"),
        ("mm", {"unit": "px"}, "or scale, the pixels that make one mm"),
        ("mm", {"dpi": 300}, "dpi is the size of pixels, and these are mm"),
        ("mm", {"unit": "in", "dpi": 300}, "dpi is the size of pixels, and these are mm"),
        (None, {"unit": "furlong"}, "unit must be one of px, um, mm"),
        (None, {"scale": 0}, "scale must be a positive number, got 0"),
        (None, {"scale": "2"}, "scale must be a positive number, got '2'"),
        (None, {"scale": float("inf")}, "scale must be a positive number, got inf"),
        (None, {"dpi": -300}, "dpi must be a positive number, got -300"),
    ],
)
def test_what_cannot_be_known_is_asked_for(unit, options, message):
    with pytest.raises(InvalidInputError, match=message):
        in_unit(line(unit), **options)


def test_every_length_of_a_drawing_is_scaled_and_nothing_else():
    drawing = Drawing(nested().fits, nested().parents, ViewBox(1, 2, 3, 4), "cm")
    found = in_unit(drawing, "mm")
    assert (found.unit, found.parents, found.frame) == ("mm", drawing.parents, (10, 20, 30, 40))
    for one, other in zip(drawing, found, strict=True):
        assert np.array_equal(10 * one.control_points, other.control_points)
        assert np.array_equal(10 * one.contour.points, other.contour.points)
        assert np.array_equal(one.knots, other.knots)
        assert (one.closed, one.kept, one.spline.periodic) == (
            other.closed, other.kept, other.spline.periodic,
        )  # fmt: skip
        for name in ("max_distance", "rms_distance", "hausdorff_distance", "tolerance"):
            assert getattr(other, name) == pytest.approx(10 * getattr(one, name))
    same = in_unit(drawing, "cm")
    assert all(one is other for one, other in zip(drawing, same, strict=True))


def test_outlines_are_scaled_and_stay_closed():
    found = in_unit(Outlines([square(0.3)], unit="m"), "in")
    begin, end = found.curves[0][0].control_points[0], found.curves[0][-1].control_points[-1]
    assert begin.tolist() == end.tolist()
    assert found.curves[0][0].control_points[1, 0] == pytest.approx(300 / 25.4)

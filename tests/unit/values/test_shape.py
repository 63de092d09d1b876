"""Shape: contours and which lies in which."""

from __future__ import annotations

import pytest
from tests.support.shapes import on_circle

from shapespline.errors import InvalidInputError
from shapespline.values.contour import Contour
from shapespline.values.shape import Shape
from shapespline.values.view_box import ViewBox


def ring(radius):
    return Contour(on_circle(12, radius), closed=True)


def test_nesting():
    shape = Shape([ring(4), ring(3), ring(2), ring(1), ring(9)], parents=[-1, 0, 1, 2, -1])
    assert [shape.is_hole(i) for i in range(5)] == [False, True, False, True, False]
    assert shape.longest is shape.contours[4]
    assert len(shape) == 5
    assert list(shape) == list(shape.contours)
    assert Shape([ring(1)], frame=ViewBox(0, 0, 4, 3)).frame.width == 4
    assert Shape(iter([ring(1), ring(2)])).parents == (-1, -1)


@pytest.mark.parametrize(
    ("n", "parents", "message"),
    [
        (0, None, "contours must hold at least one Contour, got none"),
        (2, [-1], r"one parent .*: expected 2, got 1"),
        (2, [-1, 2], r"parents must be .*-1.*, got 2 for 1"),
        (2, [-2, -1], r"parents must be .*-1.*, got -2 for 0"),
        (2, [1, 7], r"parents must be .*-1.*, got 7 for 1"),
        (1, [0], "parents must"),
        (2, [1, 0], "parents"),
        (3, [1, 2, 0], "parents"),
    ],
)
def test_bad_nesting(n, parents, message):
    with pytest.raises(InvalidInputError, match=message):
        Shape([ring(k + 1) for k in range(n)], parents)


def test_a_shape_holds_contours_only():
    with pytest.raises(InvalidInputError, match="contours must"):
        Shape([on_circle(5)])


def test_widths_of_strokes():
    line = Contour([(0, 0), (4, 0)])
    assert Shape([line]).widths == (None,)
    assert Shape([line, line], widths=[2, None]).widths == (2.0, None)
    for widths in ([1.0], [1.0, 0.0], ["2", None], [float("nan"), 1.0]):
        with pytest.raises(InvalidInputError, match="widths must"):
            Shape([line, line], widths=widths)

"""Which closed outline lies in which."""

from __future__ import annotations

import numpy as np
from tests.support.pieces import bezier, square

from shapespline.geometry.exact import Outlines, exact_drawing
from shapespline.geometry.nesting import containing
from shapespline.values.view_box import ViewBox


def test_nesting_by_containment_and_open_ones_in_nothing():
    frame = ViewBox(0, 0, 20, 20)
    stroke = [bezier((2, 2), (3, 3))]
    curves = [
        stroke,
        square(2, (4, 4)),
        square(8, (1, 1)),
        square(1, (4.5, 4.5)),
        square(5, (12, 2)),
    ]
    drawing = exact_drawing(Outlines(curves, frame))
    assert drawing.parents == (-1, 2, -1, 1, -1)
    assert drawing.frame == frame


def test_outlines_that_touch_are_still_nested():
    big, small = square(8), square(4)  # share a vertex and parts of two sides
    assert exact_drawing(Outlines([small, big])).parents == (1, -1)


def test_outlines_that_cross_or_repeat_do_not_run_in_a_circle():
    box = np.array([(0.0, 0.0), (4, 0), (4, 4), (0, 4)])
    assert containing([box, box + 2]) == [-1, -1]
    assert sorted(containing([box, box, box]))[0] == -1
    assert containing([]) == []

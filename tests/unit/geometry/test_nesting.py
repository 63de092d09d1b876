"""Which closed outline lies in which."""

from __future__ import annotations

import numpy as np
import pytest
from tests.support.pieces import bezier, square
from tests.support.shapes import on_circle

from shapespline.geometry.exact import Outlines, exact_drawing
from shapespline.geometry.nesting import all_containing, containing, parents_of, signed_area
from shapespline.geometry.scaling import in_unit
from shapespline.values.contour import Contour
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


def test_outlines_that_say_how_they_are_nested_are_so():
    curves = [square(8), square(4, (2, 2))]
    assert exact_drawing(Outlines(curves, parents=(-1, -1))).parents == (-1, -1)
    assert exact_drawing(in_unit(Outlines(curves, unit="mm", parents=(-1, -1)), "in")).parents == (
        -1,
        -1,
    )


def test_outlines_that_touch_are_still_nested():
    big, small = square(8), square(4)  # share a vertex and parts of two sides
    assert exact_drawing(Outlines([small, big])).parents == (1, -1)


def test_outlines_that_cross_or_repeat_do_not_run_in_a_circle():
    box = np.array([(0.0, 0.0), (4, 0), (4, 4), (0, 4)])
    assert containing([box, box + 2]) == [-1, -1]
    assert containing([box, box, box]) == [-1, -1, -1]
    assert containing([]) == []


def test_parents_are_closed_and_the_nearest_ones_around():
    rings = [Contour(on_circle(40, radius), closed=True) for radius in (1, 5, 3, 4)]
    stroke = Contour([(0.0, 0.0), (0.2, 0.1)], closed=False)
    assert parents_of([*rings, stroke]) == [2, -1, 3, 1, -1]
    assert parents_of([stroke]) == [-1]


@pytest.mark.parametrize("seed", range(5))
def test_boxes_in_boxes_in_any_order(seed):
    rng = np.random.default_rng(seed)
    boxes, expected = [], []

    def fill(low, size, parent, depth):
        index = len(boxes)
        boxes.append(low + size * np.array([(0.0, 0), (1, 0), (1, 1), (0, 1)]))
        expected.append(parent)
        for corner in [(0.05, 0.05), (0.55, 0.05), (0.05, 0.55), (0.55, 0.55)]:
            if depth and rng.random() < 0.7:
                fill(low + size * np.array(corner), 0.4 * size, index, depth - 1)

    fill(np.zeros(2), 100.0, -1, 3)
    order = rng.permutation(len(boxes))
    place = np.argsort(order)
    turned = [np.roll(boxes[k], rng.integers(4), axis=0)[:: rng.choice([-1, 1])] for k in order]
    wanted = [-1 if expected[k] < 0 else place[expected[k]] for k in order]
    assert containing(turned) == wanted
    for around, parent in zip(all_containing(turned), wanted, strict=True):
        assert around == ([] if parent < 0 else [parent, *all_containing(turned)[parent]])


def test_all_that_lie_around_cross_each_other_or_not():
    box = np.array([(0.0, 0.0), (4, 0), (4, 4), (0, 4)])
    wide, high = box * (3, 1) + (0, 2), box * (1, 3) + (2, 0)
    inner = 0.25 * box + (2.5, 2.5)
    assert all_containing([wide, inner, 9 * box - 1, high]) == [[2], [3, 0, 2], [], [2]]
    assert all_containing([]) == []


def test_the_sign_of_an_area_is_that_of_the_way_round():
    box = np.array([(0.0, 0.0), (4, 0), (4, 2), (0, 2)])
    assert signed_area(box) == 8.0
    assert signed_area(box[::-1]) == -8.0
    assert signed_area(box + 1e9) == 8.0

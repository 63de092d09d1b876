"""What one side of the ink tells of where a pen went: its middle, corners, ends, stubs."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import cKDTree

from shapespline.tracing.strokes.ink import OUTLINE_STEP
from shapespline.tracing.strokes.pen import Pen
from shapespline.tracing.strokes.pen_edges import HIDDEN, pen_edges
from shapespline.values import Contour

PEN = Pen(5.0, 0.0)
# Directions are differences over a step of the outline, a chord of 0.05 of the radius at the ends.
NEAR = 0.05


def bow(middle, begin, end, radius=PEN.radius, count=80):
    t = np.radians(np.linspace(begin, end, count))
    return np.asarray(middle, dtype=float) + radius * np.column_stack([np.cos(t), np.sin(t)])


def told(outline):
    """The edges of one outline, the ink on its left."""
    contour = Contour.silently(np.asarray(outline, dtype=float), True)
    points = contour.resampled(round(contour.length / OUTLINE_STEP)).points
    return pen_edges(points, PEN, cKDTree(points), 100)


def test_a_bar_is_told_twice_from_end_to_end():
    edges = told([*bow((40, 0), -90, 90), *bow((0, 0), 90, 270)])
    assert len(edges) == 2
    for edge in edges:
        assert np.abs(edge.middles[:, 1]).max() < NEAR
        assert np.ptp(edge.middles[:, 0]) == pytest.approx(40, abs=2 * OUTLINE_STEP)
    (a, b), (c, d) = (edge.ends for edge in edges)
    assert {a, b} == {c, d}
    assert a != b
    assert min(a, b) >= 100


def test_a_square_end_is_one_as_well():
    edges = told([(0, -5), (40, -5), (40, 5), (0, 5)])
    assert len(edges) == 2
    assert all(HIDDEN not in edge.ends for edge in edges)
    # The middle of the last disc that fits is a radius before a square end.
    assert edges[0].middles[:, 0].min() == pytest.approx(5, abs=1.0)


def test_a_ring_is_told_without_ends():
    (edge,) = told(bow((0, 0), 0, 360, radius=25, count=720)[:-1])
    assert edge.closed
    assert np.abs(np.hypot(*edge.middles.T) - 20).max() < NEAR


def test_the_outer_side_of_a_corner_tells_the_corner():
    # Two strokes of 40 that meet at a right angle in (0, 0), round outside.
    outline = [
        (-5, 40), *bow((0, 0), 180, 270), (40, -5), *bow((40, 0), -90, 90),
        (5, 5), *bow((0, 40), 0, 180),
    ]  # fmt: skip
    (outer,) = (edge for edge in told(outline) if edge.corners)
    (corner,) = outer.corners
    assert np.hypot(*outer.middles[corner]) < 0.2
    inner = [edge for edge in told(outline) if not edge.corners]
    assert sorted(edge.ends.count(HIDDEN) for edge in inner) == [1, 1]


def test_of_a_stroke_that_only_ends_outside_a_stub_is_told():
    # A bar, and above it the end of an upright whose sides are inside the bar.
    bar = [*bow((60, 0), -90, 90), (36, 5), *bow((30, 6), 0, 180), (24, 5), *bow((0, 0), 90, 270)]
    edges = told(bar)
    (stub,) = (edge for edge in edges if len(edge.middles) < 5)
    assert stub.ends[1] == HIDDEN
    assert stub.ends[0] != HIDDEN
    assert np.hypot(*(stub.middles[0] - (30, 6))) < 0.2
    assert stub.middles[-1][1] < stub.middles[0][1] - 1  # it leads into the bar


def test_a_dot_tells_nothing():
    assert told(bow((0, 0), 0, 360, count=720)[:-1]) == []

"""Elements of a few points that are the beginning of a free-form run beside them."""

from __future__ import annotations

import numpy as np
import pytest

from shapespline.engines.drawn.beginnings import without_beginnings
from shapespline.engines.drawn.observed import Observed
from shapespline.engines.drawn.segments import ARC, FREE, LINE, Segment, Segments
from shapespline.values import Contour

STEP = 0.5


def row_of(parts, kinds, noise=0.0):
    """A closed row of parts end to end, each without its last point, and its points observed."""
    points = np.concatenate([part[:-1] for part in parts])
    points = points + np.random.default_rng(2).normal(0.0, noise, points.shape)
    ends = np.cumsum([0, *(len(part) - 1 for part in parts)]).tolist()
    found = tuple(Segment(i, j, kind) for i, j, kind in zip(ends, ends[1:], kinds, strict=False))
    row = np.concatenate([points, points[:1]])
    stations = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(row, axis=0).T))])
    seen = Observed.of(Contour(points, closed=True), None)
    return Segments(row, stations, np.ones(len(row)), 0, found), seen


def edge(a, b):
    n = round(float(np.hypot(*np.subtract(b, a))) / STEP)
    return np.linspace(a, b, n + 1)


def wave(x):
    """Up from (40, 0) and over to (0, 0), steep at its beginning."""
    return np.column_stack([x, 8 * np.sin(np.pi * x / 40) + 2 * np.sin(np.pi * x / 20)])


def kinds_of(row):
    return [segment.kind for segment in row.found]


EDGES = [edge((0, 0), (0, -20)), edge((0, -20), (40, -20)), edge((40, -20), (40, 0))]
CURVE = wave(np.linspace(40, 0, 90))


@pytest.mark.parametrize("kind", [LINE, ARC])
@pytest.mark.parametrize("noise", [0.0, 0.02])
def test_what_a_curve_begins_with_is_the_curves(kind, noise):
    for cut in (4, 9):
        parts = [*EDGES, CURVE[: cut + 1], CURVE[cut:]]
        row, seen = row_of(parts, [LINE, LINE, LINE, kind, FREE], noise)
        assert kinds_of(without_beginnings(row, seen)) == [LINE, LINE, LINE, FREE, FREE]
        parts = [*EDGES, CURVE[:-cut], CURVE[-cut - 1 :]]
        row, seen = row_of(parts, [LINE, LINE, LINE, FREE, kind], noise)
        assert kinds_of(without_beginnings(row, seen)) == [LINE, LINE, LINE, FREE, FREE]


@pytest.mark.parametrize("cut", [4, 9])
def test_the_point_in_the_corner_may_be_the_edges(cut):
    # No point lies in (40, 0): the last one of the edge is where the element is cut to begin.
    edges = [*EDGES[:2], edge((40, -20), (40, -0.5))]
    curve = np.concatenate([edges[-1][-1:], wave(np.linspace(39.8, 0, 90))])
    row, seen = row_of([*edges, curve[: cut + 1], curve[cut:]], [LINE, LINE, LINE, ARC, FREE])
    assert kinds_of(without_beginnings(row, seen)) == [LINE, LINE, LINE, FREE, FREE]


def test_one_of_three_points_one_of_which_is_the_corners_is_the_curves():
    row, seen = row_of([*EDGES, CURVE[:3], CURVE[2:]], [LINE, LINE, LINE, LINE, FREE])
    assert kinds_of(without_beginnings(row, seen)) == [LINE, LINE, LINE, FREE, FREE]


def test_a_straight_edge_that_runs_into_a_curve_stays():
    # Level from the corner on, then a bend that begins with the curvature of a circle of ten.
    angle = np.linspace(0, np.pi / 2, 40)
    bend = np.column_stack([20 - 10 * np.sin(angle), 10 - 10 * np.cos(angle)])
    curve = np.concatenate([bend, edge((10, 10), (14, 20))[1:]])
    close = [curve[-1], (40, 40), (40, 0)]
    parts = [edge((40, 0), (20, 0)), curve, *map(edge, close[:-1], close[1:])]
    row, seen = row_of(parts, [LINE, FREE, LINE, LINE])
    assert without_beginnings(row, seen) is row


def test_an_edge_with_corners_at_both_ends_stays():
    # As short as it is: a quintic through three points of it and three of the curve proves nothing.
    parts = [*EDGES, edge((40, 0), (38.5, 0)), wave(np.linspace(38.5, 0, 80))]
    parts[-1][0] = (38.5, 0)
    row, seen = row_of(parts, [LINE, LINE, LINE, LINE, FREE])
    assert without_beginnings(row, seen) is row


def test_fillets_stay():
    # Tangent to its edge: no corner there.
    angle = np.linspace(0, np.pi / 2, 4)
    fillet = np.column_stack([36 + 4 * np.cos(angle), 4 * np.sin(angle)])
    x = np.linspace(36, 0, 80)
    curve = np.column_stack([x, x / 9 + 3 * np.sin(np.pi * x / 36)])
    row, seen = row_of([*EDGES, fillet, curve], [LINE, LINE, LINE, ARC, FREE])
    assert without_beginnings(row, seen) is row


def test_pictures_are_left_alone():
    row, _ = row_of([*EDGES, CURVE[:5], CURVE[4:]], [LINE, LINE, LINE, LINE, FREE])
    of_picture = Observed.of(Contour(row.points[:-1], closed=True), 0.02)
    assert without_beginnings(row, of_picture) is row

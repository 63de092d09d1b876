"""Rows with one element or one free-form run between corners, of noisy points."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from benchmarks.drawn.profiles import noisy_profile

from shapespline import Contour
from shapespline.engines.drawn import DrawnLine, FreeRun, drawn_between_corners
from shapespline.engines.drawn.between_corners import rows_between_corners
from shapespline.engines.drawn.observed import Observed
from shapespline.engines.drawn.segments import ARC, FREE, LINE, segmented


def points_of(name: str, noise: float, n: int, draw: int = 0) -> np.ndarray:
    drawn = noisy_profile(name, draw, 10)
    return next(points for key, points, _ in drawn if key == (noise, n))


def test_what_is_several_elements_between_two_corners_is_one_run():
    # A wavy edge of 400 points was five arcs and four lines.
    seen = Observed.of(Contour(points_of("cover", 0.1, 1000), closed=True), None)
    row = segmented(seen)
    assert sum(one.kind != FREE for one in row.found) > 6
    lines = list(rows_between_corners(seen, row))[-1]
    assert [one.kind for one in lines.found].count(FREE) == 1
    assert [one.kind for one in lines.found].count(LINE) == 3
    assert lines.found[0].begin == 0
    assert lines.found[-1].end == len(lines.points) - 1
    assert all(a.end == b.begin for a, b in pairwise(lines.found))


def test_an_element_that_is_long_for_what_lies_between_two_corners_is_kept_in_the_first_row_alone():
    seen = Observed.of(Contour(points_of("knife", 0.1, 1000), closed=True), None)
    first, second = rows_between_corners(seen, segmented(seen))
    assert ARC in [one.kind for one in first.found]
    assert ARC not in [one.kind for one in second.found]


@pytest.mark.parametrize("closed", [True, False])
def test_rows_go_from_corner_to_corner_of_open_outlines_too(closed):
    points = points_of("flag", 0.1, 1000)
    seen = Observed.of(Contour(points if closed else points[:700], closed=closed), None)
    for row in rows_between_corners(seen, segmented(seen)):
        assert row.found[0].begin == 0
        assert row.found[-1].end == len(row.points) - 1
        assert all(one.begin < one.end for one in row.found)


def test_smooth_outlines_have_no_such_rows():
    angle = 2 * np.pi * np.arange(400) / 400
    r = 40 + 6 * np.cos(3 * angle)
    points = np.column_stack([r * np.cos(angle), r * np.sin(angle)])
    points += np.random.default_rng(1).normal(0, 0.1, points.shape)
    seen = Observed.of(Contour(points, closed=True), None)
    assert list(rows_between_corners(seen, segmented(seen))) == []
    assert drawn_between_corners(Contour(points, closed=True)) == []


def test_readings_hold_edges_and_runs_end_to_end():
    found = drawn_between_corners(Contour(points_of("cover", 0.5, 1000), closed=True))
    assert found
    for drawn in found:
        assert drawn.is_told
        assert any(isinstance(part, FreeRun) for part in drawn.parts)
        assert sum(isinstance(part, DrawnLine) for part in drawn.parts) >= 3
        ends = [
            part.points[[0, -1]] if isinstance(part, FreeRun) else (part.begin, part.end)
            for part in drawn.parts
        ]
        for before, after in zip(ends, [*ends[1:], ends[0]], strict=True):
            assert np.array_equal(before[1], after[0])


def test_edges_whose_directions_say_nothing_tell_of_no_drawing():
    # Three edges of any directions and a curve: nobody knows whether they were drawn.
    corners = np.array([(0.0, 0.0), (70.0, 13.0), (95.0, 61.0), (20.0, 74.0)])
    t = np.linspace(0, 1, 100, endpoint=False)[:, None]
    edges = [a + t * (b - a) for a, b in pairwise(corners)]
    bulge = np.column_stack([9 * np.sin(np.pi * t[:, 0]), -4 * np.sin(2 * np.pi * t[:, 0])])
    points = np.concatenate([*edges, corners[3] + t * (corners[0] - corners[3]) - bulge])
    points += np.random.default_rng(2).normal(0, 0.2, points.shape)
    assert drawn_between_corners(Contour(points, closed=True)) == []


def test_too_few_points_are_read_in_no_way():
    assert drawn_between_corners(Contour(points_of("cover", 0.1, 200)[:10], closed=True)) == []

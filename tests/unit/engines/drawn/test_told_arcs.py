"""Stretches of a picture's outline that lie on one circle to rounding are arcs that were told."""

from __future__ import annotations

import numpy as np

from shapespline.engines.drawn.observed import Observed
from shapespline.engines.drawn.segments import ARC, LINE, segmented
from shapespline.values import Contour

RADIUS, SIDE, POINTS = 1.0, 20.0, 9


def rounded_square(wobble=0.0):
    """Corners of a pixel's radius, nine points each, between sides with a point for each pixel."""
    corner = np.linspace(-np.pi / 2, 0, POINTS)
    arc = SIDE - RADIUS + RADIUS * np.column_stack([np.cos(corner), np.sin(corner)])
    arc[:, 1] = RADIUS + RADIUS * np.sin(corner)
    side = np.column_stack([np.arange(1.5, SIDE - 1), np.zeros(18)])
    quarter = np.concatenate([side, arc])
    quarter += wobble * np.random.default_rng(1).normal(size=quarter.shape)
    turned = [quarter - SIDE / 2]
    for _ in range(3):
        turned.append(np.column_stack([-turned[-1][:, 1], turned[-1][:, 0]]))
    return np.concatenate(turned)


def seen(points, accuracy=0.02):
    return Observed.of(Contour(points, closed=True), accuracy)


def test_arcs_are_told_wherever_the_outline_begins():
    points = rounded_square()
    for shift in (0, 20, 24, 50):
        found = seen(np.roll(points, shift, axis=0)).told_arcs
        begins = sorted((i - shift) % len(points) for i, _ in found)
        assert begins == [18, 45, 72, 99]
        assert {j - i for i, j in found} == {POINTS - 1}


def test_what_is_off_by_less_than_is_seen_is_told_by_nobody():
    assert seen(rounded_square(wobble=1e-4)).told_arcs == []


def test_measured_points_and_whole_circles_are_looked_for_as_ever():
    assert seen(rounded_square(), accuracy=None).told_arcs == []
    angle = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    assert seen(3 * np.column_stack([np.cos(angle), np.sin(angle)])).told_arcs == []


def test_segments_are_the_arcs_and_the_lines_between():
    row = segmented(seen(np.roll(rounded_square(), 21, axis=0)))
    assert [segment.kind for segment in row.found] == [ARC, LINE] * 4
    assert row.found[-1].end == len(row.points) - 1

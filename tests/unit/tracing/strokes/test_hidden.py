"""Loose ends led on: across what hides them, to another stroke, to each other, or nowhere."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import cKDTree

from shapespline.tracing.strokes.graph import Graph
from shapespline.tracing.strokes.hidden import lead_on
from shapespline.tracing.strokes.pen import Pen
from shapespline.tracing.strokes.pen_net import PenNet

PEN = Pen(4.0, 0.0)
# No outline is near: the pen may have been everywhere.
INKED = cKDTree([(1e3, 1e3)])


def led(lines, loose, outline=INKED):
    """The net of lines of nodes a pixel apart; ``loose`` are ends, x and y, that ink hides."""
    lines = [np.asarray(line, dtype=float) for line in lines]
    points = np.concatenate(lines)
    graph, first = Graph(points, np.full(len(points), PEN.radius)), 0
    for line in lines:
        graph.connect_all(range(first, first + len(line)))
        first += len(line)
    hidden = {int(np.hypot(*(points - end).T).argmin()) for end in loose}
    lead_on(PenNet(graph, set(graph.loose_ends()) - hidden), PEN, outline)
    return graph


def row(begin, end):
    count = int(np.hypot(*np.subtract(end, begin))) + 1
    return np.linspace(begin, end, count)


def test_a_stroke_goes_on_behind_what_hides_it():
    graph = led([row((0, 0), (20, 0)), row((30, 0), (50, 0))], [(20, 0), (30, 0)])
    (branch,) = graph.branches()
    assert np.abs(branch.points[:, 1]).max() < 1e-9
    assert graph.loose_ends() == [0, 41]


def test_a_stroke_ends_on_another():
    graph = led([row((0, 0), (50, 0)), row((25, 20), (25, 5))], [(25, 5)])
    (junction,) = graph.junctions()
    assert graph.points[junction] == pytest.approx((25, 0), abs=1e-9)


def test_strokes_that_are_hidden_on_all_sides_meet_where_they_lead():
    graph = led([row((0, 0), (20, 0)), row((28, 28), (28, 8))], [(20, 0), (28, 8)])
    (branch,) = graph.branches()
    assert np.hypot(*(branch.points - (28, 0)).T).min() < 1e-9
    assert len(branch.corners) == 1


def test_what_crosses_has_one_junction():
    lines = [
        row((0, 0), (20, 0)),
        row((30, 0), (50, 0)),
        row((25, 25), (25, 5)),
        row((25, -5), (25, -25)),
    ]
    graph = led(lines, [(20, 0), (30, 0), (25, 5), (25, -5)])
    (junction,) = graph.junctions()
    assert graph.points[junction] == pytest.approx((25, 0), abs=1e-9)
    assert len(graph.links[junction]) == 4


def test_no_stroke_leads_through_the_ground():
    # An outline between both: the pen cannot have been there.
    wall = cKDTree(row((25, -30), (25, 30)))
    graph = led([row((0, 0), (20, 0)), row((30, 0), (50, 0))], [(20, 0), (30, 0)], wall)
    assert len(list(graph.branches())) == 2

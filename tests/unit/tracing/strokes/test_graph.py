"""Nets of strokes: branches between ends and junctions, and rings."""

from __future__ import annotations

import numpy as np

from shapespline.tracing.strokes.graph import Graph


def graph(count):
    points = np.column_stack([np.arange(count), np.zeros(count)]).astype(float)
    return Graph(points, np.ones(count))


def test_branches_run_from_end_to_junction():
    net = graph(6)
    net.connect_all([0, 1, 2, 3])
    net.connect_all([2, 4, 5])
    net.corners.add(4)
    branches = list(net.branches())
    assert sorted(len(branch.points) for branch in branches) == [2, 3, 3]
    assert all(2 in branch.nodes for branch in branches)
    assert [branch.corners for branch in branches if branch.corners] == [(1,)]
    assert net.junctions() == [2]
    assert sorted(net.loose_ends()) == [0, 3, 5]


def test_a_ring_ends_where_it_begins():
    net = graph(4)
    net.connect_all([0, 1, 2, 3, 0])
    (ring,) = net.branches()
    assert ring.is_ring
    assert (ring.points[0] == ring.points[-1]).all()
    assert len(ring.points) == 5


def test_new_nodes_are_linked_to_nothing():
    net = graph(2)
    (node,) = net.add(np.array([(5.0, 5.0)]), 2.0)
    assert node == 2
    assert net.radii[node] == 2.0
    net.connect(node, node)
    assert node not in net.links
    net.connect(0, node)
    net.disconnect_all([0, node])
    assert net.links == {0: set(), node: set()}

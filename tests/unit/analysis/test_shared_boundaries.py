"""Arcs that outlines have in common."""

from __future__ import annotations

from tests.support.maps import cells

from shapespline.analysis.shared_boundaries import shared_arcs


def test_arcs_of_the_map():
    arcs = shared_arcs(cells(), 1e-9)
    # Four inner borders, one outer border for each cell, the island once.
    assert len(arcs.points) == 9
    assert sum(arcs.closed) == 1
    assert [len(uses) for uses in arcs.uses] == [3, 3, 3, 3, 1, 1]
    assert {use.arc for use in arcs.uses[4]} == {use.arc for use in arcs.uses[5]}

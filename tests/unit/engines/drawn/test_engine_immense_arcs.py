"""Edges that a renderer bends by hundredths of a pixel are straight: nobody draws such arcs."""

from __future__ import annotations

import numpy as np
import pytest
from benchmarks.drawn.shapes import rounded
from benchmarks.drawn.truth import Line, sampled

from shapespline import Contour
from shapespline.engines.drawn import DrawnArc, DrawnLine, as_drawn

ACCURACY = 0.02
CORNERS = [(0.0, 0.0), (150.0, 12.0), (163.0, 107.0), (15.0, 121.0)]
RADII = [15.0, 21.0, 12.0, 18.0]


def bent(sagitta):
    """Points of a quadrilateral with fillets, one apart, whose edges bulge by so much."""
    parts = []
    for one in rounded(CORNERS, RADII):
        points = sampled([one], 1.0)
        if isinstance(one, Line):
            along = np.linspace(-1, 1, len(points))
            chord = one.end - one.begin
            normal = np.array([chord[1], -chord[0]]) / np.hypot(*chord)
            points = points + sagitta * (1 - along**2)[:, None] * normal
        parts.append(points)
    return Contour(np.concatenate(parts), closed=True)


@pytest.mark.parametrize("sagitta", [0.0, 0.02, 0.03, 0.04])
def test_edges_stay_straight(sagitta):
    found = as_drawn(bent(sagitta), accuracy=ACCURACY)
    kinds = sorted(type(part).__name__ for part in found.parts)
    assert kinds == ["DrawnArc"] * 4 + ["DrawnLine"] * 4
    assert found.is_told


def test_edges_that_bulge_visibly_are_arcs():
    found = as_drawn(bent(1.0), accuracy=ACCURACY)
    largest = max(part.arc.radius for part in found.parts if isinstance(part, DrawnArc))
    assert not any(isinstance(part, DrawnLine) for part in found.parts)
    # L^2 / 8 s of the longest edge.
    assert 1000 < largest < 2000

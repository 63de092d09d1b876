"""Fillets of noisy points."""

from __future__ import annotations

import numpy as np
import pytest
from benchmarks.drawn.tables import noisy_points

from shapespline import Contour
from shapespline.engines.drawn import DrawnArc, as_drawn


@pytest.mark.parametrize(("n", "seed"), [(1000, 1), (200, 1)])
def test_fillets_that_took_points_of_their_neighbours_are_alike(n, seed):
    # A bracket: four fillets of one radius and a larger one, 0.1 % noise. One of the four had
    # points of an edge beside it, was larger and touched only one of its edges.
    drawn = [d for d in noisy_points("bracket", np.random.default_rng(seed)) if d[0] == 0.1]
    points = next(points for _, points, _, _ in drawn if len(points) == n)
    found = as_drawn(Contour(points, closed=True))
    radii = sorted(part.arc.radius for part in found.parts if isinstance(part, DrawnArc))
    assert len(radii) == 5
    assert radii[3] - radii[0] < 1e-9 * radii[0]
    assert radii[4] > 1.5 * radii[3]
    assert sum(one.name == "tangent" for one in found.regularities) == 10

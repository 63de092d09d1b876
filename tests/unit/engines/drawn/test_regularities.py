"""Which equations measured points allow."""

from __future__ import annotations

import numpy as np
import pytest
from benchmarks.drawn.tables import noisy_points

from shapespline import Contour
from shapespline.engines.drawn import DrawnArc, DrawnLine, as_drawn


@pytest.mark.parametrize("seed", [1, 5, 7, 8])
def test_an_arc_with_a_point_of_its_neighbour_costs_others_no_tangency(seed):
    # Six fillets of a tee, the small ones of four points: one held a point of an edge, so that none
    # was tangent, and arcs that meet edges in 2 degrees were none: chains, or one spline (seed 8).
    samplings = noisy_points("tee", np.random.default_rng(seed))
    points = next(p for noise, p, _, _ in samplings if (noise, len(p)) == (0.02, 200))
    found = as_drawn(Contour(points, closed=True))
    assert found is not None
    kinds = [type(part) for part in found.parts]
    assert kinds.count(DrawnLine) == 8
    assert kinds.count(DrawnArc) == 6
    assert sum(one.name == "tangent" for one in found.regularities) >= 8

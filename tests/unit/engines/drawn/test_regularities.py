"""Which equations measured points allow."""

from __future__ import annotations

import numpy as np
import pytest
from benchmarks.drawn.random_plates import plate, points_of
from benchmarks.drawn.tables import noisy_points, rendered
from benchmarks.drawn.truth import sampled

from shapespline import Contour, fit_shape, trace
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


@pytest.mark.parametrize(("form", "draw"), [("L", 2), ("L", 3), ("U", 3), ("box", 0)])
def test_of_a_few_noisy_points_directions_and_tangents_may_be_far_off(form, draw):
    # Fillets and short edges of some points in noise of 0.6: off by more than 1.7 and 20 degrees,
    # they were neither level nor tangent, and chamfers or bare corners cost less.
    outline, random = plate(form, draw, regular=True), np.random.default_rng([draw, *form.encode()])
    points = points_of(sampled(outline, 0.02), 1000, 0.005, random)
    found = as_drawn(Contour(points, closed=True))
    assert found is not None
    own = sorted(f"Drawn{type(one).__name__}" for one in outline)
    assert sorted(type(part).__name__ for part in found.parts) == own
    assert found.otherwise is not None


def test_edges_of_small_letters_in_a_picture_lean_by_two_degrees():
    # A 7 of 24 pixels in a word: its foot leaned by 1.74 degrees, and it was a smooth curve. One of
    # its seven edges is shorter than two pixels.
    fits = fit_shape(trace(rendered("Plate 7", 128)[1]))
    assert ["line"] * 6 in [[piece.kind for piece in fit.pieces] for fit in fits]

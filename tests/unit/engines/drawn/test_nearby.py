"""Rows beside a row: what a drawing repeats tells elements that their own points hardly tell."""

from __future__ import annotations

import numpy as np
import pytest
from benchmarks.drawn.tables import noisy_points

from shapespline import Contour
from shapespline.engines.drawn import Drawn, DrawnArc, DrawnLine, as_drawn


def drawn_from(name: str, noise: float, n: int, seed: int) -> Drawn:
    samplings = noisy_points(name, np.random.default_rng(seed))
    points = next(p for part, p, _, _ in samplings if (part, len(p)) == (noise, n))
    found = as_drawn(Contour(points, closed=True))
    assert found is not None
    return found


@pytest.mark.parametrize("seed", [1, 3, 4, 5, 6, 7])
def test_a_bracket_in_much_noise_has_all_its_fillets(seed):
    # Noise of 1.9 in fillets of radius 12.9: four of one radius and a larger one, six edges. Alone
    # each was a chamfer, a corner or, with an edge of 21 between two, a chain of arcs (seed 6).
    found = drawn_from("bracket", 0.5, 1000, seed)
    radii = sorted(part.arc.radius for part in found.parts if isinstance(part, DrawnArc))
    assert sum(isinstance(part, DrawnLine) for part in found.parts) == 6
    assert len(radii) == 5
    assert radii[3] - radii[0] < 1e-9 * radii[0]
    # The larger one is twice as large; a radius is told to a few deviations.
    assert radii[4] > 1.3 * radii[3]


def test_fillets_of_one_radius_are_not_two_and_two():
    # Two of four fillets had radius 17.9, 13.0 the others: moved one by one they saved nothing.
    found = drawn_from("bracket", 0.1, 200, 0)
    radii = sorted(part.arc.radius for part in found.parts if isinstance(part, DrawnArc))
    assert len(radii) == 5
    assert radii[3] - radii[0] < 1e-9 * radii[0]


@pytest.mark.parametrize("seed", [1, 2, 7])
def test_free_form_runs_between_edges_become_fillets(seed):
    # 200 points of a tee: fillets of three points were free-form runs, or chamfers.
    found = drawn_from("tee", 0.02, 200, seed)
    kinds = [type(part) for part in found.parts]
    assert kinds.count(DrawnArc) == 6
    assert kinds.count(DrawnLine) == 8
    assert len(kinds) == 14


@pytest.mark.parametrize("seed", [4, 5, 7])
def test_chamfers_and_corners_that_are_told_together_become_fillets(seed):
    # Fillets of radius 7.2 in noise of 1.3: each alone saves less than its radius costs.
    found = drawn_from("box little rounded", 0.5, 1000, seed)
    radii = [part.arc.radius for part in found.parts if isinstance(part, DrawnArc)]
    assert len(found.parts) == 8
    assert len(radii) == 4
    assert max(radii) - min(radii) < 1e-9 * min(radii)


@pytest.mark.parametrize("name", ["house", "arrow", "star 7"])
@pytest.mark.parametrize("seed", range(3))
def test_corners_get_no_fillets(name, seed):
    found = drawn_from(name, 0.5, 200, seed)
    assert all(isinstance(part, DrawnLine) for part in found.parts)

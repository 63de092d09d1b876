"""Edges along the directions that others share: a few noisy points hardly tell their own."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
from benchmarks.drawn.tables import noisy_points

from shapespline import Contour
from shapespline.engines.drawn import DrawnArc, DrawnLine, as_drawn
from shapespline.engines.drawn.directed import rows_along
from shapespline.engines.drawn.model import Model
from shapespline.engines.drawn.observed import Observed
from shapespline.engines.drawn.regularities import NAMES, Search
from shapespline.engines.drawn.segments import LINE, segmented

if TYPE_CHECKING:
    from shapespline.typing import FloatArray


def polygon(corners: list[tuple[float, float]], each: int = 20) -> FloatArray:
    t = np.arange(each)[:, None] / each
    ends = np.roll(corners, -1, axis=0)
    return np.concatenate([a + t * (b - a) for a, b in zip(np.array(corners), ends, strict=True)])


def model_of(points: FloatArray) -> Model:
    seen = Observed.of(Contour(points, closed=True), None)
    model = Model.of(seen, segmented(seen), None, None)
    Search(model, NAMES).run()
    return model


@pytest.mark.parametrize("seed", [3, 8])
def test_a_bracket_of_few_points_in_much_noise_is_one(seed):
    # Six edges and five fillets of five to ten points whose noise is a ninth of a fillet's chord:
    # read with free directions they were five lines, an arc and a run.
    samplings = noisy_points("bracket", np.random.default_rng(seed))
    points = next(p for part, p, _, _ in samplings if (part, len(p)) == (0.5, 200))
    found = as_drawn(Contour(points, closed=True))
    assert found is not None
    lines = [part for part in found.parts if isinstance(part, DrawnLine)]
    arcs = [part for part in found.parts if isinstance(part, DrawnArc)]
    assert (len(lines), len(arcs), len(found.parts)) == (6, 5, 11)
    for line in lines:
        assert (line.begin == line.end).any()


def test_without_a_shared_direction_there_is_no_such_row():
    model = model_of(polygon([(0, 0), (10, 1), (3, 8)]))
    assert [kind for _, _, kind in model.row.found] == [LINE] * 3
    assert list(rows_along(model)) == []


def test_edges_at_right_angles_share_a_direction():
    # All of a turned box; the row along them is the box itself.
    box = np.array([(0, 0), (10, 0), (10, 6), (0, 6)]) @ np.array([[0.8, 0.6], [-0.6, 0.8]])
    model = model_of(polygon(box.tolist()))
    first = next(rows_along(model))
    assert [kind for _, _, kind in first.found] == [LINE] * 4
    assert {end - begin for begin, end, _ in first.found} == {20}

"""What readings cost that differ in their free-form runs, joints and numbers of elements."""

from __future__ import annotations

import numpy as np
import pytest

from shapespline import Contour
from shapespline.engines.drawn.estimated import ELEMENT, estimated
from shapespline.engines.drawn.model import Model
from shapespline.engines.drawn.observed import Observed
from shapespline.engines.drawn.segments import (
    FREE,
    FREE_OF_POINTS,
    LINE,
    LINE_LINE_SMOOTH,
    PRICE,
    Segment,
    segmented,
)

NOISE, STEPS = 0.002, 40


@pytest.fixture(scope="module")
def square():
    """Noisy points of a unit square, and its four sides."""
    t = np.linspace(0, 1, STEPS, endpoint=False)
    side = np.column_stack([t, 0 * t])
    turns = [np.array([[c, s], [-s, c]]) for c, s in [(1, 0), (0, 1), (-1, 0), (0, -1)]]
    places = [(0, 0), (1, 0), (1, 1), (0, 1)]
    points = np.concatenate([side @ turn + at for turn, at in zip(turns, places, strict=True)])
    points += np.random.default_rng(1).normal(0, NOISE, points.shape)
    seen = Observed.of(Contour(points, closed=True), None)
    row = segmented(seen)
    assert [segment.kind for segment in row.found] == [LINE] * 4
    return seen, row


def as_it_is(seen, row):
    found = estimated(Model.of(seen, row), row, np.inf)
    assert found is not None
    assert found.model.row is row
    return found


def test_points_of_free_form_runs_are_as_far_off_as_others(square):
    # Else a long run pays for itself by the misfit of its points.
    seen, row = square
    first, *rest = row.found
    sides = as_it_is(seen, row)
    run = row._replace(found=(first._replace(kind=FREE), *rest)).turned(1)
    with_run = as_it_is(seen, run)
    per_point = 0.5 * with_run.model.chi_sq / with_run.model.row.found[2].end
    told = with_run.cost + per_point * (first.end - first.begin)
    expected = told + PRICE * (FREE_OF_POINTS + 4 * ELEMENT)
    assert with_run.whole_cost == pytest.approx(expected, rel=1e-12)
    assert with_run.cost < sides.cost
    assert with_run.whole_cost > sides.whole_cost


def test_smooth_joints_of_lines_and_elements_cost(square):
    # A side cut in two, which no corner explains.
    seen, row = square
    first, *rest = row.found
    middle = (first.begin + first.end) // 2
    cut = row._replace(found=(first._replace(end=middle), Segment(middle, first.end, LINE), *rest))
    sides, halves = as_it_is(seen, row), as_it_is(seen, cut)
    more = halves.whole_cost - halves.cost - (sides.whole_cost - sides.cost)
    assert more == pytest.approx(PRICE * (LINE_LINE_SMOOTH + ELEMENT), rel=1e-9)

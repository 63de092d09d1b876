"""Which stretches of an outline are lines, arcs and free-form runs."""

from __future__ import annotations

import pytest
from benchmarks.drawn.profiles import PROFILES
from benchmarks.drawn.truth import Line, sampled

from shapespline.engines.drawn.observed import Observed
from shapespline.engines.drawn.segments import FREE, LINE, segmented
from shapespline.values import Contour


@pytest.mark.parametrize("name", ["cover", "saddle (aside)"])
def test_a_point_in_a_corner_breaks_no_bit_off_an_edge(name):
    # The chord across the corner holds it, some thousandths off the edge.
    points = Contour(sampled(PROFILES[name], 0.01), closed=True).resampled(1500).points[::-1]
    row = segmented(Observed.of(Contour(points, closed=True), None))
    lines = [segment for segment in row.found if segment.kind == LINE]
    assert FREE in {segment.kind for segment in row.found}
    assert len(lines) >= sum(isinstance(one, Line) for one in PROFILES[name])
    assert min(segment.end - segment.begin for segment in lines) > 3

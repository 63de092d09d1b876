"""Where curvature jumps: from an edge to its fillet, not along a chain of arcs on a curve."""

from __future__ import annotations

import numpy as np
import pytest
from benchmarks.drawn.random_plates import plate
from benchmarks.drawn.renderers import exact
from benchmarks.drawn.truth import placed

import shapespline as ss
from shapespline import Contour
from shapespline.engines.drawn.jumps import jump_clearly
from shapespline.engines.drawn.model import Model
from shapespline.engines.drawn.observed import Observed
from shapespline.engines.drawn.segments import ARC, LINE, Segment, segmented

ACCURACY = 0.02


def model_of(points, found=None):
    seen = Observed.of(Contour(points, closed=True), ACCURACY)
    row = segmented(seen)
    if found is not None:
        row = row._replace(first=0, points=np.concatenate([points, points[:1]]), found=found)
    return Model.of(seen, row, None, None)


def ellipse_in_arcs(n_arcs):
    """Points on an ellipse one apart, and arcs of as many of them each."""
    t = np.linspace(0, 2 * np.pi, 20_000)
    dense = np.column_stack([60 * np.cos(t), 40 * np.sin(t)])
    # Where arcs are mirror images of each other their curvature does not jump at all.
    points = np.roll(Contour(dense[:-1], closed=True).resampled(320).points, -7, axis=0)
    each = 320 // n_arcs
    return points, tuple(Segment(k, k + each, ARC) for k in range(0, 320, each))


@pytest.mark.parametrize("tolerance", [None, 0.35])
@pytest.mark.parametrize(("form", "draw"), [("Z", 4), ("U", 1), ("box", 1)])
def test_a_traced_plate_that_repeats_nothing_has_its_lines_and_arcs(form, draw, tolerance):
    # No two directions, no two radii are alike: nothing but its joints tells that it was drawn.
    outlines = placed([plate(form, draw, regular=False)], 512, 0.0, seed=draw)
    (contour,) = ss.trace(exact(outlines, 512))
    fit = ss.fit_curve(contour, tolerance=tolerance)
    own = sorted(type(one).__name__.lower() for one in outlines[0])
    assert sorted(piece.kind for piece in fit.pieces) == own


# Eight arcs miss the ellipse by ten deviations, their curvatures jump by as much as that; sixteen
# miss it by one, and hardly jump where the ellipse is flattest.
@pytest.mark.parametrize("n_arcs", [8, 16])
def test_arcs_that_follow_an_ellipse_do_not_jump(n_arcs):
    points, found = ellipse_in_arcs(n_arcs)
    model = model_of(points, found)
    assert len(model.at) == n_arcs
    assert not jump_clearly(model)


def test_edges_and_fillets_do():
    t = np.linspace(0, np.pi / 2, 17)[:-1]
    bend = 10 * np.column_stack([np.cos(t), np.sin(t)])
    side = np.column_stack([np.full(40, 10.0), np.arange(-40.0, 0.0)])
    quarter = np.concatenate([side, bend])
    turns = [
        np.array([[np.cos(a), np.sin(a)], [-np.sin(a), np.cos(a)]])
        for a in np.pi / 2 * np.arange(4)
    ]
    centres = [(0, 0), (-40, 0), (-40, -40), (0, -40)]
    points = np.concatenate([quarter @ turn + c for turn, c in zip(turns, centres, strict=True)])
    model = model_of(points)
    assert sorted(segment.kind for segment in model.row.found) == [LINE] * 4 + [ARC] * 4
    assert jump_clearly(model)


def test_corners_alone_say_nothing():
    corners = np.array([(0, 0), (80, 7), (61, 66), (11, 50)])
    ends = np.roll(corners, -1, axis=0)
    each = np.arange(60)[:, None] / 60
    points = np.concatenate([a + each * (b - a) for a, b in zip(corners, ends, strict=True)])
    model = model_of(points)
    assert {segment.kind for segment in model.row.found} == {LINE}
    assert not jump_clearly(model)

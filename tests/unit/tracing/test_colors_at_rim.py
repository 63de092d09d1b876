"""Areas of colours as large as their picture: nothing of them is cut, and nothing is left over."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import cKDTree
from tests.support.rendering import coverage, tile

import shapespline as ss
from shapespline.geometry import signed_area
from shapespline.tracing import trace

SIDE, PAPER = 60, np.array([250.0, 246, 240])
INKS = np.array([(200.0, 40, 30), (30, 42, 120)])
# Grey is read as in tests/unit/tracing/test_edges_at_rim.py, of 250 steps in a channel.
READ = 1 / 64


def disc(x, y):
    return np.hypot(x - SIDE / 2, y - SIDE / 2) <= SIDE / 2


def half(x, y):
    return disc(x, y) & (x > SIDE / 2)


def strip(x, y):
    """Cut off at two sides."""
    return np.abs(y - 0.4 * x - 20) < 6


def picture(*figures):
    shown = np.broadcast_to(PAPER, (SIDE, SIDE, 3)).copy()
    for ink, figure in zip(INKS, figures, strict=False):
        shown += coverage(figure, SIDE, SIDE)[..., None] * (ink - shown)
    return np.rint(shown).astype(np.uint8)


FIGURES = {"disc": (disc,), "halves": (disc, half), "tile": (tile(SIDE, 14),), "strip": (strip,)}


@pytest.mark.parametrize("name", FIGURES)
def test_cut_to_the_figure_areas_are_the_same(name):
    shown, n_colors = picture(*FIGURES[name]), 1 + len(FIGURES[name])
    cut = trace(shown, colors=n_colors)
    assert sum(signed_area(contour.points) for contour in cut) == pytest.approx(SIDE**2, rel=1e-9)
    points = np.concatenate([contour.points for contour in cut])
    assert points.min() == 0
    assert points.max() == SIDE
    if name == "strip":  # more paper beside it is another picture
        return
    wide = np.empty((SIDE + 18, SIDE + 18, 3), dtype=np.uint8)
    wide[:] = PAPER
    wide[9:-9, 9:-9] = shown
    wide = trace(wide, colors=n_colors)
    own, other = (
        [c for c, color in zip(one, one.colors, strict=True) if color not in (None, paper(one))]
        for one in (cut, wide)
    )
    assert len(own) == len(other)
    for one in own:
        dense = [ss.Contour.silently(c.points - 9, closed=True).resampled(8000) for c in other]
        tree = cKDTree(np.concatenate([contour.points for contour in dense]))
        assert tree.query(one.points)[0].max() < 2 * READ


def paper(shape):
    """The lightest colour."""
    told = {color for color in shape.colors if color}
    return max(told, key=lambda color: sum(bytes.fromhex(color[1:])))


def test_a_circle_that_fills_its_picture_is_one():
    drawing = ss.fit_shape(trace(picture(disc), colors="auto"))
    circles = [piece.arc for fit in drawing for piece in fit.pieces if piece.kind == "arc"]
    assert len(circles) == 2  # of the area and of the hole in the paper
    for circle in circles:
        assert abs(circle.radius - SIDE / 2) < READ

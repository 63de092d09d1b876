"""Long straight edges between curves, where nothing else tells of a drawing."""

from __future__ import annotations

import numpy as np
import pytest
from benchmarks.drawn.found import Found
from benchmarks.drawn.renderers import exact
from benchmarks.drawn.shapes import smooth
from benchmarks.drawn.truth import Cubic, Line

import shapespline as ss

SIZE = 256


def loaf(height):
    """A level base and a level side, everything else free curves that go on smoothly from them."""
    a, b, c, d = (np.array(p) for p in ((-35.0, -60.0), (40.0, -60.0), (75.0, -15.0), (75.0, 40.0)))
    return [
        Line(a, b),
        Cubic(np.array([b, b - [-25.0, 0.0], c - [0.0, 30.0], c])),
        Line(c, d),
        Cubic(np.array([d, d - [0.0, -24.0], [40.0, height], [5.0, height - 12.0]])),
        Cubic(np.array([[5.0, height - 12.0], [-30.0, height - 24.0], [-80.0, 20.0], [-88, -10]])),
        Cubic(np.array([[-88.0, -10.0], [-96.0, -40.0], a - [40.0, 0.0], a])),
    ]


def fit_of(outline, *, turn=0.0, **options):
    drawn = tuple(one.moved(1.0, np.radians(turn), np.array([128.3, 127.6])) for one in outline)
    (fit,) = ss.fit_shape(ss.trace(exact([drawn], SIZE)), character="drawn", **options)
    return drawn, fit


@pytest.mark.parametrize("height", [70.0, 84.0])
@pytest.mark.parametrize("options", [{}, {"tolerance": 0.35}])
def test_level_edges_between_curves_are_level(height, options):
    # They were part of curves that bowed by a tenth of a pixel, and leaned.
    drawn, fit = fit_of(loaf(height), **options)
    lines = [piece for piece in fit.pieces if piece.kind == "line"]
    assert len(lines) == 2
    level = {one.pieces for one in fit.regularities if one.name == "axis-parallel"}
    assert len(level) == 2
    for piece in lines:
        along = np.ptp(piece.control_points, axis=0)
        axis = int(np.argmin(along))
        assert along[axis] == 0.0  # to the bit
        true = drawn[0] if axis else drawn[2]
        assert abs(piece.control_points[0, axis] - true.begin[axis]) < 0.02
        # A curve of 60 pixels of radius leaves its tangent by what points are off by in four.
        assert abs(along.max() - np.hypot(*(true.end - true.begin))) < 16.0
    assert not len(Found.of_fits([fit]).breaks)
    assert fit.kept


def test_what_is_not_level_tells_nothing():
    _, fit = fit_of(loaf(70.0), turn=17.0)
    assert not fit.regularities


@pytest.mark.parametrize("seed", range(4))
def test_smooth_outlines_have_no_edges(seed):
    angle = 2 * np.pi * np.arange(14) / 14
    radii = 80.0 + 14.0 * np.random.default_rng(seed).normal(size=14)
    ring = smooth(radii[:, None] * np.column_stack([np.cos(angle), np.sin(angle)]))
    _, fit = fit_of(ring)
    assert not fit.regularities

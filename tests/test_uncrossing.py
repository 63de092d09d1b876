"""Slits narrower than the tolerance stay open, for few points."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from benchmarks.outside_metric import two_sided
from numpy.testing import assert_allclose, assert_array_equal
from tests import shapes

import shapespline as ss
from shapespline.engines.pieces.engine import fit_pieces
from shapespline.fitting.repair.assignment import DataRun, PieceAssignment, curve_of, located
from shapespline.fitting.repair.clearance import Sides, moved
from shapespline.fitting.repair.crossings import _no_larger_than_data
from shapespline.fitting.verify import verified_fit
from shapespline.geometry.flattening import sampled
from shapespline.geometry.intersections import crossing_pairs, self_crossings
from shapespline.geometry.joining import joined
from shapespline.geometry.nearest import nearest
from shapespline.values.piece import Piece

IMAGES = Path(__file__).resolve().parents[1] / "examples" / "data" / "images"


def crossings(fit, tolerance):
    return self_crossings(sampled(fit.spline, 0.01 * tolerance)[0].polyline)


def airfoil(camber, power, n=40):
    """A cambered airfoil whose trailing edge is sharp and thin for long; from there around."""
    x = 0.5 * (1 + np.cos(np.pi * np.arange(n) / n))
    middle = camber * np.sin(np.pi * x**1.5)
    half = 0.12 * np.sqrt(x) * (1 - x) ** power
    upper = np.column_stack([x, middle + half])
    lower = np.column_stack([x, middle - half])[:0:-1]
    return np.concatenate([upper, [(0.0, 0.0)], lower])


def ribbon(waves, half, n=150):
    """A closed outline around a wavy band that is thinner than the tolerance."""
    x = np.linspace(-1, 1, n)
    middle = 0.1 * np.sin(waves * x)
    low, high = middle - half * (1 + 0.5 * np.sin(5 * x)), middle + half * (1 + 0.5 * np.cos(4 * x))
    return np.concatenate([np.column_stack([x, low]), np.column_stack([x, high])[::-1]])


SLITS = [
    *(
        (airfoil(camber, 2.5), part)
        for camber in (0.03, 0.06, 0.09)
        for part in (0.003, 0.008, 0.012)
    ),
    *((ribbon(waves, 0.002), part) for waves in (7, 11) for part in (0.005, 0.008)),
]


@pytest.mark.slow
def test_slits_stay_open_for_few_points():
    n_crossing = 0
    for points, part in SLITS:
        contour = ss.Contour(points, closed=True)
        tolerance = part * contour.box_diagonal
        searched = fit_pieces(contour, tolerance)
        n_crossing += crossings(searched, tolerance) > 0
        fit = ss.fit_curve(contour, tolerance=tolerance)
        assert crossings(fit, tolerance) == self_crossings(contour.polyline) == 0
        assert fit.kept
        assert two_sided(fit.curve, points, closed=True, step=tolerance / 10).larger <= tolerance
        # Cubics err with the fourth power of their length: twice the points are a fit of everything
        # within a sixteenth of the distance.
        assert fit.n_stored_points <= 2 * searched.n_stored_points
    assert n_crossing >= 3  # else no test


def test_curves_beside_slits_do_not_depend_on_the_first_point():
    points = airfoil(0.03, 2.5)
    tolerance = 0.008 * ss.Contour(points, closed=True).box_diagonal
    fits = [
        ss.fit_curve(np.roll(points, k, axis=0), closed=True, tolerance=tolerance)
        for k in (0, 1, 33)
    ]
    for fit in fits[1:]:
        assert_array_equal(fit.control_points, fits[0].control_points)


@pytest.mark.slow
def test_every_outline_of_a_drawing_comes_apart():
    # One of them is so narrow that a node is nearer to the other side than to its own.
    drawing = ss.fit_shape(ss.read(IMAGES / "opencv_butterfly.jpg"), tolerance=1.5)
    assert all(fit.kept and crossings(fit, 1.5) == 0 for fit in drawing)
    assert not [fit for fit in drawing if "crosses" in fit.status.value]


def trail(contour):
    return DataRun(contour.points, contour.arc_length[: len(contour)])


def test_what_lies_across_a_slit_by_hand():
    hairpin = ss.Contour([(0, 0), (4, 0), (8, 0), (8, 1), (4, 1), (0, 1)], closed=False)
    across = Sides.of([hairpin]).across(trail(hairpin), 0, least=0.0)
    # The ways around are 17, 9 and 1: the last is no slit.
    assert_allclose(across[[0, 1, 4, 5]], [(0, -1), (0, -1), (0, 1), (0, 1)])
    assert np.isinf(across[[2, 3]]).all()
    far = Sides.of([hairpin]).across(trail(hairpin), 0, least=10.0)
    assert np.isinf(far).all(axis=1).tolist() == [False, True, True, True, True, False]
    # A closed one is as short the other way around; another outline is always another side.
    ring = ss.Contour(hairpin.points, closed=True)
    assert np.isinf(Sides.of([ring]).across(trail(ring), 0, least=0.0)[0]).all()
    other = ss.Contour(hairpin.points + np.array([0, 3]), closed=False)
    assert_allclose(Sides.of([ring, other]).across(trail(ring), 0, least=0.0)[3], (0, -2))


def test_points_move_apart_and_no_farther_than_the_room():
    within, room = 0.75, 0.25
    points = np.array([(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0)])
    across = np.array([(0.0, 1.2), (0.0, 0.1), (np.inf, np.inf), (0.0, 9.0)])
    feet = points + np.array([(0.0, -1.0), (0.0, 1.0), (0.0, 1.0), (0.0, -0.5)])
    offsets = moved(points, feet, across, within, room) - points
    # Half the gap, 0.6, and 0.15 more than a quarter towards the curve: beyond what is missing.
    assert_allclose(offsets, [(0, 0.15), (0, 0.25), (0, 0.25), (0, -0.125)], atol=1e-15)


def test_parts_hold_every_point_once_from_any_of_them_on():
    contour = ss.Contour(ribbon(7, 0.002), closed=True)
    fit = ss.fit_curve(contour, tolerance=0.3)
    row = PieceAssignment.of(0, fit)
    for at in range(len(row.parts)):
        turned = row.turned(at)
        bounds = [part.begin for part in turned.parts] + [turned.parts[-1].end]
        assert bounds[0] == 0
        assert bounds[-1] == len(contour)
        assert bounds == sorted(bounds)
        assert (np.diff(turned.trail.along) > 0).all()
        assert {tuple(p) for p in turned.trail.points} == {tuple(p) for p in contour.points}


def test_points_that_scatter_go_with_their_pieces():
    """Where data are far longer than the curve along them, and elsewhere not, none is misplaced."""
    x, tolerance = np.linspace(0, 100, 4000), 0.5
    y = 5 * np.sin(x / 3)
    fit = ss.fit_curve(np.column_stack([x, y]), tolerance=0.001, closed=False)
    pieces = [Piece("bezier", 3, np.repeat([0.0, 1.0], 4), p) for p in fit.spline.beziers().points]
    assert len(pieces) > 20
    scatter = 0.9 * tolerance * (-1.0) ** np.arange(len(x)) * (x < 50)
    data = ss.Contour(np.column_stack([x, y + scatter]), closed=False)
    assert data.length > 10 * fit.spline.length()
    parts = located(DataRun(data.points, data.arc_length), pieces, tolerance)
    for part in parts:
        own = data.points[part.begin : part.end]
        assert len(own)
        # A point beside a node may be given to the neighbour of its piece.
        off = np.sqrt(nearest(curve_of(part.piece), own).distances_sq)
        assert off.max() <= 3 * tolerance


@pytest.mark.parametrize("turn", [0.0, 0.3])
def test_ways_that_cross_in_a_vertex_cross(turn):
    """Points on a grid often meet where a pen crosses its own way: nothing to part there."""
    t = np.linspace(0, 6 * np.pi, 90)
    loops = np.column_stack([6 * t + 22 * np.sin(t), 25 * np.cos(t) + 6 * np.sin(0.4 * t)])
    points = shapes.moved(np.round(loops), turn)
    contour = ss.Contour(points, closed=False)
    fit = ss.fit_curve(contour, tolerance=0.6)
    searched = fit_pieces(contour, 0.6)
    assert self_crossings(contour.polyline) == crossings(fit, 0.6) == 3
    assert fit.n_stored_points <= searched.n_stored_points < 20


def test_strokes_that_cross_in_a_vertex_cross():
    bar = np.column_stack([np.arange(-20.0, 21), np.zeros(41)])
    stem = np.column_stack([0.02 * np.arange(-20.0, 21) ** 2, np.arange(-20.0, 21)])
    assert crossing_pairs([bar, stem]) == set()
    assert crossing_pairs([bar, stem], at_vertices=True) == {(0, 1)}
    beside, above = stem + np.array([0.5, 0.0]), bar + np.array([0.0, 3.0])
    assert crossing_pairs([bar, beside], at_vertices=True) == {(0, 1)}
    assert crossing_pairs([bar, above], at_vertices=True) == set()
    shape = ss.Shape([ss.Contour(p, closed=False) for p in (bar, stem)])
    drawing = ss.fit_shape(shape, tolerance=0.3)
    assert all(fit.kept and not fit.status.value.endswith("do not") for fit in drawing)
    assert drawing.fits[0].n_stored_points == 2


def test_what_comes_apart_stores_no_more_points_than_the_data():
    contour = ss.Contour(SLITS[0][0], closed=True)
    halves = [
        Piece("line", 1, np.array([0.0, 0.0, 1.0, 1.0]), np.array(ends))
        for a, b in pairwise(contour.polyline)
        for ends in ((a, (a + b) / 2), ((a + b) / 2, b))
    ]
    larger = verified_fit(
        contour, joined(halves, 3), tolerance=0.01, method="sections", sections=tuple(halves)
    )
    assert larger.n_stored_points == 2 * len(contour)
    smaller = _no_larger_than_data(larger)
    assert smaller.kept
    assert smaller.n_stored_points == len(contour)
    assert _no_larger_than_data(smaller) is smaller

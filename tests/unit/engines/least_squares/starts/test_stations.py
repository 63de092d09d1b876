"""Stations: what gets a control point, by maxima of H, by curvature, by length or by index."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_array_equal
from tests.support.places import DATA
from tests.support.shapes import flower, on_circle, wave

from shapespline import LITERAL, SENSIBLE, Contour, initial_curve, optimize, read
from shapespline.analysis import bending
from shapespline.engines.least_squares import STATIONS
from shapespline.engines.least_squares.starts.stations import MEAN_PART, _filled
from shapespline.errors import DegenerateContourError


def reading(kind, base=SENSIBLE):
    return replace(base, start=kind)


def semi_closed():
    """A drop: its two ends coincide in a corner."""
    t = np.linspace(0, 2 * np.pi, 301)
    points = np.column_stack([10 * np.sin(0.5 * t), 4 * np.sin(t) * np.sin(0.5 * t)])
    points[-1] = points[0]
    return Contour(points, closed=False)


def uneven():
    t = np.linspace(0, 1, 400, endpoint=False)
    t = t + 0.12 * np.sin(2 * np.pi * t)
    r = 10 + 2 * np.cos(10 * np.pi * t)
    angle = 2 * np.pi * t
    return Contour(np.column_stack([r * np.cos(angle), r * np.sin(angle)]), True)


def noisy():
    points = flower(400).points
    return Contour(points + np.random.default_rng(1).normal(0, 0.03, points.shape), True)


SHAPES = {
    "periodic": flower(300),
    "open": wave(),
    "semi-closed": semi_closed(),
    "uneven": uneven(),
    "noisy": noisy(),
}


@pytest.mark.slow
@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("kind", STATIONS)
@pytest.mark.parametrize("clamped", [False, True])
def test_every_kind_on_every_shape_with_a_given_number(shape, kind, clamped):
    contour, n = SHAPES[shape], 10 if kind == "cpda-maxima" else 40
    if kind == "cpda-maxima" and not (contour.closed and not clamped):
        n = 4
    start = initial_curve(
        contour, 8, reading=replace(reading(kind), clamped=clamped), n_control_points=n
    )
    assert start.n_control_points == n
    assert (np.diff(start.stations) > 0).all()
    assert (np.diff(start.parameters) >= 0).all()
    fit = optimize(contour, start, "levenberg-marquardt")
    assert fit.history[-1].cost < fit.history[0].cost


def test_maxima_stay_stations_where_gaps_are_filled():
    for kind in ("cpda-filled", "cpda-halved"):
        start = initial_curve(flower(300), 8, reading=reading(kind))
        assert len(start.stations) > len(start.cpda.maxima) > 0
        assert np.isin(start.cpda.maxima, start.stations).all()


def test_gaps_are_filled_at_equal_integrals_of_the_density():
    """The integrals are taken anew, by the definition, on an ellipse without symmetry of points."""
    t = np.linspace(0, 2 * np.pi, 2000, endpoint=False) + 0.3
    ellipse = Contour(np.column_stack([4 * np.cos(t), np.sin(t)]), True).resampled(2000)
    start = initial_curve(ellipse, 8, n_control_points=41)
    root = np.sqrt(bending(ellipse, 8))
    density = root + MEAN_PART * root.mean()
    stations = start.stations
    edges = np.append(stations, stations[0] + 2000)
    shares = np.array(
        [
            sum(0.5 * (density[i % 2000] + density[(i + 1) % 2000]) for i in range(a, b))
            for a, b in pairwise(edges)
        ]
    )
    # Between two maxima all shares are alike but for the rounding to whole points, at both ends.
    at = np.isin(stations, start.cpda.maxima)
    assert at.sum() == 2
    first, second = np.flatnonzero(at)
    for gap in (shares[first:second], np.concatenate([shares[second:], shares[:first]])):
        assert np.ptp(gap) <= 2 * density.max()
    # And both gaps, which bend alike, are cut as finely as whole numbers of parts allow.
    half = 0.5 * shares.sum()
    assert np.ptp(shares) <= half / 20 - half / 21 + 2 * density.max()


def test_curvature_is_that_of_the_outline():
    radius = 7.0
    circle = Contour(on_circle(400, radius), True)
    assert np.abs(bending(circle, 8) * radius - 1).max() < 0.01
    assert not bending(Contour(np.column_stack([np.arange(99.0), np.zeros(99)]), False), 8).any()


@pytest.mark.parametrize("kind", ["arc-length", "every-nth"])
def test_without_maxima_stations_are_even(kind):
    contour = uneven()
    start = initial_curve(contour, 8, reading=reading(kind), n_control_points=40)
    at = start.samples.arc_length[start.stations]
    steps = np.diff(start.stations) if kind == "every-nth" else np.diff(at)
    largest = 1 if kind == "every-nth" else np.diff(start.samples.arc_length).max()
    assert np.ptp(steps) <= 2 * largest
    if kind == "every-nth":
        assert start.samples is contour


def test_every_nth_literal_control_point_is_a_data_point():
    contour = flower(300)
    literal = replace(LITERAL, start="every-nth", offset="none")
    start = initial_curve(contour, 4, reading=literal, n_control_points=31)
    assert_array_equal(start.control_points, contour.polyline[::10])


def test_fewer_stations_than_maxima_are_the_highest():
    start = initial_curve(flower(300), 8, n_control_points=5)
    heights = np.sort(start.cpda.values[start.cpda.maxima])[::-1]
    assert set(start.cpda.values[start.stations]) == set(heights[:5])


def test_too_many_and_too_few():
    with pytest.raises(DegenerateContourError, match="finds 10 maxima, at least 12 are needed"):
        initial_curve(flower(300), 8, reading=reading("cpda-maxima"), n_control_points=12)
    dense = initial_curve(flower(40), 4, n_control_points=40)
    assert_array_equal(dense.stations, np.arange(40))


@pytest.mark.slow
@settings(max_examples=200, deadline=None)
@given(st.data())
def test_stations_are_distinct_and_inside_whatever_the_density(data):
    n = data.draw(st.integers(6, 40))
    closed = data.draw(st.booleans())
    weights = data.draw(st.lists(st.floats(1e-3, 1e3), min_size=n, max_size=n))
    grown = np.concatenate([[0.0], np.cumsum(weights)])
    room = range(n) if closed else range(1, n)
    fixed = np.array(sorted(data.draw(st.sets(st.sampled_from(room), max_size=4))), dtype=np.int64)
    count = data.draw(st.integers(max(len(fixed), 1), len(room)))
    found = _filled(fixed, grown, count, closed=closed)
    assert len(found) == count
    assert (np.diff(found) > 0).all()
    assert np.isin(fixed, found).all()
    assert set(found) <= set(room)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["paper/leaf840", "paper/palm620", "paper/airplane1100"])
@pytest.mark.parametrize("length", [3, 8])
def test_the_two_lines_of_the_readme_stay_within_a_hundredth(name, length):
    contour = read(DATA / f"{name}.csv", closed=True).longest
    start = initial_curve(contour, length=length)
    fit = optimize(contour, start, method="d-bfgs")
    assert fit.hausdorff_distance < 0.01 * contour.box_diagonal

"""are_drawn_vertices: teeth, slots and steps are told from noise, and from outlines of pixels."""

from __future__ import annotations

import numpy as np
import pytest
from tests.support.toothed import comb, finger_plate, star

import shapespline as ss
from shapespline.analysis import resolution
from shapespline.analysis.drawn_vertices import are_drawn_vertices
from shapespline.analysis.noise import noise_level, scatter
from shapespline.values import Contour


def turned(points, degrees=23.0):
    angle = np.radians(degrees)
    c, s = np.cos(angle), np.sin(angle)
    return points @ np.array([[c, s], [-s, c]])


TOOTHED = {
    "star": (star(32), True),
    "star of 100": (star(100), True),
    "plate": (finger_plate(200.0, 100.0, 21, 11, 3.0), True),
    "plate, turned": (turned(finger_plate(200.0, 100.0, 21, 11, 3.0)), True),
    "teeth as deep as wide": (finger_plate(210.0, 110.0, 21, 11, 10.0), True),
    "comb": (comb(20, 1.0, 30.0), False),
    "comb with an even lattice": (comb(20, 3.0, 3.0), False),
    "saw": (np.column_stack([np.arange(80.0), 1.5 * (np.arange(80) % 2)]), False),
}


@pytest.mark.parametrize("name", TOOTHED)
def test_vertices_of_a_drawing_are_no_noise(name):
    points, closed = TOOTHED[name]
    contour = Contour(points, closed)
    assert scatter(contour) == (0.0, True)
    assert resolution(contour).band < 0.02 * np.diff(contour.arc_length).min()


@pytest.mark.parametrize("name", TOOTHED)
def test_the_polygon_itself_is_the_curve(name):
    points, closed = TOOTHED[name]
    fit = ss.fit_curve(Contour(points, closed))
    # Rounding of the joined curve: some hundred units in the last place of the coordinates.
    assert fit.hausdorff_distance <= 1e-12 * fit.contour.box_diagonal
    assert fit.n_stored_points == len(points)


def test_digits_of_a_file_do_not_hide_that_it_repeats():
    plate = np.round(finger_plate(200.0, 100.0, 21, 11, 3.0), 3)
    assert scatter(Contour(plate, True)).of_vertices


@pytest.mark.parametrize("name", TOOTHED)
def test_shaken_ones_are_noise(name):
    points, closed = TOOTHED[name]
    level = noise_of(points)
    shaken = points + np.random.default_rng(3).normal(0, 0.3 * level, points.shape)
    assert not are_drawn_vertices(shaken, closed, level)


def noise_of(points):
    """What would be the noise of toothed points: a part of their steps."""
    return 0.5 * float(np.median(np.hypot(*np.diff(points, axis=0).T)))


def pixels_of(contour):
    """The pixels that a curve goes through, one after the other."""
    points = np.round(contour)
    return points[(points != np.roll(points, 1, axis=0)).any(axis=1)]


@pytest.mark.parametrize("radius", [12.0, 20.0, 50.0])
def test_an_outline_of_pixels_is_none(radius):
    angle = np.linspace(0, 2 * np.pi, 4000, endpoint=False)
    disc = pixels_of(radius * np.column_stack([np.cos(angle), np.sin(angle)]))
    contour = Contour(disc, True)
    # A picture's pixels repeat themselves, too; half a pixel is what they show.
    assert not scatter(contour).of_vertices
    assert 0.2 < noise_level(contour) < 1.0


@pytest.mark.parametrize("digits", [0, 1, 3])
def test_rounded_noise_is_noise(digits):
    angle = np.linspace(0, 2 * np.pi, 300, endpoint=False)
    ring = 10 * np.column_stack([np.cos(angle), 0.6 * np.sin(angle)])
    noise = max(0.3, 1.5 * 10.0**-digits)
    shaken = np.round(ring + np.random.default_rng(2).normal(0, noise, ring.shape), digits)
    contour = Contour.silently(shaken, True)
    # The median of 300 windows that overlap, of a chi-squared with 3 degrees: 20 % at 4 sigma; and
    # what the steps of a noisy ring take from it.
    assert 0.6 * noise < noise_level(contour) < 1.4 * noise


def test_exact_points_have_no_noise():
    rng = np.random.default_rng(1)
    polygon = np.cumsum(rng.normal(0, 1, (100, 2)), axis=0)
    assert noise_level(Contour(polygon, False)) > 0.1
    assert noise_level(Contour(polygon, False, accuracy=0.0)) == 0.0


def test_digits_of_a_circle_are_noise():
    # Rounded, it repeats itself eight times.
    angle = 2 * np.pi * np.arange(90) / 90
    circle = np.round(9.0 * np.column_stack([np.cos(angle), np.sin(angle)]), 2)
    assert not scatter(Contour(circle, True)).of_vertices

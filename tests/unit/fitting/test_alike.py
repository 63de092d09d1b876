"""Copies that were read differently are read as one of them is, through the public functions."""

import numpy as np
import pytest
from benchmarks.drawn.equal_outlines import PICTURES, SHAPES, TWINS, laid_out, measured, told
from benchmarks.drawn.few_points import is_outline
from benchmarks.drawn.shapes import box

import shapespline as ss
from checks import two_sided

LIGHT_SCAN = "blurred by 0.7, grain of 4, JPEG 90"


def kinds(fit):
    return "".join(sorted(piece.kind[0] for piece in fit.pieces))


def six(name, way="moved", draw=0):
    return laid_out([SHAPES[name]] * 6, draw, way)


@pytest.mark.parametrize(
    ("name", "picture", "way"),
    [
        ("window", "JPEG 90", "moved"),
        ("window", "blurred by 0.5", "on a ring"),
        ("bent slot", LIGHT_SCAN, "mirrored"),
        ("lens", LIGHT_SCAN, "on a ring"),
        ("keyhole", "blurred by 1, grain of 8, JPEG 90", "mirrored"),
    ],
)
def test_copies_in_a_picture_are_read_alike_and_as_they_were_drawn(name, picture, way):
    found = told(six(name, way), picture)
    assert found.right == 6
    assert found.equal


def test_without_regularities_each_is_read_alone():
    shape = ss.trace(PICTURES["JPEG 90"](six("window")))
    alone = [ss.fit_curve(contour, character="drawn", regularities=None) for contour in shape]
    fits = ss.fit_shape(shape, character="drawn", regularities=None).fits
    assert [kinds(fit) for fit in fits] == [kinds(fit) for fit in alone]
    assert len({kinds(fit) for fit in fits}) > 1


@pytest.mark.parametrize(
    ("name", "picture", "way"),
    [
        # Level lines of grainy pictures are as far apart as their grain puts them.
        ("bent slot", "blurred by 1, grain of 8, JPEG 90", "mirrored"),
        # Of those with the same pieces one is farther from the others than these are.
        ("window", LIGHT_SCAN, "moved"),
    ],
)
def test_level_copies_in_grainy_pictures_are_equal(name, picture, way):
    assert told(six(name, way, draw=1), picture).equal


@pytest.mark.parametrize(("way", "draw"), [("moved", 0), ("moved", 1), ("mirrored", 0)])
def test_measured_copies_are_read_alike(way, draw):
    fits = ss.fit_shape(measured(six("tee", way, draw))).fits
    assert all(is_outline(fit, SHAPES["tee"]) for fit in fits)


def test_what_differs_by_a_corner_is_not_made_equal():
    one, other = TWINS["pad, one corner sharp"]
    drawn = laid_out([one, other] * 3, 0, "moved")
    for picture in ("exact coverage", "JPEG 90", LIGHT_SCAN):
        assert told(drawn, picture).right == 6


def test_pads_of_two_radii_keep_them():
    radii = [4.0, 4.5] * 3
    pads = laid_out([box(36.0, 20.0, radius) for radius in radii], 0, "moved")
    for fit in ss.fit_shape(ss.trace(PICTURES["exact coverage"](pads)), character="drawn"):
        middle = fit.contour.points.mean(axis=0)
        own = [np.mean([one.points(1.0).mean(axis=0) for one in pad], axis=0) for pad in pads]
        radius = radii[int(np.hypot(*(np.array(own) - middle).T).argmin())]
        found = [piece.arc.radius for piece in fit.pieces if piece.kind == "arc"]
        assert np.abs(np.array(found) - radius).max() < 0.1


@pytest.mark.parametrize(("name", "tolerance"), [("keyhole", 0.2), ("window", 0.35)])
def test_copies_within_a_tolerance_keep_it(name, tolerance):
    # Curves of other keyholes are farther from some than the smaller one.
    shape = ss.trace(PICTURES["JPEG 90"](six(name)))
    drawing = ss.fit_shape(shape, tolerance=tolerance)
    for fit in drawing:
        found = two_sided(fit.spline, fit.contour.points, closed=True, step=tolerance / 20)
        assert fit.kept
        assert found.larger <= tolerance


def test_level_edges_of_copies_stay_level():
    pads = laid_out([SHAPES["pad"]] * 6, 1, "moved")
    fits = ss.fit_shape(ss.trace(PICTURES[LIGHT_SCAN](pads)), character="drawn").fits
    lines = [piece.control_points for fit in fits for piece in fit.pieces if piece.kind == "line"]
    assert len(lines) == 24
    assert all((np.abs(points[1] - points[0]) == 0.0).any() for points in lines)


def test_a_curve_that_misses_the_points_of_a_copy_does_not_stand_for_it():
    # Two rings of one length, of which the second has a dent that noise does not make.
    t = 2 * np.pi * np.arange(200) / 200
    circle = np.column_stack([np.cos(t), np.sin(t)])
    rng = np.random.default_rng(3)
    wave = (20 + 2 * np.cos(3 * t))[:, None] * circle
    dented = (20 + 2 * np.cos(3 * t) - 0.5 * np.exp(-(((t - 3) / 0.08) ** 2)))[:, None] * circle
    contours = [
        ss.Contour(points + rng.normal(0, 0.05, points.shape), closed=True)
        for points in (wave, dented + np.array([60, 0]))
    ]
    alone = [ss.fit_curve(contour) for contour in contours]
    for fit, own in zip(ss.fit_shape(ss.Shape(contours)), alone, strict=True):
        assert fit.rms_distance == pytest.approx(own.rms_distance, rel=1e-9)

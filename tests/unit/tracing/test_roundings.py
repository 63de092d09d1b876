"""Round corners and ends of one to four pixels of radius come back as arcs, all alike."""

from __future__ import annotations

import numpy as np
import pytest
from benchmarks.drawn import renderers
from benchmarks.drawn.shapes import box as drawn_box
from benchmarks.drawn.shapes import rounded
from benchmarks.drawn.tables import rendered
from benchmarks.drawn.truth import sampled
from scipy.spatial import cKDTree
from tests.support.rendering import coverage, dark, polygon

import shapespline as ss
from shapespline.tracing.touching import Touching

# Ink is counted by samples of a 32nd, so sides lie up to half of one beside their places: along the
# r pixels of each that a corner takes that is r / 32 of ink together, and a radius is read off
# r^2 (2 - pi / 2) / 2 of it.
SIZE = 256
READ = 1 / 32 / (2 - np.pi / 2)


def box(middle, half, radius, turn=0.0):
    """A rectangle with round corners, turned."""
    along = np.array([np.cos(turn), np.sin(turn)])

    def inside(x, y):
        x, y = x - middle[0], y - middle[1]
        u, v = along[0] * x + along[1] * y, along[0] * y - along[1] * x
        dx, dy = (
            np.maximum(np.abs(c) - (h - radius), 0.0) for c, h in zip((u, v), half, strict=True)
        )
        return np.hypot(dx, dy) <= radius

    return inside


def fitted(*insides, size=48):
    ink = np.zeros((size, size))
    for inside in insides:
        ink = np.maximum(ink, coverage(inside, size, size))
    return list(ss.fit_shape(ss.trace(dark(ink))))


@pytest.mark.parametrize("radius", [1.0, 1.5, 2.0, 2.5, 3.0])
@pytest.mark.parametrize("place", [(24.0, 24.0), (24.3, 23.6), (23.85, 24.55)])
def test_all_corners_of_a_rounded_rectangle_are_round(radius, place):
    (fit,) = fitted(box(place, (15.2, 11.7), radius))
    radii = [piece.arc.radius for piece in fit.pieces if piece.arc is not None]
    assert [piece.kind for piece in fit.pieces].count("line") == len(radii) == 4
    assert len(fit.pieces) == 8
    np.testing.assert_allclose(radii, radius, atol=READ)
    assert np.ptp(radii) < 1e-9  # they are told to be equal


@pytest.mark.parametrize("width", [2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0])
@pytest.mark.parametrize("turn", [0.0, 0.5 * np.pi, 0.25 * np.pi, 0.4])
def test_both_ends_of_a_stroke_are_half_circles(width, turn):
    (fit,) = fitted(box((24.2, 23.7), (14.0, 0.5 * width), 0.5 * width, turn))
    arcs = [piece.arc for piece in fit.pieces if piece.arc is not None]
    assert sorted(piece.kind for piece in fit.pieces) == ["arc", "arc", "line", "line"]
    np.testing.assert_allclose([arc.radius for arc in arcs], 0.5 * width, atol=READ)
    np.testing.assert_allclose([abs(arc.sweep) for arc in arcs], np.pi, atol=0.02)


def test_inner_and_outer_corners_of_a_frame_keep_their_radii():
    def frame(x, y):
        return box((24.3, 23.8), (18, 15), 3.0)(x, y) & ~box((24.3, 23.8), (15, 12), 1.0)(x, y)

    fits = fitted(frame)
    assert [len(fit.pieces) for fit in fits] == [8, 8]
    for fit, radius in zip(fits, (3.0, 1.0), strict=True):
        radii = [piece.arc.radius for piece in fit.pieces if piece.arc is not None]
        np.testing.assert_allclose(radii, radius, atol=READ)


def test_sharp_corners_stay_sharp():
    (fit,) = fitted(box((24.3, 23.6), (15.2, 11.7), 0.0, 0.2))
    assert [piece.kind for piece in fit.pieces] == ["line"] * 4


@pytest.mark.parametrize("name", ["keyhole", "home"])
def test_arcs_beyond_the_rim_are_told_by_nothing(name):
    # No pixel lies along them; their mean was none, which numpy warned of.
    assert len(ss.trace(rendered(name, 128, "cut to the ink, JPEG 90")[1])) > 0


@pytest.mark.parametrize("radius", [3.0, 3.5, 3.8, 4.0, 4.2])
@pytest.mark.parametrize("place", [(24.0, 24.0), (24.3, 23.6), (24.5, 24.5), (24.8, 24.2)])
def test_ends_of_few_chords_are_half_circles(radius, place):
    # As Cairo draws them: corners on the circle, chords a tenth of a pixel inside, fifteen rows.
    n = int(np.ceil(np.pi / (2 * np.arccos(1 - 0.1 / radius))))
    angles = np.linspace(-0.5 * np.pi, 0.5 * np.pi, n + 1)
    right = np.column_stack([14 - radius + radius * np.cos(angles), radius * np.sin(angles)])
    inside = polygon(np.concatenate([right, -right]) + place)
    rows, columns = (np.arange(48 * steps) + 0.5 for steps in (15, 64))
    ink = inside(*np.meshgrid(columns / 64, 48 - rows / 15)).reshape(48, 15, 48, 64)
    (fit,) = ss.fit_shape(ss.trace(dark(ink.mean(axis=(1, 3)))))
    assert sorted(piece.kind for piece in fit.pieces) == ["arc", "arc", "line", "line"]
    radii = [piece.arc.radius for piece in fit.pieces if piece.arc is not None]
    np.testing.assert_allclose(radii, radius, atol=0.1)
    assert np.ptp(radii) < 1e-9


@pytest.mark.parametrize("turn", np.radians([25.0, 36.0, 45.0, 60.0, 90.0, 120.0]))
@pytest.mark.parametrize("place", [(0.0, 0.0), (200.0, 30.0), (-3000.0, 5000.0)])
def test_a_circle_through_the_middle_of_an_arc_is_that_of_the_arc(turn, place):
    # Where sides turn by less than 52 degrees it depended on the place in the picture.
    along = np.array([[1.0, 0.0], [np.cos(turn), np.sin(turn)]])
    inward = along[1] - along[0]
    inward /= np.hypot(*inward)
    radius = 5.0
    apex = np.array(place) + (radius / np.cos(0.5 * turn) - radius) * inward
    sides = [
        (np.array([place + way * u]), u[None]) for way, u in zip((-9.0, 9.0), along, strict=True)
    ]
    touching = Touching(sides)
    arcs = touching.arcs(touching.through(apex[None]))
    # Equations in places of such a size, divided by what a shallow turn leaves of them.
    rounding = 1e-15 * (1.0 + np.hypot(*place)) / (1.0 - np.cos(0.5 * turn)) ** 2
    assert abs(arcs.radii[0] - radius) <= 100 * rounding


@pytest.mark.parametrize(("n", "radius"), [(7, 4.0), (8, 3.0), (8, 4.0), (8, 5.0), (9, 5.0)])
@pytest.mark.parametrize("turn", [0.0, 0.2])
def test_shallow_fillets_are_where_they_were_drawn(n, radius, turn):
    angle = turn + 2 * np.pi * (np.arange(n) + 0.5) / n
    corners = 128.3 + 100.0 * np.column_stack([np.cos(angle), np.sin(angle)])
    outline = rounded(corners.tolist(), radius)
    (contour,) = ss.trace(renderers.exact([outline], 256))
    # A false corner in such a place is a tenth of a pixel off and more.
    away, _ = cKDTree(sampled(outline, 0.002)).query(contour.points)
    assert away.max() < 0.02
    (fit,) = ss.fit_shape(ss.Shape([contour]), character="drawn")
    radii = [piece.arc.radius for piece in fit.pieces if piece.arc is not None]
    assert len(radii) == [piece.kind for piece in fit.pieces].count("line") == n
    # What a fillet takes off its corner is told to a hundredth of a pixel.
    np.testing.assert_allclose(radii, radius, atol=0.01 / (1.0 / np.cos(np.pi / n) - 1.0))


@pytest.mark.parametrize("picture", ["exact coverage", "blurred by 1", "scanned, JPEG 90"])
@pytest.mark.parametrize("place", range(4))
def test_all_fillets_of_seven_pixels_are_one(picture, place):
    # As long an arc turns alike in several places: the outline had two turns there, and no sides
    # between them, so one of four fillets stayed as blurred as it was, with a break beside it.
    moved = SIZE / 2 + np.random.default_rng(place).uniform(-0.5, 0.5, 2)
    outline = [one.moved(1.0, 0.0, moved) for one in drawn_box(200.0, 120.0, 6.72)]
    (fit,) = ss.fit_shape(ss.trace(renderers.RENDERERS[picture]([outline], SIZE)))
    radii = [piece.arc.radius for piece in fit.pieces if piece.arc is not None]
    assert len(radii) == 4
    assert len(fit.pieces) == 8
    assert np.ptp(radii) < 1e-9 * radii[0]
    assert sum(one.name == "tangent" for one in fit.regularities) == 8

"""Parabolas through crossings: tangents, how far points lie off, what they cover of pixels."""

from __future__ import annotations

import numpy as np
import pytest

from shapespline.tracing.parabolas import Parabolas

AROUND, AT = np.arange(11)[None, :], np.array([(5.0, 5.0)])
# Samples of a pixel, by which what is covered is known to half a row of them.
SAMPLES = 400


def straight(slope_degrees, offset):
    """Eleven points along a line, that far to the left of (5, 5)."""
    angle = np.radians(slope_degrees)
    along, left = (
        np.array([np.cos(angle), np.sin(angle)]),
        np.array([-np.sin(angle), np.cos(angle)]),
    )
    return 5.0 + offset * left + np.linspace(-4, 4, 11)[:, None] * along


def sampled(inside):
    y, x = (np.mgrid[:SAMPLES, :SAMPLES] + 0.5) / SAMPLES - 0.5
    return inside(5.0 + x, 5.0 + y).mean()


@pytest.mark.parametrize("degrees", [0, 17, 45, 90, 163, 200, 288])
@pytest.mark.parametrize("offset", [-0.8, -0.55, -0.3, 0.0, 0.1, 0.6])
def test_a_line_covers_what_lies_left_of_it(degrees, offset):
    edge = Parabolas.through(straight(degrees, offset), AROUND, AT)
    angle = np.radians(degrees)

    def left(x, y):
        return (y - 5.0) * np.cos(angle) - (x - 5.0) * np.sin(angle) > offset

    assert edge.covered(np.array([(5.0, 5.0)]))[0] == pytest.approx(sampled(left), abs=1 / SAMPLES)
    assert edge.off[0] == pytest.approx(0.0, abs=1e-9)
    direction = edge.direction[0] / np.hypot(*edge.direction[0])
    assert direction == pytest.approx([np.cos(angle), np.sin(angle)], abs=1e-9)


def test_a_circle_of_some_pixels_is_nearly_a_parabola():
    radius, middle = 8.0, np.array([5.3, -2.9])
    angle = np.pi / 2 + np.linspace(0.5, -0.5, 11)  # clockwise: the inside is on the right
    points = middle + radius * np.column_stack([np.cos(angle), np.sin(angle)])
    edge = Parabolas.through(points, AROUND, points[5:6])

    def outside(x, y):
        return np.hypot(x - middle[0], y - middle[1]) > radius

    # The fourth power of half the angle, by radius / 8, is what a parabola misses at its ends.
    assert edge.off[0] < radius / 8 * 0.5**4
    assert edge.covered(np.array([(5.0, 5.0)]))[0] == pytest.approx(sampled(outside), abs=0.02)
    x, y = edge.direction[0]
    assert np.degrees(np.arctan2(y, x)) == pytest.approx(0.0, abs=0.1)


def test_points_that_scatter_lie_off():
    points = straight(30, 0.0)
    points[::2] += [0.0, 0.4]
    # Half of the points are higher by 0.4 along y: 0.2 to either side of the middle, turned.
    assert Parabolas.through(points, AROUND, AT).off[0] == pytest.approx(
        0.2 * np.cos(np.pi / 6), rel=0.1
    )


def test_points_that_come_back_tell_a_direction_all_the_same():
    angle = np.linspace(0.0, 2.0 * np.pi, 11)
    points = np.column_stack([np.cos(angle), np.sin(angle)])
    points[-1] = points[0]
    edge = Parabolas.through(points, AROUND, points[5:6])
    assert np.isfinite(edge.direction).all()
    assert 0.0 <= edge.covered(AT)[0] <= 1.0
    assert edge.off[0] > 0.5

"""Pictures whose ink and ground were mixed as light: told by waves along edges, and undone."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter
from tests.support.rendering import coverage, polygon

from shapespline.tracing import trace
from shapespline.tracing.seeing import Seeing

MIDDLE, RADIUS = np.array([60.2, 59.7]), 38.4
DISC = coverage(lambda x, y: np.hypot(x - MIDDLE[0], y - MIDDLE[1]) <= RADIUS, 120, 120)
SQUARE = coverage(polygon([(22.3, 20.7), (100.1, 28.2), (92.6, 106.0), (14.8, 98.5)]), 120, 120)


def mixed(cover, power, ground=255, ink=0):
    """A picture of 8 bits of ink on ground, mixed in light of that power."""
    light = (1 - cover) * (ground / 255) ** power + cover * (ink / 255) ** power
    return np.rint(255 * light ** (1 / power)).astype(np.uint8)


def off_round(picture):
    points = trace(picture).longest.points
    return np.hypot(*(points - MIDDLE).T) - RADIUS


@pytest.mark.parametrize("power", [1.8, 2.2])
@pytest.mark.parametrize(("ground", "ink"), [(255, 0), (0, 255), (240, 30), (20, 230)])
def test_edges_lie_where_they_were_drawn(power, ground, ink):
    off = off_round(mixed(DISC, power, ground, ink))
    # A grey more or less of 8 bits is a fiftieth of the light where it is dark; half of such.
    assert np.sqrt((off**2).mean()) < 0.02
    assert np.abs(off).max() < 0.1


def test_values_that_are_mixed_are_left_as_they_are():
    for cover in (DISC, SQUARE):
        field, _ = Seeing().field(mixed(cover, 1.0))
        assert field.values[:1, :1].dtype == np.uint8


@pytest.mark.parametrize(
    "picture",
    [
        # Level edges wave nowhere.
        mixed(np.pad(np.full((60, 60), 1.0), 30) * 0.999, 2.2),
        np.rint(gaussian_filter(mixed(DISC, 2.2).astype(float), 1.0)).astype(np.uint8),
        np.dstack([np.full((120, 120, 3), 40), 255 * DISC]).astype(np.uint8),
    ],
    ids=["level", "blurred", "transparent"],
)
def test_what_tells_nothing_is_left_as_it_is(picture):
    field, _ = Seeing().field(picture)
    assert field.values[:1, :1].dtype == np.uint8


def test_a_level_that_is_given_is_kept():
    field, _ = Seeing(level=128).field(mixed(DISC, 2.2))
    assert field.cut == 127.5


def test_a_range_without_a_white_tells_no_light():
    field, _ = Seeing().field(7.0 * mixed(DISC, 2.2))  # floats beyond one
    assert field.values.range == (0.0, 7.0 * 255.0)


def test_the_square_has_its_corners():
    points = trace(mixed(SQUARE, 2.2)).longest.points
    off = np.hypot(*(points - np.array([22.3, 20.7])).T)
    assert off.min() < 0.1

"""Two inks in one blurred picture: each outline lies half-way to its own ink."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter
from tests.support.rendering import coverage

from shapespline.tracing import trace

SIZE = 120
# Middles, radii and greys: two discs, a thin ring in the darker ink, on paper of 240.
PAPER = 240.0
DISCS = {(35.3, 80.2): (22.0, 30.0), (88.6, 84.7): (20.0, 120.0)}
RING, WIDTH, DARK = ((60.4, 30.1), 20.0), 3.6, 30.0


def seen(blur, dark=DARK, seed=0, grain=1.0):
    picture = np.full((SIZE, SIZE), PAPER)
    for (x0, y0), (radius, grey) in DISCS.items():
        inside = coverage(lambda x, y: np.hypot(x - x0, y - y0) <= radius, SIZE, SIZE)  # noqa: B023
        picture += inside * ((dark if grey == DARK else grey) - PAPER)
    (x0, y0), radius = RING
    inside = coverage(
        lambda x, y: np.abs(np.hypot(x - x0, y - y0) - radius) <= WIDTH / 2, SIZE, SIZE
    )
    picture += inside * (dark - PAPER)
    noise = np.random.default_rng(seed).normal(0.0, grain, picture.shape)
    return np.rint(np.clip(gaussian_filter(picture, blur) + noise, 0, 255)).astype(np.uint8)


def radii(shape, middle):
    """Mean radius of the outlines around a point, smallest first."""
    around = [c for c in shape if np.hypot(*(c.points.mean(axis=0) - middle)) < 2]
    return sorted(float(np.hypot(*(c.points - middle).T).mean()) for c in around)


@pytest.mark.parametrize(
    ("blur", "grain"), [(0.8, 1.0), (1.0, 1.0), (1.5, 1.0), (1.0, 5.0), (1.0, 10.0)]
)
def test_outlines_of_both_inks_lie_where_they_were_drawn(blur, grain):
    shape = trace(seen(blur, grain=grain), min_area=20)
    for middle, (radius, grey) in DISCS.items():
        (found,) = radii(shape, middle)
        # The level is known to half a grey value, which is so much over the slope of the edge;
        # noise leaves less than this of the mean over a hundred points.
        flat = np.sqrt(2 * np.pi * (blur**2 + 1 / 12)) / (PAPER - grey)
        off = 0.5 * flat + 3 * grain * flat / np.sqrt(100)
        # A level line of a disc of radius r blurred by s is s^2 / (2 r) inside it.
        assert found == pytest.approx(radius - blur**2 / (2 * radius), abs=off)
    middle, radius = RING
    inner, outer = radii(shape, middle)
    # Where both edges add up, the level line of the ring is a little inside both.
    assert outer - inner == pytest.approx(WIDTH, abs=0.05 * grain**0.5 if blur < 1.2 else 0.5)
    assert 0.5 * (inner + outer) == pytest.approx(
        radius, abs=0.02 * grain**0.5 + blur**2 / (2 * inner)
    )


def test_one_level_for_both_is_off():
    """What the test above would find if the picture's own level were taken, and so why."""
    picture = seen(1.0)
    level = 0.5 * (PAPER + 120.0)
    discs = [radii(trace(picture, level=level), middle)[0] for middle in DISCS]
    assert discs[0] > 22.0 + 0.2


def test_one_ink_is_left_as_it_is():
    from shapespline.tracing.crossings import crossings
    from shapespline.tracing.inks import inks_of, moved_to_own
    from shapespline.tracing.layer import Layer
    from shapespline.tracing.seeing import cut_field

    field = cut_field(Layer(seen(1.0, dark=120.0)), light=False)
    found = crossings(field)
    part = found.chosen(np.concatenate(found.loops))
    inks = inks_of(field, part, [len(loop) for loop in found.loops])
    assert (inks == 1.0).all()
    shares = np.full(len(part.row), 0.25)
    assert (moved_to_own(field, part, shares, np.ones(len(shares))) == 0.25).all()


def test_inks_that_differ_little_are_told_among_grain():
    """The strength of an ink is known to what noise leaves of the mean, not to that of a pixel."""
    shape = trace(seen(1.0, dark=75.0, grain=8.0), min_area=20)
    for middle, (radius, _) in DISCS.items():
        (found,) = radii(shape, middle)
        flat = np.sqrt(2 * np.pi * (1 + 1 / 12)) / 120.0
        assert found == pytest.approx(radius - 1 / (2 * radius), abs=3 * 8.0 * flat / np.sqrt(100))

"""Chains of pixels: borders of masks are told, whatever program gives them; drawings are not."""

from __future__ import annotations

import numpy as np
import pytest
from benchmarks.drawn.pixel_chains import BORDERS, mask_of, turns_of
from tests.support.shapes import on_circle

from shapespline.analysis.noise import FEWEST_POINTS, left_of_cubics, noise_level
from shapespline.analysis.pixel_chains import (
    FEWEST_EACH_WAY,
    GOING_ON,
    STAIRS,
    along_pixels,
    pixel_of,
)
from shapespline.analysis.resolution import NOISE_BAND, resolution
from shapespline.values.contour import Contour

# A slot nine tenths of which is level; its ends go on in stairs.
END = on_circle(400, 25.0)
SLOT = np.concatenate(
    [
        np.roll(END, 100, axis=0)[:200] + np.array([330.3, 35.4]),
        np.roll(END, -100, axis=0)[:200] + np.array([30.3, 35.4]),
    ]
)


def border(name, outline=SLOT):
    return BORDERS[name](mask_of(outline))


def polygon(*corners):
    """Points one by one along edges that are level, upright or oblique."""
    points = []
    for begin, end in zip(corners, (*corners[1:], corners[0]), strict=True):
        begin, along = np.array(begin), np.array(end) - begin
        count = np.abs(along).max()
        points += [begin + along * k / count for k in range(count)]
    return np.array(points)


SQUARE = polygon((0, 0), (40, 0), (40, 40), (0, 40))
OCTAGON = polygon(*((20, 0), (50, 0), (70, 20), (70, 50), (50, 70), (20, 70), (0, 50), (0, 20)))
COMB = polygon(
    (0, -9),
    *((x, y) for k in range(0, 80, 2) for x, y in ((k, 0), (k, 5), (k + 1, 5), (k + 1, 0))),
    (79, -9),
)
# A shaft with a chamfer of one unit at each of its two steps.
SHAFT = polygon((0, 0), (90, 0), (90, 12), (61, 12), (60, 11), (31, 11), (30, 10), (0, 10))


@pytest.mark.parametrize("name", BORDERS)
@pytest.mark.parametrize("side", [1.0, 0.37, 25.4])
def test_pixels_are_told_wherever_the_border_begins_and_whichever_way_it_runs(name, side):
    chain = side * border(name) + (1000.1, -5.5)
    rounding = 2 * np.finfo(float).eps * np.abs(chain).max()  # of both ends of a step
    for first in (0, 1, 7, len(chain) // 2):
        turned = np.roll(chain, -first, axis=0)
        assert pixel_of(Contour(turned, closed=True)) == pytest.approx(side, abs=rounding)
        assert pixel_of(Contour(turned[::-1], closed=True)) == pytest.approx(side, abs=rounding)
    assert pixel_of(Contour(chain[: len(chain) - 30], closed=False)) == pytest.approx(
        side, abs=rounding
    )


# Teeth as deep as they are wide.
CRENELS = polygon(
    (0, -9),
    *((x, y) for k in range(0, 80, 2) for x, y in ((k, 0), (k, 1), (k + 1, 1), (k + 1, 0))),
    (79, -9),
)


@pytest.mark.parametrize("points", [SQUARE, OCTAGON, COMB, CRENELS, SHAFT], ids=len)
def test_what_was_drawn_on_pixels_without_stairs_is_no_chain(points):
    for first in range(len(points)):
        assert pixel_of(Contour(np.roll(points, first, axis=0), closed=True)) == 0.0
    assert along_pixels(Contour(turns_of(points), closed=True)) is None


def row_of(*steps):
    """Points of an open row, by how often each step is made."""
    along = np.concatenate([np.tile(step, (count, 1)) for count, step in steps])
    return Contour(np.concatenate([[(0.0, 0.0)], np.cumsum(along, axis=0)]), closed=False)


def test_three_stairs_of_an_open_row_tell_and_its_ends_are_none():
    level, up = (30, (1, 0)), (1, (1, 1))
    assert pixel_of(row_of(level, up, level, up, level, up, level)) == 1.0
    assert pixel_of(row_of(level, up, level, up, level)) == 0.0
    # A step at an end turns back nothing.
    assert pixel_of(row_of(up, level, up, level, up, level)) == 0.0
    assert pixel_of(row_of(level, up, level, up, level, up)) == 0.0


def test_points_that_leave_pixels_out_or_lie_beside_them_are_no_chain():
    chain = border("middles of pixels")
    assert pixel_of(Contour(chain[::2], closed=True)) == 0.0
    assert pixel_of(Contour(np.delete(chain, 100, axis=0), closed=True)) == 0.0
    shaken = chain + np.random.default_rng(1).uniform(-0.04, 0.04, chain.shape)
    assert pixel_of(Contour(shaken, closed=True)) == 0.0
    assert pixel_of(Contour(chain[:2], closed=False)) == 0.0


@pytest.mark.parametrize("name", BORDERS)
def test_a_level_border_has_the_noise_of_its_stairs(name):
    contour = Contour(2.0 * border(name), closed=True)
    shown = resolution(contour)
    assert not shown.clean
    assert shown.noise == pytest.approx(GOING_ON * 2.0)
    # More than half of the border is level: neighbours leave nothing.
    assert noise_level(contour) < 1e-9
    assert shown.band == pytest.approx(NOISE_BAND * STAIRS * 2.0)


def test_curves_may_be_farther_from_rougher_masks():
    circle = on_circle(4000, 60.0)
    steps = np.repeat(np.random.default_rng(2).integers(-2, 3, 400), 10)
    rough = BORDERS["middles of pixels"](mask_of((1 + steps[:, None] / 60) * circle + 80))
    contour = Contour(rough, closed=True)
    assert resolution(contour).noise == GOING_ON
    assert left_of_cubics(contour) > STAIRS
    assert resolution(contour).band == NOISE_BAND * left_of_cubics(contour)


def test_an_accuracy_that_is_given_counts_instead():
    points = border("middles of pixels")
    for accuracy in (0.0, 0.01):
        contour = Contour(points, closed=True, accuracy=accuracy)
        assert pixel_of(contour) == 0.0
        assert resolution(contour).noise == accuracy
        assert along_pixels(Contour(turns_of(points), closed=True, accuracy=accuracy)) is None


def test_few_points_tell_no_chain():
    angle = 2 * np.pi * np.arange(4000) / 4000
    for radius, told in ((9.0, False), (14.0, True)):
        disc = mask_of(radius * np.column_stack([np.cos(angle), np.sin(angle)]) + 20)
        contour = Contour(BORDERS["middles of pixels"](disc), closed=True)
        assert (len(contour) >= FEWEST_POINTS) == told == (pixel_of(contour) == 1.0)


@pytest.mark.parametrize("name", BORDERS)
def test_pixels_that_were_left_out_between_turns_are_put_back(name):
    chain = 0.5 * border(name) + 3.0
    for points, closed in ((chain, True), (np.roll(chain, -5, axis=0)[:-40], False)):
        turning = turns_of(points)
        if not closed:
            turning = np.concatenate([points[:1], turns_of(points)[1:-1], points[-1:]])
        whole = along_pixels(Contour(turning, closed))
        assert whole is not None
        begin = int(np.abs(whole.points - chain[0]).sum(axis=1).argmin()) if closed else 0
        assert np.allclose(np.roll(whole.points, -begin, axis=0), points, rtol=0, atol=1e-12)
        assert along_pixels(Contour(points, closed)) is None  # they are all there


def test_a_polygon_that_was_drawn_is_left_alone():
    # Counts of events in time rise by one: stairs, but beside level edges alone.
    times = np.cumsum(np.random.default_rng(3).integers(1, 9, 60))
    count = np.column_stack([np.repeat(times, 2)[1:], np.repeat(np.arange(60), 2)[:-1]])
    assert along_pixels(Contour(count, closed=False)) is None
    # A pen that leaves out few pixels has points that do not turn.
    chain = border("middles of pixels")
    assert along_pixels(Contour(np.delete(chain, 100, axis=0), closed=True)) is None
    assert along_pixels(Contour(np.array([(0.0, 0.0), (3.0, 1.0), (1.0, 5.0)]))) is None


def test_as_many_stairs_are_asked_for_beside_upright_edges():
    """A mask of one arc with as many stairs each way, then with one less."""
    ways = [(5, 0), (1, 1)] * FEWEST_EACH_WAY + [(5, 0), (1, 2)]
    ways += [(0, 5), (1, 1)] * FEWEST_EACH_WAY + [(0, 5)]
    ways[2 * FEWEST_EACH_WAY + 1] = (2, 2)
    row = np.concatenate([[(0, 0)], np.cumsum(ways, axis=0)])
    assert along_pixels(Contour(row, closed=False)) is not None
    assert along_pixels(Contour(row[2:], closed=False)) is None
    assert along_pixels(Contour(row[:-2], closed=False)) is None

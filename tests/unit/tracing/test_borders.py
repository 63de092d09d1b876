"""Borders between areas of any number of kinds."""

from __future__ import annotations

from collections import Counter
from math import atan2, cos, pi, sin

import numpy as np
import pytest
from PIL import Image, ImageDraw

from shapespline.tracing import trace
from shapespline.tracing.borders import borders_of

SIDE, LARGER = 64, 8


def test_a_stroke_of_a_pixel_between_two_areas_is_whole():
    labels = np.zeros((12, 12), dtype=np.int8)
    for k in range(12):
        labels[k, k + 1 :] = 1
        labels[k, k] = 2  # touches itself by corners alone
    assert all(len([node for node in four if node >= 0]) < 4 for four in borders_of(labels).cells)


def test_four_areas_of_three_kinds_that_meet_have_a_junction():
    labels = np.zeros((12, 12), dtype=np.int8)
    labels[:6, 6:], labels[6:, :6] = 1, 2
    assert Counter(len([n for n in four if n >= 0]) for four in borders_of(labels).cells)[4] == 1


@pytest.mark.parametrize("beside", ["#2196f3", "#ffeb3b"])
def test_an_outline_of_a_pixel_is_one_ring(beside):
    n = LARGER
    image = Image.new("RGB", (SIDE * n, SIDE * n), "#ffffff")
    turns = [k * 2 * pi / 7 + 0.2 for k in range(9)]
    ways = [((32.3 + 24 * cos(t)) * n, (31.6 + 24 * sin(t)) * n) for t in turns]
    draw = ImageDraw.Draw(image)
    draw.polygon(ways, fill=beside)
    draw.line(ways, fill="#222222", width=n, joint="curve")
    shape = trace(np.asarray(image.resize((SIDE, SIDE), Image.Resampling.BOX)), colors="auto")
    # Ground, outline and area, and the holes of the first two.
    assert len(shape.contours) == 5
    outer, inner = sorted(
        (c.points for c in shape if 40 < np.ptp(c.points[:, 0]) < 60),
        key=lambda p: -np.ptp(p[:, 0]),
    )[::2]
    # The sides of the polygon, corners left out: half a stroke away from its middle.
    for points, away in ((outer, 0.5), (inner, -0.5)):
        x, y = points[:, 0] - 32.3, SIDE - points[:, 1] - 31.6
        turn = np.array([atan2(b, a) for a, b in zip(x, y, strict=True)]) - 0.2
        within = turn % (2 * pi / 7) - pi / 7
        off = np.hypot(x, y) * np.cos(within) - 24 * cos(pi / 7) - away
        assert np.abs(off[np.abs(within) < 0.3]).max() < 0.3

"""Pictures that were turned, or made a little larger or smaller: corners stay sharp."""

from __future__ import annotations

import numpy as np
import pytest
from PIL import Image
from scipy.spatial import cKDTree
from tests.support.rendering import coverage, dark, polygon, tile

import shapespline as ss
from shapespline.tracing import trace

SIDE = 160
STAR = np.array(
    [
        (80 + r * np.cos(a), 80 + r * np.sin(a))
        for k in range(10)
        for r, a in [((60.3, 26.1)[k % 2], np.radians(36 * k + 11))]
    ]
)
KITE = [(31.3, 40.2), (121.7, 22.6), (139.1, 117.4), (52.2, 131.9)]


def star(x, y):
    """Inside of any of its five points or of the pentagon between them."""
    inside = polygon(STAR[1::2])(x, y)
    for k in range(0, 10, 2):
        inside |= polygon(STAR[[k, k + 1, k - 1]])(x, y)
    return inside


STAR_COVER, KITE_COVER = (coverage(inside, SIDE, SIDE) for inside in (star, polygon(KITE)))
ROUNDED = coverage(lambda x, y: tile(90.3, 6)(x - 30.3, y - 34.1), SIDE, SIDE)


def turned(image):
    return np.asarray(Image.fromarray(image).rotate(7, Image.Resampling.BILINEAR, fillcolor=255))


def at_turned(points):
    """Where turning puts points: counter-clockwise, y up, about the middle."""
    angle, off = np.radians(7), np.asarray(points) - SIDE / 2
    along, left = (
        np.array([np.cos(angle), np.sin(angle)]),
        np.array([-np.sin(angle), np.cos(angle)]),
    )
    return SIDE / 2 + off[:, :1] * along + off[:, 1:] * left


def scaled(by, way):
    def make(image):
        size = round(by * SIDE)
        return np.asarray(Image.fromarray(image).resize((size, size), way))

    return make


RESAMPLED = {
    "turned": (turned, at_turned),
    "1.25": (scaled(1.25, Image.Resampling.BICUBIC), lambda points: 1.25 * np.asarray(points)),
    "1.5": (scaled(1.5, Image.Resampling.BILINEAR), lambda points: 1.5 * np.asarray(points)),
    "0.75": (scaled(0.75, Image.Resampling.LANCZOS), lambda points: 0.75 * np.asarray(points)),
}


@pytest.mark.parametrize(
    ("name", "cover", "corners"),
    [
        *((name, STAR_COVER, STAR) for name in ("turned", "1.25", "1.5")),
        *((name, KITE_COVER, KITE) for name in ("turned", "1.5", "0.75")),
    ],
    ids=["star turned", "star 1.25", "star 1.5", "kite turned", "kite 1.5", "kite 0.75"],
)
@pytest.mark.parametrize("tolerance", [None, 0.35])
def test_corners_are_where_they_were_drawn(name, cover, corners, tolerance):
    make, moved = RESAMPLED[name]
    fit = ss.fit_curve(trace(make(dark(cover))).longest, tolerance=tolerance)
    assert [piece.kind for piece in fit.pieces] == ["line"] * len(corners)
    found = [piece.control_points[0] for piece in fit.pieces]
    assert cKDTree(found).query(moved(corners))[0].max() < 0.25


@pytest.mark.parametrize("name", RESAMPLED)
@pytest.mark.parametrize("tolerance", [None, 0.35])
def test_roundings_stay_arcs(name, tolerance):
    picture = RESAMPLED[name][0](dark(ROUNDED))
    fit = ss.fit_curve(trace(picture).longest, tolerance=tolerance)
    assert sorted(piece.kind for piece in fit.pieces) == ["arc"] * 4 + ["line"] * 4

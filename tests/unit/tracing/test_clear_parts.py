"""Transparent pictures in colours: no paper, white shapes of their own, edges where they are."""

from __future__ import annotations

import numpy as np
import pytest

import shapespline as ss
from shapespline.tracing.clear_parts import on_clear

BLUE, WHITE, RED = (29, 53, 87), (255, 255, 255), (230, 57, 70)
SIZE = 96


def discs(*drawn):
    """Discs (centre, radius, colour, opacity) painted over each other, by samples."""
    n = 8
    at = (np.arange(SIZE * n) + 0.5) / n
    x, y = np.meshgrid(at, at)
    colour, alpha = np.zeros((SIZE * n, SIZE * n, 3)), np.zeros((SIZE * n, SIZE * n, 1))
    for (u, v), radius, paint, opacity in drawn:
        share = opacity * ((x - u) ** 2 + (y - v) ** 2 <= radius**2)[:, :, None]
        left = alpha * (1 - share)
        colour = (np.array(paint) * share + colour * left) / np.maximum(share + left, 1e-9)
        alpha = share + left
    # Colours weigh with their opacity.
    blocks = (SIZE, n, SIZE, n, -1)
    mean = (colour * alpha).reshape(blocks).mean(axis=(1, 3))
    alpha = alpha.reshape(blocks).mean(axis=(1, 3))
    rgb = mean / np.maximum(alpha, 1e-9)
    return np.rint(np.concatenate([rgb, 255 * alpha], axis=2)).astype(np.uint8)


def test_what_is_clear_is_no_area():
    shape = ss.trace(discs(((48, 48), 30, BLUE, 1.0)), colors="auto")
    assert shape.colors == ("#1d3557",)
    (fit,) = ss.fit_shape(shape)
    (piece,) = fit.pieces
    assert piece.kind == "arc"
    assert piece.arc.radius == pytest.approx(30, abs=0.02)


@pytest.mark.parametrize("ink", [WHITE, (0, 0, 0)])
def test_shapes_of_the_colour_of_paper_or_ink_stay(ink):
    shape = ss.trace(discs(((30, 48), 16, ink, 1.0), ((70, 48), 16, RED, 1.0)), colors="auto")
    assert sorted(shape.colors) == sorted(["#{:02x}{:02x}{:02x}".format(*ink), "#e63946"])
    assert [len(shape.parents), set(shape.parents)] == [2, {-1}]


def test_a_hole_shows_what_is_behind():
    picture = discs(((48, 48), 40, BLUE, 1.0))
    picture[38:58, 38:58, 3] = 0
    shape = ss.trace(picture, colors="auto")
    assert shape.colors == ("#1d3557", None)
    assert shape.parents == (-1, 0)


def test_what_is_half_clear_looks_as_on_paper():
    shape = ss.trace(discs(((48, 48), 30, (0, 0, 0), 0.6)), colors="auto")
    # 255 * 0.4, rounded with its opacity.
    (grey,) = shape.colors
    assert abs(int(grey[1:3], 16) - 102) <= 1
    assert grey[1:3] == grey[3:5] == grey[5:7]


def test_a_count_of_colours_is_one_of_visible_ones():
    picture = discs(((30, 48), 16, WHITE, 1.0), ((70, 48), 16, RED, 1.0))
    assert len(ss.trace(picture, colors=2).colors) == 2


def test_opaque_pictures_and_empty_ones_are_left_alone():
    opaque = np.full((8, 8, 4), 255, dtype=np.uint8)
    assert on_clear(opaque) is None
    assert on_clear(np.zeros((8, 8, 4), dtype=np.uint8)) is None
    assert on_clear(opaque[..., :3]) is None


def test_sixteen_bits_and_grey_are_the_same():
    eight = discs(((48, 48), 30, (90, 90, 90), 1.0))
    grey = eight[:, :, [0, 3]]
    found = [on_clear(each) for each in (eight, grey, eight.astype(np.uint16) * 257)]
    for other in found[1:]:
        assert (other.pixels == found[0].pixels).all()
        assert (other.ground == found[0].ground).all()

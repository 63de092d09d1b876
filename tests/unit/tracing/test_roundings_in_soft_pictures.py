"""Fillets of few pixels in JPEG files, through a lens and in grain; corners stay corners."""

from __future__ import annotations

import pytest
from benchmarks.drawn import equal_outlines
from benchmarks.drawn.few_points import is_outline
from benchmarks.drawn.fillets import PICTURES, drawn_at

import shapespline as ss

PLACE = 1


def fitted(outline, picture):
    fits = ss.fit_shape(ss.trace(PICTURES[picture]([outline])), character="drawn").fits
    assert len(fits) == 1
    return fits[0]


@pytest.mark.parametrize(
    ("shape", "radius", "turn", "picture", "off"),
    [
        ("box", 3.0, 17.0, "JPEG 90", 0.1),
        ("hexagon", 5.0, 0.0, "JPEG 90", 0.1),
        ("box", 4.0, 17.0, "blurred by 0.5", 0.1),
        ("hexagon", 4.0, 17.0, "blurred by 0.5", 0.2),
        ("box", 4.0, 0.0, "blurred by 0.5, grain of 2, JPEG 90", 0.3),
        ("box", 4.0, 17.0, "blurred by 1, grain of 8, JPEG 90", 0.4),
    ],
)
def test_a_small_fillet_comes_back_with_its_radius(shape, radius, turn, picture, off):
    outline = drawn_at(shape, radius, turn, PLACE)
    fit = fitted(outline, picture)
    assert is_outline(fit, outline)
    radii = [piece.arc.radius for piece in fit.pieces if piece.kind == "arc"]
    assert radii == pytest.approx([radius] * len(radii), abs=off)


@pytest.mark.parametrize("picture", PICTURES)
@pytest.mark.parametrize("turn", [0.0, 17.0])
def test_sharp_corners_get_no_fillets(turn, picture):
    outline = drawn_at("box", 0.0, turn, PLACE)
    assert is_outline(fitted(outline, picture), outline)


def test_level_edges_that_jpeg_leaves_as_they_are_do_not_hide_its_ripples():
    # Along blocks of eight pixels a level edge keeps its grey; only its corners ripple.
    outline = drawn_at("box", 5.0, 0.0, 0)
    assert is_outline(fitted(outline, "JPEG 90"), outline)


def test_tips_of_lenses_in_a_light_scan_are_no_arcs():
    # Looked for a third time, some of them were arcs of 2.3 pixels (TRC-49).
    lens = equal_outlines.SHAPES["lens"]
    picture = equal_outlines.PICTURES["blurred by 0.7, grain of 4, JPEG 90"]
    shape = ss.trace(picture(equal_outlines.laid_out([lens] * 6, 1, "on a ring")))
    for fit in ss.fit_shape(shape, character="drawn"):
        assert [piece.kind for piece in fit.pieces] == ["arc", "arc"]

"""Short lines between two arcs of a picture, which points beside nodes do not tell."""

from __future__ import annotations

import numpy as np
import pytest
from benchmarks.drawn.equal_outlines import COPIES, SHAPES, laid_out, told
from benchmarks.drawn.few_points import is_outline
from benchmarks.drawn.fillets import PICTURES
from benchmarks.drawn.found import Found
from benchmarks.drawn.short_sides import drawn_at
from benchmarks.drawn.truth import Arc, Line

import shapespline as ss


def fits_of(outline, picture):
    return ss.fit_shape(ss.trace(PICTURES[picture]([outline])), character="drawn").fits


@pytest.mark.parametrize("picture", ["exact coverage", "JPEG 90", "blurred by 0.5"])
@pytest.mark.parametrize("turn", [0.0, 17.0])
def test_a_side_of_four_pixels_between_two_arcs_is_a_line(picture, turn):
    # The arcs went on to meet in its middle, with a break of 12 degrees to the inside.
    outline = drawn_at("12 and 28", 4.0, turn, 1)
    fits = fits_of(outline, picture)
    assert len(fits) == 1
    assert is_outline(fits[0], outline)
    assert len(Found.of_fits(fits).breaks) == 2  # its two corners
    shortest = min((piece for piece in fits[0].pieces if piece.kind == "line"), key=length_of)
    # The place where an arc leaves its tangent line by what points are off by, on either side.
    assert abs(length_of(shortest) - 4.0) < 2 * np.sqrt(2 * 20 * 0.005)


@pytest.mark.parametrize("place", range(4))
def test_a_small_box_has_all_of_its_sides(place):
    # Arcs that meet in the middle of its short sides would turn there by 50 degrees.
    outline = drawn_at("small box", 6.0, 0.0, place)
    fits = fits_of(outline, "exact coverage")
    assert is_outline(fits[0], outline)
    radii = [piece.arc.radius for piece in fits[0].pieces if piece.kind == "arc"]
    assert np.ptp(radii) < 1e-9 * radii[0]
    assert not len(Found.of_fits(fits).breaks)


@pytest.mark.parametrize("degrees", [16.0, 28.0])
def test_arcs_that_meet_at_an_angle_keep_it(degrees):
    # The top of a box is two bows: no line touches both where the drawing is.
    radius, half, end = 60.0, np.radians(degrees / 2), np.radians(50.0)
    centre = radius * np.array([np.sin(half), -np.cos(half)])
    sweep = 0.5 * np.pi + half - end
    bows = [
        Arc(centre, radius, end, sweep),
        Arc(centre * [-1.0, 1.0], radius, 0.5 * np.pi - half, sweep),
    ]
    left, right = bows[1].end, bows[0].begin
    low = [left - [0.0, 50.0], right - [0.0, 50.0]]
    box = [*bows, Line(left, low[0]), Line(low[0], low[1]), Line(low[1], right)]
    outline = tuple(one.moved(1.0, 0.0, np.array([128.3, 128.6])) for one in box)
    fits = fits_of(outline, "exact coverage")
    assert is_outline(fits[0], outline)
    away = np.hypot(*(Found.of_fits(fits).breaks - outline[0].end).T)
    assert away.min() < 0.05


def test_fillets_that_go_over_into_a_large_arc_do_so_without_a_line():
    # The tangent of both lies as near to the points as they are known, on one of six openings of a
    # wheel, which were all read as that one.
    drawn = laid_out([SHAPES["window"]] * COPIES, 1, "mirrored")
    assert told(drawn, "blurred by 0.5").right == COPIES


def length_of(piece):
    return float(np.hypot(*(piece.control_points[-1] - piece.control_points[0])))

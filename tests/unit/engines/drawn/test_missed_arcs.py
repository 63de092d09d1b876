"""Short arcs of pictures that lie between points which count for nothing beside nodes."""

from __future__ import annotations

from collections import Counter
from itertools import pairwise

import numpy as np
import pytest
from benchmarks.drawn.fillets import PICTURES, drawn_at
from benchmarks.drawn.renderers import exact
from benchmarks.drawn.shapes import gear, rounded
from benchmarks.drawn.tables import rendered
from benchmarks.drawn.truth import Line
from shapely import Polygon

import shapespline as ss

SIZE = 256


def kinds_of(outline):
    """Of the pieces of a picture of one outline."""
    fit = ss.fit_shape(ss.trace(exact([outline], SIZE)), character="drawn").fits[0]
    return Counter(piece.kind for piece in fit.pieces), fit


@pytest.mark.parametrize(("radius", "turn"), [(6, 17), (8, 25), (8, 17)])
def test_a_fillet_that_turns_by_little_is_one(radius, turn):
    # A corner of 36 degrees: the arc is 3.8 to 5 pixels long, a corner or a chord as well, and its
    # edge was left to a curve, with a break of 4 degrees.
    corners = [(-90, -60), (90, -60), (90, -35), (-60, 75), (-90, 75)]
    moved = np.random.default_rng(0).uniform(-0.5, 0.5, 2) + SIZE / 2
    plate = [one.moved(1.0, np.radians(turn), moved) for one in rounded(corners, radius)]
    kinds, fit = kinds_of(plate)
    assert kinds == {"line": 5, "arc": 5}
    radii = [piece.arc.radius for piece in fit.pieces if piece.kind == "arc"]
    assert np.ptp(radii) < 1e-9 * radii[0]
    assert abs(radii[0] - radius) < 0.05


def test_arcs_between_fillets_are_no_lines():
    # Teeth of ten, their tips and feet arcs of five to twelve pixels between fillets: most were
    # told as lines that break by 13 degrees at both ends, and nearly all was left to curves.
    teeth = filleted(gear(10, 0.33, 0.48, 0.45, 0.25), foot=0.03, tip=0.025)
    moved = np.random.default_rng(1).uniform(-0.5, 0.5, 2) + SIZE / 2
    kinds, _ = kinds_of([one.moved(0.9 * SIZE / 0.96, np.radians(7), moved) for one in teeth])
    assert kinds == {"line": 20, "arc": 60}


@pytest.mark.parametrize(("n", "radius"), [(8, 8), (10, 8), (9, 10), (12, 12)])
@pytest.mark.parametrize("turn", [0.3, 0.0])
def test_fillets_at_every_corner_of_a_polygon_are_no_errors_of_its_picture(n, radius, turn):
    # Half a pixel between each and its corner: lines alone, taken for less exact, are much shorter
    # to tell, and contradict their points; so they became chamfers or curves.
    angle = turn + 2 * np.pi * np.arange(n) / n
    corners = 100 * np.column_stack([np.cos(angle), np.sin(angle)])
    moved = np.random.default_rng(2).uniform(-0.5, 0.5, 2) + SIZE / 2
    kinds, fit = kinds_of([one.moved(1.0, 0.0, moved) for one in rounded(corners, radius)])
    assert kinds == {"line": n, "arc": n}
    radii = [piece.arc.radius for piece in fit.pieces if piece.kind == "arc"]
    # What is known to a hundredth of a pixel is how far the middle of an arc is from its corner.
    assert abs(radii[0] - radius) * (1 / np.cos(np.pi / n) - 1) < 0.01


def test_what_errors_round_at_few_corners_are_no_fillets():
    # Those of a JPEG rounded two of this flag's ten.
    _, picture = rendered("flag", SIZE, "JPEG 90")
    (fit,) = ss.fit_shape(ss.trace(picture), character="drawn")
    assert [piece.kind for piece in fit.pieces] == ["line"] * 10


def filleted(outline, *, foot, tip):
    """A polygon of many edges: the outline with arcs that touch both sides of its corners."""
    sides = np.concatenate([element.points(1e-3) for element in outline])
    round_ends = {"quad_segs": 64}
    plate = Polygon(sides).buffer(-tip, **round_ends).buffer(tip, **round_ends)
    plate = plate.buffer(foot, **round_ends).buffer(-foot, **round_ends)
    corners = np.array(plate.exterior.coords)[::-1]
    return [Line(begin, end) for begin, end in pairwise(corners)]


@pytest.mark.parametrize(
    ("shape", "picture", "place", "off"),
    [
        ("octagon", "blurred by 0.5", 1, 0.02),
        ("hexagon", "blurred by 1, grain of 8, JPEG 90", 5, 0.1),
    ],
)
def test_chords_between_long_sides_may_all_be_fillets(shape, picture, place, off):
    # Arcs of 7.9 and 10.5 pixels were chords of 3.9 and 5, as no fillet was told yet (DRA-65).
    fits = ss.fit_shape(
        ss.trace(PICTURES[picture]([drawn_at(shape, 10.0, 17.0, place)])), character="drawn"
    ).fits
    n = 8 if shape == "octagon" else 6
    assert Counter(piece.kind for piece in fits[0].pieces) == {"line": n, "arc": n}
    radii = np.array([piece.arc.radius for piece in fits[0].pieces if piece.arc is not None])
    # Circles are told by how far in they are at their middles, to the noise of their points.
    np.testing.assert_allclose(radii, 10.0, atol=off / (1.0 / np.cos(np.pi / n) - 1.0))

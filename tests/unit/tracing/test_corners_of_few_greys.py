"""Pictures drawn by a few samples in each pixel: sharp corners stay sharp, edges are straight."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import cKDTree
from tests.support.rendering import coverage, dark, polygon, tile

import shapespline as ss
from shapespline.studio.examples import example_bytes
from shapespline.tracing import trace
from shapespline.tracing.crossings import crossings
from shapespline.tracing.inks import softness_of
from shapespline.tracing.layer import Layer
from shapespline.tracing.picture import load
from shapespline.tracing.seeing import cut_field

SIDE = 120
# Turned by 8 and 33 degrees; corners anywhere within a pixel.
SQUARES = [
    [(60.3 + 44 * np.cos(a), 59.6 + 44 * np.sin(a)) for a in np.radians(turn + 90 * np.arange(4.0))]
    for turn in (8, 33)
]


def grid(count):
    """Places of so many by so many samples within a pixel."""
    places = (np.arange(count) + 0.5) / count
    return [(x, y) for x in places for y in places]


# Of the four and eight that graphics cards take, no two lie in one row or column.
SAMPLES = {
    "2 x 2": grid(2),
    "4 x 4": grid(4),
    "4": [(0.375, 0.125), (0.875, 0.375), (0.125, 0.625), (0.625, 0.875)],
    "8": [
        (0.5625, 0.3125), (0.4375, 0.6875), (0.8125, 0.5625), (0.3125, 0.1875),
        (0.1875, 0.8125), (0.0625, 0.4375), (0.6875, 0.9375), (0.9375, 0.0625),
    ],
}  # fmt: skip


def drawn(inside, samples, side=SIDE):
    y, x = np.mgrid[:side, :side].astype(float)
    hit = [np.asarray(inside(x + dx, side - (y + dy)), dtype=float) for dx, dy in samples]
    return dark(np.mean(hit, axis=0))


def softness(image):
    field = cut_field(Layer(image), light=False)
    return softness_of(field, crossings(field))


@pytest.mark.parametrize("samples", SAMPLES.values(), ids=SAMPLES.keys())
def test_the_step_of_greys_is_told(samples):
    found = softness(drawn(polygon(SQUARES[0]), samples))
    assert found.step == 1.0 / len(samples)
    assert found.scatter > 0.0


@pytest.mark.parametrize(
    "image",
    [
        dark(coverage(polygon(SQUARES[0]), SIDE, SIDE)),
        drawn(polygon(SQUARES[0]), [(0.5, 0.5)]),
        # Level edges of half a pixel are no samples.
        dark(np.pad(np.hstack([np.full((40, 30), 1.0), np.full((40, 1), 0.5)]), 30)),
    ],
    ids=["exact", "one bit", "level"],
)
def test_others_have_no_step(image):
    assert softness(image).step == 0.0


@pytest.mark.parametrize("corners", SQUARES, ids=["8", "33"])
@pytest.mark.parametrize("samples", SAMPLES.values(), ids=SAMPLES.keys())
@pytest.mark.parametrize("tolerance", [None, 0.35])
def test_squares_are_four_lines(corners, samples, tolerance):
    fit = ss.fit_curve(trace(drawn(polygon(corners), samples)).longest, tolerance=tolerance)
    assert [piece.kind for piece in fit.pieces] == ["line"] * 4
    found = [piece.control_points[0] for piece in fit.pieces]
    # Two edges that are off by half the distance of two samples of a row.
    assert cKDTree(found).query(corners)[0].max() < np.sqrt(2) * 0.25


@pytest.mark.parametrize("samples", SAMPLES.values(), ids=SAMPLES.keys())
@pytest.mark.parametrize("tolerance", [None, 0.35])
def test_roundings_stay_arcs(samples, tolerance):
    def inside(x, y):
        return tile(70.3, 9)(x - 20.3, y - 24.1)

    fit = ss.fit_curve(trace(drawn(inside, samples)).longest, tolerance=tolerance)
    assert sorted(piece.kind for piece in fit.pieces) == ["arc"] * 4 + ["line"] * 4
    for piece in fit.pieces:
        if piece.kind == "arc":
            assert piece.arc.radius == pytest.approx(9, abs=0.25)


@pytest.mark.parametrize(("name", "accuracy"), [("2 x 2", 0.08), ("4 x 4", 0.02)])
def test_outlines_know_how_accurate_they_are(name, accuracy):
    assert trace(drawn(polygon(SQUARES[0]), SAMPLES[name])).longest.accuracy == accuracy


def test_the_gear_among_the_examples_has_sharp_roots(tmp_path):
    path = tmp_path / "gear.png"
    path.write_bytes(example_bytes("gear"))
    (gear, *_) = ss.fit_shape(trace(load(path)), tolerance=0.5)
    kinds = [piece.kind for piece in gear.pieces]
    # Flanks of three chords, heads and roots.
    assert (kinds.count("line"), kinds.count("arc")) == (72, 24)

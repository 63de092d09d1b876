"""Pictures whose contrast was raised: told by how often greys come up along edges, and undone."""

from __future__ import annotations

import io
from dataclasses import replace

import numpy as np
import pytest
from benchmarks.drawn.renderers import coverage as cover_of
from benchmarks.drawn.tables import rendered
from PIL import Image, ImageFilter
from scipy.ndimage import gaussian_filter
from scipy.spatial import cKDTree
from tests.support.rendering import coverage, dark, polygon, tile

import shapespline as ss
from shapespline.tracing import trace
from shapespline.tracing.crossings import crossings
from shapespline.tracing.layer import Layer
from shapespline.tracing.raised_contrast import _Border, _Tone, as_parts
from shapespline.tracing.seeing import Seeing, cut_field

SIDE = 120
# Turned by 8 and 33 degrees; corners anywhere within a pixel.
SQUARES = [
    [(60.3 + 44 * np.cos(a), 59.6 + 44 * np.sin(a)) for a in np.radians(turn + 90 * np.arange(4.0))]
    for turn in (8, 33)
]
COVERS = [coverage(polygon(corners), SIDE, SIDE) for corners in SQUARES]
DISC = coverage(lambda x, y: np.hypot(x - 60.2, y - 59.7) <= 38.4, SIDE, SIDE)
ROUNDED = coverage(lambda x, y: tile(70.3, 9)(x - 20.3, y - 24.1), SIDE, SIDE)
# Twelve alike: their edges show few phases.
HOLES = np.tile(coverage(lambda x, y: np.hypot(x - 20, y - 20) <= 9.3, 40, 40), (3, 4))


def clipped(gain):
    return lambda cover: np.clip(gain * (cover - 0.5) + 0.5, 0, 1)


def curved(cover):
    return 1 / (1 + np.exp(-10 * (cover - 0.5)))


def sharpened(cover):
    image = Image.fromarray(dark(cover)).filter(ImageFilter.UnsharpMask(1.0, 100, 0))
    return 1 - np.asarray(image) / 255


def as_jpeg(image):
    stream = io.BytesIO()
    Image.fromarray(image).save(stream, "JPEG", quality=90)
    return np.asarray(Image.open(stream))


# And the part of a pixel that is cut off at either end.
RAISED = {
    "twice": (clipped(2), 0.25),
    "three times": (clipped(3), 1 / 3),
    "by a curve": (curved, 0.1),
    "sharpened": (sharpened, 0.2),
}
each = pytest.mark.parametrize(("raised", "cut_off"), RAISED.values(), ids=RAISED.keys())


def parts_of(image):
    field = cut_field(Layer(image), light=False)
    return as_parts(field, crossings(field))


@each
@pytest.mark.parametrize("cover", [*COVERS, DISC], ids=["8", "33", "disc"])
def test_pixels_hold_the_part_that_is_ink(raised, cut_off, cover):
    image = dark(raised(cover))
    border = (cover > 0.01) & (cover < 0.99)
    off = np.abs(parts_of(image).values[:] - cover)[border]
    before = np.abs(1 - image / 255.0 - cover)[border]
    # Of what was cut off a twentieth, and a grey of 8 bits; beside corners more.
    assert np.median(off) < 0.05 * cut_off + 1 / 255
    assert np.sqrt((off**2).mean()) < 0.3 * np.sqrt((before**2).mean())


@each
@pytest.mark.parametrize("written", [np.asarray, as_jpeg], ids=["as it is", "JPEG"])
@pytest.mark.parametrize("which", [0, 1], ids=["8", "33"])
def test_squares_are_four_lines(raised, cut_off, written, which):
    fit = ss.fit_curve(trace(written(dark(raised(COVERS[which])))).longest)
    assert [piece.kind for piece in fit.pieces] == ["line"] * 4
    found = [piece.control_points[0] for piece in fit.pieces]
    assert cKDTree(found).query(SQUARES[which])[0].max() < 0.3 * cut_off


@pytest.mark.parametrize("which", [0, 1], ids=["8", "33"])
def test_squares_are_four_lines_within_a_tolerance(which):
    fit = ss.fit_curve(trace(dark(curved(COVERS[which]))).longest, tolerance=0.35)
    assert [piece.kind for piece in fit.pieces] == ["line"] * 4


@pytest.mark.parametrize("name", ["twice", "by a curve", "sharpened"])
@pytest.mark.parametrize("tolerance", [None, 0.35])
def test_roundings_stay_arcs(name, tolerance):
    raised, cut_off = RAISED[name]
    fit = ss.fit_curve(trace(dark(raised(ROUNDED))).longest, tolerance=tolerance)
    assert sorted(piece.kind for piece in fit.pieces) == ["arc"] * 4 + ["line"] * 4
    radii = [piece.arc.radius for piece in fit.pieces if piece.kind == "arc"]
    # Level edges are off by what was cut off, which a rounding takes up.
    assert radii == pytest.approx([9.0] * 4, abs=cut_off / (1 - np.sqrt(0.5)))


@pytest.mark.parametrize("light", [False, True])
def test_light_ink_and_colours_are_looked_at_alike(light):
    image = dark(clipped(2)(COVERS[0]))
    if light:
        image = 255 - image
    else:
        red, white = np.array([200.0, 30.0, 40.0]), np.array([255.0, 255.0, 255.0])
        image = np.rint(red + (white - red) * (image / 255.0)[..., None]).astype(np.uint8)
    fit = ss.fit_curve(trace(image).longest)
    assert [piece.kind for piece in fit.pieces] == ["line"] * 4


def samples(cover):
    """By 4 x 4 of them in each pixel."""
    return np.rint(16 * cover) / 16


@pytest.mark.parametrize(
    "image",
    [
        *(dark(cover) for cover in (*COVERS, DISC, ROUNDED, HOLES)),
        *(as_jpeg(dark(cover)) for cover in (*COVERS, DISC, HOLES)),
        *(dark(samples(cover)) for cover in (*COVERS, DISC)),
        np.rint(255 * (1 - DISC) ** (1 / 2.2)).astype(np.uint8),
        np.rint(gaussian_filter(dark(DISC).astype(float), 1.0)).astype(np.uint8),
        dark(DISC > 0.5),
        # Level edges tell nothing.
        dark(clipped(2)(np.pad(np.full((60, 60), 0.9), 30))),
    ],
)
def test_what_was_not_raised_is_left_as_it_is(image):
    assert parts_of(image) is None


@pytest.mark.parametrize("name", ["comb", "sans E"])
def test_few_pixels_of_few_slopes_tell_nothing(name):
    """Edges are laid badly where they are short and all at one angle."""
    for size in (128, 256):
        outlines, image = rendered(name, size, "JPEG 90")
        pale = np.rint(255 - 20 * cover_of(outlines, size)).astype(np.uint8)
        for one in (image, pale):
            assert parts_of(one) is None


def test_three_small_parts_tell_nothing():
    """However far they are off: of one edge they may be alike."""
    grey = np.concatenate([[0.1] * 3, np.full(40, 0.45)])
    field = cut_field(Layer(dark(grey)[None, :]), light=False)
    for count, told in ((3, False), (23, True)):
        column = np.concatenate([np.zeros(count - 3, dtype=int), np.arange(43)])
        covered = np.concatenate([np.full(count, 0.3), np.full(40, 0.45)])
        border = _Border(0 * column, column, covered, column >= 0)
        ends = replace(field, cut=127.5, middle=127.5, contrast=255.0)
        assert (_Tone.of(ends, border, 0.006) is not None) == told


@pytest.mark.parametrize("raised", [np.asarray, clipped(2)], ids=["as it is", "raised"])
def test_copies_of_pixels_are_looked_at_as_they_were_before(raised):
    image = np.kron(dark(raised(COVERS[1])), np.ones((2, 2), dtype=np.uint8))
    field, _ = Seeing().field(image)
    assert field.scale == 2
    assert (field.step > 0) == (raised is not np.asarray)


def test_a_level_that_is_given_is_kept():
    field, _ = Seeing(level=100).field(dark(clipped(2)(DISC)))
    assert field.cut == 99.5


def test_outlines_know_that_level_edges_are_less_certain():
    assert trace(dark(clipped(2)(COVERS[0]))).longest.accuracy == pytest.approx(0.06, abs=0.01)
    assert trace(dark(COVERS[0])).longest.accuracy == 0.02


def test_one_who_listens_is_told():
    heard = []
    trace(dark(clipped(2)(DISC)), progress=heard.append)
    assert "looking at the picture as it was before its contrast was raised" in heard


@pytest.mark.filterwarnings("ignore::shapespline.errors.PictureWarning")
@pytest.mark.parametrize("seed", range(8, 14))
def test_blots_of_high_contrast_have_outlines(seed):
    """Outlines that come back to where they were within a few crossings, too."""
    rng = np.random.default_rng(seed)
    height, width = rng.integers(5, 90, 2)
    blots = gaussian_filter(rng.normal(size=(height, width)), rng.uniform(0.5, 4))
    image = np.clip(127 + rng.uniform(20, 900) * blots / blots.std(), 0, 255)
    assert len(trace(np.rint(image).astype(np.uint8))) > 0

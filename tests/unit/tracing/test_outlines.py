"""Traced outlines lie where the edge is, nest as it nests, and fail in a sentence."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib.path import Path as MplPath
from scipy.ndimage import gaussian_filter

from shapespline.errors import DegenerateContourError, InvalidInputError
from shapespline.tracing import trace
from shapespline.tracing.layer import Layer
from shapespline.tracing.level import otsu_split, picture_level
from shapespline.tracing.outlines import nesting
from shapespline.tracing.pixels import colour_distance, pixel_values
from shapespline.values.view_box import ViewBox

LEAST_SPACING = 1e-3  # pixels; closer points are merged


def glyph(shape=(40, 40)):
    cover = np.zeros(shape)
    cover[10:30, 15:25] = 1.0
    cover[10:30, 14] = 0.25
    return cover


def centres(height, width):
    """Coordinates of pixel centres, y up."""
    rows, columns = np.mgrid[:height, :width]
    return columns + 0.5, height - (rows + 0.5)


def disc(centre, radius, ramp, side):
    """8-bit picture that falls linearly from 255 to 0 across a circle, over ``ramp`` pixels."""
    x, y = centres(side, side)
    distance = np.hypot(x - centre[0], y - centre[1]) - radius
    return np.rint(255 * np.clip(0.5 - distance / ramp, 0, 1)).astype(np.uint8)


def signed_area(points):
    x, y = points.T
    return 0.5 * float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))


def summary(shape):
    """Areas and lengths, which no turn or flip of the picture changes."""
    measures = [(abs(signed_area(c.points)), c.length) for c in shape]
    return np.array(sorted(measures))


def blobs(seed, side=48):
    """Smooth random picture with several nested regions, and integer values."""
    x, y = centres(side, side)
    rng = np.random.default_rng(seed)
    waves = [
        rng.normal() * np.sin((fx * x + fy * y) * 2 * np.pi / side + rng.uniform(0, 6))
        for fx in range(4)
        for fy in range(-3, 4)
    ]
    total = sum(waves)
    return np.rint(127.5 + 120 * total / np.abs(total).max()).astype(np.uint8)


@pytest.mark.slow
@given(
    st.floats(5, 30),
    st.tuples(st.floats(38, 42), st.floats(38, 42)),
    st.floats(2.5, 6),
    st.booleans(),
)
def test_a_disc_is_traced_within_the_error_of_linear_interpolation(radius, centre, ramp, dark):
    image = disc(centre, radius, ramp, 80)
    if dark:
        image = 255 - image
    shape = trace(image, level=127.5)
    assert len(shape) == 1
    points = shape.longest.level_line
    off = np.abs(np.hypot(points[:, 0] - centre[0], points[:, 1] - centre[1]) - radius)
    # Along a grid line the distance to a circle is convex, its second derivative at most 1 / r;
    # interpolating over one pixel errs by an eighth of that. Rounding moves values by 1/2 of 255.
    assert off.max() <= 1 / (8 * (radius - 1)) + 0.5 * ramp / 255
    assert signed_area(points) > 0
    assert shape.frame == ViewBox(0, 0, 80, 80)


def test_otsu_finds_the_middle_of_an_edge_by_itself():
    given_level = trace(disc((40, 40), 20, 3, 80), level=127.5)
    found = trace(disc((40, 40), 20, 3, 80))
    # Both classes are even regions of 0 and 255 with a thin seam: their medians are exact.
    assert np.array_equal(found.longest.points, given_level.longest.points)


def test_an_axis_aligned_edge_by_hand():
    # Columns 0..3 white, column 4 covered by 60 %, the rest black: true edge at x = 4.6.
    image = np.zeros((8, 10), dtype=np.uint8)
    image[:, :4], image[:, 4] = 255, 153
    contour = trace(image, level=127.5, polarity="light").longest
    # Column 4's centre (4.5) has 153, column 5's has 0: 127.5 lies at 4.5 + 25.5 / 153.
    assert contour.level_line[:, 0].max() == pytest.approx(4.5 + 25.5 / 153, abs=1e-12)
    points = contour.points
    assert points[:, 0].max() == pytest.approx(4.6, abs=1e-12)
    # Closed along the picture's border, exactly on it.
    assert points.min(axis=0).tolist() == [0.0, 0.0]
    assert points[:, 1].max() == 8.0


def test_a_shape_that_fills_the_picture_but_for_a_hole():
    image = np.full((20, 30), 10, dtype=np.uint8)
    image[5:9, 10:20] = 200
    shape = trace(image, level=100, polarity="dark")
    assert shape.parents == (-1, 0)
    # Edges on the lines between pixels, and their corners, are exact.
    assert signed_area(shape.contours[0].points) == 20 * 30
    hole = shape.contours[1].points
    assert hole.min(axis=0).tolist() == [10, 11]
    assert hole.max(axis=0).tolist() == [20, 15]
    assert signed_area(hole) == pytest.approx(-10 * 4, abs=0.5)  # its corners may be cut


def test_nesting_and_orientation_by_hand():
    image = np.zeros((60, 80), dtype=np.uint8)
    image[5:55, 5:55] = 255
    image[10:50, 10:50] = 0
    image[20:40, 20:40] = 255
    image[25:35, 25:35] = 0
    image[20:40, 60:75] = 255
    shape = trace(image)
    assert shape.parents == (-1, 0, 1, -1, 2)
    assert [shape.is_hole(k) for k in range(5)] == [False, True, False, False, True]
    assert [np.sign(signed_area(c.points)) for c in shape] == [1, -1, 1, 1, -1]


@pytest.mark.slow
@given(st.integers(0, 10_000))
@settings(max_examples=40)
def test_nesting_agrees_with_an_independent_point_in_polygon(seed):
    shape = trace(blobs(seed), min_area=0, local="off")
    paths = [MplPath(c.polyline, closed=True) for c in shape]
    areas = [abs(signed_area(c.points)) for c in shape]
    for k, contour in enumerate(shape):
        around = [
            j for j in range(len(shape)) if j != k and paths[j].contains_point(contour.points[0])
        ]
        assert shape.parents[k] == min(around, key=areas.__getitem__, default=-1)
        assert shape.is_hole(k) == (len(around) % 2 == 1)
        assert (signed_area(contour.points) > 0) != shape.is_hole(k)


@given(st.integers(0, 10_000), st.integers(40, 210))
@settings(max_examples=40)
@pytest.mark.slow
def test_no_two_points_coincide_even_where_pixels_lie_on_the_level(seed, level):
    image = blobs(seed)
    image[::3] = np.where(np.abs(image[::3].astype(int) - level) < 30, level, image[::3])
    if not image.min() < level <= image.max():
        return
    for pixels in (image, image.astype(float)):  # DroppedPointsWarning would be an error
        for contour in trace(pixels, level=level, min_area=0):
            assert np.hypot(*np.diff(contour.polyline, axis=0).T).min() > LEAST_SPACING
            assert contour.points.min() >= 0
            assert contour.points.max() <= 48


@pytest.mark.slow
@given(st.integers(0, 10_000))
@settings(max_examples=25)
def test_turned_flipped_and_inverted_pictures_give_the_same_outlines(seed):
    image = blobs(seed)

    def found(image, polarity):
        return summary(trace(image, level=127.5, polarity=polarity, min_area=0))

    expected = found(image, "light")
    for other in (np.rot90(image), image[::-1], image[:, ::-1]):
        assert found(other, "light") == pytest.approx(expected, abs=1e-9)
    assert found(255 - image, "dark") == pytest.approx(expected, abs=1e-9)


def test_polarity_is_told_by_the_rim():
    image = disc((40, 40), 20, 3, 80)
    light = trace(image)
    dark = trace(255 - image)
    assert np.allclose(light.longest.points, dark.longest.points, atol=1e-9)
    # Told otherwise, the ground is the shape and the disc its hole.
    ground = trace(image, polarity="dark")
    assert ground.parents == (-1, 0)
    assert ground.longest.points.min() == 0


@given(
    st.lists(st.integers(0, 30), min_size=2, max_size=40).filter(lambda v: len(set(v)) > 1),
    st.sampled_from([np.uint8, np.uint16]),
)
@pytest.mark.slow
def test_otsu_splits_where_the_between_class_variance_is_largest(values, dtype):
    values = np.array(values, dtype=dtype)
    split = otsu_split(np.bincount(values), np.arange(values.max() + 1.0))

    def variance(cut):
        low, high = values[values < cut], values[values >= cut]
        return len(low) * len(high) * (high.mean() - low.mean()) ** 2

    best = max(variance(cut) for cut in np.unique(values)[1:])
    assert variance(split) >= best * (1 - 1e-12)


def test_specks_are_dropped_and_counted_in_square_pixels():
    image = np.zeros((100, 100), dtype=np.uint8)
    image[20:60, 20:60] = 255
    image[80:84, 80:84] = 255  # 15.5 square pixels, corners cut
    image[10, 10] = 255  # 0.5
    assert len(trace(image, min_area=0)) == 3
    assert len(trace(image, min_area=15.6)) == 1
    with pytest.raises(DegenerateContourError, match=r"encloses 2000 .* the largest 1\.6e\+03"):
        trace(image, min_area=2000)


def test_the_longest_outline_alone():
    image = np.zeros((60, 60), dtype=np.uint8)
    image[5:55, 5:55] = 255
    image[10:50:4, 10:50] = 0  # ten slits, each longer round than ...
    assert len(trace(image)) == 11
    shape = trace(image, contours="longest")
    assert len(shape) == 1
    assert shape.longest.length == pytest.approx(4 * 50, abs=4)  # ... but shorter than the square
    assert signed_area(shape.longest.points) > 0


@pytest.mark.parametrize("value", [0, 255])
def test_a_constant_picture_has_no_outline(value):
    with pytest.raises(DegenerateContourError, match=f"every pixel has the value {value}"):
        trace(np.full((9, 9), value, dtype=np.uint8))


@pytest.mark.parametrize("level", [0, 10, 201, 300, -5])
def test_a_level_outside_the_values_has_no_outline(level):
    image = (10 + 190 * (glyph() > 0.5)).astype(np.uint8)
    with pytest.raises(DegenerateContourError, match="the pixels range from 10 to 200"):
        trace(image, level=level)
    assert len(trace(image, level=200)) == len(trace(image, level=11)) == 1


@pytest.mark.parametrize("dtype", [np.uint8, np.float64])
def test_pixels_at_the_level_are_light(dtype):
    image = (10 + 190 * (glyph() > 0.5)).astype(dtype)
    light = trace(image, level=200, polarity="light")
    assert light.longest.points.mean(axis=0) == pytest.approx([20, 20])
    dark = trace(image, level=200, polarity="dark")
    assert dark.parents == (-1, 0)
    hole = np.round(dark.contours[1].points, 9), np.round(light.longest.points, 9)
    assert sorted(map(tuple, hole[0])) == sorted(map(tuple, hole[1]))


@pytest.mark.parametrize(
    ("image", "options", "complaint"),
    [
        (np.zeros(5), {}, r"shape \(h, w\)"),
        (np.zeros((5, 5, 7)), {}, r"got \(5, 5, 7\)"),
        (np.zeros((0, 5)), {}, "at least one pixel"),
        (np.full((5, 5), np.nan), {}, "finite"),
        (np.zeros((5, 5), complex), {}, "real"),
        (glyph(), {"polarity": "white"}, "polarity must be one of auto, dark, light, got 'white'"),
        (glyph(), {"channel": "hue"}, "channel must be one of"),
        (glyph(), {"contours": "some"}, "contours must be one of all, longest"),
        (glyph(), {"min_area": -1}, "min_area must be at least 0"),
        (glyph(), {"min_area": np.nan}, "min_area must be at least 0"),
        (glyph(), {"level": np.nan}, "level must be a finite number"),
        (glyph(), {"channel": "red"}, "needs a colour picture"),
        (glyph(), {"channel": "alpha"}, "needs a picture with transparency"),
    ],
)
def test_bad_input(image, options, complaint):
    with pytest.raises(InvalidInputError, match=complaint):
        trace(image, **options)


def test_nesting_orients_and_sorts():
    square = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    outlines = [square[::-1], 5 * square - 2, 0.5 * square + 0.25, square + 10]
    parents, order, turned = nesting(outlines)
    assert order == [1, 0, 3, 2]
    assert parents == [-1, 0, -1, 1]
    assert turned == [False, False, False, False]  # the second is a hole, and runs clockwise
    assert nesting([square[::-1]])[2] == [True]


def test_accuracy_tells_one_bit_from_anti_aliased():
    y, x = (np.mgrid[0 : 80 * 16, 0 : 80 * 16] + 0.5) / 16
    ground = np.hypot(x - 40, y - 40) > 25
    soft = np.rint(255 * ground.reshape(80, 16, 80, 16).mean(axis=(1, 3))).astype(np.uint8)
    for image, accuracy in ((soft, 0.02), (255 * (soft > 127), 0.25)):
        (contour,) = trace(image)
        assert contour.accuracy == accuracy
        error = np.abs(np.hypot(*(contour.points - 40).T) - 25)
        assert np.sqrt((error**2).mean()) <= accuracy


@pytest.mark.filterwarnings("ignore::shapespline.errors.PictureWarning")
def test_corners_that_meet_in_noise_are_no_warning():
    rng = np.random.default_rng(37)
    height, width = rng.integers(5, 90, 2)
    blots = gaussian_filter(rng.normal(size=(height, width)), rng.uniform(0.5, 4))
    image = np.clip(127 + rng.uniform(20, 900) * blots / blots.std(), 0, 255)
    assert len(trace(np.rint(image).astype(np.uint8))) > 0


@pytest.mark.parametrize("grain", [4.0, 12.0, 20.0, 26.0])
def test_ink_and_ground_are_known_among_grain(grain):
    """Grain that black cuts off leaves nothing even; ink and ground are no farthest values."""
    truth = np.full((200, 200), 224.0)
    truth[40:160, 40:160] = 20.0
    noisy = truth + np.random.default_rng(5).normal(0.0, grain, truth.shape)
    found = picture_level(Layer(np.rint(np.clip(noisy, 0, 255)).astype(np.uint8)))
    # Medians of some thousand pixels, whole numbers; even pixels of what is cut off are lighter.
    assert found.light == pytest.approx(224.0, abs=0.15 * grain)
    assert found.dark == pytest.approx(20.0, abs=0.15 * grain)


def test_a_coloured_ground_under_grain_is_nothing():
    """The norm of what noise alone differs by is taken off."""
    paper, ink = np.array([245.0, 240.0, 225.0]) - 40, np.array([190.0, 40.0, 50.0])
    inside = np.hypot(*(np.mgrid[:160, :160] - 80.0)) <= 50
    noise = np.random.default_rng(6).normal(0.0, 10.0, (160, 160, 3))
    picture = np.rint(np.where(inside[..., None], ink, paper) + noise).astype(np.uint8)
    values = pixel_values(picture, "auto", lightness=False)
    assert values.is_difference
    # The noise is known to 7 %, its square to 14: the root of what that leaves. The norm has 8.9.
    assert abs(np.median(values.values[:][~inside])) < np.sqrt(0.14 * 0.789 * 10.0**2)
    contrast = np.sqrt(((ink - paper) ** 2).mean())
    assert np.median(values.values[:][inside]) == pytest.approx(contrast, abs=1.0)
    own = colour_distance(picture, "rgb(190, 40, 50)")[:]
    assert abs(np.median(own[inside])) < np.sqrt(0.14 * 0.789 * 10.0**2)
    plain = np.rint(np.where(inside[..., None], ink, paper)).astype(np.uint8)
    assert (pixel_values(plain, "auto", lightness=False).values[:][~inside] == 0.0).all()

"""Pictures of every mode and format give the same outline; broken ones give one sentence."""

from __future__ import annotations

import contextlib
import io
import struct
import zlib
from unittest import mock

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from shapespline.errors import DegenerateContourError, FormatError, PictureWarning, ShapesplineError
from shapespline.formats.registry import read
from shapespline.tracing import picture, trace
from shapespline.tracing.layer import Layer
from shapespline.tracing.lighting import evenly_lit
from shapespline.values.view_box import ViewBox

HEIGHT, WIDTH = 40, 60


def cover():
    """How much of each pixel a lying L covers; not symmetric, edges between the pixels."""
    values = np.zeros((HEIGHT, WIDTH))
    values[8:30, 10:20] = 1.0
    values[22:30, 20:45] = 1.0
    values[8:30, 9] = 0.25
    values[7, 10:20] = 0.5
    return values


BYTES = np.rint(255 * cover()).astype(np.uint8)


@pytest.fixture(scope="module")
def expected(tmp_path_factory):
    path = tmp_path_factory.mktemp("picture") / "l.png"
    Image.fromarray(BYTES).save(path)
    return read(path).longest.points


def saved(tmp_path, picture, name, **options):
    path = tmp_path / name
    picture.save(path, **options)
    return path


def same_outline(points, expected, within):
    """Corner cuts aside, which move with the level: the box is the same."""
    low, high = points.min(axis=0), points.max(axis=0)
    return (
        np.abs(low - expected.min(axis=0)).max() <= within
        and np.abs(high - expected.max(axis=0)).max() <= within
    )


def test_coordinates_by_hand(tmp_path, expected):
    shape = read(saved(tmp_path, Image.fromarray(BYTES), "l.png"))
    assert shape.frame == ViewBox(0, 0, WIDTH, HEIGHT)
    # Right and lower edges lie between pixels: column 45, row 30, y up.
    assert expected[:, 0].max() == pytest.approx(45, abs=0.01)
    assert expected[:, 1].min() == pytest.approx(HEIGHT - 30, abs=0.01)


@pytest.mark.parametrize("name", ["l.png", "l.PNG", "l.bmp", "l.tif", "l.tiff"])
def test_lossless_formats_agree_exactly(tmp_path, expected, name):
    assert np.array_equal(
        read(saved(tmp_path, Image.fromarray(BYTES), name)).longest.points, expected
    )


def test_content_counts_and_not_the_ending(tmp_path, expected):
    path = saved(tmp_path, Image.fromarray(BYTES), "l.png")
    path = path.rename(tmp_path / "l.jpg")
    assert np.array_equal(read(path).longest.points, expected)


def test_jpeg(tmp_path, expected):
    path = saved(tmp_path, Image.fromarray(BYTES), "l.jpeg", quality=95)
    # Ringing of a few grey values out of 255 on a slope of at least half of that.
    assert same_outline(read(path).longest.points, expected, within=0.1)


@pytest.mark.parametrize(
    ("mode", "name"),
    [
        ("L", "l.png"),
        ("RGB", "l.png"),
        ("RGBA", "l.png"),
        ("LA", "l.png"),
        ("P", "l.png"),
        ("CMYK", "l.tif"),
        ("YCbCr", "l.jpg"),
        ("I", "l.tif"),
        ("F", "l.tif"),
    ],
)
def test_modes(tmp_path, expected, mode, name):
    options = {"quality": 95} if name == "l.jpg" else {}
    path = saved(tmp_path, Image.fromarray(BYTES).convert(mode), name, **options)
    within = 0.1 if name == "l.jpg" else 0.01
    assert same_outline(read(path).longest.points, expected, within)


def test_one_bit(tmp_path):
    path = saved(tmp_path, Image.fromarray(cover() > 0.3), "l.png")
    with Image.open(path) as picture:
        assert picture.mode == "1"
    points = read(path).longest.points
    assert points.min(axis=0).tolist() == [10, 10]
    assert points.max(axis=0).tolist() == [45, 33]


@pytest.mark.parametrize("name", ["l.png", "l.tif"])
def test_sixteen_bits_are_kept(tmp_path, expected, name):
    path = saved(tmp_path, Image.fromarray((BYTES * 257.0).astype(np.uint16)), name)
    assert picture.load(path).dtype == np.uint16
    assert same_outline(read(path).longest.points, expected, within=0.01)
    # Contrast that eight bits would lose altogether.
    path = saved(tmp_path, Image.fromarray(np.uint16(30_000) + BYTES // 4), name)
    assert same_outline(read(path).longest.points, expected, within=0.05)


@pytest.mark.parametrize("colour", [0, 255])
@pytest.mark.parametrize("mode", ["LA", "RGBA"])
def test_a_glyph_on_a_transparent_ground(tmp_path, expected, colour, mode):
    picture = Image.merge("LA", [Image.new("L", (WIDTH, HEIGHT), colour), Image.fromarray(BYTES)])
    path = saved(tmp_path, picture.convert(mode), "l.png")
    assert np.array_equal(read(path).longest.points, expected)


@pytest.mark.parametrize("mode", ["L", "P", "RGB"])
def test_a_transparent_colour(tmp_path, mode):
    picture = Image.fromarray((255 * (cover() > 0.3)).astype(np.uint8)).convert(mode)
    clear = picture.getpixel((0, 0))
    path = saved(tmp_path, picture, "l.png", transparency=clear)
    points = read(path).longest.points
    assert points.min(axis=0).tolist() == [10, 10]
    assert points.max(axis=0).tolist() == [45, 33]


def test_a_transparent_grey_is_not_black(tmp_path):
    values = np.zeros((HEIGHT, WIDTH), dtype=np.uint8)
    values[10:30, 10:30], values[10:30, 30:50] = 10, 200
    picture = Image.fromarray(values)
    # Laid on white, for most of what shows is dark: the dark half stands out. On black the other.
    points = read(saved(tmp_path, picture, "half.png", transparency=0)).longest.points
    assert points[:, 0].max() == pytest.approx(30, abs=0.5)
    points = read(saved(tmp_path, picture, "half.png")).longest.points
    assert points[:, 0].min() == pytest.approx(30, abs=0.5)


@pytest.mark.parametrize("orientation", range(1, 9))
def test_the_camera_s_orientation_is_undone(tmp_path, expected, orientation):
    upright = Image.fromarray(BYTES)
    # What the sensor saw, for each value of the EXIF tag: the inverse of what a viewer does.
    seen = {
        1: upright,
        2: upright.transpose(Image.Transpose.FLIP_LEFT_RIGHT),
        3: upright.transpose(Image.Transpose.ROTATE_180),
        4: upright.transpose(Image.Transpose.FLIP_TOP_BOTTOM),
        5: upright.transpose(Image.Transpose.TRANSPOSE),
        6: upright.transpose(Image.Transpose.ROTATE_90),
        7: upright.transpose(Image.Transpose.TRANSVERSE),
        8: upright.transpose(Image.Transpose.ROTATE_270),
    }[orientation]
    exif = Image.Exif()
    exif[0x0112] = orientation
    shape = read(saved(tmp_path, seen, "l.png", exif=exif))
    assert shape.frame == ViewBox(0, 0, WIDTH, HEIGHT)
    assert np.array_equal(shape.longest.points, expected)


def test_options_reach_the_tracer(tmp_path):
    values = BYTES.copy()
    values[35:38, 50:58] = 100
    path = saved(tmp_path, Image.fromarray(values), "l.png")
    assert len(read(path, level=50)) == 2
    assert len(read(path, level=150)) == 1
    assert len(read(path, level=50, min_area=100)) == 1
    assert len(read(path, level=50, contours="longest")) == 1
    assert read(path, level=50, polarity="dark").is_hole(1)
    with pytest.raises(DegenerateContourError, match=r"l\.png: level 300"):
        read(path, level=300)


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


@pytest.mark.parametrize("side", [13_500, 20_000, 60_000])
def test_bombs_are_refused_before_decoding(tmp_path, side):
    path = tmp_path / "bomb.png"
    header = struct.pack(">IIBBBBB", side, side, 8, 0, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", b"x"))
    with pytest.raises(FormatError, match=r"bomb\.png: (the picture has|too large a picture)"):
        read(path)


def test_other_content_is_refused(tmp_path):
    path = tmp_path / "notes.png"
    path.write_text("x,y\n1,2\n")
    with pytest.raises(
        FormatError, match=r"notes\.png: not a PNG, JPEG, TIFF, BMP, WebP or GIF picture"
    ):
        read(path)
    # Formats that Pillow knows and nobody asked for: PostScript would start an interpreter.
    path.write_bytes(b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 10 10\n%%EndComments\n")
    with pytest.raises(FormatError, match="not a PNG"):
        read(path)


@pytest.mark.parametrize("kind", ["PNG", "JPEG", "TIFF", "BMP"])
def test_truncated_pictures(tmp_path, kind):
    file = io.BytesIO()
    Image.fromarray(BYTES).save(file, kind)
    path = tmp_path / "cut.png"
    path.write_bytes(file.getvalue()[: len(file.getvalue()) * 2 // 3])
    with pytest.raises(FormatError, match=r"cut\.png: (the picture is damaged|not a PNG)"):
        read(path)


@pytest.mark.slow
@given(data=st.data())
@settings(deadline=None)  # a damaged width can make a picture large
def test_no_damage_escapes_as_another_error(tmp_path_factory, data):
    kind = data.draw(st.sampled_from(["PNG", "JPEG", "TIFF", "BMP"]))
    file = io.BytesIO()
    Image.fromarray(BYTES).save(file, kind)
    content = bytearray(file.getvalue())
    for _ in range(data.draw(st.integers(1, 4))):
        index = data.draw(st.integers(0, min(len(content), 400) - 1))
        content[index] = data.draw(st.integers(0, 255))
    path = tmp_path_factory.mktemp("damage") / "damaged.png"
    path.write_bytes(content)
    limited = mock.patch.multiple(picture, LARGEST_IMAGE=1_000_000, LARGEST_GREY=1_000_000)
    with limited, contextlib.suppress(ShapesplineError, PictureWarning):
        read(path)


@pytest.mark.parametrize("kind", ["WEBP", "GIF"])
def test_more_kinds_of_pictures(tmp_path, kind):
    path = tmp_path / f"bytes.{kind.lower()}"
    options = {"lossless": True} if kind == "WEBP" else {}
    Image.fromarray(BYTES).save(path, kind, **options)
    assert len(read(path)) >= 1


def test_of_several_frames_the_first_is_taken_and_told(tmp_path):
    frames = [Image.new("L", (30, 30), 255) for _ in range(3)]
    for index, frame in enumerate(frames):
        frame.paste(0, (5 * index + 2, 10, 5 * index + 12, 20))
    for name in ("frames.gif", "pages.tif"):
        path = tmp_path / name
        frames[0].save(path, save_all=True, append_images=frames[1:])
        with pytest.warns(PictureWarning, match="3 frames or pages: the first one"):
            shape = read(path)
        assert shape.longest.points.mean(axis=0) == pytest.approx([7, 15])


def test_outlines_that_enclose_nothing_are_left_out(tmp_path):
    pixels = np.full((20, 24), 200.0)
    pixels[:, :3], pixels[4:9, 12:20] = 255.0, 90.0
    pixels[15, 18] = np.nextafter(147.0, 0)  # a rounding beyond the level
    shape = trace(pixels, level=147.0, polarity="dark", min_area=0)
    assert all(len(contour) > 2 for contour in shape)


def test_pictures_smaller_than_the_blocks_of_their_light():
    pixels = np.random.default_rng(3).integers(100, 255, (20, 24)).astype(np.uint8)
    assert np.isfinite(evenly_lit(Layer(pixels), light=False)[:]).all()

"""Areas of colours: exact colours, shared borders, no gap, no overlap, nothing small lost."""

from __future__ import annotations

import zlib
from collections import Counter

import ezdxf
import numpy as np
import pytest
from numpy.testing import assert_array_equal
from PIL import Image, ImageDraw, ImageFont
from tests.support.command_line import one_line

import shapespline as ss
from shapespline.errors import DegenerateContourError, InvalidInputError, PictureWarning
from shapespline.tracing import palette, told, trace

COLORS = {"#145aa0", "#dc1e28", "#ffdc00", "#1e8c3c", "#ffffff"}
LARGER = 8


def logo():
    """Four colours on white that touch, in 200 x 140 pixels."""
    n = LARGER
    image = Image.new("RGB", (200 * n, 140 * n), "#ffffff")
    draw = ImageDraw.Draw(image)
    draw.rectangle((0, 0, 200 * n, 60 * n), fill="#145aa0")
    draw.ellipse((30 * n, 20 * n, 110 * n, 100 * n), fill="#dc1e28")
    draw.ellipse((55 * n, 45 * n, 85 * n, 75 * n), fill="#ffdc00")
    draw.polygon([(120 * n, 20 * n), (190 * n, 70 * n), (130 * n, 120 * n)], fill="#1e8c3c")
    return np.asarray(image.resize((200, 140), Image.Resampling.BOX))


def signed_area(points):
    x, y = points.T
    return 0.5 * float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))


@pytest.fixture(scope="module")
def shape():
    return trace(logo(), colors="auto")


def test_looked_at_a_few_rows_at_a_time_the_palette_is_the_same(monkeypatch):
    grain = np.random.default_rng(2).normal(0.0, 6.0, (140, 200, 3))
    noisy = np.clip(logo() + grain, 0, 255).astype(np.uint8)  # hardly a pixel is even
    dots = logo().copy()
    dots[5:135:6, 5:195:7] = (250, 120, 250)  # a colour that no even pixel has
    for picture in (logo(), noisy, dots):
        colors, labels = palette.palette_of(picture, "auto")
        areas, count = palette.merged(palette.Palette(colors, labels), 6.0)
        with monkeypatch.context() as rows:
            for module in (palette, told):
                rows.setattr(module, "TOGETHER", 700)  # three
            again = palette.palette_of(picture, "auto")
            assert_array_equal(again.colors, colors)
            assert_array_equal(again.labels, labels)
            areas_again, count_again = palette.merged(again, 6.0)
        assert count_again == count
        assert_array_equal(areas_again.labels, areas.labels)


def test_flat_areas_keep_their_colours_and_edges_make_no_new_ones(shape):
    assert {color for color in shape.colors if color} == COLORS
    # White and blue are cut in two or three by what lies on them.
    assert sum(color is not None for color in shape.colors) <= 8


def test_areas_fill_the_picture_without_gap_and_overlap(shape):
    total = sum(signed_area(contour.points) for contour in shape)
    assert total == pytest.approx(200 * 140, abs=1e-9)
    steps = Counter()
    for contour in shape:
        ends = [tuple(point) for point in contour.points.tolist()]
        steps.update(zip(ends, ends[1:] + ends[:1], strict=True))
    assert max(steps.values()) == 1
    alone = [(a, b) for a, b in steps if (b, a) not in steps]
    # What no neighbour runs the other way lies on the rim.
    assert all(
        (a[0] == b[0] and a[0] in (0, 200)) or (a[1] == b[1] and a[1] in (0, 140)) for a, b in alone
    )


def test_borders_lie_where_they_were_drawn(shape):
    yellow = next(c for c, color in zip(shape, shape.colors, strict=True) if color == "#ffdc00")
    # Pillow's ellipse from 55 to 85 inclusive is half a sample larger.
    off = np.hypot(*(yellow.points - (70, 80)).T) - 15
    assert np.abs(off).max() <= 1.5 / LARGER


def test_neighbours_share_one_fitted_border_to_the_bit(shape):
    drawing = ss.fit_shape(shape, tolerance=0.25, shared_boundaries=True)
    assert drawing.colors == shape.colors
    assert all(fit.kept for fit in drawing)
    pieces = Counter()
    for fit in drawing:
        if len(fit.pieces) > 1:
            for piece in fit.pieces:
                points = [tuple(point) for point in piece.control_points.tolist()]
                pieces[min(tuple(points), tuple(reversed(points)))] += 1
    alone = [points for points, count in pieces.items() if count == 1]
    assert max(pieces.values()) == 2
    for points in alone:
        x, y = np.array(points).T
        assert np.isin(x, (0, 200)).all() or np.isin(y, (0, 140)).all()


def test_thin_letters_and_their_dots_stay():
    n = LARGER
    import matplotlib

    path = f"{matplotlib.get_data_path()}/fonts/ttf/DejaVuSans.ttf"
    image = Image.new("RGB", (120 * n, 30 * n), "#ffeecc")
    face = ImageFont.truetype(path, 14 * n)
    ImageDraw.Draw(image).text((6 * n, 6 * n), "jäger 8", font=face, fill="#101060")
    shape = trace(np.asarray(image.resize((120, 30), Image.Resampling.BOX)), colors="auto")
    ink = [color for color in shape.colors if color and color != "#ffeecc"]
    assert len(set(ink)) == 1
    assert (
        np.abs(np.array([int(ink[0][k : k + 2], 16) for k in (1, 3, 5)]) - (16, 16, 96)).max() < 40
    )
    assert len(ink) == 9  # six letters and a figure, the dot of the j, two of the ä: j ¨a g e r 8


def test_small_areas_of_a_grainy_picture_go_to_their_neighbours():
    rng = np.random.default_rng(2)
    image = np.clip(logo() + rng.normal(0, 12, (140, 200, 3)), 0, 255).astype(np.uint8)
    with pytest.warns(PictureWarning, match=r"areas below .* --min-area 0"):
        shape = trace(image, colors=5)
    assert len(shape) < 40
    total = sum(signed_area(contour.points) for contour in shape)
    assert total == pytest.approx(200 * 140, abs=1e-9)


@pytest.mark.parametrize(
    ("colors", "complaint"),
    [
        (1, "from 2 to 64"),
        (65, "from 2 to 64"),
        (2.5, "from 2 to 64"),
        ("many", "colors must be auto"),
        (12, "asks for 12, but the picture has 5"),
    ],
)
def test_numbers_of_colours_that_cannot_be(colors, complaint):
    with pytest.raises(InvalidInputError, match=complaint):
        trace(logo(), colors=colors)


def test_one_colour_has_no_border():
    with pytest.raises(DegenerateContourError, match="one colour only"):
        trace(np.full((9, 9, 3), 77, dtype=np.uint8), colors="auto")


@pytest.mark.slow
def test_no_ground_shows_between_areas_in_viewers_that_smooth_each_by_itself(shape, tmp_path):
    """Beneath areas that tile the picture lie their outlines, and nowhere else; none is read."""
    output = tmp_path / "areas.svg"
    ss.write(output, shape)
    text = output.read_text()
    assert text.count("<use ") == 1
    assert text.index("<use ") < text.index("<path")
    assert text.count("<path") == sum(color is not None for color in shape.colors)
    plain = text.replace(' fill-rule="evenodd"', "")  # of those with holes
    assert all(f'fill="{c}" stroke="{c}"' in plain for c in COLORS)
    assert len(ss.read(output)) == len(shape)
    ss.write(tmp_path / "areas.pdf", shape)
    content = zlib.decompress((tmp_path / "areas.pdf").read_bytes().split(b"stream\n")[1])
    clipped = content.split(b" re W n\n")[1].split(b"\nQ\n")[0]
    assert clipped.count(b"S") == text.count("<path")
    assert clipped.count(b"f*") == 0
    # One area alone has nothing beside it that could hide an outline.
    alone = shape.colors.index("#ffdc00")
    ss.write(output, ss.Shape([shape.contours[alone]], frame=shape.frame, colors=["#ffdc00"]))
    assert "stroke" not in output.read_text()


@pytest.fixture
def picture(tmp_path):
    Image.fromarray(logo()).save(tmp_path / "logo.png")
    return tmp_path / "logo.png"


@pytest.mark.slow
def test_files_have_the_colours(shapespline, picture, tmp_path):
    for ending in ("svg", "pdf", "dxf", "png", "json"):
        output = tmp_path / f"out.{ending}"
        code, _, err = shapespline("fit", picture, "--colors", "auto", "-o", output)
        said = f"shapespline: {output.name}: .pdf files know no arcs" if ending == "pdf" else ""
        assert (code, err.partition(";")[0]) == (0, said)
    text = (tmp_path / "out.svg").read_text()
    assert {part[:7] for part in text.split('fill="')[1:]} == COLORS
    document = ezdxf.readfile(tmp_path / "out.dxf")
    layers = {entity.dxf.layer for entity in document.modelspace()}
    assert layers == {f"color_{color[1:]}" for color in COLORS}
    again = ss.read(tmp_path / "out.json")
    assert {color for color in again.colors if color} == COLORS
    drawn = np.asarray(Image.open(tmp_path / "out.png").resize((200, 140), Image.Resampling.BOX))
    assert np.abs(drawn.astype(float) - logo()).mean() < 1.5


def test_colours_exclude_what_speaks_of_ink(shapespline, picture, tmp_path):
    code, _, err = shapespline(
        "trace", picture, "--colors", "4", "--level", "99", "-o", tmp_path / "x.svg"
    )
    assert code == 1
    assert one_line(err)
    assert "colors are areas, not ink" in err


def test_corners_of_areas_lie_where_they_were_drawn(shape):
    """The square of a pixel cuts corners of 40 to 90 degrees by 0.5 pixels and more."""
    drawn = np.array([(120, 20), (190, 70), (130, 120)])
    for color in ("#1e8c3c", "#ffffff", "#145aa0"):
        points = np.concatenate([contour.points for contour, own in owned(shape) if own == color])
        at = points * (1, -1) + (0, 140)
        off = np.array([np.hypot(*(at - corner).T).min() for corner in drawn])
        # Green has all three; of white's and blue's those that lie in them.
        near = off < 2.0
        assert near.sum() == {"#1e8c3c": 3, "#ffffff": 2, "#145aa0": 1}[color]
        # Pillow's polygon is up to a sample larger, more at acute corners.
        assert off[near].max() <= 2 / LARGER


def owned(shape):
    """Contours with the colour of the area that they bound, holes included."""
    for contour, color, parent in zip(shape, shape.colors, shape.parents, strict=True):
        yield contour, color or shape.colors[parent]


def test_strokes_of_a_pixel_stay_whole_in_colours():
    """A hairline of 1 pixel along the border of two rows covers both by not quite half."""
    image = np.full((30, 60, 3), 255, dtype=np.uint8)
    image[20:28, 5:55] = (20, 90, 160)
    image[9:11, 15:45] = (140, 174, 208)
    shape = trace(image, colors=2)
    blue = [c for c, color in zip(shape, shape.colors, strict=True) if color == "#145aa0"]
    assert [round(np.ptp(contour.points[:, 0])) for contour in blue] == [50, 30]

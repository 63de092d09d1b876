"""Colours and strokes of an SVG: what is kept, and that it looks the same in every format."""

from __future__ import annotations

import io
import re
import shutil
import subprocess
import warnings
import zlib

import numpy as np
import pytest
from PIL import Image
from tests.support.svg_pictures import GREEN, PICTURES, read, rect, svg

import shapespline as ss
from shapespline.errors import SkippedContentWarning


def at(picture, place):
    """The colour of a place of the view box in a picture, shape (height, width, 3)."""
    scale = picture.shape[0] / 100
    x, y = place
    return "#" + bytes(picture[int(scale * y), int(scale * x)]).hex()


def png(drawing, tmp_path):
    ss.write(tmp_path / "shown.png", drawing, pixels=200)
    return np.asarray(Image.open(tmp_path / "shown.png").convert("RGB"))


def alike(one, other):
    """Whether two colours are one, but for the rounding of a mixture."""
    pairs = zip(bytes.fromhex(one[1:]), bytes.fromhex(other[1:]), strict=True)
    return max(abs(a - b) for a, b in pairs) <= 1


@pytest.mark.filterwarnings("ignore::shapespline.errors.SkippedContentWarning")
@pytest.mark.parametrize("name", PICTURES)
def test_a_picture_has_the_colours_of_the_drawing(name, tmp_path):
    body, colors = PICTURES[name]
    shown = png(read(body), tmp_path)
    for place, color in colors.items():
        assert alike(at(shown, place), color), place


def rendered(data):
    command = ["rsvg-convert", "-w", "200", "--background-color", "white"]
    done = subprocess.run(command, input=data, capture_output=True, check=True)
    return np.asarray(Image.open(io.BytesIO(done.stdout)).convert("RGB"))


@pytest.mark.skipif(shutil.which("rsvg-convert") is None, reason="rsvg-convert is not installed")
@pytest.mark.filterwarnings("ignore::shapespline.errors.SkippedContentWarning")
@pytest.mark.parametrize("name", PICTURES)
def test_the_written_drawing_looks_the_same(name, tmp_path):
    body, colors = PICTURES[name]
    ss.write(tmp_path / "again.svg", read(body))
    before, after = rendered(svg(body)), rendered((tmp_path / "again.svg").read_bytes())
    for place, color in colors.items():
        assert alike(at(before, place), color), place
    # Edges lie between pixels; the few that rounding moves across a sample are less than a row.
    assert (np.abs(before.astype(int) - after).max(axis=2) > 32).sum() < 100


@pytest.mark.filterwarnings("ignore::shapespline.errors.SkippedContentWarning")
@pytest.mark.parametrize("name", PICTURES)
def test_what_is_written_reads_back_as_it_was(name, tmp_path):
    first = read(PICTURES[name][0])
    ss.write(tmp_path / "one.svg", first)
    again = ss.read(tmp_path / "one.svg")
    ss.write(tmp_path / "two.svg", again)
    assert (tmp_path / "two.svg").read_bytes() == (tmp_path / "one.svg").read_bytes()
    assert (again.colors, again.widths, again.strokes) == (
        first.colors,
        first.widths,
        first.strokes,
    )
    ss.write(tmp_path / "one.json", first)
    assert ss.read(tmp_path / "one.json") == first


def test_what_lets_others_show_through_counts_within_what_does():
    drawing = read(f'<g opacity="0.5"><g opacity="0.5">{rect(9, 9, 9, 9, fill="red")}</g></g>')
    assert drawing.colors == ("#ffbfbf",)


@pytest.mark.parametrize(
    ("style", "said"),
    [
        ("fill='#cc2222'", False),
        ("fill='#cc2222' fill-rule='evenodd'", True),
        ("fill='black'", True),
        ("fill='black' fill-rule='evenodd'", False),
    ],
)
def test_another_fill_rule_is_said_where_it_matters(style, said):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        read(f'<path {style} d="M50 5L76 86L7 36H93L24 86z"/>')
    assert [one.category for one in caught] == said * [SkippedContentWarning]


def test_a_frame_of_white_on_paper_is_left_out():
    with pytest.warns(SkippedContentWarning, match="white areas on white"):
        drawing = read(PICTURES["the hole of a white frame on paper"][0])
    assert len(drawing) == 1


def test_a_stroke_of_no_finite_width_is_an_error():
    with pytest.raises(ss.FormatError, match="width of a stroke is no finite number"):
        read('<path fill="none" stroke="black" stroke-width="1e400" d="M0 0h9"/>')


def test_black_areas_with_white_holes_have_no_colours():
    drawing = read(rect(10, 10, 80, 80) + rect(30, 30, 40, 40, fill="white"))
    assert (drawing.colors, drawing.widths) == ((None, None), (None, None))
    assert drawing.parents == (-1, 0)
    drawn = read(rect(10, 10, 80, 80) + rect(30, 30, 40, 40, fill="white", stroke="black"))
    assert drawn.colors == ("#000000", "#ffffff")


STYLE = 'fill="none" stroke="#cc2222" stroke-width="3" stroke-linecap="square"'


@pytest.mark.parametrize(
    ("body", "more", "width"),
    [
        (f'<path {STYLE} d="M10 10L60 60"/>', "", 3.0),
        (f'<g transform="scale(2 8)"><path {STYLE} d="M5 2L9 7"/></g>', "", 12.0),
        (f'<g {STYLE}><path d="M10 10L60 60"/></g>', ' width="50mm" height="50mm"', 1.5),
        (f'<path {STYLE.replace("3", "1mm")} d="M10 10L60 60"/>', "", 96 / 25.4),
        (f'<path {STYLE.replace("3", "5%")} d="M10 10L60 60"/>', "", 5.0),
        (f'<style>path{{stroke-width:7}}</style><path {STYLE} d="M10 10L60 60"/>', "", 7.0),
        (f'<path {STYLE} style="stroke-width:7px" d="M10 10L60 60"/>', "", 7.0),
    ],
)
def test_widths_of_strokes_are_in_the_unit_of_the_coordinates(body, more, width):
    drawing = read(body, more)
    assert drawing.widths == (pytest.approx(width),)
    assert drawing.strokes == (ss.Stroke("#cc2222", cap="square", join="miter"),)
    assert drawing.colors == (None,)
    larger = drawing.transformed([[2.0, 0.0], [0.0, 2.0]])
    assert larger.widths == (pytest.approx(2 * width),)
    assert larger.strokes == drawing.strokes


def test_a_fit_keeps_colours_and_strokes(tmp_path):
    body, colors = PICTURES["strokes and areas"]
    (tmp_path / "in.svg").write_bytes(svg(body))
    shape = ss.read(tmp_path / "in.svg").shape
    fits = ss.fit_shape(shape, tolerance=0.05)
    assert (fits.colors, fits.widths, fits.strokes) == (shape.colors, shape.widths, shape.strokes)
    shown = png(fits, tmp_path)
    assert {place: at(shown, place) for place in colors} == colors


def test_a_stroke_alone_is_not_filled_and_cuts_no_hole():
    body = rect(10, 10, 80, 80, fill=GREEN) + rect(30, 30, 40, 40, fill="none", stroke="black")
    drawing = read(body)
    assert [drawing.is_filled(k) for k in range(2)] == [True, False]
    # To an offset and to CAD it is an outline within another one.
    assert drawing.is_hole(1)
    assert drawing.is_area(1)


def test_a_plate_drawn_in_lines_is_a_face_with_holes():
    occ = pytest.importorskip("shapespline.formats.occ")
    pytest.importorskip("OCP")
    from OCP.TopAbs import TopAbs_FACE, TopAbs_WIRE
    from OCP.TopExp import TopExp_Explorer

    body = rect(10, 10, 80, 80) + rect(20, 20, 10, 10) + rect(70, 20, 10, 10)
    shape = occ.faces(read(f'<g fill="none" stroke="black">{body}</g>'), 1.0)
    counts = []
    for kind in (TopAbs_FACE, TopAbs_WIRE):
        explorer, count = TopExp_Explorer(shape, kind), 0
        while explorer.More():
            count += 1
            explorer.Next()
        counts.append(count)
    assert counts == [1, 3]


def test_dxf_has_a_layer_for_each_colour(tmp_path):
    ezdxf = pytest.importorskip("ezdxf")
    ss.write(tmp_path / "layers.dxf", read(PICTURES["strokes and areas"][0]))
    space = ezdxf.readfile(tmp_path / "layers.dxf").modelspace()
    assert {entity.dxf.layer for entity in space} == {"color_22aa66", "color_2255cc"}


def test_pdf_paints_areas_and_strokes():
    from shapespline.formats.pdf import encode

    content = re.search(
        rb"stream\n(.*)\nendstream", encode(read(PICTURES["strokes and areas"][0])), re.S
    )
    assert content is not None
    lines = zlib.decompress(content[1]).decode().splitlines()
    # Green within a red pen of 8 with pointed turns; then a blue one of 6 alone. 72 points an inch.
    assert lines.count("B") == lines.count("S") == 1
    before = lines[: lines.index("B")]
    assert {"0.133333 0.666667 0.4 rg", "6 w", "0.8 0.133333 0.133333 RG 0 J 0 j 4 M"} <= set(
        before
    )
    after = lines[lines.index("B") :]
    assert {"4.5 w", "0.133333 0.333333 0.8 RG 0 J 0 j 4 M"} <= set(after)


@pytest.mark.parametrize("ending", ["svg", "png", "pdf"])
def test_a_page_without_a_frame_has_room_for_strokes(ending, tmp_path):
    body = rect(10, 10, 80, 80, fill="none", stroke="black", stroke_width=20)
    drawing = read(body)
    free = ss.Drawing(drawing.fits, widths=drawing.widths, strokes=drawing.strokes)
    ss.write(tmp_path / f"out.{ending}", free)
    if ending == "svg":
        box = ss.read(tmp_path / "out.svg").frame
        assert box.x <= 0
        assert box.x + box.width >= 100
    elif ending == "pdf":
        page = re.search(rb"/MediaBox \[0 0 ([\d.]+)", (tmp_path / "out.pdf").read_bytes())
        outline = 842 / (80 + 2 * (0.02 * 80 + 20))
        assert page is not None
        assert float(page[1]) >= 100 * outline
    else:
        shown = np.asarray(Image.open(tmp_path / "out.png").convert("L"))
        assert (shown[[0, -1]] == 255).all()
        assert (shown[:, [0, -1]] == 255).all()


@pytest.mark.parametrize(
    ("join", "corner", "cap", "end"),
    [("miter", 0, "square", 0), ("round", 255, "butt", 255), ("bevel", 255, "round", 0)],
)
def test_pictures_show_turns_and_ends_of_strokes(join, corner, cap, end, tmp_path):
    style = f'fill="none" stroke="black" stroke-width="20" stroke-linejoin="{join}"'
    style += f' stroke-linecap="{cap}"'
    shown = png(read(f'<path {style} d="M20 80V20H70"/>'), tmp_path)
    # Near the tip of the corner, and five pixels of a hundred beyond the end.
    assert at(shown, (11.5, 11.5)) == f"#{3 * f'{corner:02x}'}"
    assert at(shown, (75, 20)) == f"#{3 * f'{end:02x}'}"

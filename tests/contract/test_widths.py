"""Strokes keep their widths from the picture into every file that can show one."""

from __future__ import annotations

import re
import zlib

import numpy as np
import pytest
from PIL import Image
from tests.support.make_fit import blob, fit_of, wave
from tests.support.pens import arc, picture

import shapespline as ss

SIZE = (100, 120)
WIDTH = 12.0
# A ring, which an outline would fill, a corner and a dot.
STROKES = [arc(60, 50, 34, 0, 360), [(35, 50), (60, 35), (85, 50)], [(60, 66), (60.01, 66)]]


@pytest.fixture(scope="module")
def seen():
    return picture(STROKES, WIDTH, SIZE)


@pytest.fixture(scope="module")
def drawing(seen):
    return ss.fit_shape(ss.trace(seen, centerline=True))


def off(shown, seen):
    """The part of pixels that differ by more than a quarter of black and white."""
    return float((np.abs(shown.astype(float) - seen) > 64).mean())


def test_a_drawing_knows_the_widths_of_its_strokes(drawing):
    assert drawing.widths == pytest.approx([WIDTH] * 3, abs=0.25)
    assert not any(drawing.is_area(k) for k in range(3))
    assert drawing.shape.widths == drawing.widths


def test_png_shows_the_picture_again(drawing, seen, tmp_path):
    path = tmp_path / "strokes.png"
    ss.write(path, drawing, pixels=SIZE[1])
    # Edges may be a fifth of a pixel off: of their 500 pixels few differ by a quarter.
    assert off(np.asarray(Image.open(path).convert("L")), seen) < 0.005


def test_svg_strokes_them_with_a_round_pen(drawing, tmp_path):
    path = tmp_path / "strokes.svg"
    ss.write(path, drawing)
    text = path.read_text()
    widths = [float(found) for found in re.findall(r'stroke-width="([\d.]+)"', text)]
    assert widths == pytest.approx([WIDTH] * 3, abs=0.25)
    assert text.count('fill="none"') == text.count('stroke-linecap="round"') == 3


def test_a_width_that_is_asked_for_goes_first(drawing, tmp_path):
    path = tmp_path / "thin.svg"
    ss.write(path, drawing, stroke_width=0.5)
    assert path.read_text().count('stroke-width="0.5"') == 3


def test_pdf_sets_a_pen_for_each(drawing):
    from shapespline.formats.pdf import encode

    whole = encode(drawing)
    content = re.search(rb"stream\n(.*)\nendstream", whole, re.DOTALL)
    assert content is not None
    lines = zlib.decompress(content[1]).decode().splitlines()
    pens = [float(line.removesuffix(" w")) for line in lines if line.endswith(" w")]
    # Pixels at 96 to the inch, points at 72.
    assert pens == pytest.approx([0.75 * WIDTH] * 3, abs=0.2)


def test_a_ring_of_a_stroke_is_no_polygon(drawing, tmp_path):
    path = tmp_path / "strokes.geojson"
    with pytest.warns(ss.ArcsAsCurvesWarning):  # the ring was drawn as a circle, and is one
        ss.write(path, drawing)
    assert "Polygon" not in path.read_text()
    (ring,) = (fit for fit in drawing if fit.closed)
    (read,) = (contour for contour in ss.read(path) if contour.length > 200)
    assert read.length == pytest.approx(ring.length, rel=1e-3)


def test_a_ring_of_a_stroke_is_no_face():
    occ = pytest.importorskip("shapespline.formats.occ")
    pytest.importorskip("OCP")
    kinds = [
        str(occ.faces(ss.Drawing([fit_of(blob())], widths=widths), 1.0).ShapeType())
        for widths in (None, [2.0])
    ]
    assert "FACE" in kinds[0]
    assert "WIRE" in kinds[1]


def test_json_reads_back(drawing, tmp_path):
    path = tmp_path / "strokes.json"
    ss.write(path, drawing)
    assert ss.read(path) == drawing
    ss.write(path, ss.Drawing([fit_of(wave())]))
    assert "widths" not in path.read_text()


def test_widths_grow_with_the_drawing():
    drawing = ss.Drawing([fit_of(wave()), fit_of(blob())], widths=[2.0, None])
    turned = drawing.transformed([[0.0, -3.0], [3.0, 0.0]])
    assert turned.widths == (pytest.approx(6.0), None)
    assert drawing.is_area(1)


@pytest.mark.parametrize("widths", [[1.0], [0.0, 1.0], [-1.0, None], ["1", None]])
def test_bad_widths(widths):
    with pytest.raises(ss.InvalidInputError, match="widths must"):
        ss.Drawing([fit_of(wave()), fit_of(wave())], widths=widths)

"""Glyphs of fonts in and out: pens of fontTools, TrueType and PostScript curves, GLIF, UFO."""

from __future__ import annotations

import numpy as np
import pytest

import shapespline as ss

pytest.importorskip("fontTools")
from fontTools.fontBuilder import FontBuilder
from fontTools.pens.areaPen import AreaPen
from fontTools.pens.cu2quPen import Cu2QuPen
from fontTools.pens.recordingPen import RecordingPen
from fontTools.pens.ttGlyphPen import TTGlyphPen
from fontTools.ufoLib import UFOReader, UFOWriter

# A ring: its hole runs the other way; and a stem of lines.
ANGLE = np.linspace(0, 2 * np.pi, 240, endpoint=False)
CIRCLE = np.column_stack([np.cos(ANGLE), np.sin(ANGLE)])
STEM = [(600.0, 0.0), (700.0, 0.0), (700.0, 700.0), (600.0, 700.0)]


@pytest.fixture(scope="module")
def ring():
    outlines = [300 + 250 * CIRCLE, 300 + 150 * CIRCLE, np.array(STEM)]
    shape = ss.Shape([ss.Contour(points, closed=True) for points in outlines], [-1, 0, -1])
    return ss.fit_shape(shape, tolerance=0.5, character="fewest")


class Quadratic:
    """A ring of implied points on the curve, none of them given, as TrueType has it."""

    def draw(self, pen):
        pen.qCurveTo((100, 0), (100, 100), (0, 100), (0, 0), None)
        pen.closePath()


def drawn(value, **options):
    pen = RecordingPen()
    value.draw(pen, **options)
    return pen


def test_a_fit_becomes_a_glyph_and_comes_back(ring):
    pen = drawn(ring)
    verbs = [verb for verb, _ in pen.value]
    assert verbs.count("moveTo") == verbs.count("closePath") == 3
    assert verbs.count("lineTo") == 3  # closing draws the fourth side of the stem
    assert {"curveTo", "lineTo"} < set(verbs)

    class Glyph:
        draw = staticmethod(pen.replay)

    back = ss.read(Glyph())
    assert back.parents == ring.parents
    # Roundings of numbers of a size of 700.
    assert ss.compare(ring, back).hausdorff_distance < 1e-9


@pytest.mark.parametrize("clockwise", [False, True])
def test_holes_run_the_other_way(ring, clockwise):
    pen = AreaPen()
    ring.draw(pen, clockwise=clockwise)
    # AreaPen counts counter-clockwise positive; the area of the fit knows its holes.
    assert pen.value == pytest.approx((-1 if clockwise else 1) * ring.area, rel=1e-9)


def test_quadratics_stay_quadratic():
    contour = ss.Contour(300 + 250 * CIRCLE, closed=True)
    fit = ss.fit_curve(contour, tolerance=1.0, degree=2)
    verbs = {verb for verb, _ in drawn(fit).value}
    assert verbs == {"moveTo", "qCurveTo", "closePath"}
    curve = ss.read(Quadratic())
    assert [piece.degree for piece in curve.fits[0].pieces] == [2, 2, 2, 2]
    # Four parabolas between the middles of a square of 100: 2/3 of each corner is cut off.
    assert curve.area == pytest.approx(100**2 - 4 * (50 * 50 / 2) / 3, rel=1e-12)
    assert {verb for verb, _ in drawn(curve).value} == {"moveTo", "qCurveTo", "closePath"}


def test_a_traced_glyph_stands_in_a_truetype_font(ring, tmp_path):
    pen = TTGlyphPen(None)
    ring.draw(Cu2QuPen(pen, max_err=0.5), clockwise=True)
    builder = FontBuilder(1000, isTTF=True)
    builder.setupGlyphOrder([".notdef", "a", "twice"])
    builder.setupCharacterMap({ord("a"): "a"})
    twice = TTGlyphPen({"a": None})
    twice.addComponent("a", (1, 0, 0, 1, 800, 0))
    glyphs = {".notdef": TTGlyphPen(None).glyph(), "a": pen.glyph(), "twice": twice.glyph()}
    builder.setupGlyf(glyphs)
    builder.setupHorizontalMetrics({n: (800, getattr(g, "xMin", 0)) for n, g in glyphs.items()})
    builder.setupHorizontalHeader(ascent=800, descent=-200)
    builder.setupNameTable({"familyName": "Ring", "styleName": "Regular"})
    builder.setupPost()
    builder.save(tmp_path / "ring.ttf")

    glyph_set = builder.font.getGlyphSet()
    back = ss.read(glyph_set["a"])
    # Half a unit of the conversion, and coordinates that are whole numbers: half a diagonal.
    assert ss.compare(ring, back).hausdorff_distance < 0.5 + np.sqrt(0.5)
    moved = ss.read(glyph_set["twice"])
    assert moved.bounds.x_min == pytest.approx(back.bounds.x_min + 800, abs=1e-9)


def test_glif_files_and_a_ufo(ring, tmp_path):
    ss.write(tmp_path / "o.glif", ring, glyph="o", codepoint="o", advance=650)
    text = (tmp_path / "o.glif").read_text()
    assert '<glyph name="o" format="2">' in text
    assert '<unicode hex="006F"/>' in text
    assert 'width="650' in text
    back = ss.read(tmp_path / "o.glif")
    assert ss.compare(ring, back).hausdorff_distance < 1e-9

    writer = UFOWriter(tmp_path / "font.ufo")
    glyph_set = writer.getGlyphSet()

    def points(pen):
        from fontTools.pens.pointPen import SegmentToPointPen

        ring.draw(SegmentToPointPen(pen))

    glyph_set.writeGlyph("o", drawPointsFunc=points)
    glyph_set.writeGlyph(
        "double", drawPointsFunc=lambda pen: pen.addComponent("o", (1, 0, 0, 1, 900, 0))
    )
    glyph_set.writeContents()
    writer.writeLayerContents(["public.default"])
    read = UFOReader(tmp_path / "font.ufo").getGlyphSet()
    assert ss.compare(ring, ss.read(read["o"], glyph_set=read)).hausdorff_distance < 1e-9
    # A component is found in the UFO that the file lies in.
    file = tmp_path / "font.ufo" / "glyphs" / "double.glif"
    assert ss.read(file).bounds.x_min == pytest.approx(ring.bounds.x_min + 900)


def test_components_of_nowhere_are_said():
    class Half:
        def draw(self, pen):
            Quadratic().draw(pen)
            pen.addComponent("acute", (1, 0, 0, 1, 0, 0))

    with pytest.warns(ss.SkippedContentWarning, match="components are left out"):
        assert len(ss.read(Half())) == 1


def test_bad_glyphs_are_said(tmp_path, ring):
    class Nothing:
        def draw(self, pen):
            pass

    with pytest.raises(ss.FormatError, match="draws no outline"):
        ss.read(Nothing())
    for text in ("", "<glyph", "<svg/>", '<glyph name="a" format="9"/>', "nonsense"):
        (tmp_path / "bad.glif").write_text(text)
        with pytest.raises(ss.FormatError, match=r"bad\.glif"):
            ss.read(tmp_path / "bad.glif")
    for options, sentence in (
        ({"glyph": ""}, "glyph must be a name"),
        ({"codepoint": "ab"}, "one character"),
        ({"advance": -1.0}, "advance must be a number, 0 or more"),
        ({"advance": "wide"}, "advance must be a number, 0 or more"),
    ):
        with pytest.raises(ss.InvalidInputError, match=sentence):
            ss.write(tmp_path / "x.glif", ring, **options)
    assert not (tmp_path / "x.glif").exists()

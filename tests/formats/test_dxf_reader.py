"""DXF drawings read as exact curves, against ezdxf's own geometry: every entity, blocks, layers,
units and rational splines; and anything broken or hostile refused in one sentence.
"""

from __future__ import annotations

import math
import warnings

import ezdxf
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image
from scipy.interpolate import BSpline
from tests.support.arcs import on_segment
from tests.support.make_fit import nested, wave
from tests.support.pieces import bezier, square
from tests.support.round_trip import flattened

import shapespline as ss
from shapespline.errors import FormatError, SkippedContentWarning
from shapespline.formats import dxf_writer
from shapespline.formats.splines import spline_pieces
from shapespline.geometry.exact import Outlines, exact_drawing, exact_fit
from shapespline.geometry.nearest import nearest


@pytest.fixture
def draw(tmp_path):
    """A drawing read from what a function adds to a model space."""

    def read(add, **options):
        document = ezdxf.new("R2010", **options)
        add(document.modelspace())
        path = tmp_path / "drawing.dxf"
        document.saveas(path)
        return ss.read(path)

    return read


# Curves


@pytest.mark.parametrize("digits", [None, 4, 3, 2])
def test_polylines_of_many_chords_are_fitted_as_what_they_were(draw, digits):
    plate, hole = fillets(60, 40, 6, 12), circle(20, 15, 5, 48)
    given = plate, hole
    if digits is not None:
        given = plate.round(digits), hole.round(digits)
    drawing = draw(lambda s: [s.add_lwpolyline(points, close=True) for points in given])
    # Rounding moves a radius by (|cos| + |sin|) / 2 steps at most.
    off = 1e-6 if digits is None else 0.71 * 10.0**-digits
    for tolerance in (None, 0.05):
        outer, inner = (ss.fit_curve(fit.contour, tolerance=tolerance) for fit in drawing)
        assert sorted(piece.kind for piece in outer.pieces) == ["arc"] * 4 + ["line"] * 4
        assert [piece.kind for piece in inner.pieces] == ["arc"]
        radii = [piece.arc.radius for piece in outer.pieces if piece.kind == "arc"]
        assert radii == pytest.approx([6] * 4, abs=off)
        assert inner.pieces[0].arc.radius == pytest.approx(5, abs=off)
        assert inner.pieces[0].arc.centre == pytest.approx((20, 15), abs=off)


def circle(x, y, radius, count):
    angle = 2 * np.pi * np.arange(count) / count
    return np.array([x, y]) + radius * np.column_stack([np.cos(angle), np.sin(angle)])


def fillets(width, height, radius, chords):
    """A rectangle with round corners, as ends of edges and of chords."""
    corners = [
        (width - radius, height - radius),
        (radius, height - radius),
        (radius, radius),
        (width - radius, radius),
    ]
    angle = np.linspace(0, np.pi / 2, chords + 1)
    rows = [
        np.array(corner)
        + radius * np.column_stack([np.cos(angle + k * np.pi / 2), np.sin(angle + k * np.pi / 2)])
        for k, corner in enumerate(corners)
    ]
    return np.concatenate(rows)


POINTS = [(0, 0), (1, 4), (4, 4), (6, 0), (8, 2)]


def unclamped(spline):
    """As some programs write closed curves: uniform knots, none repeated."""
    spline.set_uniform([*POINTS, *POINTS[:3]], degree=3)


@pytest.mark.slow
@pytest.mark.parametrize(
    "add",
    [
        lambda s: s.add_line((1, 2), (3, 5)),
        lambda s: s.add_circle((3, 4), 5),
        lambda s: s.add_arc((3, 4), 5, 20, 300),
        lambda s: s.add_arc((3, 4), 5, 300, 20),
        lambda s: s.add_arc((3, 4), 5, 300, 20, dxfattribs={"extrusion": (0, 0, -1)}),
        lambda s: s.add_ellipse((3, 4), (5, 1), 0.3),
        lambda s: s.add_ellipse((3, 4), (5, 1), 0.3, 1.0, 5.5),
        lambda s: s.add_ellipse((3, 4), (5, 1), 0.3, 5.5, 1.0),
        lambda s: s.add_open_spline(POINTS, degree=3),
        lambda s: s.add_open_spline(POINTS, degree=2),
        lambda s: unclamped(s.add_open_spline(POINTS, degree=3)),
        lambda s: s.add_rational_spline([(0, 0), (1, 4), (4, 4), (6, 0)], [1, 3, 0.5, 1]),
        lambda s: s.add_spline([(0, 0), (3, 5), (6, 0), (9, 2)]),
    ],
)
def test_curves_against_the_tools_of_the_library(draw, tmp_path, add):
    (fit,) = draw(add)
    (entity,) = ezdxf.readfile(tmp_path / "drawing.dxf").modelspace()
    expected = flattened(entity)
    found = np.sqrt(nearest(fit.spline, expected).distances_sq)
    assert found.max() <= 2e-9 * fit.contour.box_diagonal
    ends = fit.spline([0.0, 1.0])
    assert np.abs(ends - expected[[0, -1]]).max() <= 1e-12 * 10


@pytest.mark.parametrize("bulge", [1.0, -1.0, 0.3, -2.5, 1e-3])
def test_bulges(draw, bulge):
    (fit,) = draw(lambda s: s.add_lwpolyline([(1, 1, bulge), (5, 3, 0), (4, 6, 0)], format="xyb"))
    arc = on_segment(np.array([1.0, 1]), np.array([5.0, 3]), bulge, 300)
    distances = np.sqrt(nearest(fit.spline, arc).distances_sq)
    radius = math.hypot(4, 2) * (1 + bulge**2) / (4 * abs(bulge))
    assert distances.max() <= 1.2e-9 * radius
    assert not fit.closed


@given(st.integers(0, 3000), st.sampled_from([2, 3, 5]), st.booleans())
@settings(max_examples=12)
@pytest.mark.slow
def test_rational_splines_within_a_billionth(seed, degree, even):
    rng = np.random.default_rng(seed)
    curve = wave(degree + 3, degree, seed=seed, interior=np.sort(rng.uniform(0.1, 0.9, 2)))
    weights = np.full(degree + 3, 0.5) if even else rng.uniform(0.3, 3, degree + 3)
    knots = 7 + 3 * curve.knots
    pieces = spline_pieces(degree, knots, curve.control_points, weights)
    assert len(pieces) == 1 if even else all(piece.degree == 3 for piece in pieces)
    fit = exact_fit(pieces)
    homogeneous = np.column_stack([curve.control_points * weights[:, None], weights])
    values = BSpline(knots, homogeneous, degree)(np.linspace(7, 10, 200))
    points = values[:, :2] / values[:, 2:]
    size = float(np.hypot(*np.ptp(curve.control_points, axis=0)))
    assert np.sqrt(nearest(fit.spline, points).distances_sq.max()) <= 1.1e-9 * size


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((3, [0, 0, 1, 1], [(0, 0), (1, 1)]), "degree . 1 knots more"),
        ((2, [0, 0, 0, 1, 1, 1], [(0, 0), (1, 1), (2, 0)], [1, 0, 1]), "positive weight"),
        ((2, [0, 0, 0, 1, 1, 1], [(0, 0), (1, 1), (2, 0)], [1, 1]), "positive weight"),
        ((1, [1, 1, 0, 0], [(0, 0), (1, 1)]), "not decrease"),
        ((1, [0, 0, 0, 0], [(0, 0), (1, 1)]), "span a domain"),
        ((1, [0, 0, np.nan, 1], [(0, 0), (1, 1)]), "finite"),
        ((12, np.repeat([0, 1], 13), np.ones((13, 2))), "degree"),
        ((1, [0, 0, 0.5, 0.5, 1, 1], [(0, 0), (1, 1), (1, 2), (3, 3)]), "repeat more"),
        ((2, [0, 0, 0, 1, 1, 1], [(0, 0), (1, 1), (2, 0)], [1e-12, 1, 1e-12]), "so uneven"),
    ],
)
def test_splines_that_are_none(arguments, message):
    with pytest.raises(FormatError, match=message):
        spline_pieces(*arguments)


# Drawings


def test_polylines_of_old_and_new(draw):
    points = [(0, 0), (4, 0), (4, 3)]

    def add(space):
        space.add_lwpolyline(points, close=True)
        space.add_polyline2d([(x + 9, y) for x, y in points], close=True)
        space.add_polyline3d([(x + 18, y, 2) for x, y in points])

    with pytest.warns(SkippedContentWarning, match="not flat"):
        drawing = draw(add)
    assert [fit.closed for fit in drawing] == [True, True, False]
    assert [fit.n_stored_points for fit in drawing] == [3, 3, 3]


def test_entities_that_meet_become_outlines_and_nest(draw):
    def add(space):
        for begin, end in [((0, 0), (9, 0)), ((9, 8), (9, 0)), ((9, 8), (0, 8)), ((0, 0), (0, 8))]:
            space.add_line(begin, end)
        space.add_arc((4, 4), 2, 0, 180)
        space.add_line((2, 4), (6, 4 + 1e-9))  # as near as programs come
        space.add_line((20, 0), (21, 0))
        space.add_circle((21, 0), 0.5)

    drawing = draw(add)
    assert [fit.closed for fit in drawing] == [True, True, False, True]
    assert drawing.parents == (-1, 0, -1, -1)
    assert len(drawing.fits[0].pieces) == 4


def test_ends_of_other_programs_that_almost_meet(draw):
    """Lines and polylines off by what rounding leaves, on a size of 85."""

    def add(space):
        corners = [(0, 0), (60, 0), (60, 60), (0, 60)]
        for (x, y), (u, v) in zip(corners, corners[1:] + corners[:1], strict=True):
            space.add_line((x, y), (u + 1e-6, v))
        space.add_lwpolyline([(10, 10), (20, 10), (20, 20), (10 + 1e-7, 10 - 1e-7)])

    drawing = draw(add)
    assert [(fit.closed, len(fit.pieces)) for fit in drawing] == [(True, 4), (True, 3)]
    assert drawing.area == pytest.approx(60**2 - 50, abs=1e-3)


def test_what_is_drawn_twice_is_cut_once(draw):
    def add(space):
        for _ in range(2):
            space.add_circle((5, 5), 2)
            space.add_lwpolyline([(0, 0), (10, 0), (10, 10), (0, 10)], close=True)

    with pytest.warns(SkippedContentWarning, match="drawing.dxf: 2 entities that repeat others"):
        drawing = draw(add)
    assert [fit.closed for fit in drawing] == [True, True]


def test_two_outlines_that_share_a_corner_stay_two(draw):
    drawing = draw(
        lambda s: [s.add_lwpolyline([(x, 0), (x + 4, 0), (4, 4)], close=True) for x in (0, 4)]
    )
    assert [fit.closed for fit in drawing] == [True, True]


def test_blocks_are_exploded_and_hidden_things_left_out(draw):
    def add(space):
        document = space.doc
        block = document.blocks.new("B")
        block.add_circle((0, 0), 1)
        outer = document.blocks.new("OUTER")
        outer.add_blockref("B", (1, 0), dxfattribs={"xscale": 2, "yscale": 1})
        space.add_blockref("OUTER", (10, 5), dxfattribs={"rotation": 90})
        space.add_blockref("B", (0, 20)).grid((2, 3), (5, 5))
        document.layers.add("off").off()
        document.layers.add("ice").freeze()
        for layer in ("off", "ICE"):
            space.add_line((0, 0), (100, 100), dxfattribs={"layer": layer})
        space.add_line((0, 0), (100, 100), dxfattribs={"invisible": 1})

    drawing = draw(add)
    assert len(drawing) == 7
    x, y = drawing.fits[0].contour.points.T
    # The ellipse with half axes 2 and 1 about (1, 0), turned by 90 degrees.
    assert (x.min(), x.max()) == pytest.approx((9, 11), abs=1e-3)
    assert (y.min(), y.max()) == pytest.approx((4, 8), abs=1e-3)


def test_what_is_no_curve_is_named(draw):
    def add(space):
        space.add_text("A")
        space.add_point((1, 1))
        space.add_line((0, 0), (1, 1))

    with pytest.warns(SkippedContentWarning, match="no curves were left out: TEXT, POINT"):
        assert len(draw(add)) == 1
    with pytest.raises(FormatError, match="holds no curve, only TEXT"):
        draw(lambda s: s.add_text("A"))


@pytest.mark.parametrize(("code", "unit"), [(0, None), (1, "in"), (4, "mm"), (6, "m"), (20, None)])
def test_units_are_read(draw, code, unit):
    assert draw(lambda s: s.add_line((0, 0), (1, 1)), units=code).unit == unit


# What is no drawing


WHOLE = dxf_writer.encode(exact_drawing(Outlines([square(3.0), [bezier((0, 0), (1, 4), (5, 5))]])))


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"not a drawing", "no DXF drawing, or damaged"),
        (WHOLE[: len(WHOLE) // 2], "damaged"),
        (WHOLE.replace(b"LINE\n", b"LINE\nx", 1), "damaged|understood"),
        (dxf_writer.encode(nested()).replace(b"SPLINE", b"SPLIME"), "holds no curve"),
    ],
)
def test_broken_files_are_sentences(tmp_path, data, message):
    path = tmp_path / "drawing.dxf"
    path.write_bytes(data)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SkippedContentWarning)
        with pytest.raises(FormatError, match=message) as caught:
            ss.read(path)
    assert "drawing.dxf" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_picture_with_the_wrong_ending(tmp_path):
    Image.new("L", (8, 8)).save(tmp_path / "picture.png")
    (tmp_path / "picture.png").rename(tmp_path / "picture.dxf")
    with pytest.raises(FormatError, match=r"no DXF drawing, or damaged: File 'picture\.dxf' is"):
        ss.read(tmp_path / "picture.dxf")


@pytest.mark.slow
def test_bombs_of_blocks_are_refused_before_one_is_exploded(draw):
    def tenfold(space):
        blocks = space.doc.blocks
        blocks.new("B0").add_line((0, 0), (1, 0))
        for k in range(1, 12):
            block = blocks.new(f"B{k}")
            for index in range(10):
                block.add_blockref(f"B{k - 1}", (index, k))
        space.add_blockref("B11", (0, 0))

    def endless(space):
        for name, other in (("ONE", "OTHER"), ("OTHER", "ONE")):
            block = space.doc.blocks.new(name)
            block.add_line((0, 0), (1, 0))
            block.add_blockref(other, (1, 1))
        space.add_blockref("ONE", (0, 0))

    def array(space):
        space.doc.blocks.new("DOT").add_line((0, 0), (1, 0))
        many = {"column_count": 3000, "row_count": 3000, "row_spacing": 1, "column_spacing": 1}
        space.add_blockref("DOT", (0, 0), dxfattribs=many)

    def long(space):
        space.doc.blocks.new("LONG").add_lwpolyline([(k, k % 2) for k in range(2000)])
        for index in range(501):
            space.add_blockref("LONG", (index, 0))

    def deep(space):
        blocks = space.doc.blocks
        blocks.new("D0").add_line((0, 0), (1, 0))
        for k in range(1, 60):
            blocks.new(f"D{k}").add_blockref(f"D{k - 1}", (0, 0))
        space.add_blockref("D59", (0, 0))

    for bomb, message in (
        (tenfold, "make 211111111111 entities, more than 200000"),
        (endless, "the block 'one' holds itself"),
        (array, "make 18000000 entities"),
        (long, "make 1002000 vertices, more than 1000000"),
        (deep, "more than 50 deep"),
    ):
        with pytest.raises(FormatError, match=message):
            draw(bomb)


def test_splines_of_many_fit_points_are_refused(draw):
    with pytest.raises(FormatError, match="1001 fit points and no control points"):
        draw(lambda space: space.add_spline([(k, k % 2) for k in range(1001)]))


def test_coordinates_that_cannot_be(draw):
    with pytest.raises(ss.ShapesplineError, match="must not exceed"):
        draw(lambda s: s.add_line((0, 0), (1e80, 0)))


@pytest.mark.slow
@given(st.integers(0, len(WHOLE)), st.binary(max_size=6), st.booleans())
@settings(max_examples=60)
def test_any_damage_is_read_or_refused_in_a_sentence(tmp_path_factory, at, junk, cut):
    path = tmp_path_factory.mktemp("fuzz") / "drawing.dxf"
    path.write_bytes(WHOLE[:at] + junk + (b"" if cut else WHOLE[at + len(junk) :]) or b" ")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SkippedContentWarning)
        try:
            drawing = ss.read(path)
        except ss.ShapesplineError as error:
            message = str(error)
        else:
            message = "drawing.dxf"
            assert all(np.isfinite(fit.control_points).all() for fit in drawing)
    assert "drawing.dxf" in message
    assert len(message) < 1000

"""SVG drawings as exact curves: every command, shape, transform and unit; and nothing harmful."""

from __future__ import annotations

import math
import shutil
import subprocess
import warnings

import numpy as np
import pytest
import svgelements
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image
from tests.support.make_fit import blob, fit_of, nested, wave
from tests.support.round_trip import round_trip
from tests.support.svg_pages import HEAD, PAGE, path, points

import shapespline as ss
from shapespline.errors import FormatError, SkippedContentWarning
from shapespline.geometry.exact import exact_drawing
from shapespline.geometry.nearest import nearest
from shapespline.values.drawing import Drawing
from shapespline.values.view_box import ViewBox


def test_every_command_by_hand(drawn):
    found = drawn(path("M1 2L3 2h2v4H4C5 8 6 8 7 8s2 1 3 0Q11 9 12 8t2 0l1 1Z"))
    flipped = [np.array(p) * [1, -1] + [0, 30] for p in points(found)]
    expected = [
        [(1, 2), (3, 2)], [(3, 2), (5, 2)], [(5, 2), (5, 6)], [(5, 6), (4, 6)],
        [(4, 6), (5, 8), (6, 8), (7, 8)], [(7, 8), (8, 8), (9, 9), (10, 8)],
        [(10, 8), (11, 9), (12, 8)], [(12, 8), (13, 7), (14, 8)], [(14, 8), (15, 9)],
        [(15, 9), (1, 2)],
    ]  # fmt: skip
    assert [p.tolist() for p in flipped] == [[list(map(float, q)) for q in p] for p in expected]
    assert [piece.degree for piece in found.curves[0]] == [1, 1, 1, 1, 3, 3, 2, 2, 1, 1]
    assert found.frame == ViewBox(0, 0, 40, 30)
    assert found.unit == "px"


def test_sub_paths_and_what_follows_a_close(drawn):
    found = drawn(path("M0 0h4v4zM10 10h1zl5 5"))
    assert [len(pieces) for pieces in found.curves] == [3, 2, 1]
    assert points(found, 2) == [[[10.0, 20.0], [15.0, 15.0]]]


@pytest.mark.parametrize(
    ("style", "closed"),
    [
        ({}, True),
        ({"fill": "#fe0", "stroke": "black"}, True),
        ({"style": "fill:url(#gradient)"}, True),
        ({"fill": "none", "stroke": "black"}, False),
        ({"fill": "transparent", "stroke": "black"}, False),
        ({"fill": "#00000000", "stroke": "black"}, False),
        ({"fill-opacity": "0", "stroke": "black"}, False),
    ],
)
def test_what_is_filled_is_closed(drawn, style, closed):
    found = drawn(path("M1 1L9 1L9 9M20 2Q25 9 30 2M5 20L6 21", **style))
    assert [fit.closed for fit in exact_drawing(found)] == [closed, closed, False]
    area = 32 + 2 / 3 * 0.5 * 10 * 7  # a triangle, and two thirds of the one around a parabola
    assert exact_drawing(found).area == pytest.approx(area if closed else 0.0)
    polyline = " ".join(f'{name}="{value}"' for name, value in style.items())
    found = drawn(f'<polyline points="1,1 9,1 9,9" {polyline}/>')
    assert exact_drawing(found).fits[0].closed == closed


def test_open_curves_of_ours_stay_open(tmp_path):
    open_ones = Drawing([fit_of(wave(9, 3)), fit_of(wave(9, 1))], frame=ViewBox(-20, -20, 60, 60))
    again = round_trip(open_ones, tmp_path / "open.svg")
    assert not any(fit.closed for fit in again)


def arc_points(d, n=200):
    """Points of an arc by the library, and the control points that we read."""
    (shape,) = [e for e in svgelements.Path(d) if isinstance(e, svgelements.Arc)]
    return np.array([(shape.point(t).x, shape.point(t).y) for t in np.linspace(0, 1, n)])


@pytest.mark.slow
@pytest.mark.parametrize("rotation", [0, 30, 90, -77])
@pytest.mark.parametrize("flags", ["0 0", "0 1", "1 0", "1 1"])
def test_arcs_are_within_a_billionth(drawn, rotation, flags):
    d = f"M5 5A7 3 {rotation} {flags} 15 8"
    fit = exact_drawing(drawn(path(d, fill="none", stroke="red"))).fits[0]
    expected = arc_points(d) * [1, -1] + [0, 30]
    found = np.sqrt(nearest(fit.spline, expected).distances_sq)
    assert found.max() <= 1.2e-9 * 7  # 1.1e-9 of the longer half axis, and the library's rounding
    assert fit.spline([0.0])[0].tolist() == pytest.approx([5, 25], abs=1e-14)
    assert fit.spline([1.0])[0].tolist() == pytest.approx([15, 22], abs=1e-14)


def test_the_curve_of_a_circle_is_round_to_a_billionth(drawn):
    fit = exact_drawing(drawn('<circle cx="10" cy="10" r="5"/>')).fits[0]
    assert fit.closed
    radius = np.hypot(*(fit.spline(np.linspace(0, 1, 20_001)) - (10, 20)).T)
    assert np.abs(radius - 5).max() <= 1.1e-9 * 5


def test_shapes(drawn):
    found = drawn(
        '<rect x="1" y="2" width="3" height="4"/><line x1="1" y1="1" x2="2" y2="3" stroke="red"/>'
        '<polyline points="0,0 1,1 2,0" fill="none" stroke="red"/>'
        '<polygon points="5 5 6 6 7 5"/><ellipse rx="3" ry="1"/>'
        '<rect x="10" y="10" width="6" height="4" rx="1"/>'
    )
    drawing = exact_drawing(found)
    assert [fit.closed for fit in drawing] == [True, False, False, True, True, True]
    assert points(found, 0)[0] == [[1.0, 28.0], [4.0, 28.0]]
    straight = [sum(p.degree == 1 for p in pieces) for pieces in found.curves]
    assert straight == [4, 1, 2, 3, 0, 4]


def test_transforms_and_groups_against_a_matrix(drawn):
    m = svgelements.Matrix("translate(3,4) rotate(30) scale(2,0.5) skewX(20)")
    found = drawn(
        f'<g transform="translate(3,4)"><g transform="rotate(30)">'
        f"{path('M1 2C3 4 5 6 8 7', transform='scale(2,0.5) skewX(20)')}</g></g>"
    )
    expected = [m.point_in_matrix_space(p) for p in [(1, 2), (3, 4), (5, 6), (8, 7)]]
    assert np.abs(points(found)[0] - np.array([(p.x, 30 - p.y) for p in expected])).max() < 1e-13


def test_a_skewed_circle_is_an_ellipse(drawn):
    fit = exact_drawing(drawn('<circle r="5" transform="translate(20 15) skewX(40)"/>')).fits[0]
    x, y = (fit.spline(np.linspace(0, 1, 999)) - (20, 15)).T
    assert np.abs(np.hypot(x + math.tan(math.radians(40)) * y, y) - 5).max() <= 2e-9 * 5


def test_what_is_not_drawn_is_not_read(drawn):
    hidden = [
        path("M0 0h1v1z", fill="none"),
        path("M0 0h1v1z", style="fill:none;stroke:none"),
        path("M0 0h1v1z", display="none"),
        path("M0 0h1v1z", style="display:none"),
        path("M0 0h1v1z", visibility="hidden"),
        path("M0 0h1v1z", opacity="0"),
        f'<g style="opacity: 0.0">{path("M0 0h1v1z", opacity="1")}</g>',
        path("M0 0h1v1z", fill="#00000000"),
        path("M0 0h1v1z", fill="rgba(0,0,0,0)"),
        path("M0 0h1v1z", **{"fill-opacity": "0%"}),
        path("M0 0h1v1z", fill="none", stroke="black", **{"stroke-width": "0mm"}),
        path("M0 0h1v1z", fill="none", stroke="black", **{"stroke-opacity": "0"}),
        '<g display="none"><text>A</text></g>',
        path("M0 0h1v1z", **{"class": "gone"}),
        f"<defs>{path('M0 0h1v1z')}</defs>",
        f"<symbol>{path('M0 0h1v1z')}</symbol>",
        f"<clipPath>{path('M0 0h1v1z')}</clipPath>",
        f"<mask>{path('M0 0h1v1z')}</mask>",
        f"<marker>{path('M0 0h1v1z')}</marker>",
        f"<pattern>{path('M0 0h1v1z')}</pattern>",
        f'<g display="none"><g>{path("M0 0h1v1z")}</g></g>',
        '<rect width="0" height="3"/>',
        path("M3 3"),
    ]
    style = "<style>.gone {display: none}</style>"
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = drawn(style + "".join(hidden) + path("M5 5h1v1z"))
    assert len(found.curves) == 1
    with pytest.raises(FormatError, match="no visible path or shape"):
        drawn(style + "".join(hidden))


def test_what_cannot_be_read_is_said(drawn):
    body = (
        '<text x="1" y="2">A</text><image width="3" height="3"/><use href="other.svg#a"/>'
        f"{path('M0 0h1v1z', **{'clip-path': 'url(#c)'})}"
    )
    with pytest.warns(SkippedContentWarning) as caught:
        found = drawn(body)
    assert len(found.curves) == 1
    (message,) = [str(warning.message) for warning in caught]
    for words in ("text", "pictures", "references to what is not in the file", "clip paths"):
        assert words in message


def test_elements_used_again(drawn):
    found = drawn(
        '<defs><rect id="r" width="2" height="1"/><g id="g"><use href="#r" x="5"/></g>'
        f'<symbol id="s" viewBox="0 0 10 10">{path("M0 0h10v10z")}</symbol></defs>'
        '<use xlink:href="#r" x="1" y="2"/><use href="#g" transform="scale(2)"/>'
        '<use href="#s" x="20" y="10" width="5" height="5"/>'
    )
    corners = [points(found, index)[0][0] for index in range(3)]
    assert corners == [[1.0, 28.0], [10.0, 30.0], [20.0, 20.0]]
    assert points(found, 2)[0][1] == pytest.approx([25.0, 20.0])


def test_a_close_within_rounding_is_no_piece(drawn):
    found = drawn(path("M0.1 0.2l0.3 0.1l0.3 0.7l-0.6 -0.8z"))
    assert len(found.curves[0]) == 3
    assert exact_drawing(found).fits[0].closed


@pytest.mark.parametrize("degree", [1, 2, 3])
@pytest.mark.parametrize("unit", [None, "mm", "in", "px"])
def test_what_our_writer_wrote_comes_back(tmp_path, degree, unit):
    frame = ViewBox(-20, -20, 60, 60)
    fits = [fit_of(blob(11, degree)), fit_of(blob(7, degree, radius=4)), fit_of(wave(9, degree))]
    drawing = Drawing(fits, [-1, 0, -1], frame, unit)
    again = round_trip(drawing, tmp_path / "drawing.svg")
    assert again.frame == frame
    assert again.unit == (unit or "px")
    for before, after in zip(drawing, again, strict=True):
        mine, theirs = before.spline.beziers().points, after.spline.beziers().points
        if degree == 3:
            assert mine.shape == theirs.shape
            assert np.abs(mine - theirs).max() <= 1e-9 * before.contour.box_diagonal


def test_nesting_comes_back(tmp_path):
    drawing = Drawing(nested().fits, nested().parents, ViewBox(-20, -20, 60, 60))
    again = round_trip(drawing, tmp_path / "drawing.svg")
    assert again.parents == (-1, 0, 1, -1)


def test_an_outline_fitted_and_read_again_is_the_same(tmp_path, outline):
    fit = ss.fit_curve(outline("hand620_closed"), tolerance="0.1%")
    frame = ViewBox(*fit.contour.points.min(axis=0), *np.ptp(fit.contour.points, axis=0))
    round_trip(Drawing([fit], frame=frame), tmp_path / "hand.svg")


LAUGHS = "".join(f'<!ENTITY l{k} "{f"&l{k - 1};" * 10 if k else "lol"}">' for k in range(10))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (f"<!DOCTYPE svg [{LAUGHS}]><svg><text>&l9;</text></svg>", "declares the XML entity 'l0'"),
        ('<!DOCTYPE svg [<!ENTITY x SYSTEM "file:///etc/passwd">]><svg>&x;</svg>', "entity 'x'"),
        (f"{HEAD} {PAGE}>{path('M0 0h1v1z')}", "no SVG drawing, or cut off: .*line"),
        (f"{HEAD} {PAGE}>{path('M0 0h1v1z')}"[:-40], "no SVG drawing, or cut off"),
        ("<html><body/></html>", "its first element is <html>"),
        ("not a drawing", "no SVG drawing, or cut off"),
        (f"{HEAD} {PAGE}></svg>", "no visible path or shape"),
        (f'{HEAD} viewBox="0 0 x 1">{path("M0 0h1v1z")}</svg>', "viewBox must be four numbers"),
        (f'{HEAD} viewBox="0 0 1 1 1">{path("M0 0h1v1z")}</svg>', "viewBox must be four numbers"),
        (f'{HEAD} viewBox="0 0 0 1">{path("M0 0h1v1z")}</svg>', "viewBox must have an area"),
        (f'{HEAD}><g id="a"><use href="#a"/></g></svg>', "uses itself"),
        (f"{HEAD}>{'<g>' * 300}{'</g>' * 300}</svg>", "nested more than 200 deep"),
        (f"{HEAD}>{path('M0 0L1e70 1e70')}</svg>", "must not exceed"),
    ],
)
def test_harmful_and_broken_files_are_sentences(tmp_path, text, message):
    file = tmp_path / "drawing.svg"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(ss.ShapesplineError, match=message) as caught:
        ss.read(file)
    assert "drawing.svg" in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.slow
def test_a_bomb_of_uses_is_refused_at_once(tmp_path):
    groups = "".join(
        f'<g id="g{k}">{f"""<use href="#g{k - 1}"/>""" * 10 if k else path("M0 0h1v1z")}</g>'
        for k in range(12)
    )
    file = tmp_path / "bomb.svg"
    file.write_text(f"{HEAD}><defs>{groups}</defs><use href='#g11'/></svg>")
    with pytest.raises(FormatError, match="more than 200000 elements"):
        ss.read(file)


def test_paths_without_end_are_refused_before_they_are_parsed(tmp_path):
    long = path("M0 0" + "L1 2" * 1000).replace("<path", '<path id="p"')
    file = tmp_path / "long.svg"
    uses = '<use href="#p"/>' * 500
    file.write_text(f"{HEAD}><defs>{long}</defs>{uses}</svg>")
    with pytest.raises(FormatError, match="more than 1000000 numbers"):
        ss.read(file)


def test_a_picture_with_the_wrong_ending(tmp_path):
    Image.new("L", (8, 8)).save(tmp_path / "picture.png")
    (tmp_path / "picture.png").rename(tmp_path / "picture.svg")
    with pytest.raises(FormatError, match=r"picture\.svg: no SVG drawing, or cut off"):
        ss.read(tmp_path / "picture.svg")


NUMBER = st.one_of(
    st.integers(-99, 99).map(str),
    st.floats(-1e3, 1e3).map(str),
    st.sampled_from(["1e400", "-", "nan"]),
)
COMMANDS = st.lists(
    st.tuples(st.sampled_from("MmLlHhVvCcSsQqTtAaZz"), st.lists(NUMBER, max_size=8)), max_size=8
)


@given(COMMANDS)
@settings(max_examples=200)
@pytest.mark.slow
def test_any_path_is_read_or_refused_in_a_sentence(tmp_path_factory, commands):
    d = " ".join(f"{letter}{' '.join(numbers)}" for letter, numbers in commands)
    check(tmp_path_factory, f"{HEAD} {PAGE}>{path(d)}</svg>".encode())


@given(st.integers(0, 600), st.binary(max_size=6), st.booleans())
@settings(max_examples=200)
@pytest.mark.slow
def test_any_damage_is_read_or_refused_in_a_sentence(tmp_path_factory, at, junk, cut):
    whole = (
        f'{HEAD} {PAGE} width="40mm"><g transform="rotate(30)">'
        f'{path("M1 1A5 3 10 0 1 9 9q1 2 3 0z")}<rect x="1mm" width="3" height="5" rx="1"/></g>'
        '<use href="#a"/><circle id="a" r="3"/></svg>'
    ).encode()
    check(tmp_path_factory, whole[:at] + junk + (b"" if cut else whole[at + len(junk) :]))


def check(factory, data):
    file = factory.mktemp("fuzz") / "drawing.svg"
    file.write_bytes(data or b" ")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SkippedContentWarning)
        try:
            drawing = ss.read(file)
        except ss.ShapesplineError as error:
            message = str(error)
        else:
            message = "drawing.svg"
            assert all(np.isfinite(fit.control_points).all() for fit in drawing)
            assert all(fit.kept for fit in drawing)
    assert "drawing.svg" in message
    assert len(message) < 1000


@pytest.mark.skipif(shutil.which("rsvg-convert") is None, reason="rsvg-convert is not installed")
def test_a_renderer_sees_the_same_picture(tmp_path):
    body = (
        '<g transform="rotate(10 20 15) skewX(10)">'
        f"{path('M5 5A5 3 20 0 1 15 8q3 3 6 0t6 0C30 20 20 20 10 20z')}"
        '</g><rect x="33" y="2" width="5" height="4" rx="1"/><circle cx="34" cy="24" r="3"/>'
        '<polygon points="1,20 6,28 2,28"/>'
    )
    file, again = tmp_path / "drawing.svg", tmp_path / "again.svg"
    file.write_text(f'{HEAD} width="40" height="30" {PAGE}>{body}</svg>')
    ss.write(again, ss.read(file))
    pictures = []
    for source in (file, again):
        done = subprocess.run(
            ["rsvg-convert", "-w", "800", "--background-color", "white", str(source)],
            capture_output=True, check=True,
        )  # fmt: skip
        target = source.with_suffix(".png")
        target.write_bytes(done.stdout)
        pictures.append(np.asarray(Image.open(target).convert("L")).astype(int))
    # The renderer takes polygons for curves, within 0.1 pixel: so much of a rim pixel, twice.
    assert np.abs(pictures[0] - pictures[1]).max() <= 2 * 0.1 * 255
    assert (pictures[0] < 128).mean() > 0.1

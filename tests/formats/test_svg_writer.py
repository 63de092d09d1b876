"""SVG files as a reader that we did not write sees them, against the curves that went in."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
import svgelements
from tests.support.make_fit import blob, fit_of, nested, wave

import shapespline as ss
from shapespline.errors import FormatError, InvalidInputError
from shapespline.formats import cubics as beziers
from shapespline.formats import svg_writer as subject
from shapespline.values.contour import Contour
from shapespline.values.curve import BSplineCurve
from shapespline.values.drawing import Drawing
from shapespline.values.knots import clamped_knots
from shapespline.values.view_box import ViewBox

EPS = np.finfo(float).eps
FRAME = ViewBox(0.0, 0.0, 40.0, 30.0)


def root_of(data):
    return ElementTree.fromstring(data)


def view_box(data):
    return np.array([float(number) for number in root_of(data).get("viewBox").split()])


def sub_paths(data, tmp_path):
    """Segments of each sub-path, without the zero-length Close, as svgelements reads them."""
    file = tmp_path / "drawing.svg"
    file.write_bytes(data)
    paths = [e for e in svgelements.SVG.parse(file).elements() if isinstance(e, svgelements.Path)]
    found = []
    for path in paths:
        assert path.transform.is_identity()
        found.extend([list(part) for part in path.as_subpaths()])
    return found


def drawn(segments):
    """Segments that draw something."""
    return [s for s in segments if not isinstance(s, svgelements.Move) and s.start != s.end]


def sampled(segments, n=40):
    """Points along the drawn segments, n + 1 each, shape (s, n + 1, 2)."""
    t = np.linspace(0, 1, n + 1)
    return np.array([[(s.point(x).x, s.point(x).y) for x in t] for s in drawn(segments)])


def on_each_span(curve, n=40):
    """The curve at the same parameters, shape (spans, n + 1, 2)."""
    t = np.linspace(0, 1, n + 1)
    u = curve.breakpoints[:-1, None] + np.diff(curve.breakpoints)[:, None] * t
    # The end of a span, not the start of the next: equal anyway for a continuous curve.
    return curve(u.ravel()).reshape(len(u), n + 1, 2)


def cubics_of(segments):
    """Control points of cubics, shape (s, 4, 2)."""
    names = ("start", "control1", "control2", "end")
    points = [[getattr(s, name) for name in names] for s in drawn(segments)]
    return np.array([[(p.x, p.y) for p in cubic] for cubic in points])


def evaluated(cubics, t):
    """Points of cubics by the Bernstein polynomials, shape (s, k, 2)."""
    t = np.asarray(t)[:, None]
    weights = np.hstack([(1 - t) ** 3, 3 * (1 - t) ** 2 * t, 3 * (1 - t) * t**2, t**3])
    return np.einsum("kj,sjd->skd", weights, cubics)


def upright(points):
    """Points of a file with ``FRAME`` back in data coordinates."""
    return np.stack([points[..., 0], FRAME.height - points[..., 1]], axis=-1)


def distance_to(polyline, points):
    """Distance of points to a fine polyline, from the two segments at the nearest vertex."""
    from scipy.spatial import cKDTree

    nearest = cKDTree(polyline).query(points)[1]
    found = np.full(len(points), np.inf)
    for first in (nearest - 1, nearest):
        begin = polyline[np.clip(first, 0, len(polyline) - 2)]
        chord = polyline[np.clip(first, 0, len(polyline) - 2) + 1] - begin
        share = np.sum((points - begin) * chord, axis=1) / np.sum(chord**2, axis=1)
        foot = begin + np.clip(share, 0, 1)[:, None] * chord
        found = np.minimum(found, np.hypot(*(points - foot).T))
    return found


@pytest.mark.parametrize("degree", [1, 2, 3])
@pytest.mark.parametrize("make", [blob, wave])
def test_geometry_is_exact(tmp_path, make, degree):
    curve = make(11, degree)
    data = subject.encode(Drawing([fit_of(curve)], frame=FRAME))
    (segments,) = sub_paths(data, tmp_path)
    # Both evaluate a cubic of coordinates up to 40: a few dozen roundings of that size.
    np.testing.assert_allclose(
        upright(sampled(segments)), on_each_span(curve), rtol=0, atol=100 * EPS * 40
    )


def test_lines_are_lines(tmp_path):
    polygon = BSplineCurve(clamped_knots(5, 1), [(0, 0), (3, 1), (5, 0), (2, 7), (0, 0)], 1)
    data = subject.encode(Drawing([fit_of(polygon)], frame=FRAME))
    assert 'd="M0 30L3 29L5 30L2 23Z"' in data.decode()
    straight = BSplineCurve(clamped_knots(4, 3), [(0, 0), (1, 1), (2, 2), (3, 3)], 3)
    assert 'd="M0 30L3 27"' in subject.encode(Drawing([fit_of(straight)], frame=FRAME)).decode()


def test_a_cubic_that_overshoots_its_chord_is_no_line():
    beyond = BSplineCurve(clamped_knots(4, 3), [(0, 0), (-5, 0), (2, 0), (3, 0)], 3)
    assert "C-5 30 2 30 3 30" in subject.encode(Drawing([fit_of(beyond)], frame=FRAME)).decode()


def test_a_cubic_slightly_bent_is_no_line():
    bent = BSplineCurve(clamped_knots(4, 3), [(0, 0), (1, 1e-12), (2, 0), (3, 0)], 3)
    assert "C" in subject.encode(Drawing([fit_of(bent)], frame=FRAME)).decode().split(' d="')[1]


@pytest.mark.parametrize("degree", range(4, 10))
@pytest.mark.parametrize("make", [blob, wave])
@pytest.mark.slow
def test_high_degrees_keep_the_bound(tmp_path, make, degree):
    """Sampled from both sides: each is within the bound of the other."""
    curve = make(12, degree)
    fit = fit_of(curve)
    (segments,) = sub_paths(subject.encode(Drawing([fit], frame=FRAME)), tmp_path)
    u = np.linspace(*curve.domain, 60_001)
    parts = evaluated(cubics_of(segments), np.linspace(0, 1, 401)[:-1])
    ends = cubics_of(segments)[-1:, 3]
    original, cubics = curve(u), upright(np.concatenate([parts.reshape(-1, 2), ends]))
    bound = beziers.CUBIC_TOLERANCE * fit.contour.box_diagonal
    # A chord of length c leaves an arc of curvature k by k c^2 / 8.
    step = max(np.hypot(*np.diff(line, axis=0).T).max() for line in (original, cubics))
    sagitta = np.abs(curve.curvature(u)).max() * step**2 / 8
    assert sagitta < 0.5 * bound
    assert 0.0 < distance_to(original, cubics).max() <= bound + 2 * sagitta
    assert distance_to(cubics, original).max() <= bound + 2 * sagitta
    assert len(drawn(segments)) < 64 * len(curve.breakpoints)


@pytest.mark.parametrize("degree", range(4, 10))
def test_high_degrees_at_equal_parameters(degree):
    """The rigorous statement itself: every cubic against the part of the piece it stands for."""
    piece = np.random.default_rng(degree).uniform(-1, 1, (degree + 1, 2))
    cubics = list(beziers._cubics(piece, 1e-6))
    knots = [np.repeat([0.0, 1.0], k + 1) for k in (degree, 3)]
    whole = BSplineCurve(knots[0], piece, degree)
    t = np.linspace(0, 1, 101)
    begin = 0.0
    for cubic in cubics:
        # Where a part ends is told by its end point: halving makes dyadic parameters.
        width = next(
            w for w in 0.5 ** np.arange(12) if np.hypot(*(whole([begin + w])[0] - cubic[3])) < 1e-13
        )
        difference = BSplineCurve(knots[1], cubic, 3)(t) - whole(begin + width * t)
        assert np.hypot(*difference.T).max() <= 1e-6
        begin += width
    assert begin == 1.0
    assert len(cubics) > 1


@pytest.mark.parametrize("curve", [blob(11, 3), wave(11, 3)], ids=["periodic", "clamped"])
def test_second_derivatives_agree_at_joints(tmp_path, curve):
    data = subject.encode(Drawing([fit_of(curve)], frame=FRAME))
    (segments,) = sub_paths(data, tmp_path)
    cubics = cubics_of(segments)
    h = np.diff(curve.breakpoints)
    before = 6 * (cubics[:, 1] - 2 * cubics[:, 2] + cubics[:, 3]) / h[:, None] ** 2
    after = 6 * (cubics[:, 0] - 2 * cubics[:, 1] + cubics[:, 2]) / h[:, None] ** 2
    joints = slice(None) if curve.periodic else slice(1, None)
    # A second difference adds four coordinates below 40, each with a rounding from the flip
    # and a few from knot insertion: say 8 half-units in the last place of 40 in all.
    bound = 6 * 4 * 8 * (EPS / 2) * 40 / h.min() ** 2
    jump = np.abs(np.roll(before, 1, axis=0) - after)[joints]
    assert jump.max() <= bound
    assert np.abs(after).max() > 1e8 * bound  # six digits would not pass


def test_y_is_turned_over_once():
    """An L: its foot is at the bottom, which is large y in the file."""
    points = [(1, 1), (5, 1), (5, 2), (2, 2), (2, 9), (1, 9), (1, 1)]
    fit = fit_of(BSplineCurve(clamped_knots(7, 1), points, 1))
    data = subject.encode(Drawing([fit], frame=ViewBox(0, 0, 6, 10)))
    assert view_box(data).tolist() == [0, 0, 6, 10]
    assert 'd="M1 9L5 9L5 8L2 8L2 1L1 1Z"' in data.decode()


def test_a_frame_off_the_origin_keeps_its_place():
    fit = fit_of(BSplineCurve(clamped_knots(2, 1), [(10, 20), (14, 26)], 1))
    data = subject.encode(Drawing([fit], frame=ViewBox(10, 20, 4, 8)))
    assert view_box(data).tolist() == [10, 20, 4, 8]
    assert 'd="M10 28L14 22"' in data.decode()


def test_without_a_frame_the_box_holds_the_strokes(tmp_path):
    curve = wave(8, 3)
    data = subject.encode(Drawing([fit_of(curve)]), stroke_width=1.5)
    x, y, width, height = view_box(data)
    (segments,) = sub_paths(data, tmp_path)
    points = sampled(segments, 400).reshape(-1, 2)  # svgelements counts from the view box
    low, high = points.min(axis=0), points.max(axis=0)
    margins = np.concatenate([low, (width, height) - high])
    # 2 % of the longer side (20 for the wave) and the stroke; sampling may miss an extreme.
    assert margins.min() >= 0.4 + 1.5 - 1e-9
    assert margins.max() <= 0.4 + 1.5 + 1e-3
    begin = (x + points[0, 0], y + height - points[0, 1])  # y runs down within the view box
    np.testing.assert_allclose(begin, curve.control_points[0], rtol=0, atol=1e-9)


def test_far_from_the_origin_the_file_is_near_it():
    curve = wave(8, 3)
    far = BSplineCurve(curve.knots, curve.control_points + np.array([5e6, 6e6]), 3)
    data = subject.encode(Drawing([fit_of(far)])).decode()
    numbers = re.findall(r"-?\d[\d.e-]*", data.split(' d="')[1])
    assert max(abs(float(number)) for number in numbers) < 25
    # As far as the corner of the view box to the last digit: both cancel in any precision.
    begin = data.split('viewBox="')[1].split()[:2]
    assert f'<g transform="translate({" ".join(begin)})">' in data


@pytest.mark.parametrize("place", [(3.0, -4.0), (5e5, 5e6), (-1e-3, 2e9)])
@pytest.mark.parametrize("unit", [None, "mm", "in", "m"])
def test_places_come_back(tmp_path, place, unit):
    """Those of drawings without a frame, too."""
    curve = wave(8, 3)
    moved = BSplineCurve(curve.knots, curve.control_points + np.array(place), 3)
    before = Drawing([fit_of(moved)], unit=unit)
    ss.write(tmp_path / "placed.svg", before)
    after = ss.read(tmp_path / "placed.svg", unit=unit)
    # Each of four sums and of four scalings rounds a coordinate once.
    bound = 8 * EPS * np.abs(moved.control_points).max()
    for mine, theirs in zip(before.bounds, after.bounds, strict=True):
        assert abs(mine - theirs) <= bound


def test_extremes_of_cubics_against_dense_samples():
    cubics = np.random.default_rng(3).uniform(-1, 1, (50, 4, 2))
    cubics[0] = [(0, 0), (1, 1), (2, 2), (3, 3)]  # derivative without roots
    cubics[1] = [(0, 0), (0, 1), (1, 1), (1, 0)]  # quadratic term vanishes in y
    for cubic in cubics:
        (dense,) = evaluated(cubic[None], np.linspace(0, 1, 5001))
        found = beziers.turning_points(cubic[None])
        # Next to an extreme a sample is at most |p''| dt^2 / 8 <= 6 * 4 * 4e-8 / 8 away.
        np.testing.assert_allclose(found.max(axis=0), dense.max(axis=0), rtol=0, atol=1.3e-7)
        np.testing.assert_allclose(found.min(axis=0), dense.min(axis=0), rtol=0, atol=1.3e-7)


def test_flat_drawings_have_an_area():
    flat = fit_of(BSplineCurve(clamped_knots(2, 1), [(0, 5), (8, 5)], 1), noise=0.0)
    assert view_box(subject.encode(Drawing([flat])))[3] > 0


def test_outline_and_holes_are_one_path(tmp_path):
    data = subject.encode(nested())
    paths = root_of(data).findall("{http://www.w3.org/2000/svg}path")
    assert [path.get("d").count("M") for path in paths] == [2, 1, 1]
    assert [path.get("d").count("Z") for path in paths] == [2, 1, 0]
    assert [path.get("fill") for path in paths] == ["black", "black", "none"]
    assert {path.get("fill-rule") for path in paths[:2]} == {"evenodd"}
    assert paths[0].get("stroke") is None
    assert float(paths[2].get("stroke-width")) > 0
    assert len(sub_paths(data, tmp_path)) == 4


def test_children_before_their_parents():
    drawing = nested()
    backwards = Drawing(drawing.fits[::-1], parents=[-1, 2, 3, -1])
    paths = root_of(subject.encode(backwards)).findall("{http://www.w3.org/2000/svg}path")
    assert sorted(path.get("d").count("M") for path in paths) == [1, 1, 2]


def test_unfilled():
    data = subject.encode(nested(), fill=False, stroke_width=0.25)
    paths = root_of(data).findall("{http://www.w3.org/2000/svg}path")
    assert {path.get("fill") for path in paths} == {"none"}
    assert {path.get("stroke-width") for path in paths} == {"0.25"}


def test_a_closed_path_ends_where_it_began(tmp_path):
    for degree in (1, 3, 5):
        (segments,) = sub_paths(subject.encode(Drawing([fit_of(blob(9, degree))])), tmp_path)
        assert isinstance(segments[-1], svgelements.Close)
        if degree > 1:  # the last cubic ends on the first point exactly, and Close draws nothing
            assert segments[-1].start == segments[-1].end


@pytest.mark.parametrize(
    ("unit", "width", "height"),
    [
        (None, None, None),  # no size: viewers fit it into their window
        ("px", "40px", "30px"),
        ("mm", "40mm", "30mm"),
        ("m", "40000mm", "30000mm"),
    ],
)
def test_the_unit_sizes_the_page(unit, width, height):
    root = root_of(subject.encode(Drawing([fit_of(wave())], frame=FRAME, unit=unit)))
    assert (root.get("width"), root.get("height")) == (width, height)
    assert root.get("viewBox") == "0 0 40 30"


def test_same_drawing_same_bytes():
    assert subject.encode(nested()) == subject.encode(nested())


def test_numbers_read_back_to_the_same_double():
    for value in [0.1 + 0.2, 1e-300, 123456789.123, 5e-324, 1e22, -1 / 3]:
        assert float(subject._number(value)) == value
    assert subject._number(-0.0) == "0"
    assert subject._number(np.float64(3.0)) == "3"


@pytest.mark.parametrize("width", [0.0, -1.0, float("nan"), "thin"])
def test_a_stroke_width_out_of_range(width):
    with pytest.raises(InvalidInputError, match="stroke_width must be a positive number, got"):
        subject.encode(nested(), stroke_width=width)


def test_frames_and_nestings_that_make_no_sense():
    fit = fit_of(wave())
    with pytest.raises(FormatError, match="frame must be finite and have an area"):
        subject.encode(Drawing([fit], frame=ViewBox(0, 0, 5, 0)))


def test_a_curve_far_smaller_than_its_coordinates_ends():
    """Halving must stop where rounding is coarser than the tolerance."""
    curve = wave(8, 5)
    far = BSplineCurve(curve.knots, curve.control_points * 1e-12 + 1.0, 5)
    contour = Contour(far(np.linspace(0, 1, 9)))
    assert len(subject.encode(Drawing([fit_of(far, contour=contour)]))) < 20_000

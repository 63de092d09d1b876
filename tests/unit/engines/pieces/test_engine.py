"""The structured fit: the promise by dense samples, counts, exact export, canonical order."""

import warnings

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.support.engines import fit_pieces
from tests.support.promise import ROUNDING, SMOOTH, assert_turns_with_the_data
from tests.support.shapes import flower, moved, on_circle, rectangle, wave
from tests.support.sizes import most_points

from checks import distance_to_polyline, gaps, polyline_of, turns, two_sided
from shapespline.errors import InvalidInputError
from shapespline.values.contour import Contour

PEERS = ("hand620_closed", "leaf840_closed", "plane1100_closed", "loop500_open")


def check_promise(result, contour):
    """Both distances by dense samples; the pieces end to end."""
    step = result.tolerance / 10
    found = two_sided(result.pieces, contour.points, closed=contour.closed, step=step)
    assert result.kept
    assert found.larger <= result.tolerance + ROUNDING * contour.box_diagonal
    assert not gaps(result.pieces, closed=result.closed).any()


def check_export(result):
    """The one B-spline runs through the same points, piece by piece."""
    whole, step = result.spline, result.tolerance / 10
    one, many = polyline_of(whole, step), polyline_of(result.pieces, step)
    # Points of either lie on the other: near its chords, which its bends leave by less than a step.
    assert max(distance_to_polyline(one, many).max(), distance_to_polyline(many, one).max()) <= step
    assert whole.domain == (0.0, 1.0)


@pytest.mark.parametrize("name", PEERS)
@pytest.mark.parametrize("corners", ["auto", "free"])
@pytest.mark.slow
def test_peers_keep_the_promise_with_few_points(outline, name, corners):
    given, rng = outline(name), np.random.default_rng(1)
    for percent in (0.1, 0.5):
        tolerance, sizes = percent / 100 * given.box_diagonal, []
        # One outline is one draw (PKG-01): bounds are held by it, or in the mean of three.
        for shake in (0.0, 0.02, 0.02):
            moved = given.points + rng.normal(0, shake * tolerance, given.points.shape)
            contour = Contour(moved, given.closed)
            result = fit_pieces(contour, tolerance, corners=corners)
            check_promise(result, contour)
            check_export(result)
            sizes.append(result.n_stored_points)
        most = most_points(name, percent, "pieces alone", corners)
        assert min(sizes[0], np.mean(sizes)) <= most


@pytest.mark.parametrize("name", ["hand620_closed", "leaf840_closed", "loop500_open"])
def test_joints_that_are_no_corners_are_tangent(outline, name):
    contour = outline(name)
    result = fit_pieces(contour, 0.001 * contour.box_diagonal)
    assert_turns_with_the_data(result.pieces, contour, result.tolerance)


def test_a_line_stays_one_line():
    x = np.linspace(0, 10, 50)
    result = fit_pieces(Contour(np.column_stack([x, 0.5 * x]), closed=False), 0.01)
    assert [piece.kind for piece in result.pieces] == ["line"]
    assert result.n_stored_points == 2


def test_a_rectangle_is_four_lines_through_its_corners():
    contour = rectangle(60, 40)
    result = fit_pieces(contour, 0.1)
    assert [piece.kind for piece in result.pieces] == ["line"] * 4
    corners = contour.points[[0, 60, 100, 160]]
    for piece in result.pieces:
        assert np.hypot(*(corners - piece.control_points[0]).T).min() <= 0.1


def test_a_stadium_keeps_its_sides_straight_and_its_joints_smooth():
    angle = np.linspace(-np.pi / 2, np.pi / 2, 60)
    right = np.column_stack([20 + 5 * np.cos(angle), 5 * np.sin(angle)])
    x = np.linspace(0, 20, 81)[1:-1]
    bottom = np.column_stack([x, 0 * x - 5])
    contour = Contour(np.concatenate([bottom, right, -bottom + (20, 0), -right + (20, 0)]), True)
    result = fit_pieces(contour, 0.02)
    check_promise(result, contour)
    assert len(result.corners) == 0
    assert np.abs(turns(result.pieces, closed=True)).max() < SMOOTH


@pytest.mark.parametrize("degree", range(1, 10))
def test_every_degree_keeps_the_promise(degree):
    contour = wave(120)
    result = fit_pieces(contour, 0.05, degree=degree)
    check_promise(result, contour)
    check_export(result)
    assert result.spline.degree == degree
    assert max(piece.degree for piece in result.pieces) <= min(degree, 3)


def test_corners_that_are_named_are_nodes_and_make_none():
    contour, named = rectangle(60, 40), [0, 60, 100, 160]
    result = fit_pieces(contour, 0.05, corners=named)
    check_promise(result, contour)
    nodes = np.array([piece.control_points[0] for piece in result.pieces])
    for corner in contour.points[named]:
        assert np.hypot(*(nodes - corner).T).min() <= 0.05
    # Named where the outline is smooth, or none at all: nothing turns.
    for corners in ([0, 120], None):
        smooth = fit_pieces(flower(), 0.05, corners=corners)
        check_promise(smooth, flower())
        assert np.abs(turns(smooth.pieces, closed=True)).max() < SMOOTH


@pytest.mark.slow
@pytest.mark.parametrize("effort", ["fast", "balanced", "smallest"])
def test_every_effort_keeps_the_promise(effort):
    contour = flower()
    check_promise(fit_pieces(contour, 0.05, effort=effort), contour)


def test_smallest_is_no_larger_than_balanced(outline):
    contour = outline("loop500_open")
    tolerance = 0.001 * contour.box_diagonal
    smallest, balanced = (
        fit_pieces(contour, tolerance, effort=effort).n_stored_points
        for effort in ("smallest", "balanced")
    )
    assert smallest <= balanced


@pytest.mark.parametrize("shift", [1, 57])
def test_the_first_point_of_a_closed_outline_does_not_matter(outline, shift):
    contour = outline("plane1100_closed")
    other = Contour(np.roll(contour.points, shift, axis=0), closed=True)
    a, b = (fit_pieces(c, 0.001 * contour.box_diagonal) for c in (contour, other))
    assert a.spline.control_points.tolist() == b.spline.control_points.tolist()
    assert a.spline.knots.tolist() == b.spline.knots.tolist()


@pytest.mark.parametrize("name", ["plane1100_closed", "loop500_open"])
def test_the_direction_of_the_outline_does_not_matter(outline, name):
    contour = outline(name)
    other = Contour(contour.points[::-1], contour.closed)
    a, b = (fit_pieces(c, 0.001 * contour.box_diagonal) for c in (contour, other))
    assert len(a.pieces) == len(b.pieces)
    for piece, mirrored in zip(a.pieces, reversed(b.pieces), strict=True):
        assert piece.control_points.tolist() == mirrored.control_points[::-1].tolist()


def test_repetition_gives_the_same_bits():
    a, b = (fit_pieces(flower(), 0.05) for _ in range(2))
    assert a.spline.control_points.tobytes() == b.spline.control_points.tobytes()
    assert a.spline.knots.tobytes() == b.spline.knots.tobytes()


@pytest.mark.slow
@pytest.mark.parametrize("scale", [1e-9, 1e9])
@pytest.mark.parametrize("shift", [0.0, 1e3])
def test_scale_and_place_do_not_break_the_promise(scale, shift):
    points = moved(flower().points, 0.2, scale, (shift * scale, -shift * scale))
    contour = Contour(points, closed=True)
    result = fit_pieces(contour, 0.05 * scale)
    check_promise(result, contour)
    assert result.n_stored_points <= 1.1 * fit_pieces(flower(), 0.05).n_stored_points


def spiky():
    """A circle with a spike that runs out and back on itself."""
    points = on_circle(100, 10.0)
    out = np.column_stack([np.linspace(10.5, 20, 20), np.zeros(20)])
    return np.concatenate([out, out[-2::-1], points[1:]])


@pytest.mark.parametrize(
    "points",
    [
        on_circle(3), on_circle(5), on_circle(12), spiky(),
        np.column_stack([np.geomspace(1, 1e3, 60), np.sqrt(np.geomspace(1, 1e3, 60))]),
        np.column_stack([np.linspace(0, 1, 40), np.zeros(40)]),
        np.column_stack([np.sin(2 * on_circle(300)[:, 0]), on_circle(300)[:, 1]]),
    ],
)  # fmt: skip
@pytest.mark.parametrize("part", [0.2, 0.01, 1e-4])
@pytest.mark.parametrize("corners", ["auto", "free", None])
@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::shapespline.SparsePointsWarning")
def test_awkward_outlines_keep_the_promise(points, part, corners):
    for closed in (True, False):
        contour = Contour(points, closed=closed)
        check_promise(fit_pieces(contour, part * contour.box_diagonal, corners=corners), contour)


@given(
    st.lists(st.tuples(st.integers(-20, 20), st.integers(-20, 20)), min_size=5, max_size=40),
    st.booleans(),
    st.sampled_from(["auto", "free", None]),
)
@pytest.mark.slow
def test_any_polyline_keeps_the_promise(points, closed, corners):
    if len(set(points)) < 3:
        return
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        contour = Contour(points, closed=closed)
    check_promise(fit_pieces(contour, 0.3, corners=corners), contour)


@pytest.mark.slow
@pytest.mark.parametrize("folder", ["airfoils", "glyphs", "icons", "silhouettes", "strokes"])
def test_the_corpus_keeps_the_promise(more_outlines, folder):
    for name, contour in more_outlines(folder, 12):
        for corners in ("auto", "free"):
            result = fit_pieces(contour, 0.005 * contour.box_diagonal, corners=corners)
            assert result.kept, (name, corners)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"tolerance": 0.0}, "tolerance must be a positive length"),
        ({"tolerance": np.nan}, "tolerance must be a positive length"),
        ({"effort": "quick"}, "effort must be one of fast, balanced, smallest"),
        ({"corners": "none"}, "corners must be 'auto', 'free', None or indices"),
        ({"corners": [900]}, "corners must be indices below"),
        ({"corners": [0.5]}, "corners must be 'auto', 'free', None or indices"),
        ({"degree": 10}, "degree must be an integer from 1 to 9"),
    ],
)
def test_bad_arguments_say_what_is_wrong(arguments, message):
    with pytest.raises(InvalidInputError, match=message):
        fit_pieces(flower(), **{"tolerance": 0.05, **arguments})

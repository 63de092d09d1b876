"""Fits as they were drawn, through the public functions."""

import numpy as np
import pytest
from benchmarks.drawn.tables import measured, rendered
from benchmarks.drawn.truth import sampled
from benchmarks.small_letters import drawn
from tests.support.promise import checked
from tests.support.rendering import coverage, dark, polygon
from tests.support.shapes import moved

import shapespline as ss
from shapespline.engines.drawn import as_drawn


def rounded_box():
    """100 by 60, corners of radius 12: about a point a unit."""
    parts = []
    for corner, (x, y) in enumerate([(38, -18), (38, 18), (-38, 18), (-38, -18)]):
        a = np.radians(-90 + 90 * corner + 90 * np.arange(18) / 18)
        parts.append(np.column_stack([x + 12 * np.cos(a), y + 12 * np.sin(a)]))
        along = np.arange(0, 36 if corner % 2 == 0 else 76)[:, None]
        parts.append(
            [x + 12 * np.cos(a[-1] + np.pi / 36), y + 12 * np.sin(a[-1] + np.pi / 36)]
            + along * [(0, 1), (-1, 0), (0, -1), (1, 0)][corner]
        )
    return np.concatenate(parts)


def arc(x, y, radius, begin, end, n=40):
    """Points on an arc, angles in degrees."""
    angle = np.radians(np.linspace(begin, end, n))
    return np.column_stack([x + radius * np.cos(angle), y + radius * np.sin(angle)])


OPEN_PATHS = {
    "J": [np.linspace((0, 20), (0, 0), 40), arc(5, 0, 5, 180, 360)],
    "two arcs": [arc(0, 5, 5, 0, 90), arc(-7, 10, 7, 0, 100)],
    "pie": [arc(0, 0, 10, 0, 270, 150), np.linspace((0, -10), (0, 0), 20)],
    "two edges": [np.linspace((0, 0), (5, 3), 60), np.linspace((5, 3), (9, -4), 60)],
}


@pytest.mark.parametrize("options", [{"tolerance": 0.03}, {}], ids=["within", "estimated"])
@pytest.mark.parametrize("noise", [0.0, 0.005])
@pytest.mark.parametrize("name", OPEN_PATHS)
def test_a_few_lines_and_arcs_need_no_regularities(name, noise, options):
    parts = OPEN_PATHS[name]
    points = moved(np.concatenate([parts[0], parts[1][1:]]), 0.3)
    shaken = points + np.random.default_rng(5).normal(0, noise, points.shape)
    fit = ss.fit_curve(shaken, closed=False, **options)
    assert fit.kept
    kinds = {"J": ["arc", "line"], "two arcs": ["arc", "arc"], "pie": ["arc", "line"]}
    assert sorted(piece.kind for piece in fit.pieces) == kinds.get(name, ["line", "line"])
    # The ends are those of the data but for the noise.
    ends = fit.curve([0.0, 1.0]) - points[[0, -1]]
    assert np.abs(ends).max() <= 4 * noise + 1e-9


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("name", ["J", "two arcs", "pie"])
def test_fixed_ends_are_those_of_the_data_to_the_bit(name, seed):
    parts = OPEN_PATHS[name]
    points = np.concatenate([parts[0], parts[1][1:]]) + 10.0 * seed
    shaken = points + np.random.default_rng(seed).normal(0, 0.008, points.shape)
    fit = ss.fit_curve(shaken, closed=False, ends="fixed", tolerance=0.05)
    assert fit.kept
    assert fit.method == "drawn"
    ends = [fit.pieces[0].control_points[0], fit.pieces[-1].control_points[-1]]
    assert np.array_equal(ends, shaken[[0, -1]])
    for one in fit.regularities:
        if one.name == "axis-parallel":
            begin, end = fit.pieces[one.pieces[0]].control_points
            assert (begin == end).any()
    for before, after in zip(fit.pieces[:-1], fit.pieces[1:], strict=True):
        assert np.array_equal(before.control_points[-1], after.control_points[0])


def test_a_free_form_run_keeps_fixed_ends_too():
    t = np.linspace(0, 1, 80)
    wave = np.column_stack([10 * t, np.sin(6 * t) * (1 + t)])
    box = np.array([(10, -5), (30, -5), (30, 15), (0, 15), (0, 25), (20, 25)], dtype=float)
    edges = [np.linspace(a, b, 60)[1:] for a, b in zip([wave[-1], *box[:-1]], box, strict=True)]
    points = np.concatenate([wave, *edges])
    for data in (points, points[::-1]):
        fit = ss.fit_curve(data, closed=False, ends="fixed", tolerance=0.1)
        assert fit.method == "drawn"
        assert {"spline", "bezier"} & {piece.kind for piece in fit.pieces}
        ends = [fit.pieces[0].control_points[0], fit.pieces[-1].control_points[-1]]
        assert np.array_equal(ends, data[[0, -1]])


def test_a_smooth_outline_is_no_row_of_arcs():
    t = np.linspace(0, 2 * np.pi, 300, endpoint=False)
    for ratio in (0.4, 0.8):
        ellipse = moved(np.column_stack([10 * np.cos(t), 10 * ratio * np.sin(t)]), 0.3)
        for options in ({"tolerance": 0.05}, {"tolerance": 0.4}, {}):
            assert not any(piece.arc for piece in ss.fit_curve(ellipse, **options).pieces)


def test_the_promise_holds_and_edges_are_level_to_the_bit():
    shaken = rounded_box() + np.random.default_rng(3).normal(0, 0.03, (len(rounded_box()), 2))
    fit = checked(ss.fit_curve(shaken, closed=True, tolerance=0.4, character="drawn"), 0.4)
    assert sorted(piece.kind for piece in fit.pieces) == 4 * ["arc"] + 4 * ["line"]
    assert fit.n_stored_points == 12
    for piece in fit.pieces:
        if piece.kind == "line":
            assert (piece.control_points[0] == piece.control_points[1]).any()
    told = {one.name for one in fit.regularities}
    assert {"axis-parallel", "tangent", "equal-radius"} <= told
    assert all(0 <= k < 8 for one in fit.regularities for k in one.pieces)
    radii = [piece.arc.radius for piece in fit.pieces if piece.arc]
    assert max(radii) - min(radii) < 1e-9 * 12
    # Looser, no edge is less straight: structure comes from the noise, not from the tolerance.
    loose = ss.fit_curve(shaken, closed=True, tolerance=3.0, character="drawn")
    assert [piece.kind for piece in loose.pieces] == [piece.kind for piece in fit.pieces]
    plain = ss.fit_curve(shaken, closed=True, tolerance=0.4, character="drawn", regularities=None)
    assert plain.kept
    assert plain.regularities == ()


def slot(n):
    """About n points of a slot 56 by 16."""
    t = np.arange(n // 4) / (n // 4)
    half = np.pi * (t - 0.5)
    right = np.column_stack([20 + 8 * np.cos(half), 8 * np.sin(half)])
    edge = np.column_stack([20 - 40 * t, 0 * t + 8])
    return np.concatenate([-edge, right, edge, -right])


def test_many_points_and_noisy_ones_tell_the_same():
    for n, noise in ((24_000, 0.0), (1_000, 0.05)):
        points = slot(n) + np.random.default_rng(1).normal(0, 1, (n, 2)) * noise
        fit = ss.fit_curve(points, closed=True, tolerance=0.3, character="drawn")
        assert sorted(piece.kind for piece in fit.pieces) == ["arc", "arc", "line", "line"]
        # A radius is known to sigma * sqrt(8 / n) about, which is a hundredth at most.
        assert all(abs(piece.arc.radius - 8) < 0.03 for piece in fit.pieces if piece.arc)
        assert fit.kept


@pytest.mark.parametrize("seed", [3, 9, 17])
def test_noisy_points_of_a_slot_tell_it_though_a_curve_follows_them_as_well(seed):
    # Ten equations leave five of fourteen numbers: a spline of twelve points must be far nearer.
    points = slot(200) + np.random.default_rng(seed).normal(0, 0.3, (200, 2))
    fit = ss.fit_curve(points, closed=True)
    assert sorted(piece.kind for piece in fit.pieces) == ["arc", "arc", "line", "line"]
    # Fifty points of half a circle tell its radius to about 0.3 / sqrt(50): four of these.
    assert all(abs(piece.arc.radius - 8) < 0.17 for piece in fit.pieces if piece.arc)


@pytest.mark.parametrize("word", ["gear", "No. 42"])
def test_corners_between_an_edge_and_a_curve_stay_with_the_edge(word):
    figures = measured(word, 256, 0.35, "drawn")
    assert max(figures.corners) <= 0.5
    assert not any(figures.chamfered)


@pytest.mark.parametrize("word", ["jäger", "Plate 7"])
def test_acute_notches_between_short_edges_are_no_hooks(word):
    figures = measured(word, 256, 0.35, "drawn")
    assert max(figures.corners) <= 1.5  # none is lost
    assert not any(figures.chamfered)
    assert sum(figures.hooks) == 0


def test_a_gear_of_many_small_teeth_comes_back_without_a_tolerance():
    outlines, picture = rendered("gear 24", 128)
    rim, hole = ss.fit_shape(ss.trace(picture), character="drawn").fits
    assert [piece.kind for piece in rim.pieces] == ["line"] * len(outlines[0])
    assert [piece.kind for piece in hole.pieces] == ["arc"]


def test_an_open_row_on_a_circle_is_one_arc():
    for sweep in (1.0, 2 * np.pi):
        angle = np.linspace(0, sweep, 300)
        points = 10 * np.column_stack([np.cos(angle), np.sin(angle)])
        (arc,) = ss.fit_curve(points, closed=False, character="drawn").pieces
        assert arc.kind == "arc"
        assert abs(arc.arc.sweep - sweep) < 1e-6
    parabola = np.column_stack([angle, angle**2])
    assert ss.fit_curve(parabola, closed=False, character="drawn").method != "drawn"


def test_free_form_parts_run_smoothly_into_lines():
    t = np.linspace(0, 1, 120)
    wave = np.column_stack([100 * t, 12 * t**2 * (1 - t) ** 2 * 16 * (1 + np.sin(7 * t))])
    row = np.concatenate([np.column_stack([np.arange(-60, 0), np.zeros(60)]), wave])
    fit = checked(ss.fit_curve(row, closed=False, tolerance=0.3, character="drawn"), 0.3)
    assert fit.pieces[0].kind == "line"
    assert len(fit.pieces) > 1
    assert not len(fit.corners)


def test_a_picture_comes_back_as_it_was_drawn():
    angle = np.radians(17)
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    corners = np.array([(-30, -18), (30, -18), (30, 18), (-30, 18)]) @ turn + (45.3, 40.8)
    shape = ss.trace(dark(coverage(polygon(corners), 80, 90)))
    for tolerance in (None, 0.35):
        (fit,) = ss.fit_shape(shape, tolerance=tolerance, character="drawn")
        assert fit.kept
        assert [piece.kind for piece in fit.pieces] == 4 * ["line"]
        nodes = np.array([piece.control_points[0] for piece in fit.pieces])
        # 32 samples a side of a pixel leave 1/64 of one in place, averaged over an edge less.
        assert all(np.hypot(*(nodes - corner).T).min() < 0.02 for corner in corners)


def test_what_is_organic_is_as_with_the_fewest_points():
    t = np.linspace(0, 2 * np.pi, 300, endpoint=False)
    r = 35 + 8 * np.cos(2 * t + 0.4) + 5 * np.sin(3 * t) + 2.5 * np.cos(5 * t + 1)
    points = np.column_stack([r * np.cos(t), r * np.sin(t)])
    drawn, fewest = (
        ss.fit_curve(points, closed=True, tolerance=0.3, character=word)
        for word in ("drawn", "fewest")
    )
    assert drawn == fewest


def test_lines_and_arcs_for_machines_are_those_that_were_drawn():
    options = {"closed": True, "tolerance": 0.2, "form": "arcs"}
    drawn, fewest = (
        checked(ss.fit_curve(rounded_box(), character=word, **options), 0.2)
        for word in ("drawn", "fewest")
    )
    assert sorted(piece.kind for piece in drawn.pieces) == 4 * ["arc"] + 4 * ["line"]
    assert len(drawn.pieces) < len(fewest.pieces)


@pytest.mark.slow
def test_a_tolerance_below_the_noise_falls_back():
    shaken = rounded_box() + np.random.default_rng(3).normal(0, 0.3, (len(rounded_box()), 2))
    assert checked(ss.fit_curve(shaken, closed=True, tolerance=0.2, character="drawn"), 0.2)


def test_drawn_is_the_default_where_it_acts():
    from shapespline.fitting import Settings

    fit = ss.fit_curve(slot(400), closed=True, tolerance=0.1)
    assert fit == ss.fit_curve(slot(400), closed=True, tolerance=0.1, character="drawn")
    assert fit.method == "drawn"
    for options in (
        {"corners": "free"},
        {"corners": [3]},
        {"form": "spline"},
        {"weights": np.ones(9)},
        {"through": [3]},
        {"degree": 2},
        {"character": "fewest"},
    ):
        assert not Settings(tolerance=0.1, **options).as_drawn
    assert Settings(tolerance=0.1, form="arcs", regularities=None).as_drawn


def test_corners_between_samples_stay_near_within_any_tolerance():
    at = 4 * (np.arange(799) + 0.5) / 799
    k, part = at.astype(int), (at % 1)[:, None]
    corners = 10 * np.array([(0, 0), (1, 0), (1, 1), (0, 1), (0, 0)])
    square = corners[k] * (1 - part) + corners[k + 1] * part
    for tolerance in (0.02, 0.3):
        fit = checked(ss.fit_curve(square, closed=True, tolerance=tolerance), tolerance)
        assert fit.n_stored_points <= 16


def test_settings_survive_a_dictionary_and_bad_ones_are_refused():
    from shapespline.fitting import Request, Settings

    asked = Settings(tolerance=0.1, character="drawn", regularities=["mirror"])
    assert Settings.from_dict(asked.to_dict()).regularities == ("mirror",)
    none = Settings(tolerance=0.1, character="drawn", regularities=None)
    assert Settings.from_dict(none.to_dict()).regularities is None
    assert 'regularities = "none"\n' in none.to_toml()
    request = Request.of(rounded_box(), True, asked)
    again = Request.from_dict(request.to_dict())
    assert (again.style.character, again.style.regularities) == ("drawn", ("mirror",))
    for options, words in (
        ({"character": "sketched"}, "character must be one of drawn, fewest"),
        ({"character": "drawn", "form": "spline"}, "cannot act where one spline"),
        ({"character": "drawn", "tolerance": None, "sigma": 0.1}, "leave .* sigma and loss out"),
        ({"character": "drawn", "corners": "free"}, "where corners are given"),
        ({"character": "drawn", "through": [0]}, "cannot act where something else is kept"),
        ({"regularities": "mirror", "through": [0]}, "regularities cannot act"),
        ({"character": "drawn", "degree": 2}, "degree must be 3 or more"),
        (
            {"character": "fewest", "regularities": None},
            "regularities act with character='drawn' only",
        ),
        ({"character": "drawn", "regularities": "round"}, "some of tangent, rotation"),
        ({"character": "drawn", "regularities": 3}, "some of tangent, rotation"),
    ):
        with pytest.raises(ss.InvalidInputError, match=words):
            Settings(**{"tolerance": 0.1} | options)


def test_features_below_the_tolerance_are_left_out_on_request_and_never_bent():
    outline = rounded_box()  # a fillet is 4.97 from its corner, its chord 3.51 from it
    asked = {"closed": True, "character": "drawn"}
    plain = ss.fit_curve(outline, tolerance=5.2, **asked)
    assert sorted(piece.kind for piece in plain.pieces) == 4 * ["arc"] + 4 * ["line"]
    sharp = checked(ss.fit_curve(outline, tolerance=5.2, simplify=True, **asked), 5.2)
    assert [piece.kind for piece in sharp.pieces] == 4 * ["line"]
    corners = np.array([piece.control_points[0] for piece in sharp.pieces])
    assert len(set(corners[:, 0])) == len(set(corners[:, 1])) == 2  # level to the bit
    assert np.abs(np.abs(corners) - (50, 30)).max() < 0.01
    assert {one.name for one in sharp.regularities} >= {"axis-parallel"}
    assert all(0 <= k < 4 for one in sharp.regularities for k in one.pieces)
    chamfered = checked(ss.fit_curve(outline, tolerance=4.0, simplify=True, **asked), 4.0)
    assert [piece.kind for piece in chamfered.pieces] == 8 * ["line"]
    kept = ss.fit_curve(outline, tolerance=3.0, simplify=True, **asked)
    assert [piece.kind for piece in kept.pieces] == [piece.kind for piece in plain.pieces]
    with pytest.raises(ss.InvalidInputError, match="simplify acts with character='drawn'"):
        ss.fit_curve(outline, closed=True, tolerance=0.5, character="fewest", simplify=True)
    with pytest.raises(ss.InvalidInputError, match="simplify acts within a tolerance"):
        ss.fit_curve(outline, closed=True, simplify=True)


@pytest.mark.parametrize("letter", ["8", "B", "g", "R"])
def test_a_letter_of_one_bit_stays_within_a_pixel_of_its_picture(letter):
    ink = drawn(letter, "DejaVuSans.ttf", 180) < 128
    drawing = ss.fit_shape(ss.trace(np.where(ink, 0, 255).astype(np.uint8)))
    # Half a pixel is the stair's own height; what is farther than a pixel is no stair.
    for fit in drawing:
        assert fit.max_distance <= 1.0
        assert fit.rms_distance <= 0.5


def test_a_corner_between_two_points_is_where_the_sides_meet():
    # Steps of 0.7 meet the corners of 10 by 6 nowhere but at the first point.
    along = np.concatenate([np.arange(0.0, 32.0, 0.7)])
    x = np.interp(along, [0, 10, 16, 26, 32], [0, 10, 10, 0, 0])
    y = np.interp(along, [0, 10, 16, 26, 32], [0, 0, 6, 6, 0])
    points = np.column_stack([x, y])
    for tolerance, exact in ((None, True), (0.5, True), (0.001, False)):
        fit = ss.fit_curve(points, closed=True, tolerance=tolerance)
        assert fit.kept
        assert {piece.kind for piece in fit.pieces} == {"line"}
        nodes = np.array([piece.control_points[0] for piece in fit.pieces])
        corners = np.array([(0, 0), (10, 0), (10, 6), (0, 6)])
        away = np.hypot(*np.moveaxis(corners[:, None] - nodes, -1, 0)).min(axis=1)
        if exact:  # else a corner farther from the polyline than the tolerance is cut off
            assert len(fit.pieces) == 4
            assert away.max() < 1e-12
        else:
            assert len(fit.pieces) == 7


@pytest.mark.parametrize("seed", [0, 3])
def test_a_few_noisy_points_are_no_edge_of_their_own(seed):
    # By chance four points beside a node lie in a row, and no line beside them is far off.
    dense = sampled(rendered("keyhole", 256)[0][0], 0.02)
    points = ss.Contour(dense, closed=True).resampled(1000).points
    deviation = 0.0002 * np.hypot(*np.ptp(dense, axis=0))
    noise = np.random.default_rng(seed).normal(0, deviation, points.shape)
    fit = ss.fit_curve(points + noise, closed=True)
    assert sorted(piece.kind for piece in fit.pieces) == ["arc", "line", "line", "line"]


@pytest.mark.parametrize("tolerance", [None, 0.01])
def test_lines_and_arcs_are_looked_for_once(monkeypatch, tolerance):
    asked = []

    def counted(*given, **named):
        asked.append(given)
        return as_drawn(*given, **named)

    monkeypatch.setattr("shapespline.fitting.problem.as_drawn", counted)
    turn = np.linspace(0, 2 * np.pi, 400, endpoint=False)
    radius = 5 + np.sin(2 * turn) + 0.7 * np.cos(3 * turn)
    points = np.column_stack([radius * np.cos(turn), radius * np.sin(turn)])
    assert ss.fit_curve(points, closed=True, tolerance=tolerance).method != "drawn"
    assert len(asked) == 1

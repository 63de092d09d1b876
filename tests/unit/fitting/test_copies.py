"""Equal outlines with free-form parts, through the public functions."""

import numpy as np
import pytest
from tests.support.shapes import moved

import shapespline as ss
from checks import two_sided

TOLERANCE, NOISE = 0.15, 0.004
QUARTER = np.array([[0.0, -1.0], [1.0, 0.0]])
MIRROR = np.diag([-1.0, 1.0])


def letter(begin=0.0):
    """A bowl on a level foot, about a point half a unit, from some part of the way on."""
    t = np.linspace(0, np.pi, 600)
    bowl = np.column_stack([-14 * np.cos(t), 11 * np.sin(t) + 4 * np.sin(2 * t) ** 2 * (t > 1.5)])
    corners = np.array([(14, 0), (14, -6), (-14, -6), (-14, 0)], dtype=float)
    way = np.concatenate([bowl, corners[1:]])
    at = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(way, axis=0).T))])
    stations = (np.arange(200) / 200 + begin) % 1.0 * at[-1]
    return np.column_stack([np.interp(stations, at, c) for c in way.T])


def lobed():
    t = 2 * np.pi * np.arange(150) / 150
    return (10 + 2 * np.cos(3 * t))[:, None] * np.column_stack([np.cos(t), 0.8 * np.sin(t)])


def drawn(outlines, **options):
    rng = np.random.default_rng(7)
    contours = [
        ss.Contour(points + rng.normal(0, NOISE, points.shape), closed=True) for points in outlines
    ]
    return ss.fit_shape(ss.Shape(contours), **{"tolerance": TOLERANCE, **options})


def sides(fit):
    """Control points of all pieces about their mean, in the order of the outline."""
    points = np.concatenate([piece.control_points[:-1] for piece in fit.pieces])
    return points - points.mean(axis=0)


def equal_ones(drawing):
    return [one.pieces for one in drawing.regularities if one.name == "equal-copies"]


def test_letters_of_a_word_are_one_letter_in_several_places():
    places = np.array([(0, 0), (37.3, 0.4), (90.13, -2.2)])
    drawing = drawn([letter(0.31 * k) + place for k, place in enumerate(places)])
    assert equal_ones(drawing) == [(0, 1, 2)]
    first, *others = drawing
    assert any(piece.kind not in ("line", "arc") for piece in first.pieces)
    for fit, place in zip(drawing, places, strict=True):
        # Rounding of coordinates of some tens.
        assert np.allclose(sides(fit), sides(first), atol=1e-12)
        found = two_sided(fit.spline, fit.contour.points, closed=True, step=TOLERANCE / 20)
        assert fit.kept
        assert found.larger <= TOLERANCE
        # Two hundred points tell a place to a tenth of their noise.
        way = fit.spline(0.3)[0] - first.spline(0.3)[0]
        assert np.hypot(*(way - place)) < NOISE
    feet = [fit.pieces for fit in others]
    level = [
        p
        for pieces in feet
        for p in pieces
        if p.kind == "line" and np.ptp(p.control_points[:, 0]) > 20
    ]
    assert len(level) == 2
    assert all(np.ptp(piece.control_points[:, 1]) == 0.0 for piece in level)


@pytest.mark.parametrize("linear", [QUARTER, -np.eye(2), MIRROR, QUARTER @ MIRROR])
def test_copies_may_be_turned_by_right_angles_and_mirrored(linear):
    image = moved(letter(0.4) @ linear.T, shift=(60, 5))
    image = image[::-1] if np.linalg.det(linear) < 0 else image
    drawing = drawn([letter(), image])
    assert equal_ones(drawing) == [(0, 1)]
    first, second = drawing
    assert second.kept
    assert sorted(p.kind for p in second.pieces) == sorted(p.kind for p in first.pieces)
    own, its = sides(first) @ linear.T, sides(second)
    apart = np.abs(own[:, None] - its[None]).max(axis=2)
    if np.linalg.det(linear) > 0:
        assert apart.min(axis=1).max() < 1e-12
    turned = two_sided(second.spline, second.contour.points, closed=True, step=TOLERANCE / 20)
    assert turned.larger <= TOLERANCE


@pytest.mark.parametrize("angle", [0.3, 2.0])
def test_copies_may_be_turned_by_any_angle(angle):
    drawing = drawn([letter(), moved(letter(0.4), angle, shift=(60, 5))])
    assert equal_ones(drawing) == [(0, 1)]
    first, second = drawing
    assert not any(one.name == "axis-parallel" for one in second.regularities)
    off = moved(sides(first), angle)[:, None] - sides(second)
    # Two hundred points tell the angle to a tenth of their noise over the letter's size.
    assert np.hypot(*off.transpose(2, 0, 1)).min(axis=1).max() < NOISE
    found = two_sided(second.spline, second.contour.points, closed=True, step=TOLERANCE / 20)
    assert found.larger <= TOLERANCE


def test_what_is_not_equal_stays_as_it_was():
    larger = moved(1.008 * letter(0.2), shift=(50, 0))
    bent = letter(0.2) + np.column_stack([np.zeros(200), 0.1 * np.sin(letter(0.2)[:, 0] / 3)])
    drawing = drawn([letter(), larger, moved(bent, shift=(100, 0))])
    assert equal_ones(drawing) == []


@pytest.mark.parametrize("options", [{"regularities": None}, {"character": "fewest"}])
def test_copies_are_a_regularity(options):
    outlines = [lobed(), np.roll(moved(lobed(), shift=(31.7, 2)), 40, axis=0)]
    assert equal_ones(drawn(outlines)) == [(0, 1)]
    drawing = drawn(outlines, **options)
    assert drawing.regularities == ()
    first, second = (fit.spline.control_points for fit in drawing)
    assert first.shape != second.shape or np.ptp(second - first, axis=0).max() > 1e-6


def test_copies_of_one_smooth_spline():
    drawing = drawn([lobed(), moved(np.roll(lobed(), 40, axis=0), shift=(31.7, 2))], tolerance=None)
    assert equal_ones(drawing) == [(0, 1)]
    first, second = drawing
    way = second.spline.control_points - first.spline.control_points
    assert np.ptp(way, axis=0).max() < 1e-12

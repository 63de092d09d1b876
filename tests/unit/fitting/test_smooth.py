"""Splines from corner to corner: for all runs (smoothness=2), or where pieces turn needlessly.

Curvature is looked at on both sides of every joint that is no corner, by scipy alone.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import cKDTree
from tests.support.shapes import flower

import shapespline as ss
from checks import splines, turns, two_sided

# What turns more is a corner; smooth joints turn by rounding only.
CORNER = np.radians(1.0)
ANGLE = np.linspace(0, np.pi, 100)
# A half disc: two corners, a straight side. A heart of smooth sides: two corners.
HALF_DISC = np.concatenate(
    [
        np.column_stack([np.cos(ANGLE), np.sin(ANGLE)]),
        np.column_stack([np.linspace(-1, 1, 50)[1:-1], np.zeros(48)]),
    ]
)
SIDE = np.linspace(0, 2 * np.pi, 400, endpoint=False)
HEART = np.column_stack(
    [16 * np.sin(SIDE) ** 3, 13 * np.cos(SIDE) - 5 * np.cos(2 * SIDE) - 2 * np.cos(3 * SIDE)]
)
SHAPES = {"flower": flower(300).points, "half disc": HALF_DISC, "heart": HEART}


def curvature(spline, u):
    (x, y), (v, w) = spline(u, nu=1), spline(u, nu=2)
    return (x * w - y * v) / np.hypot(x, y) ** 3


def jumps(parts, closed):
    """Jumps of curvature at knots and at joints that turn less than corners, over the largest."""
    found, largest = [0.0], 0.0
    for part in parts:
        knots = np.unique(part.t[part.k : len(part.t) - part.k])
        reach = 1e-7 * np.diff(knots).min()
        sides = [(curvature(part, u - reach), curvature(part, u + reach)) for u in knots[1:-1]]
        found += [abs(b - a) for a, b in sides]
        u = np.linspace(knots[0], knots[-1], 500)
        largest = max(largest, max(abs(curvature(part, at)) for at in u))
    smooth = np.abs(turns(parts, closed=closed)) <= CORNER
    pairs = [(parts[i - 1], parts[i]) for i in range(0 if closed else 1, len(parts))]
    for (before, after), is_smooth in zip(pairs, smooth, strict=True):
        if is_smooth:
            ends = (
                curvature(before, before.t[-before.k - 1]),
                curvature(after, after.t[after.k]),
            )
            found.append(abs(ends[1] - ends[0]))
    return max(found) / largest


@pytest.mark.slow
@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("degree", [3, 5])
def test_curvature_has_no_jump_but_in_corners(shape, degree):
    options = {"closed": True, "tolerance": "0.1%", "degree": degree, "effort": "fast"}
    fit = ss.fit_curve(SHAPES[shape], smoothness=2, **options)
    assert fit.kept
    assert len(fit.corners) == (0 if shape == "flower" else 2)
    parts = splines(fit.pieces)
    step = fit.tolerance / 10
    assert two_sided(parts, SHAPES[shape], closed=True, step=step).larger <= fit.tolerance
    # Both sides are looked at 1e-7 of an interval from the knot.
    assert jumps(parts, closed=True) < 1e-4
    back = ss.fit_curve(np.roll(SHAPES[shape][::-1], 57, axis=0), smoothness=2, **options)
    stored = (
        sorted(np.concatenate([p.control_points for p in each.pieces]).tolist())
        for each in (fit, back)
    )
    assert next(stored) == next(stored)


def test_pieces_alone_have_jumps():
    rounded = np.concatenate([[(1.0, -1.0)], HALF_DISC[:101], [(-1.0, -1.0)]])
    fit = ss.fit_curve(rounded, closed=False, tolerance="0.02%")
    assert jumps(splines(fit.pieces), closed=False) > 0.1
    again = ss.fit_curve(rounded, closed=False, tolerance="0.02%", smoothness=2)
    assert again.status == ss.Status.KEPT
    assert jumps(splines(again.pieces), closed=False) < 1e-4


def test_where_curvature_may_jump_the_status_says_so():
    walk = np.cumsum(np.random.default_rng(2).normal(0, 1, (30, 2)), axis=0)
    options = {"closed": False, "tolerance": "0.02%", "effort": "fast"}
    assert ss.fit_curve(walk, **options).status == ss.Status.KEPT
    fit = ss.fit_curve(walk, smoothness=2, **options)
    assert fit.kept
    assert fit.status == ss.Status.EXCEEDED
    assert "curvature may jump in" in fit.status.value
    assert jumps(splines(fit.pieces), closed=False) > 1e-4


@pytest.mark.parametrize(
    "options",
    [
        {},
        {"tolerance": 0.1, "degree": 2},
        {"tolerance": 0.1, "form": "spline"},
        {"tolerance": 0.1, "form": "arcs"},
        {"tolerance": 0.1, "character": "drawn"},
        {"tolerance": 0.1, "corners": "free"},
        {"tolerance": 0.1, "through": [3]},
        {"n_control_points": 12},
    ],
)
def test_where_it_cannot_act_it_is_refused(options):
    with pytest.raises(ss.InvalidInputError, match="smoothness"):
        ss.fit_curve(HEART, closed=True, smoothness=2, **options)


@pytest.mark.parametrize("value", [0, 3, 1.5, True, "2"])
def test_it_is_one_or_two(value):
    with pytest.raises(ss.InvalidInputError, match="smoothness must be 1"):
        ss.fit_curve(HEART, closed=True, tolerance=0.1, smoothness=value)


def airfoil(n=35):
    """NACA 0012 with a sharp trailing edge, 2 n - 1 points as tables have them."""
    x = 0.5 * (1 + np.cos(np.linspace(0, np.pi, n)))
    y = 0.6 * (0.2969 * np.sqrt(x) - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
    y[0] = y[-1] = 0.0
    return np.column_stack([np.concatenate([x, x[-2::-1]]), np.concatenate([y, -y[-2::-1]])])[:-1]


def two_bends(n=60):
    """Two half waves, n points each, that meet in a corner of 90 degrees."""
    t = np.linspace(0, np.pi, n)
    before = np.column_stack([t - np.pi, np.sin(t)])
    return np.concatenate([before, np.column_stack([t, np.sin(t)])[1:]])


@pytest.mark.parametrize(
    ("points", "closed", "tolerance"),
    [(airfoil(), True, "0.02%"), (airfoil(), True, "0.01%"), (two_bends(30), False, "0.02%")],
)
@pytest.mark.parametrize("effort", ["fast", "balanced"])
@pytest.mark.filterwarnings("ignore:the points are sparse")
def test_sparse_data_turn_in_their_corner_alone(points, closed, tolerance, effort):
    # Pieces alone followed the chords between points: 10 to 40 corners.
    options = {"closed": closed, "tolerance": tolerance, "effort": effort}
    fit = ss.fit_curve(points, character="fewest", **options)
    step = fit.tolerance / 10
    assert two_sided(splines(fit.pieces), points, closed=closed, step=step).larger <= fit.tolerance
    corner = points[0] if closed else points[len(points) // 2]
    assert np.hypot(*(fit.spline(fit.corners) - corner).T).max(initial=0.0) <= 2 * fit.tolerance
    assert len(fit.corners) == 1
    assert jumps(splines(fit.pieces), closed=closed) < 1e-4


@pytest.mark.filterwarnings("ignore:the points are sparse")
def test_a_smooth_run_does_not_hang_on_the_order_of_the_data():
    points = airfoil()
    fit = ss.fit_curve(points, closed=True, tolerance="0.02%", character="fewest")
    for other in (points[::-1], np.roll(points, 20, axis=0)):
        again = ss.fit_curve(other, closed=True, tolerance="0.02%", character="fewest")
        assert again.n_stored_points == fit.n_stored_points
        there, back = (cKDTree(one.spline.control_points) for one in (fit, again))
        assert there.query(back.data)[0].max() < 1e-9


def test_straight_sides_beside_a_sparse_bend_stay_straight():
    # The bend of nine points is coarse for the tolerance; each side has 20 points on a line.
    angle = np.linspace(0, np.pi, 9)
    x = np.linspace(0, 10, 21)[:-1]
    side = np.column_stack([x, np.full(20, -1.0)])
    bend = np.column_stack([10 + np.sin(angle), -np.cos(angle)])
    points = np.concatenate([side, bend, side[::-1] * (1, -1)])
    fit = ss.fit_curve(points, closed=True, tolerance="0.02%", character="fewest")
    lines = [piece for piece in fit.pieces if piece.degree == 1]
    lengths = sorted(float(np.hypot(*np.diff(line.control_points, axis=0)[0])) for line in lines)
    assert all(length > 8.0 for length in lengths[-2:])


def test_points_and_tangents_that_are_kept_stay_so():
    points = two_bends()
    held = ss.fit_curve(points, closed=False, tolerance="0.01%", through=[30, 90])
    nodes = np.array([piece.control_points[0] for piece in held.pieces])
    assert all((nodes == point).all(axis=1).any() for point in points[[30, 90]])
    slope = ((1.0, 1.0), None)
    turned = ss.fit_curve(points, closed=False, tolerance="0.01%", end_tangents=slope)
    first = turned.pieces[0].control_points
    direction = (first[1] - first[0]) / np.hypot(*(first[1] - first[0]))
    assert np.abs(direction - np.sqrt(0.5)).max() < 1e-9

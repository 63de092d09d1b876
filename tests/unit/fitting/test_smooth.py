"""smoothness=2: the curvature of both sides of every joint that is no corner, by scipy alone."""

from __future__ import annotations

import numpy as np
import pytest
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

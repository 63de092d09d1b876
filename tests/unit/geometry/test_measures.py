"""Lengths, areas, boxes, insides and equal steps of curves, against closed forms."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from tests.support.make_fit import blob, fit_of, nested, wave

import shapespline as ss
from shapespline.geometry import bounds, contains, enclosed_area, evenly_spaced, polygon_drawing
from shapespline.geometry.monotone import bezier_at, critical_parameters
from shapespline.values import BSplineCurve

EPS = np.finfo(float).eps
POLYGON = np.array([(0.0, 0), (5, 0), (5, 2), (3, 2), (3, 1), (2, 1), (2, 4), (0, 4)])


def closed_polygon(points):
    (fit,) = polygon_drawing(ss.Shape([ss.Contour(points, closed=True)]))
    return fit


def bezier(points):
    return BSplineCurve(np.repeat([0.0, 1.0], len(points)), points, len(points) - 1)


def test_a_polygon():
    fit = closed_polygon(POLYGON)
    # 5 x 2 and 2 x 2 on top of it, less 1 x 1.
    assert fit.area == pytest.approx(13, abs=64 * EPS * 13)
    assert fit.length == pytest.approx(20, abs=64 * EPS * 20)
    assert fit.bounds == (0, 0, 5, 4)
    assert enclosed_area(closed_polygon(POLYGON[::-1]).spline) == pytest.approx(-13, abs=1e-12)
    # Without the corner that sticks out of every half-plane: points of each box.
    inside = [(1, 1), (2.5, 0.5), (4, 1.5), (1, 3)]
    outside = [(2.5, 1.5), (3, 3), (-1, 1), (6, 0), (2.5, 4), (1, 4.1)]
    assert fit.contains(inside).all()
    assert not fit.contains(outside).any()


@pytest.mark.parametrize("degree", [2, 3, 5, 9])
def test_an_area_is_that_of_green_by_power_coefficients(degree):
    rng = np.random.default_rng(degree)
    points = rng.uniform(-3, 3, (degree + 1, 2)) + 100
    points[-1] = points[0]
    # The same polynomials about the first point, multiplied and integrated as coefficients.
    x, y = (
        np.polynomial.Polynomial.fit(*sampled, degree, domain=[0, 1], window=[0, 1])
        for sampled in (
            (
                np.linspace(0, 1, 4 * degree),
                bezier(points - points[0])(np.linspace(0, 1, 4 * degree))[:, axis],
            )
            for axis in (0, 1)
        )
    )
    area = 0.5 * (x * y.deriv() - y * x.deriv()).integ()
    # Coefficients of the fit are at most 6^degree times larger than the coordinates.
    assert enclosed_area(bezier(points)) == pytest.approx(
        area(1) - area(0), abs=EPS * 6.0**degree * 100
    )


def test_a_circle_within_its_cubics():
    # Eight cubics with handle 4/3 tan(a/4): the radius is at most 1 + 4/27 sin^6(a/4)/cos^2(a/4).
    a = np.pi / 4
    error = 4 / 27 * np.sin(a / 4) ** 6 / np.cos(a / 4) ** 2
    angle = np.arange(9) * a
    on, along = (
        np.column_stack([np.cos(angle), np.sin(angle)]),
        np.column_stack([-np.sin(angle), np.cos(angle)]),
    )
    handle = 4 / 3 * np.tan(a / 4)
    points = [on[0]]
    for k in range(8):
        points += [on[k] + handle * along[k], on[k + 1] - handle * along[k + 1], on[k + 1]]
    points[-1] = points[0]
    knots = np.concatenate([[0.0], np.repeat(np.arange(9) / 8, 3), [1.0]])
    circle = BSplineCurve(knots, points, 3)
    area = enclosed_area(circle)
    assert np.pi - 1e-14 < area < np.pi * (1 + error) ** 2
    assert np.hypot(*np.array(bounds([circle])[2:])) == pytest.approx(np.sqrt(2), abs=8 * EPS)
    # Between two circles about the origin and convex: between their circumferences.
    assert 2 * np.pi <= circle.length() <= 2 * np.pi * (1 + error)
    # Equal steps are equal angles as far as radius and speed allow: the length along the curve
    # differs from the angle by no more than the total excess.
    u = evenly_spaced(circle, 100, closed=True)
    place = circle(u)
    turned = np.unwrap(np.arctan2(place[:, 1], place[:, 0]))
    assert np.abs(turned - 2 * np.pi * np.arange(100) / 100).max() < 4 * np.pi * error
    rng = np.random.default_rng(0)
    queries = rng.uniform(-1.2, 1.2, (2000, 2))
    radius = np.hypot(*queries.T)
    clear = (radius < 1) | (radius > 1 + error)
    assert (contains([circle], queries) == (radius < 1))[clear].all()


def test_a_parabola_in_closed_form():
    # y = 2 x (2 - x): length by the primitive of sqrt(1 + s^2) in the slope s = 4 - 4 x.
    curve = bezier([(0, 0), (1, 4), (2, 0)])
    exact = 2 * (4 * np.sqrt(17) + np.arcsinh(4)) / 2 / 4
    assert curve.length() == pytest.approx(exact, rel=1e-13)
    assert bounds([curve]) == (0, 0, 2, 2)
    u = evenly_spaced(curve, 9, closed=False)
    s = 4 - 8 * u
    along = (4 * np.sqrt(17) + np.arcsinh(4) - s * np.sqrt(1 + s * s) - np.arcsinh(s)) / 8
    assert np.abs(along - np.linspace(0, exact, 9)).max() < 1e-12


@pytest.mark.slow
@pytest.mark.parametrize("curve", [blob(9, 2), blob(12), wave(9, 5), blob(14, 7, centre=(1e6, 3))])
def test_boxes_and_insides_of_curves(curve):
    u = np.linspace(0, 1, 20001)
    points = curve(u)
    box = np.array(bounds([curve]))
    sampled = np.concatenate([points.min(axis=0), points.max(axis=0)])
    size = np.abs(box).max()
    assert (np.sign([1, 1, -1, -1]) * (sampled - box) >= -16 * EPS * size).all()
    # Between samples a coordinate exceeds both neighbours by h^2 / 8 of its second derivative.
    second = np.abs(curve(u, derivative=2)).max() * 1.1
    assert np.abs(sampled - box).max() <= second * (u[1] ** 2) / 8 + 16 * EPS * size
    if curve.periodic:
        rng = np.random.default_rng(1)
        queries = rng.uniform(box[:2] - 1, box[2:] + 1, (500, 2))
        ahead = np.roll(points[:-1], -1, axis=0)
        count = np.zeros(500, dtype=int)
        for (ax, ay), (bx, by) in zip(points[:-1], ahead, strict=True):
            over = (ay > queries[:, 1]) != (by > queries[:, 1])
            if over.any():
                at = ax + (queries[:, 1] - ay) / (by - ay) * (bx - ax)
                count += over & (at > queries[:, 0])
        from shapespline.geometry import nearest

        clear = nearest(curve, queries).distances_sq > (second * u[1] ** 2) ** 2
        assert clear.mean() > 0.99
        assert (contains([curve], queries) == (count % 2 == 1))[clear].all()


def test_a_ray_through_vertices_counts_once():
    diamond = closed_polygon([(0, -1), (1, 0), (0, 1), (-1, 0)])
    assert diamond.contains([(-0.5, 0), (0, 0), (-2, 0), (-2, 1), (-2, -1)]).tolist() == [
        True, True, False, False, False,
    ]  # fmt: skip


def test_a_silhouette():
    drawing = nested()
    ring, hole, island, _ = drawing.fits
    assert drawing.area == pytest.approx(ring.area - hole.area + island.area, rel=1e-14)
    assert drawing.length == pytest.approx(sum(fit.length for fit in drawing), rel=1e-14)
    assert drawing.contains([(7.0, 0.0), (3.5, 0.0), (0.0, 0.0)]).tolist() == [True, False, True]
    assert drawing.bounds == bounds([fit.spline for fit in drawing])


@pytest.mark.parametrize("fit", [fit_of(blob(12)), fit_of(wave())], ids=["closed", "open"])
def test_equal_steps(fit):
    points = fit.points(400)
    assert points.shape == (400, 2)
    u = evenly_spaced(fit.spline, 400, closed=fit.closed)
    ends = [*u, 1.0] if fit.closed else u
    fine = [fit.spline(np.linspace(a, b, 65)) for a, b in itertools.pairwise(ends)]
    lengths = [np.hypot(*np.diff(part, axis=0).T).sum() for part in fine]
    # A chord of length h misses h^3 k^2 / 24 of its arc.
    bend = np.abs(fit.spline.curvature(np.linspace(0, 1, 4001))).max()
    missing = 64 * (max(lengths) / 64) ** 3 * (2 * bend) ** 2 / 24
    assert np.ptp(lengths) <= missing + 1e-12
    stepped = fit.points(step=fit.length / 10.5)
    assert len(stepped) == 11 + (not fit.closed)
    assert len(fit.points(step=fit.length / 10)) == 10 + (not fit.closed)


def test_critical_parameters_of_many_turns():
    # The Chebyshev polynomial of degree 9 turns at (1 + cos(k pi / 9)) / 2.
    t = np.linspace(0, 1, 10)
    chebyshev = np.cos(9 * np.arccos(np.clip(2 * t - 1, -1, 1)))
    basis = bezier_at(np.eye(10)[None], t[None])[0]
    values = np.linalg.solve(basis, chebyshev)
    turns = critical_parameters(values[None])[0, :8]
    exact = np.sort(0.5 * (1 + np.cos(np.pi * np.arange(1, 9) / 9)))
    # A zero of the derivative is known to the rounding of its values over its slope there, and
    # those of the Bernstein coefficients are below 5000 units.
    assert np.abs(turns - exact).max() < 5000 * 64 * EPS


def test_what_is_refused():
    line = fit_of(wave())
    with pytest.raises(ss.InvalidInputError, match="area is of a closed curve, got an open one"):
        _ = line.area
    with pytest.raises(ss.InvalidInputError, match="contains is of a closed curve"):
        line.contains([(0, 0)])
    ring = fit_of(blob(12))
    with pytest.raises(ss.InvalidInputError, match=r"finite \(k, 2\) array, got shape \(1, 3\)"):
        ring.contains([(0, 0, 0)])
    with pytest.raises(ss.InvalidInputError, match="1 numbers that are not finite"):
        ring.contains([(0, np.nan)])
    for arguments, sentence in [
        ({}, "one of both"),
        ({"n": 3, "step": 1.0}, "one of both"),
        ({"n": 1}, "2 or more, got 1"),
        ({"n": 2.5}, "whole number"),
        ({"n": True}, "whole number"),
        ({"step": 0}, "positive length, got 0"),
        ({"step": float("inf")}, "positive length"),
        ({"step": 1e-9}, "take fewer or a larger step"),
    ]:
        with pytest.raises(ss.InvalidInputError, match=sentence):
            line.points(**arguments)

"""Offsets of fits and drawings, against closed forms and an independent dense sampler."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import cKDTree
from tests.support.make_fit import fit_of, wave

import shapespline as ss

# Offsets are judged by dense samples.
pytestmark = pytest.mark.slow

TOLERANCE = 0.01
ANGLE = np.linspace(0, 2 * np.pi, 400, endpoint=False)


def ring(radius, lobes=0.0, n=5):
    reach = radius * (1 + lobes * np.cos(n * ANGLE))
    return ss.Contour(np.column_stack([np.cos(ANGLE), np.sin(ANGLE)]) * reach[:, None], closed=True)


def polygon(points):
    points = np.asarray(points, dtype=float)
    ahead = np.roll(points, -1, axis=0)
    share = np.linspace(0, 1, 20, endpoint=False)[:, None]
    return ss.Contour(
        np.concatenate([a + share * (b - a) for a, b in zip(points, ahead, strict=True)]),
        closed=True,
    )


L_SHAPE = [(0, 0), (4, 0), (4, 2), (2, 2), (2, 5), (0, 5)]
DUMBBELL = [(0, 0), (3, 0), (3, 1.2), (5, 1.2), (5, 0), (8, 0), (8, 3), (5, 3), (5, 1.8),
            (3, 1.8), (3, 3), (0, 3)]  # fmt: skip
BAY = [(0, 0), (6, 0), (6, 4), (3.2, 4), (3.2, 3.5), (4.5, 3.5), (4.5, 1), (1.5, 1), (1.5, 3.5),
       (2.8, 3.5), (2.8, 4), (0, 4)]  # fmt: skip


def fitted(contours, parents=None):
    return ss.fit_shape(ss.Shape(contours, parents), tolerance=TOLERANCE)


DRAWINGS = {
    "flower": fitted([ring(3, 0.4)]),
    "flower, clockwise": ss.Drawing([fit.reversed() for fit in fitted([ring(3, 0.4)])]),
    "corners": fitted([polygon(L_SHAPE)]),
    "waist": fitted([polygon(DUMBBELL)]),
    "bay": fitted([polygon(BAY)]),
    "washer": fitted([ring(4), ring(1.5, 0.2)], [-1, 0]),
    "neighbours": fitted([ring(1), ss.Contour(ring(1).points + np.array([2.5, 0.2]), closed=True)]),
}


def dense(curves, n=6000):
    """Points of curves at equal parameters, and the longest step between them."""
    parts = [curve(np.linspace(0, 1, n)) for curve in curves]
    step = max(np.hypot(*np.diff(part, axis=0).T).max() for part in parts)
    return np.concatenate(parts), step


def from_points(points, cloud):
    """Distances to the nearest of a cloud."""
    return cKDTree(cloud).query(points)[0]


def inside(points, curves):
    """Even-odd by dense polygons."""
    from matplotlib.path import Path

    count = np.zeros(len(points), dtype=int)
    for curve in curves:
        count += Path(curve(np.linspace(0, 1, 4000))).contains_points(points)
    return count % 2 == 1


@pytest.mark.parametrize(
    ("name", "distance", "n_outlines"),
    [
        ("flower", 0.5, 1),
        ("flower", 2.0, 1),
        ("flower", -0.4, 1),
        ("flower", -0.9, 1),
        ("flower, clockwise", 0.5, 1),
        ("corners", 0.4, 1),
        ("corners", -0.6, 1),
        ("waist", -0.4, 2),
        ("waist", 0.5, 1),
        ("bay", 0.25, 2),
        ("washer", 0.3, 2),
        ("washer", -0.3, 2),
        ("neighbours", 0.4, 1),
        ("neighbours", -0.4, 2),
    ],
)
def test_two_sided_promise_against_the_true_offset(name, distance, n_outlines):
    drawing = DRAWINGS[name]
    found = drawing.offset(distance, tolerance=TOLERANCE)
    assert len(found) == n_outlines
    assert all(fit.kept and fit.closed for fit in found)
    source = [fit.spline for fit in drawing]
    cloud, step = dense(source)
    result, _ = dense([fit.spline for fit in found], 1500)
    # To a cloud that lies on the curves a distance d is at most sqrt(d^2 + step^2 / 4).
    slack = np.hypot(abs(distance), 0.5 * step) - abs(distance)
    away = from_points(result, cloud)
    # Of points on the result the distance may miss by the tolerance: they are so near to the
    # true offset, and a distance changes no faster than its point.
    assert np.abs(away - abs(distance)).max() <= TOLERANCE + slack
    clear = np.abs(away) > TOLERANCE
    assert (inside(result, source) == (distance < 0))[clear].all()
    # The other way: of the raw offset of dense source points what is far enough from the cloud
    # is on the true offset. Corners get a fan of normals.
    raw = []
    for curve in source:
        u = np.linspace(0, 1, 1200, endpoint=False)
        tangent = curve(u, derivative=1)
        normal = np.column_stack([-tangent[:, 1], tangent[:, 0]])
        normal /= np.hypot(*normal.T)[:, None]
        raw += [curve(u) + distance * normal, curve(u) - distance * normal]
        fan = np.linspace(0, 2 * np.pi, 60)
        for corner in curve(curve.breakpoints):
            raw.append(corner + abs(distance) * np.column_stack([np.cos(fan), np.sin(fan)]))
    raw = np.concatenate(raw)
    near = from_points(raw, cloud)
    on = (near >= abs(distance) - 1e-6) & (inside(raw, source) == (distance < 0))
    assert on.sum() > 200
    target, spacing = dense([fit.spline for fit in found])
    missed = from_points(raw[on], target).max()
    assert missed <= np.hypot(TOLERANCE, 0.5 * spacing) + 1e-4


def test_areas_in_closed_form():
    # Steiner: a convex outline grows to A + P d + pi d^2; each side has a band of the tolerance.
    square = fitted([polygon([(0, 0), (3, 0), (3, 2), (0, 2)])])
    grown = square.offset(0.5, tolerance=0.001)
    perimeter = 10 + np.pi
    exact = 6 + 10 * 0.5 + np.pi * 0.25
    assert abs(grown.area - exact) <= (0.001 + TOLERANCE) * perimeter
    shrunk = square.offset(-0.5, tolerance=0.001)
    assert abs(shrunk.area - 2) <= (0.001 + TOLERANCE) * 6
    assert len(shrunk.fits[0].corners) == 4
    assert len(grown.fits[0].corners) == 0


def test_an_open_curve_to_its_left():
    fit = fit_of(wave(7, seed=3), noise=0.0)
    found = fit.offset(0.3, tolerance=TOLERANCE)
    assert not any(one.closed for one in found)
    cloud, step = dense([fit.spline])
    points, _ = dense([one.spline for one in found], 800)
    away = from_points(points, cloud)
    assert np.abs(away - 0.3).max() <= TOLERANCE + np.hypot(0.3, 0.5 * step) - 0.3
    line = ss.fit_curve([(0, 0), (4, 0)], closed=False, tolerance=TOLERANCE)
    (left,), (right,) = line.offset(0.5), line.offset(-0.5)
    assert np.abs(left.spline([0, 1]) - [(0, 0.5), (4, 0.5)]).max() <= left.tolerance
    assert np.abs(right.spline([0, 1]) - [(0, -0.5), (4, -0.5)]).max() <= right.tolerance


def test_where_nothing_is_left():
    drawing = DRAWINGS["corners"]
    with pytest.raises(
        ss.DegenerateContourError, match=r"nothing is left at a distance of -1\.5.*nowhere wider"
    ):
        drawing.offset(-1.5)


def test_what_is_refused():
    drawing = DRAWINGS["corners"]
    for arguments, sentence in [
        ((0,), "distance must be a length in data units other than 0, got 0"),
        ((np.inf,), "distance must be"),
        (("1",), "distance must be"),
        ((1, -1), "tolerance must be a positive length, got -1"),
    ]:
        with pytest.raises(ss.InvalidInputError, match=sentence):
            drawing.offset(arguments[0], tolerance=(arguments[1:] or (None,))[0])
    eight = ss.Contour(np.column_stack([np.sin(2 * ANGLE), np.sin(ANGLE)]), closed=True)
    with pytest.raises(ss.InvalidInputError, match="do not cross themselves or each other"):
        ss.fit_curve(eight, tolerance=0.01).offset(0.1)


def test_frame_unit_and_nesting_stay():
    washer = DRAWINGS["washer"]
    drawing = ss.Drawing(washer.fits, washer.parents, ss.ViewBox(0, 0, 9, 9), "mm")
    found = drawing.offset(0.2)
    assert (found.unit, found.frame) == ("mm", drawing.frame)
    assert sorted(found.parents) == [-1, 0]

"""Edges of equal length: slopes against differences, and outlines that have some."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

import shapespline as ss
from shapespline import _kernels


def polygon(corners, noise=0.02, seed=0):
    """Points 0.7 apart on the edges of a polygon, shaken."""
    corners, sides = np.array(corners, dtype=float), []
    for begin, end in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        count = int(np.hypot(*(end - begin)) / 0.7)
        sides.append(begin + np.arange(count)[:, None] / count * (end - begin))
    points = np.vstack(sides)
    return points + np.random.default_rng(seed).normal(0, noise, points.shape)


def fitted(points, tolerance=0.2, **options):
    return ss.fit_curve(points, closed=True, tolerance=tolerance, character="drawn", **options)


def lengths_of(fit):
    return np.array([np.hypot(*np.ptp(p.control_points[[0, -1]], axis=0)) for p in fit.pieces])


def said(fit):
    return [one for one in fit.regularities if one.name == "equal-length"]


@pytest.mark.parametrize(
    ("side", "end"), [(1.0, 1 + 2 * np.sqrt(6)), (-1.0, 1 - 2 * np.sqrt(6)), (0.0, 1.0)]
)
def test_a_length_is_told_by_what_an_edge_meets(side, end):
    # The line y = 2 from the line x = -3 to a circle about (1, 3) of radius 5, or to its foot.
    x = np.array([0.0, 2.0, np.pi / 2, 3.0, 1.0, 3.0, 5.0])
    edge = _kernels.Edge(
        0, _kernels.End(2, is_line=True), _kernels.End(4, is_line=False, side=side), 1e-4
    )
    assert edge.length(x) == pytest.approx(end + 3, abs=1e-14)


def test_equal_edges_of_an_outline_without_symmetry_are_equally_long():
    corners = [(0, 0), (40, 0), (60, 34.641016), (30, 60), (-10, 30)]
    fit = fitted(polygon(corners))
    (one,) = said(fit)
    lengths = lengths_of(fit)
    assert np.ptp(lengths[list(one.pieces)]) < 1e-12 * 60
    assert lengths[list(one.pieces)] == pytest.approx([40, 40], abs=0.02)
    assert 0 < one.off < 0.06
    assert not said(fitted(polygon(corners), regularities=["axis-parallel"]))


def step_with_fillet(radius, edge, noise):
    """Two edges of one length beside a fillet, and steps of other lengths; shaken points."""
    a, run = np.linspace(0, np.pi / 2, 26)[1:-1], np.arange(60)[:, None] / 60
    far = edge + radius
    fillet = np.column_stack([edge + radius * np.sin(a), radius - radius * np.cos(a)])
    corners = [(far, radius), (far, far), (far - 13, far), (far - 13, far + 20), (0, far + 20)]
    corners = np.array([*corners, (0, 0)], dtype=float)
    sides = [p + run * (q - p) for p, q in itertools.pairwise(corners)]
    points = np.vstack([run * [edge, 0], [[edge, 0]], fillet, *sides])
    return points + np.random.default_rng(3).normal(0, noise, points.shape)


def test_edges_that_end_in_fillets_are_equally_long():
    fit = fitted(step_with_fillet(8.0, 30.0, 0.02))
    (one,) = said(fit)
    lengths = lengths_of(fit)[list(one.pieces)]
    assert lengths == pytest.approx([30, 30], abs=0.05)
    assert np.ptp(lengths) < 1e-12 * 60


def test_edges_that_differ_by_more_than_noise_stay_different():
    fit = fitted(polygon([(0, 0), (40, 0), (60, 34.9), (30, 60), (-10, 30)]))
    assert not said(fit)


def test_sides_of_a_rectangle_need_no_saying():
    fit = fitted(polygon([(0, 0), (40, 0), (40, 30), (0, 30)]))
    lengths = lengths_of(fit)
    assert lengths[:2] == pytest.approx(lengths[2:], abs=1e-12 * 40)
    assert not said(fit)


def test_what_leaves_out_a_fillet_says_no_length_of_its_edges():
    points = step_with_fillet(1.0, 29.0, 0.004)
    (one,) = said(fitted(points))
    assert len(one.pieces) == 2
    fit = fitted(points, tolerance=0.5, simplify=True)
    assert len(fit.pieces) == 6
    assert not said(fit)

"""Fit and Status: what writers read."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from tests.support.make_fit import blob, fit_of, wave

from shapespline.values.curve import BSplineCurve
from shapespline.values.fit import Status
from shapespline.values.knots import clamped_knots, periodic_knots


def clamped(points, degree, interior=None):
    return BSplineCurve(clamped_knots(len(points), degree, interior), points, degree)


def test_statuses_are_equal_by_name_and_say_their_own_sentence():
    kept = Status.KEPT.saying("kept: data to curve 0.1")
    assert kept == Status.KEPT
    assert kept != Status.EXCEEDED
    assert kept != "KEPT"
    assert len({kept, Status.KEPT, Status.BUDGET, Status.CANCELLED, Status.EXCEEDED}) == 4
    assert (str(kept), kept.value, kept.name) == ("kept: data to curve 0.1",) * 2 + ("KEPT",)
    assert Status.KEPT.value != kept.value
    for name in ("KEPT", "EXCEEDED", "BUDGET", "CANCELLED"):
        assert getattr(Status, name).name == name
        assert " " in getattr(Status, name).value
    with pytest.raises(AttributeError):
        Status.KEPT.name = "x"


@pytest.mark.parametrize(
    ("max_distance", "hausdorff", "kept"),
    [(1.0, 1.0, True), (1.0, 1.1, False), (1.1, 1.0, False), (0.5, 0.9, True)],
)
def test_kept_needs_both_bounds(max_distance, hausdorff, kept):
    fit = fit_of(wave(), max_distance=max_distance, hausdorff_distance=hausdorff, tolerance=1.0)
    assert fit.kept is kept


def test_a_fit_gives_its_curve_to_scipy():
    fit = fit_of(blob(12))
    u = np.arange(32) / 32
    assert fit.curve is fit.curve
    # Two de Boor recursions of degree 3 and coordinates up to 13.
    assert np.abs(fit.curve(u) - fit.spline(u)).max() <= 50 * np.finfo(float).eps * 13
    assert fit.curve.extrapolate == "periodic"
    assert (fit.n_control_points, fit.degree, fit.closed) == (12, 3, True)
    assert_array_equal(fit.control_points, fit.spline.control_points)
    assert_array_equal(fit.knots, fit.spline.knots)
    assert fit.outliers.tolist() == []


# Control points on a circle: a double knot is a corner there.
RING = np.column_stack([np.cos(np.arange(6)), np.sin(np.arange(6))])


def test_closed():
    assert not fit_of(wave()).closed
    loop = clamped([(0, 0), (4, 0), (4, 4), (0, 4), (0, 0)], 2)
    assert fit_of(loop).closed


@pytest.mark.parametrize(
    ("curve", "corners"),
    [
        (clamped([(0, 0), (1, 2), (2, 1), (3, 3)], 3), []),
        (clamped([(0, 0), (1, 2), (2, 1), (3, 3)], 1, [0.3, 0.6]), [0.3, 0.6]),
        (clamped(np.arange(14).reshape(7, 2) ** 2, 3, [0.5, 0.5, 0.5]), [0.5]),
        (clamped(np.arange(14).reshape(7, 2) ** 2, 3, [0.5, 0.5, 0.7]), []),
        (clamped([(0, 0), (4, 0), (4, 4), (0, 4), (0, 0)], 2), [0]),
        (blob(12), []),
        (BSplineCurve(periodic_knots(3, 1), [(0, 0), (1, 0), (0, 1)], 1, True), [0, 1 / 3, 2 / 3]),
        (
            BSplineCurve(
                periodic_knots(6, 2, [0, 0.2, 0.4, 0.4, 0.6, 0.8, 1]), RING, 2, True
            ),
            [0.4],
        ),
        (
            BSplineCurve(
                periodic_knots(6, 2, [0, 0, 0.2, 0.4, 0.6, 0.8, 1]), RING, 2, True
            ),
            [0],
        ),
        (
            BSplineCurve(
                periodic_knots(6, 2, [0, 0.2, 0.4, 0.6, 0.8, 1, 1]), RING, 2, True
            ),
            [0],
        ),
    ],
)  # fmt: skip
def test_corners(curve, corners):
    fit = fit_of(curve, n_points=12)
    assert fit.corners.tolist() == corners
    # A corner is where the tangent may jump, and nowhere else.
    h = 1e-9
    for u in np.setdiff1d(curve.breakpoints[1:-1], corners):
        before, after = curve([u - h, u + h], derivative=1)
        assert np.abs(before - after).max() < 1e-4


@pytest.mark.parametrize(
    ("curve", "kind", "stored"),
    [
        (clamped([(0, 0), (1, 1)], 1), "line", 2),
        (clamped([(0, 0), (1, 1), (2, 0), (3, 3)], 3), "bezier", 4),
        (clamped([(0, 0), (1, 1), (2, 0), (3, 3), (4, 0)], 3), "spline", 5),
        (clamped([(0, 0), (1, 1), (2, 0)], 1), "spline", 3),
        (clamped([(0, 0), (4, 0), (4, 4), (0, 0)], 3), "bezier", 3),
        (blob(12), "spline", 12),
    ],
)
def test_pieces(curve, kind, stored):
    fit = fit_of(curve)
    (piece,) = fit.pieces
    assert (piece.kind, piece.degree) == (kind, curve.degree)
    assert_array_equal(piece.knots, curve.knots)
    assert_array_equal(piece.control_points, curve.coefficients)
    assert fit.n_stored_points == stored

"""Fits moved, turned around and cut: the same curve, and figures that a checker confirms."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from tests.support.make_fit import blob, fit_of, nested

import shapespline as ss
from checks import two_sided

EPS = np.finfo(float).eps
ANGLE = np.linspace(0, 2 * np.pi, 240, endpoint=False)
FLOWER = np.column_stack([np.cos(ANGLE), np.sin(ANGLE)]) * (3 + np.cos(5 * ANGLE))[:, None]
TOLERANCE = 0.02
FITS = {
    "pieces": ss.fit_curve(FLOWER, closed=True, tolerance=TOLERANCE),
    "spline": ss.fit_curve(FLOWER, closed=True, tolerance=TOLERANCE, form="spline"),
    "open": ss.fit_curve(FLOWER[:150], closed=False, tolerance=TOLERANCE),
    "corners": ss.fit_curve(
        ss.Contour([(0, 0), (3, 0), (3, 2), (0, 2)], closed=True).resampled(100),
        tolerance=TOLERANCE,
    ),
    "outliers": ss.fit_curve(
        np.insert(FLOWER[:150], 40, [20, 20], axis=0), closed=False, tolerance=TOLERANCE,
        outliers=True,
    ),
}  # fmt: skip
by_fit = pytest.mark.parametrize("fit", FITS.values(), ids=FITS)
SIMILAR = 2.5 * np.array([[np.cos(0.4), np.sin(0.4), 2], [np.sin(0.4), -np.cos(0.4), -7]])
SHEAR = np.array([[2.0, 0.7], [0.1, 0.5]])


def measured(fit):
    """Distances by the outside checker; its sampling misses less than its step."""
    found = two_sided(
        fit.curve, fit.contour.points, closed=fit.contour.closed, step=fit.tolerance / 10
    )
    rounding = 1e-9 * fit.contour.box_diagonal
    assert found.larger <= fit.hausdorff_distance + rounding
    return found.larger


@by_fit
def test_a_similarity_scales_what_is_said(fit):
    moved = fit.transformed(SIMILAR)
    assert moved.kept
    assert moved.status == fit.status
    assert f"tolerance {moved.tolerance:.6g} kept" in moved.status.value
    for name in ("tolerance", "max_distance", "rms_distance", "hausdorff_distance"):
        assert getattr(moved, name) == pytest.approx(2.5 * getattr(fit, name), rel=4 * EPS)
    measured(moved)
    u = np.linspace(0, 1, 99, endpoint=False)
    wanted = fit.spline(u) @ SIMILAR[:, :2].T + SIMILAR[:, 2]
    assert np.abs(moved.spline(u) - wanted).max() < 200 * EPS * np.abs(wanted).max()
    assert moved.n_stored_points == fit.n_stored_points
    assert (moved.outliers == fit.outliers).all()
    assert moved.length == pytest.approx(2.5 * fit.length, rel=1e-12)


@by_fit
def test_another_map_keeps_the_promise(fit):
    moved = fit.transformed(SHEAR)
    factor = np.linalg.norm(SHEAR, 2)
    assert moved.kept
    assert moved.tolerance == pytest.approx(factor * fit.tolerance, rel=4 * EPS)
    assert moved.hausdorff_distance <= factor * fit.hausdorff_distance * (1 + 4 * EPS)
    # The least factor of a length is another bound.
    least = np.linalg.norm(SHEAR, -2)
    assert measured(moved) >= least * 0.9 * fit.hausdorff_distance - fit.tolerance / 10
    if fit.closed:
        assert moved.area == pytest.approx(abs(np.linalg.det(SHEAR)) * fit.area, rel=1e-12)


@by_fit
def test_the_other_way(fit):
    back = fit.reversed()
    u = np.linspace(0, 1, 97)[1:-1]
    size = np.abs(fit.contour.points).max()
    assert np.abs(back.spline(u) - fit.spline(1 - u)).max() < 200 * EPS * size
    feet = back.spline(back.parameters) - back.contour.points[back.contour.source]
    assert np.hypot(*feet.T).max() <= fit.max_distance + 200 * EPS * size
    measured(back)
    again = back.reversed()
    assert (again.contour.points == fit.contour.points).all()
    assert (again.outliers == fit.outliers).all()
    assert back.n_stored_points == fit.n_stored_points


@pytest.mark.slow
@by_fit
@pytest.mark.parametrize("at", [[0.3], [0.0, 0.37, 0.5], [0.11, 0.111, 0.9]])
def test_parts_are_the_curve(fit, at):
    parts = fit.split(at)
    inner = [u for u in at if fit.closed or u > 0]
    assert len(parts) == len(inner) + (not fit.closed)
    assert sum(part.length for part in parts) == pytest.approx(fit.length, rel=1e-11)
    size = np.abs(fit.contour.points).max()
    joints = fit.spline(inner)
    begins = [part.spline([0])[0] for part in parts][0 if fit.closed else 1 :]
    assert np.abs(joints - begins).max() < 1000 * EPS * size
    for before, after in pairwise(parts):
        assert np.abs(before.spline([1.0]) - after.spline([0.0])).max() < 1000 * EPS * size
    # Every part lies on the curve, and not on another place of it.
    from shapespline.geometry import nearest

    for part in parts:
        points = part.spline(np.linspace(0, 1, 50))
        assert np.sqrt(nearest(fit.spline, points).distances_sq.max()) < 1e-12 * size
        # A data polyline that is cut where it is nearest to the ends: the distances at the ends
        # are those of the whole, and inside a foot can move past an end by no more than that.
        assert measured(part) <= part.hausdorff_distance + 1e-9
        assert part.hausdorff_distance <= 2 * fit.tolerance
        assert part.status == (ss.Status.KEPT if part.kept else ss.Status.EXCEEDED)


def test_a_drawing_moves_with_its_frame():
    drawing = ss.Drawing(nested().fits, nested().parents, ss.ViewBox(0, 0, 4, 2), "mm")
    moved = drawing.transformed([[0, -1, 1], [1, 0, 0]])
    assert moved.frame == (-1, 0, 2, 4)
    assert (moved.unit, moved.parents) == (drawing.unit, drawing.parents)
    assert moved.area == pytest.approx(drawing.area, rel=1e-12)


def test_what_is_refused():
    fit = fit_of(blob(9))
    for matrix, sentence in [
        ([1, 2], r"shape \(2, 2\), \(2, 3\) or \(3, 3\), got shape \(2,\)"),
        ([[1, 0], [0, np.nan]], "must be finite"),
        ([[1, 0], [1, 0]], "must not flatten the plane"),
        ([[1, 0, 0], [0, 1, 0], [0, 1, 1]], "last row of matrix must be 0, 0, 1"),
    ]:
        with pytest.raises(ss.InvalidInputError, match=sentence):
            fit.transformed(matrix)
    for at in ([], 1.5, [-0.1], [np.nan]):
        with pytest.raises(ss.InvalidInputError, match="at must be parameters"):
            fit.split(at)

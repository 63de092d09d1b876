"""Outliers left out on request: found, listed, and the promise about the rest."""

import numpy as np
import pytest
from benchmarks.outliers import contaminated
from numpy.testing import assert_array_equal
from tests.support.shapes import flower

from checks import two_sided
from shapespline import Contour, Drawing, InvalidInputError, Status, fit_curve, read, write


def assert_promise_about_the_rest(fit, points):
    rest = np.delete(points, fit.outliers, axis=0)
    assert_array_equal(fit.contour.points, rest)
    found = two_sided(fit.curve, rest, closed=fit.closed, step=fit.tolerance / 4)
    assert found.larger <= fit.hausdorff_distance + 1e-9 * fit.contour.box_diagonal
    assert fit.kept
    assert len(fit.parameters) == len(rest)


@pytest.mark.slow
@pytest.mark.parametrize(
    "arguments",
    [{"tolerance": 0.1}, {"tolerance": 0.1, "form": "spline"}, {"n_control_points": 40}, {}],
)
def test_every_way_to_fit_leaves_them_out(outline, arguments):
    data, moved_points = contaminated(outline("hand620_closed"), 0.01, 0.1, seed=4)
    fit = fit_curve(data, outliers=True, **arguments)
    assert set(fit.outliers.tolist()) == moved_points
    assert_promise_about_the_rest(fit, data.points)
    assert fit.hausdorff_distance < 0.01 * data.box_diagonal


def test_off_unless_asked_for(outline):
    data, _ = contaminated(outline("hand620_closed"), 0.01, 0.1, seed=4)
    fit = fit_curve(data, tolerance=0.1)
    assert fit.outliers.size == 0
    assert len(fit.contour) == len(data)


def test_indices_are_those_of_the_points_given():
    points = flower(200).points.copy()
    points[60] *= 3.0
    repeated = np.repeat(points, [2] * 100 + [1] * 100, axis=0)
    with pytest.warns(UserWarning, match="dropped 100"):
        fit = fit_curve(repeated, closed=True, tolerance=0.1, outliers=True)
    assert fit.outliers.tolist() == [120, 121]
    assert len(fit.parameters) == 298


def test_corners_and_weights_keep_their_points():
    square = Contour([(0, 0), (4, 0), (4, 4), (0, 4)], closed=True).resampled(160)
    points = square.points.copy()
    points[20] += [0.0, -2.0]
    fit = fit_curve(points, closed=True, tolerance=0.02, outliers=True, corners=[0, 40, 80, 120])
    assert fit.outliers.tolist() == [20]
    assert fit.n_stored_points == 4
    weighted = fit_curve(
        points, closed=True, n_control_points=12, outliers=True, weights=np.ones(160)
    )
    plain = fit_curve(points, closed=True, n_control_points=12, outliers=True)
    assert weighted.rms_distance == pytest.approx(plain.rms_distance, rel=1e-6)


def test_outliers_survive_a_file(tmp_path):
    points = flower(200).points.copy()
    points[199] *= 3.0
    fit = fit_curve(points, closed=True, tolerance=0.1, outliers=True)
    assert fit.status == Status.KEPT
    write(tmp_path / "fit.json", Drawing([fit]))
    assert_array_equal(read(tmp_path / "fit.json").fits[0].outliers, [199])


def test_bad_request():
    with pytest.raises(InvalidInputError, match="outliers must be True or False, got 'auto'"):
        fit_curve(flower(160), tolerance=0.1, outliers="auto")

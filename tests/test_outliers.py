"""Outliers left out on request: found, listed, and the promise about the rest."""

import numpy as np
import pytest
from benchmarks.outliers import contaminated
from benchmarks.outside_metric import two_sided
from numpy.testing import assert_array_equal
from tests.shapes import flower, moved

from shapespline import Contour, Drawing, InvalidInputError, Status, fit_curve, read, write
from shapespline.analysis.outliers import LONGEST_RUN, find_outliers


def assert_promise_about_the_rest(fit, points):
    rest = np.delete(points, fit.outliers, axis=0)
    assert_array_equal(fit.contour.points, rest)
    found = two_sided(fit.curve, rest, closed=fit.closed, step=fit.tolerance / 4)
    assert found.larger <= fit.hausdorff_distance + 1e-9 * fit.contour.box_diagonal
    assert fit.kept
    assert len(fit.parameters) == len(rest)


def test_none_on_clean_outlines(all_outlines):
    for name, contour in all_outlines:
        assert len(find_outliers(contour)) == 0, name


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


@pytest.mark.parametrize("length", range(1, LONGEST_RUN + 2))
def test_several_in_a_row(length):
    points = flower(300).points.copy()
    points[100 : 100 + length] += [7.0, 7.0]
    found = find_outliers(Contour(points, closed=True)).tolist()
    # A longer run may be a feature.
    assert found == (list(range(100, 100 + length)) if length <= LONGEST_RUN else [])


def test_a_real_spike_and_a_real_hairpin_stay():
    x = np.arange(0.0, 10.0, 0.1)
    flank = np.arange(0.1, 4.0, 0.1)
    spike = np.concatenate(
        [
            np.column_stack([x[:50], 0 * x[:50]]),
            np.column_stack([0 * flank + 5.0, flank]),
            np.column_stack([0 * flank + 5.05, flank[::-1]]),
            np.column_stack([x[51:], 0 * x[51:]]),
        ]
    )
    assert len(find_outliers(Contour(spike, closed=False))) == 0


def test_uneven_sampling_is_no_outlier():
    steps = 1000.0 ** np.random.default_rng(5).uniform(0, 1, 300)
    t = 2 * np.pi * np.cumsum(steps) / steps.sum()
    ellipse = np.column_stack([8 * np.cos(t), 5 * np.sin(t)])
    assert len(find_outliers(Contour(ellipse, closed=True))) == 0


def test_neither_motion_nor_start_nor_direction_matter(outline):
    data, _ = contaminated(outline("leaf840_closed"), 0.03, 0.05, seed=7)
    n, found = len(data), find_outliers(data)
    assert len(found) > 0
    turned = Contour(moved(data.points), closed=True)
    assert_array_equal(find_outliers(turned), found)
    rolled = Contour(np.roll(data.points, 123, axis=0), closed=True)
    assert_array_equal(np.sort((find_outliers(rolled) - 123) % n), found)
    reverse = Contour(data.points[::-1], closed=True)
    assert_array_equal(np.sort(n - 1 - find_outliers(reverse)), found)


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

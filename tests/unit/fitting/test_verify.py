"""What becomes of a curve: its distances, and a status that is a true sentence."""

import time

import pytest
from tests.support.make_fit import fit_of, wave

from checks import two_sided
from shapespline import Contour, Status
from shapespline.fitting.verify import final_status, status_of, verified_fit
from shapespline.geometry import two_sided_distance
from shapespline.monitor import Monitor

FIT = fit_of(wave(), noise=0.1)


@pytest.mark.parametrize("part", [None, 0.5, 1.0, 2.0])
def test_a_fit_says_what_an_outside_checker_finds(part):
    distances = two_sided_distance(FIT.spline, FIT.contour)
    tolerance = None if part is None else part * distances.hausdorff_distance
    fit = verified_fit(FIT.contour, FIT.spline, tolerance=tolerance, method="by hand")
    found = two_sided(fit.curve, FIT.contour.points, closed=False, step=0.01)
    assert found.larger <= fit.hausdorff_distance <= 1.002 * found.larger + 0.01
    assert found.forward == pytest.approx(fit.max_distance, rel=1e-9)
    assert fit.kept is (part is None or part >= 1)
    assert fit.status == (Status.KEPT if fit.kept else Status.EXCEEDED)
    assert f"{fit.max_distance:.6g}" in fit.status.value
    if tolerance is None:
        assert fit.tolerance == fit.hausdorff_distance
        assert "no tolerance asked for" in fit.status.value
    else:
        assert fit.tolerance == tolerance
        assert f"tolerance {tolerance:.6g} {'kept' if fit.kept else 'not kept'}" in fit.status.value


def test_repeated_points_have_parameters_of_their_own():
    points = FIT.contour.points
    contour = Contour.silently(points[[0, 0, 1, 2, 2, 2, *range(3, len(points))]], closed=False)
    fit = verified_fit(contour, FIT.spline, tolerance=1.0, method="by hand")
    assert len(fit.parameters) == len(points) + 3
    assert fit.parameters[0] == fit.parameters[1]
    assert fit.parameters[3] == fit.parameters[4] == fit.parameters[5]


def test_who_ended_a_search_is_said():
    found = two_sided_distance(FIT.spline, FIT.contour)
    fit = verified_fit(FIT.contour, FIT.spline, tolerance=9.0, method="x", distances=found)
    assert final_status(fit, Monitor()) is fit.status
    cancelled = Monitor(lambda record: True)
    cancelled.ends(5)
    said = final_status(fit, cancelled)
    assert said == Status.CANCELLED
    assert said.value.startswith("cancelled by the callback after")
    assert said.value.endswith(status_of(found, 9.0).value)
    late = Monitor(time_limit=1e-9)
    time.sleep(1e-4)
    late.ends(5)
    said = final_status(fit, late)
    assert said == Status.BUDGET
    assert "time limit of 1e-09 s ran out, give more" in said.value

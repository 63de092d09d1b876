"""How many points fits store: no more than pinned; ``python -m benchmarks.quality --pin``."""

import numpy as np
import pytest
from tests.support.promise import checked
from tests.support.shapes import flower
from tests.support.sizes import pinned

from shapespline import fit_curve
from shapespline.fitting.request import tolerance_length

SIZES = pinned()
BOUNDS = [size for size in SIZES if size.most is not None and "alone" not in size.form]


@pytest.mark.parametrize("size", BOUNDS, ids=lambda size: "-".join(map(str, size[:4])))
@pytest.mark.slow
def test_no_more_points_than_the_bound(outline, size):
    contour = outline(size.outline)
    tolerance = tolerance_length(f"{size.percent}%", contour)
    found = fit_curve(
        contour, tolerance=tolerance, form=size.form, corners=size.corners, character="fewest"
    )
    assert checked(found, tolerance).n_stored_points <= size.most


@pytest.mark.slow
@pytest.mark.parametrize("percent", [0.5, 0.1, 0.02])
def test_the_promise_and_the_sizes_hold_on_every_outline_of_the_corpus(all_outlines, percent):
    today = {size.outline: size.points for size in SIZES if size.points and size.percent == percent}
    ratios = {}
    for name, contour in all_outlines:
        tolerance = tolerance_length(f"{percent}%", contour)
        fit = checked(fit_curve(contour, tolerance=tolerance, character="fewest"), tolerance)
        ratios[name] = fit.n_stored_points / today[name]
    assert len(ratios) == len(today)
    # The search is local: another compiler may find other optima, on the whole as good ones.
    assert np.exp(np.mean(np.log(list(ratios.values())))) <= 1.02
    assert max(ratios.values()) <= 1.5, ratios


@pytest.mark.parametrize("form", ["pieces", "spline"])
def test_many_points_cost_no_more_control_points_than_few(form):
    few, many = (
        fit_curve(flower(n, depth=3.0), tolerance=0.02, form=form) for n in (2_000, 200_000)
    )
    assert few.kept
    assert many.kept
    # The polylines differ by the sagitta of the coarser one, far below the tolerance: what is left
    # is the luck of a greedy search.
    assert many.n_stored_points <= 1.1 * few.n_stored_points + 1

"""Data as it comes: each case ends with a verified promise and a status that is a true sentence."""

import warnings

import numpy as np
import pytest

from checks import two_sided
from shapespline import Contour, DroppedPointsWarning, Status, fit_curve
from shapespline.fitting.request import tolerance_length

# Noise alone looks shuffled, and is; few points of a ring are sparse: what comes of them has to be
# true all the same.
pytestmark = pytest.mark.filterwarnings(
    "ignore::shapespline.ShuffledPointsWarning", "ignore::shapespline.SparsePointsWarning"
)


def ring(n, radius=10.0):
    t = 2 * np.pi * np.arange(n) / n
    return radius * np.column_stack([np.cos(t), np.sin(t)])


def leaf(n=200):
    t = 2 * np.pi * np.arange(n) / n
    return np.column_stack([(5 + np.cos(3 * t)) * np.cos(t), (3 + np.sin(2 * t)) * np.sin(t)])


def uneven(ratio):
    """Steps along an ellipse that vary by a ratio, not in any order."""
    steps = ratio ** np.random.default_rng(5).uniform(0, 1, 300)
    t = 2 * np.pi * np.cumsum(steps) / steps.sum()
    return np.column_stack([8 * np.cos(t), 5 * np.sin(t)])


def staircase():
    """The boundary of the pixels of a disc."""
    y, x = np.mgrid[-14:15, -14:15]
    inside = x**2 + y**2 <= 150
    widths = [np.flatnonzero(row) for row in inside if row.any()]
    low = next(i for i, row in enumerate(inside) if row.any())
    right, left = [], []
    for k, row in enumerate(widths):
        right += [(row[-1] + 1, low + k), (row[-1] + 1, low + k + 1)]
        left += [(row[0], low + k), (row[0], low + k + 1)]
    return np.array(right + left[::-1], dtype=float)


def hairpin():
    x = np.linspace(0, 10, 60)
    return np.concatenate([np.column_stack([x, 0 * x]), np.column_stack([x[::-1], 0 * x + 0.05])])


def cusp():
    t = np.linspace(-1, 1, 121)
    return np.column_stack([t**2, t**3])


def eight(n=240):
    t = 2 * np.pi * np.arange(n) / n
    return np.column_stack([np.sin(t), np.sin(t) * np.cos(t)])


def spike():
    points = ring(120)
    points[30] *= 2.0
    return points


CASES = {
    "repeated points": (np.repeat(leaf(80), 3, axis=0), True),
    "returning to a point": (np.concatenate([leaf(60), leaf(60)]), True),
    "uneven spacing": (uneven(1000.0), True),
    "uneven spacing, open": (uneven(1000.0)[:250], False),
    "self-intersection": (eight(), True),
    "self-intersection, open": (eight()[:200], False),
    "hairpin": (hairpin(), False),
    "hairpin, closed": (hairpin(), True),
    "there and back": (np.concatenate([hairpin()[:60], hairpin()[58::-1]]), False),
    "cusp": (cusp(), False),
    "spike": (spike(), True),
    "pixel staircase": (staircase(), True),
    "nearly closed": (leaf(200)[:-2], False),
    "nearly closed, by rounding": (np.vstack([leaf(), leaf()[:1] + 1e-13]), True),
    "tiny numbers": (1e-9 * leaf(), True),
    "large numbers": (1e9 * leaf(), True),
    "far from the origin": (leaf() + np.array([1e7, -3e7]), True),
    "very far from the origin": (leaf() + 1e11, True),
    "flat": (np.column_stack([np.linspace(0, 9, 50), np.zeros(50)]), False),
    "nearly flat": (np.column_stack([np.linspace(0, 9, 50), 1e-13 * np.arange(50) % 3]), False),
    "flat, closed": (leaf() * [1, 0], True),
    "zigzag": (np.column_stack([np.arange(60.0), np.arange(60) % 2]), False),
    "noise alone": (np.random.default_rng(3).normal(size=(80, 2)), True),
    "two points": (np.array([(0.0, 0.0), (1.0, 2.0)]), False),
    "three points": (np.array([(0.0, 0.0), (1.0, 2.0), (2.0, 0.0)]), True),
}
for count in (5, 7, 12, 25, 50):
    CASES[f"ring of {count}"] = (ring(count), True)
    CASES[f"arc of {count}"] = (ring(2 * count)[:count], False)


def contour_of(name):
    points, closed = CASES[name]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DroppedPointsWarning)
        return Contour(points, closed)


def assert_true(fit):
    """The distances against an outside sampler, the status against the distances."""
    contour = fit.contour
    # Coordinates are known to their own rounding, which far from the origin is what counts.
    rounding = 1e-9 * contour.box_diagonal + 8 * np.spacing(np.abs(contour.points).max())
    step = max(fit.tolerance / 4, contour.length / 20_000)
    found = two_sided(fit.curve, contour.points, closed=contour.closed, step=step)
    assert found.larger <= fit.hausdorff_distance + rounding
    assert np.isfinite(fit.control_points).all()
    assert len(fit.parameters) == contour.n_given
    assert fit.kept == (fit.hausdorff_distance <= fit.tolerance)
    assert fit.kept == (fit.status == Status.KEPT)
    assert ("not kept" in fit.status.value) == (not fit.kept)


@pytest.mark.parametrize("percent", [2.0, 0.1])
@pytest.mark.parametrize("form", ["pieces", "spline"])
@pytest.mark.parametrize("name", list(CASES))
@pytest.mark.slow
def test_within_a_tolerance(name, form, percent):
    contour = contour_of(name)
    tolerance = tolerance_length(f"{percent}%", contour)
    fit = fit_curve(contour, tolerance=tolerance, form=form)
    assert fit.tolerance == tolerance
    assert_true(fit)
    if form == "pieces":
        # A line from each point to the next keeps every tolerance above rounding.
        assert fit.kept
        assert fit.n_stored_points <= len(contour) + 1


@pytest.mark.parametrize("name", list(CASES))
@pytest.mark.slow
def test_with_no_parameter_at_all(name):
    contour = contour_of(name)
    if len(contour) < 4:
        pytest.skip("a cubic needs four points")
    fit = fit_curve(contour)
    assert_true(fit)
    assert fit.tolerance == fit.hausdorff_distance

"""What an attack from outside has found once about fairness: hooks, waves, standstill."""

from __future__ import annotations

import re

import numpy as np
import pytest
from benchmarks.attack.judge import NEAR_CUSP
from benchmarks.attack.options import drawn_options
from benchmarks.attack.shapes import drawn

import shapespline as ss
from checks import hooks, polyline_of, self_crossings, speed_ratio
from shapespline.engines.spline.fairness import MORE_TURN

pytestmark = pytest.mark.filterwarnings("ignore::shapespline.DroppedPointsWarning")


def attacked(seed):
    """What a seed of the attack asks for, and the fit that this gives."""
    shape = drawn(seed)
    options = drawn_options(np.random.default_rng([seed, 1]), shape.points, shape.closed)
    return options, ss.fit_curve(shape.points, **options)


@pytest.mark.slow
@pytest.mark.parametrize("tolerance", [0.4, 0.5, 0.8])
def test_pixel_chains_get_curves_without_hooks(tolerance):
    for radius in (30, 60, 90, 140):
        for waves in (3, 5):
            t = np.linspace(0, 2 * np.pi, 40 * radius, endpoint=False)
            y = 0.6 * radius * np.sin(t) + 0.1 * radius * np.sin(waves * t)
            chain = np.round(np.column_stack([radius * np.cos(t), y]))
            chain = chain[(chain != np.roll(chain, 1, axis=0)).any(axis=1)]
            fit = ss.fit_curve(chain, closed=True, tolerance=tolerance)
            assert fit.kept
            assert not len(hooks(fit.pieces, chain, closed=True, tolerance=tolerance))


def test_no_piece_of_noisy_points_nearly_stands_still(outline):
    # Two pieces did before.
    fit = ss.fit_curve(outline("loop500_n1_open"), tolerance="0.5%")
    assert speed_ratio(fit.pieces) >= NEAR_CUSP


def turned_wrongly(fit):
    """How far, radians, the curve of a convex outline that runs to the left turns right."""
    chords = np.diff(fit.curve(np.linspace(0, 1, 20_011)), axis=0)
    chords = chords[np.hypot(*chords.T) > 0]
    (ax, ay), (bx, by) = chords[:-1].T, chords[1:].T
    turns = np.arctan2(ax * by - ay * bx, ax * bx + ay * by)
    return -turns[turns < 0].sum()


@pytest.mark.parametrize(
    ("n", "scale", "tolerance"), [(60, (5.0, 1.0), "0.02%"), (30, (1.2, 0.8), "0.1%")]
)
def test_sparse_points_of_a_smooth_outline_make_no_waves(n, scale, tolerance):
    t = 2 * np.pi * np.arange(n) / n
    points = np.column_stack([np.cos(t), np.sin(t)]) * scale
    with pytest.warns(ss.SparsePointsWarning, match="tolerance=") as caught:
        fit = ss.fit_curve(points, closed=True, tolerance=tolerance)
    assert fit.kept
    assert turned_wrongly(fit) < 0.5 * MORE_TURN * 2 * np.pi  # to and fro
    # What the sentence says is true.
    enough = float(re.search(r"or tolerance=(\S+) for", str(caught[0].message))[1])
    smooth = ss.fit_curve(points, closed=True, tolerance=enough)
    assert smooth.kept
    assert not len(smooth.corners)
    assert turned_wrongly(smooth) == pytest.approx(0.0, abs=1e-6)
    assert smooth.n_stored_points < 10


# Ends of strokes beside themselves, one on itself; a smooth outline; weights; a comb's corners; a
# row of pixels that turns by 45 degrees exactly.
@pytest.mark.slow
@pytest.mark.parametrize("seed", [20036, 20060, 20110, 21161, 20781, 22527, 71411])
def test_no_repair_and_no_joint_makes_a_hook(seed):
    fit = attacked(seed)[1]
    assert fit.kept
    found = hooks(fit.pieces, fit.contour.points, closed=fit.closed, tolerance=fit.tolerance)
    assert not len(found)


# Walks and spirals through points, lines alone, corners free, one spline; weights.
@pytest.mark.slow
@pytest.mark.parametrize("seed", [30302, 30555, 30783, 31821, 32855, 32950, 33018, 33533, 500733])
def test_hooks_that_are_left_are_fitted_away(seed):
    asked, fit = attacked(seed)
    assert fit.kept
    found = hooks(fit.pieces, fit.contour.points, closed=fit.closed, tolerance=fit.tolerance)
    ends = fit.pieces[0].control_points[0], fit.pieces[-1].control_points[-1]
    for end, wanted in zip(ends, asked.get("end_tangents", (None, None)), strict=True):
        if wanted is not None:
            found = found[np.hypot(*(found - end).T) > fit.tolerance]
    assert not len(found)
    assert "turns back" not in fit.status.value


@pytest.mark.slow
def test_a_hook_that_stays_is_said(monkeypatch):
    monkeypatch.setattr("shapespline.fitting.repair.hooks.WHOLE", ())
    fit = attacked(30302)[1]
    assert fit.kept
    assert fit.status.value.endswith("it turns back where the data do not")


def test_a_sharp_tip_at_the_seam_is_not_crossed():
    options, fit = attacked(1160723)
    # The loop was a third of the tolerance long.
    fine = polyline_of(fit.curve, 0.05 * options["tolerance"])
    assert fit.kept
    assert self_crossings(fine) == 0

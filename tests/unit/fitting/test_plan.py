"""Which strategies are asked: no search for curves where lines alone may follow the points."""

from __future__ import annotations

import numpy as np
import pytest

import shapespline as ss
from shapespline.fitting import plan
from shapespline.fitting.strategies import Pieces

N = 300
T = np.linspace(0, 2 * np.pi, N, endpoint=False)


def ring(n, noise):
    t = np.linspace(0, 2 * np.pi, n, endpoint=False)
    points = 10 * np.column_stack([np.cos(t), 0.6 * np.sin(t)])
    return points + np.random.default_rng(3).normal(0, noise, points.shape)


@pytest.fixture
def asked(monkeypatch):
    """How often pieces are searched for."""
    counted = []
    propose = Pieces.propose

    def counting(self, problem, monitor):
        counted.append(len(problem.contour))
        yield from propose(self, problem, monitor)

    monkeypatch.setattr(Pieces, "propose", counting)
    return counted


def test_rough_points_get_lines_at_once(asked):
    fit = ss.fit_curve(ring(N, 0.5), closed=True, tolerance=0.1)
    assert fit.kept
    assert {piece.kind for piece in fit.pieces} == {"line"}
    assert fit.n_stored_points > 0.5 * N
    assert N not in asked


def test_the_same_curve_as_with_a_search_for_pieces(asked, monkeypatch):
    lines = ss.fit_curve(ring(N, 0.5), closed=True, tolerance=0.1)
    monkeypatch.setattr(plan, "NO_CURVE_PART", 1.0)
    assert ss.fit_curve(ring(N, 0.5), closed=True, tolerance=0.1) == lines
    assert N in asked


@pytest.mark.parametrize(
    "points",
    [
        ring(N, 0.02),  # noise within the tolerance
        ring(60, 0.5),  # few points
        ring(N, 0.0) + 0.4 * np.column_stack([np.cos(40 * T), np.sin(41 * T)]),  # they bend evenly
    ],
)
def test_other_points_get_curves(points, asked):
    assert ss.fit_curve(points, closed=True, tolerance=0.1).kept
    assert len(points) in asked

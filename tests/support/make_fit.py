"""Fits with made-up but consistent numbers, for writers and plots."""

from __future__ import annotations

import numpy as np

from shapespline.monitor import Iteration
from shapespline.values.contour import Contour
from shapespline.values.curve import BSplineCurve
from shapespline.values.drawing import Drawing
from shapespline.values.fit import Fit, Status
from shapespline.values.knots import clamped_knots, periodic_knots


def blob(n_control_points=12, degree=3, *, centre=(0.0, 0.0), radius=10.0, seed=0):
    """A closed smooth curve around a centre."""
    rng = np.random.default_rng(seed)
    angle = 2 * np.pi * np.arange(n_control_points) / n_control_points
    reach = radius * (1 + 0.3 * rng.uniform(-1, 1, n_control_points))
    points = np.column_stack([np.cos(angle), np.sin(angle)]) * reach[:, None] + centre
    return BSplineCurve(periodic_knots(n_control_points, degree), points, degree, periodic=True)


def wave(n_control_points=9, degree=3, *, seed=1, interior=None):
    """An open curve from left to right."""
    rng = np.random.default_rng(seed)
    points = np.column_stack(
        [np.linspace(0.0, 20.0, n_control_points), rng.uniform(-5, 5, n_control_points)]
    )
    return BSplineCurve(clamped_knots(n_control_points, degree, interior), points, degree)


def fit_of(curve, *, n_points=60, noise=0.05, seed=2, **fields):
    """A fit whose data lie beside the curve, with distances measured at its parameters."""
    rng = np.random.default_rng(seed)
    begin, end = curve.domain
    u = np.linspace(begin, end, n_points, endpoint=not curve.periodic)
    contour = Contour(curve(u) + noise * rng.standard_normal((n_points, 2)), curve.periodic)
    distance = np.hypot(*(curve(u) - contour.points).T)
    known = {
        "spline": curve,
        "contour": contour,
        "parameters": u,
        "max_distance": float(distance.max()),
        "rms_distance": float(np.sqrt(np.mean(distance**2))),
        "hausdorff_distance": float(1.2 * distance.max()),
        "tolerance": float(1.5 * distance.max()),
        "status": Status.KEPT.saying("kept: made up for a test"),
        "history": history(),
        "method": "levenberg-marquardt",
    }
    return Fit(**(known | fields))


def history(n=8, rate=0.5):
    """Records of a run that converges linearly."""
    return tuple(
        Iteration(
            iteration=k,
            cost=100.0 * rate ** (2 * k) / 3,
            paper_error=rate**k / 3,
            gradient_norm=rate**k / 7,
            evaluations=2 * k + 1,
            step=0.0 if k == 0 else 1.0 / 3,
            seconds=0.1 * k,
        )
        for k in range(n)
    )


def nested(**fields):
    """A ring with an island in its hole, and an open stroke beside it."""
    fits = [
        fit_of(blob(12, radius=10.0, seed=3), **fields),
        fit_of(blob(9, radius=5.0, seed=4), **fields),
        fit_of(blob(7, radius=2.0, seed=5), **fields),
        fit_of(wave(), **fields),
    ]
    return Drawing(fits, parents=[-1, 0, 1, -1])

"""Curves and outlines to test with."""

from __future__ import annotations

import numpy as np

from shapespline.contour import Contour
from shapespline.curve import BSplineCurve
from shapespline.knots import clamped_knots, periodic_knots


def random_curve(rng, degree, n_control_points, *, periodic=False, multiple=True):
    """A curve on unevenly spaced knots, some of them repeated up to degree times."""
    m = n_control_points
    n_inside = m - 1 if periodic else m - degree - 1
    inside = np.sort(rng.uniform(0.02, 0.98, n_inside))
    if multiple and n_inside > 1:
        start = int(rng.integers(n_inside - 1))
        inside[start : start + int(rng.integers(2, degree + 1) if degree > 1 else 1)] = inside[
            start
        ]
    points = rng.uniform(-10, 10, (m, 2))
    if periodic:
        knots = periodic_knots(m, degree, np.concatenate([[0.0], inside, [1.0]]))
    else:
        knots = clamped_knots(m, degree, inside)
    return BSplineCurve(knots, points, degree, periodic)


def on_circle(n, radius=1.0, centre=(0.0, 0.0), turns=1.0):
    """Points at equal angles, counterclockwise; the last one short of the first."""
    angle = 2 * np.pi * turns * np.arange(n) / n
    return np.column_stack([np.cos(angle), np.sin(angle)]) * radius + centre


def flower(n=240, petals=5, depth=2.0):
    """A closed smooth outline of radius 10 with petals."""
    t = 2 * np.pi * np.arange(n) / n
    r = 10 + depth * np.cos(petals * t)
    return Contour(np.column_stack([r * np.cos(t), r * np.sin(t)]), closed=True)


def wave(n=200):
    """An open smooth outline, 20 long and 6 high."""
    t = np.linspace(0, 1, n)
    return Contour(np.column_stack([20 * t, 3 * np.sin(7 * t) * (1 - 0.5 * t)]), closed=False)


def rectangle(n_a, n_b, spacing=1.0):
    """A closed rectangle of n_a by n_b steps, corners at its points."""
    a, b = np.arange(n_a), np.arange(n_b)
    sides = [
        np.column_stack([a, 0 * a]),
        np.column_stack([n_a + 0 * b, b]),
        np.column_stack([n_a - a, n_b + 0 * a]),
        np.column_stack([0 * b, n_b - b]),
    ]
    return Contour(spacing * np.concatenate(sides), closed=True)


def moved(points, angle=0.0, scale=1.0, shift=(0.0, 0.0)):
    """Points turned about the origin, scaled, shifted."""
    c, s = scale * np.cos(angle), scale * np.sin(angle)
    return np.asarray(points) @ np.array([[c, s], [-s, c]]) + np.asarray(shift)

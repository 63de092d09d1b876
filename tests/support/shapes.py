"""Curves and outlines to test with, data beside them, and the degrees and closures to try."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from tests.support import reference

import shapespline as ss
from shapespline.engines.least_squares.problem import CurveProblem
from shapespline.errors import DegenerateContourError
from shapespline.paper import SENSIBLE, initial_curve
from shapespline.values.contour import Contour
from shapespline.values.curve import BSplineCurve
from shapespline.values.knots import clamped_knots, periodic_knots

EPS = reference.EPS


degrees = pytest.mark.parametrize("degree", range(1, 10))


closures = pytest.mark.parametrize("periodic", [False, True], ids=["clamped", "periodic"])


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


def some_curve(degree, periodic, seed=0, extra=8):
    """A random curve that is the same every time, of degree + 1 + extra control points."""
    rng = np.random.default_rng([degree, periodic, seed])
    return random_curve(rng, degree, degree + 1 + extra, periodic=periodic)


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


class Start:
    """Anything with a spline and parameters."""

    def __init__(self, spline, parameters):
        self.spline, self.parameters = spline, np.asarray(parameters, dtype=float)


def plain_start(contour, length=None, *, reading=SENSIBLE, **arguments):
    """The maxima of H as control points, and nothing said on how to go on from there."""
    reading = replace(reading, start="cpda-maxima", closing_point=False)
    try:
        start = initial_curve(contour, length, reading=reading, **arguments)
    except DegenerateContourError:  # fewer than a cubic needs
        reading = replace(reading, start="cpda-halved")
        start = initial_curve(contour, length, reading=reading, n_control_points=4, **arguments)
    return Start(start.spline, start.parameters)


class Case:
    """A curve, data near it, parameters in order, weights; and how much rounding they stand."""

    def __init__(self, degree, periodic, *, m=None, n=45, seed=0, noise=1.0, multiple=True):
        rng = np.random.default_rng([degree, periodic, seed])
        m = degree + 6 if m is None else m
        self.curve = random_curve(rng, degree, m, periodic=periodic, multiple=multiple)
        self.parameters = np.sort(rng.uniform(0, 1, n))
        self.points = self.curve(self.parameters) + rng.normal(0, noise, (n, 2))
        self.weights = rng.uniform(0.1, 3, n)
        self.n, self.m, self.degree = n, m, degree

    def problem(self, weighted=True, **options):
        return CurveProblem(self.points, self.curve, self.weights if weighted else None, **options)

    def x(self):
        return np.concatenate([self.curve.control_points.ravel(), self.parameters])

    def dense(self, weighted=True, stray_weight=0.0):
        return reference.dense(
            self.curve,
            self.points,
            self.parameters,
            self.weights if weighted else None,
            stray_weight,
        )

    def off(self, dense, derivative):
        """Bound of the rounding of points and tangents, (k, 2), k with strays."""
        u = self.parameters
        if len(dense.residuals) > self.n:
            strays = reference.stray_residuals(
                self.curve.knots, self.degree, self.points, u, 1.0, self.curve.periodic
            )
            u = np.array([*u, *(s.parameter for s in strays)])
            slack = 4 * EPS * 20 * (1 - derivative)  # the targets are rounded, too
        else:
            slack = 0
        bound = reference.evaluation_bound(
            self.curve.knots,
            self.curve.control_points,
            self.degree,
            u,
            self.curve.periodic,
            derivative,
        )
        return bound + slack + EPS * np.abs(dense.residuals) * (1 - derivative)


def outlines(count):
    t = np.linspace(0, 2 * np.pi, 90, endpoint=False)
    for index in range(count):
        radius = 5 + np.sin((2 + index % 5) * t + index)
        yield ss.Contour(np.column_stack([radius * np.cos(t), radius * np.sin(t)]), closed=True)


def shaken(contour, percent, seed):
    """The contour with noise of so many per cent of its box diagonal in each coordinate."""
    deviation = percent / 100 * contour.box_diagonal
    noise = np.random.default_rng(seed).normal(0, deviation, contour.points.shape)
    return Contour(contour.points + noise, contour.closed)


def airfoil(camber, power, n=40):
    """A cambered airfoil whose trailing edge is sharp and thin for long; from there around."""
    x = 0.5 * (1 + np.cos(np.pi * np.arange(n) / n))
    middle = camber * np.sin(np.pi * x**1.5)
    half = 0.12 * np.sqrt(x) * (1 - x) ** power
    upper = np.column_stack([x, middle + half])
    lower = np.column_stack([x, middle - half])[:0:-1]
    return np.concatenate([upper, [(0.0, 0.0)], lower])


def ribbon(waves, half, n=150):
    """A closed outline around a wavy band that is thinner than the tolerance."""
    x = np.linspace(-1, 1, n)
    middle = 0.1 * np.sin(waves * x)
    low, high = middle - half * (1 + 0.5 * np.sin(5 * x)), middle + half * (1 + 0.5 * np.cos(4 * x))
    return np.concatenate([np.column_stack([x, low]), np.column_stack([x, high])[::-1]])

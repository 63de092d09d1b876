"""Pieces of curves, made by hand."""

from __future__ import annotations

import numpy as np

from shapespline.values.piece import Piece

LINE = np.array([0.0, 0, 1, 1])
QUADRATIC = np.array([0.0, 0, 0, 1, 1, 1])
CUBIC = np.array([0.0, 0, 0, 0, 1, 1, 1, 1])


def bezier(*points):
    degree = len(points) - 1
    kind = "line" if degree == 1 else "bezier"
    return Piece(kind, degree, np.repeat([0.0, 1.0], degree + 1), np.array(points, dtype=float))


def square(side=1.0, at=(0.0, 0.0)):
    x, y = at
    corners = [(x, y), (x + side, y), (x + side, y + side), (x, y + side)]
    return [bezier(corners[i], corners[(i + 1) % 4]) for i in range(4)]


def piece(knots, points):
    degree = len(knots) - len(points) - 1
    kind = "line" if degree == 1 else "bezier" if len(points) == degree + 1 else "spline"
    return Piece(kind, degree, np.asarray(knots, dtype=float), np.asarray(points, dtype=float))

"""Outlines of teeth, of which the vertices alone are given."""

from __future__ import annotations

import numpy as np


def star(n_tips):
    """A star: radii 10 and 7 by turns."""
    angle = np.arange(2 * n_tips) * np.pi / n_tips
    radius = np.where(np.arange(2 * n_tips) % 2, 7.0, 10.0)
    return radius[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])


def comb(n_teeth, width, height):
    """Teeth as far apart as they are wide, open."""
    x = width * np.repeat(np.arange(2.0 * n_teeth), 2)
    return np.column_stack([x, height * np.tile([0.0, 1.0, 1.0, 0.0], n_teeth)])


def finger_plate(width, height, n_across, n_up, depth):
    """A plate whose edges are finger joints: odd numbers of fingers, corners whole."""
    corners = np.array([(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)])
    inward = np.array([(0.0, 1.0), (-1.0, 0.0), (0.0, -1.0), (1.0, 0.0)])
    points = []
    for k, n in enumerate((n_across, n_up, n_across, n_up)):
        begin, end = corners[k], corners[(k + 1) % 4]
        for j in range(n):
            offset = depth * inward[k] * (j % 2)
            points += [begin + (end - begin) * part / n + offset for part in (j, j + 1)]
    row = np.array(points)
    return row[(row != np.roll(row, 1, axis=0)).any(axis=1)]

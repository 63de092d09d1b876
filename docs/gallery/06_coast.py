"""
A coast at three scales
=======================

A fractal coast of 3072 sides (Koch's). A coarse tolerance keeps bays, a fine one every step.
"""

import numpy as np
from canvas import curves, dots, panels

import shapespline as ss

coast = np.exp(2j * np.pi * np.array([0, 2, 1, 0]) / 3)
for _ in range(5):
    step = np.diff(coast) / 3
    tip = coast[:-1] + step + step * np.exp(1j * np.pi / 3)
    corners = [coast[:-1], coast[:-1] + step, tip, coast[:-1] + 2 * step]
    coast = np.append(np.column_stack(corners).ravel(), coast[-1])
points = np.column_stack([coast.real, coast.imag])[:-1]

for axes, tolerance in zip(panels(3), ("5%", "2%", "0.8%"), strict=True):
    fit = ss.fit_curve(points, closed=True, tolerance=tolerance, effort="fast")
    dots(axes, points, 1.5)
    curves(axes, [fit])
    axes.set_title(f"{tolerance}: {fit.n_stored_points} points")

"""
A band of noise
===============

How far the curve would move with other noise of the same size: twenty fits to it with new noise.
"""

import numpy as np
from canvas import BLUE, curves, dots, outline, panels

import shapespline as ss

points = outline("loop500_n1_open")
fit = ss.fit_curve(points, closed=False)
random = np.random.default_rng(0)
on_curve = fit.curve(fit.parameters)
(axes,) = panels()
dots(axes, points)
for _ in range(20):
    moved = on_curve + random.normal(0, fit.rms_distance, on_curve.shape)
    again = ss.fit_curve(moved, closed=False, n_control_points=fit.n_control_points)
    axes.plot(*again.curve(np.linspace(0, 1, 1000)).T, color=BLUE, lw=4, alpha=0.06)
curves(axes, [fit], points=False)
axes.set_title(f"{fit.n_stored_points} points; rms {fit.rms_distance:.2f}")

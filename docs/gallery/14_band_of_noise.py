"""
A band of noise
===============

How far the curve would move with other noise of the same size: twenty fits to it with new noise.
"""

import numpy as np
from canvas import GREEN, closer, curves, dots, outline, panels

import shapespline as ss

points = outline("loop500_n1_open")
fit = ss.fit_curve(points, closed=False)
random = np.random.default_rng(0)
on_curve = fit.curve(fit.parameters)
whole, near = panels(2)
for axes in (whole, near):
    dots(axes, points, 3 if axes is whole else 6)
for _ in range(20):
    moved = on_curve + random.normal(0, fit.rms_distance, on_curve.shape)
    again = ss.fit_curve(moved, closed=False, n_control_points=fit.n_control_points)
    for axes in (whole, near):
        axes.plot(*again.curve(np.linspace(0, 1, 1000)).T, color=GREEN, lw=1, alpha=0.5)
for axes in (whole, near):
    curves(axes, [fit], points=False)
closer(whole, near, fit.curve([0.25])[0], 12 * fit.rms_distance)
whole.set_title(f"{fit.n_stored_points} points; rms {fit.rms_distance:.2f}")
near.set_title("twenty times with new noise")

"""
Known errors, and points that went wrong
========================================

Half of the outline was measured four times less exactly, and six points are wrong. ``sigma`` tells
the first, ``loss="tukey"`` shrugs off the second; the strip holds the true curve at each place with
95 %.
"""

import numpy as np
from canvas import GREEN, closer, curves, dots, panels

import shapespline as ss

angle = np.linspace(0, 2 * np.pi, 220, endpoint=False)
r = 10 + 1.6 * np.cos(5 * angle)
sigma = np.where(angle < np.pi, 0.05, 0.2)
random = np.random.default_rng(3)
points = np.column_stack([r * np.cos(angle), r * np.sin(angle)])
points += random.normal(0, 1, points.shape) * sigma[:, None]
points[random.choice(220, 6, replace=False)] *= random.uniform(0.6, 1.3, (6, 1))

fit = ss.fit_curve(points, closed=True, sigma=sigma, loss="tukey")
band = fit.band(0.95)
whole, near = panels(2)
for axes in (whole, near):
    strip = np.vstack([band.left, band.right[::-1]]).T
    axes.fill(*strip, color=GREEN, alpha=0.35, lw=0)
    dots(axes, points, 4 if axes is whole else 7)
    curves(axes, [fit], points=False)
closer(whole, near, points[110], 2.5)
whole.set_title(f"{fit.n_stored_points} points")
near.set_title(f"half width {band.half_width.min():.2f} to {band.half_width.max():.2f}")

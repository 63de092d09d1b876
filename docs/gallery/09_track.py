"""
A track with jumps
==================

A recorded track scatters, and jumps now and then; the jumps are left out and listed.
"""

import numpy as np
from canvas import ORANGE, curves, dots, outline, panels

import shapespline as ss

points = outline("loop500_n0.2_open")
jumps = np.random.default_rng(4).choice(500, 8, replace=False)
points[jumps] += np.random.default_rng(5).normal(0, 9, (8, 2))
fit = ss.fit_curve(points, closed=False, outliers=True)

(axes,) = panels()
dots(axes, points)
curves(axes, [fit])
axes.plot(*points[fit.outliers].T, "x", color=ORANGE)
axes.set_title(f"{len(fit.outliers)} points left out, {fit.n_stored_points} stored")

"""
The published method
====================

Control points from chord-to-point distance accumulation, then moved together with the
parameters (D-BFGS).
"""

import numpy as np
from canvas import DATA, GREEN, curves, dots, panels

import shapespline as ss

contour = ss.Contour(np.loadtxt(DATA / "paper" / "leaf840.csv", delimiter=","), closed=True)
start = ss.initial_curve(contour, length=2)
fit = ss.optimize(contour, start, method="d-bfgs")

before, after = panels(2)
for axes in (before, after):
    dots(axes, contour.points)
before.plot(*start.curve(np.linspace(0, 1, 3000)).T, color=GREEN, lw=1.5)
before.set_title(f"start: {start.spline.n_control_points} control points")
curves(after, [fit], points=False)
after.set_title(f"rms {fit.rms_distance:.4f} after {fit.history[-1].iteration} iterations")

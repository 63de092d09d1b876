"""
An airfoil and its curvature
============================

69 points of NACA 2412, ends exact; below, the curvature of the curve along the chord.
"""

import matplotlib.pyplot as plt
import numpy as np
from canvas import BLUE, curves, dots, outline

import shapespline as ss

points = outline("naca2412")
fit = ss.fit_curve(points, closed=False, tolerance="0.02%", ends="fixed", form="spline")

_, (above, below) = plt.subplots(2, 1, figsize=(7, 4.6), layout="constrained")
dots(above, points, 6)
curves(above, [fit])
above.set_aspect("equal")
above.set_title(f"69 points, {fit.n_stored_points} stored, within 0.02 % of the size")
u = np.linspace(0, 1, 3000)
(dx, dy), (ddx, ddy) = fit.curve(u, 1).T, fit.curve(u, 2).T
below.plot(fit.curve(u)[:, 0], (dx * ddy - dy * ddx) / np.hypot(dx, dy) ** 3, color=BLUE, lw=1)
below.set(xlabel="chord", ylabel="curvature", yscale="symlog")

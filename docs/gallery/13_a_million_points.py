"""
A million points
================

The promise is measured on every one of them.
"""

import time

import numpy as np
from canvas import curves, panels

import shapespline as ss

t = np.linspace(0, 2 * np.pi, 1_000_000, endpoint=False)
r = 10 + 2 * np.sin(5 * t) + np.cos(11 * t)
points = np.column_stack([r * np.cos(t), r * np.sin(t)])
began = time.perf_counter()
fit = ss.fit_curve(points, closed=True, tolerance="0.1%")
seconds = time.perf_counter() - began

(axes,) = panels()
curves(axes, [fit], filled=True)
axes.set_title(f"10\u2076 points, {fit.n_stored_points} stored, {seconds:.2f} s")

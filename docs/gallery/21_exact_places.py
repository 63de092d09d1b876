"""
Ends, tangents and points, exactly
==================================

An open curve that begins with a given direction and meets three points to the last bit.
"""

import numpy as np
from canvas import GREEN, curves, dots, outline, panels

import shapespline as ss

points = outline("loop500_open")
through = [0, 120, 250]
tangent = points[8] - points[0]
fit = ss.fit_curve(
    points, closed=False, tolerance="0.5%", end_tangents=(tangent, None), through=through
)
(axes,) = panels()
dots(axes, points)
curves(axes, [fit])
axes.plot(*points[through].T, "o", ms=9, mfc="none", mec=GREEN, mew=2, zorder=6)
off = np.linalg.norm(fit.curve(fit.parameters[through]) - points[through], axis=1).max()
axes.set_title(f"{fit.n_stored_points} points; off by {off:.0e} at the rings")

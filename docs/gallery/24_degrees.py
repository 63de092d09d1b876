"""
Lines, cubics, quintics
=======================

Any degree from 1 to 9; least squares with 28 control points each.
"""

from canvas import curves, dots, outline, panels

import shapespline as ss

points = outline("mdi_fish_c0")
for axes, degree in zip(panels(3), (1, 3, 5), strict=True):
    fit = ss.fit_curve(points, closed=True, n_control_points=28, degree=degree)
    dots(axes, points, 2)
    curves(axes, [fit], points=False)
    axes.plot(*fit.control_points.T, "s", ms=4, mfc="white", mec="#D55E00", zorder=5)
    axes.set_title(f"degree {degree}: rms {fit.rms_distance:.2f}")

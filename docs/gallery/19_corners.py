"""
Corners kept, free, or none
===========================

The default keeps corners; free joints and one smooth spline may need fewer points.
"""

from canvas import curves, outline, panels

import shapespline as ss

points = outline("gameicons_bat-leth_c0")
said = ({}, {"corners": "free"}, {"form": "spline"})
for axes, options in zip(panels(3), said, strict=True):
    fit = ss.fit_curve(points, closed=True, tolerance="0.8%", **options)
    curves(axes, [fit], filled=True)
    words = ", ".join(f"{name}={value!r}" for name, value in options.items()) or "corners kept"
    axes.set_title(f"{words}: {fit.n_stored_points}")

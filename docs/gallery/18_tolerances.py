"""
One shape, four tolerances
==========================

What a smaller tolerance costs in points.
"""

from canvas import curves, outline, panels

import shapespline as ss

points = outline("mdi_saw-blade_c0")
for axes, tolerance in zip(panels(4), ("5%", "2%", "0.5%", "0.05%"), strict=True):
    fit = ss.fit_curve(points, closed=True, tolerance=tolerance)
    curves(axes, [fit], filled=True)
    axes.set_title(f"{tolerance}: {fit.n_stored_points}")

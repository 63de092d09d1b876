"""
Closer where it matters
=======================

Points of weight 10 are kept within a tenth of the tolerance.
"""

import numpy as np
from canvas import GREEN, curves, dots, outline, panels

import shapespline as ss

points = outline("fa_horse_c0")
weights = np.ones(len(points))
head = points[:, 0] > np.quantile(points[:, 0], 0.75)
weights[head] = 10
for axes, given in zip(panels(2), (None, weights), strict=True):
    fit = ss.fit_curve(points, closed=True, tolerance="1.5%", weights=given)
    dots(axes, points, 2)
    curves(axes, [fit])
    if given is not None:
        axes.plot(*points[head].T, ".", ms=3, color=GREEN, mew=0)
    axes.set_title(f"{'even' if given is None else 'closer at the head'}: {fit.n_stored_points}")

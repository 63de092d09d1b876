"""
Points in no order
==================

A cloud is chained to an outline first, with a figure for how sure that is.
"""

import numpy as np
from canvas import GREY, curves, dots, outline, panels

import shapespline as ss

cloud = np.random.default_rng(0).permutation(outline("hand620_closed"))
found = ss.order_points(cloud)
fit = ss.fit_curve(found.shape.longest, tolerance="0.3%")

given, chained = panels(2)
given.plot(*cloud.T, lw=0.2, color=GREY)
given.set_title("as the points stand in the file")
dots(chained, cloud)
curves(chained, [fit])
chained.set_title(f"{fit.n_stored_points} points, confidence {found.confidence:.2f}")

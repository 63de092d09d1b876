"""
What a control point buys
=========================

Root mean square distance against the number of control points, least squares.
"""

import matplotlib.pyplot as plt
from canvas import BLUE, outline

import shapespline as ss

points = outline("hand620_closed")
counts = [12, 16, 20, 26, 34, 44, 58, 76, 100]
fits = [ss.fit_curve(points, closed=True, n_control_points=count) for count in counts]

_, axes = plt.subplots(figsize=(5.4, 3.8), layout="constrained")
axes.loglog(counts, [fit.rms_distance for fit in fits], "o-", color=BLUE, label="rms")
axes.loglog(counts, [fit.hausdorff_distance for fit in fits], "s--", color=BLUE, label="largest")
axes.set_xticks(counts, counts)
axes.minorticks_off()
axes.set(xlabel="control points", ylabel="distance (size 100)")
axes.legend(frameon=False)

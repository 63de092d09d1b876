"""
A mirror symmetry, exactly
==========================

One half is fitted and reflected.
"""

from canvas import curves, dots, outline, panels

import shapespline as ss

points = outline("plane1100_closed")
fit = ss.fit_curve(points, closed=True, tolerance="0.3%", symmetric=True)

(axes,) = panels()
dots(axes, points)
curves(axes, [fit], filled=True)
axes.set_title(f"{fit.n_stored_points} points")

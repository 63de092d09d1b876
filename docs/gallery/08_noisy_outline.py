"""
A noisy outline, no tolerance
=============================

A leaf of 840 points with noise of 0.2 % of its size, as a segmented cell would have
it. The noise is measured.
"""

from canvas import curves, dots, outline, panels

import shapespline as ss

points = outline("leaf840_n0.2_closed")
fit = ss.fit_curve(points, closed=True)

whole, part = panels(2)
for axes in (whole, part):
    dots(axes, points, 4 if axes is whole else 8)
    curves(axes, [fit], points=axes is whole)
x, y = points[200]
part.set(xlim=(x - 8, x + 8), ylim=(y - 8, y + 8))
whole.set_title(f"840 points, {fit.n_stored_points} stored")
part.set_title(f"rms distance {fit.rms_distance:.3f}")

"""
Neighbours with one border
==========================

Fitted together, two neighbours on a map keep one border, to the bit.
"""

import numpy as np
from canvas import GREEN, curves, panels

import shapespline as ss

x = np.linspace(0, 4, 200)
border = np.column_stack([0.4 * np.sin(2 * x) + 0.15 * np.sin(7 * x), x])
west = ss.Contour(np.vstack([border, [(-3, 4), (-3, 0)]]), closed=True)
east = ss.Contour(np.vstack([border[::-1], [(3, 0), (3, 4)]]), closed=True)
drawing = ss.fit_shape(ss.Shape([west, east]), tolerance="0.5%", shared_boundaries=True)

(axes,) = panels()
curves(axes, drawing.fits[:1], filled=True)
curves(axes, drawing.fits[1:], filled=True, color=GREEN)
axes.set_title(f"{sum(fit.n_stored_points for fit in drawing)} points, no gap")

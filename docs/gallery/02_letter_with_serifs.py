"""
A letter at two tolerances
==========================

The same picture, within a pixel and within a fifth of one.
"""

from canvas import curves, image, panels, stored

import shapespline as ss

shape = ss.read(image("NotoSerif-Regular_U0067_512.png"))
for axes, tolerance in zip(panels(2), (1.0, 0.2), strict=True):
    drawing = ss.fit_shape(shape, tolerance=tolerance)
    curves(axes, drawing, filled=True)
    axes.set_title(f"within {tolerance} px: {stored(drawing)} points")

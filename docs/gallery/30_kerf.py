"""
A path beside the curve
=======================

A cutter of radius 3 runs beside the outline: outside it, and inside the hole.
"""

from canvas import ORANGE, curves, image, panels

import shapespline as ss

drawing = ss.fit_shape(ss.read(image("fa_gear_256.png")), tolerance=0.3)
path = drawing.offset(3.0)

(axes,) = panels()
curves(axes, drawing, filled=True, points=False)
for fit in path:
    axes.plot(*fit.points(2000).T, color=ORANGE, lw=1.2)
axes.set_title(f"area {drawing.area:.0f}, {path.area:.0f} within the path")

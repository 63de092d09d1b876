"""
Centre lines of strokes
=======================

A plotter draws lines, not outlines: the middle of each stroke, from the picture.
"""

from canvas import curves, image, panels, picture, stored

import shapespline as ss

name = image("EBGaramond12-Regular_U0026_256.png")
drawing = ss.fit_shape(ss.read(name, centerline=True), tolerance=1.0)

(axes,) = panels()
picture(axes, name)
curves(axes, drawing)
axes.set_title(f"{len(drawing)} open strokes, {stored(drawing)} points")

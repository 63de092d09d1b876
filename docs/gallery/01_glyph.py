"""
A glyph from a picture
======================

An ampersand of 256 x 256 pixels, with its two holes. Half a pixel both ways.
"""

from canvas import curves, image, panels, picture, stored

import shapespline as ss

name = image("EBGaramond12-Regular_U0026_256.png")
drawing = ss.fit_shape(ss.read(name), tolerance=0.5)

(axes,) = panels()
picture(axes, name)
curves(axes, drawing)
axes.set_title(f"65 536 pixels, {stored(drawing)} points")

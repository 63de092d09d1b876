"""
A scanned leaf
==============

The lobes of an oak leaf are smooth, its notches sharp; its vein is a hole.
"""

from canvas import curves, image, panels, picture, stored

import shapespline as ss

name = image("gameicons_oak-leaf_256.png")
drawing = ss.fit_shape(ss.read(name), tolerance=0.6)

(axes,) = panels()
picture(axes, name)
curves(axes, drawing)
axes.set_title(f"{stored(drawing)} points within 0.6 pixels")

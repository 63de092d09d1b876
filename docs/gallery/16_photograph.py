"""
A photograph
============

The longest outline of a butterfly, within one and a half pixels; a blur takes the texture away.
"""

from canvas import curves, image, panels, picture, stored

import shapespline as ss

name = image("opencv_butterfly.jpg")
drawing = ss.fit_shape(ss.read(name, contours="longest", blur=4), tolerance=1.5, effort="fast")

(axes,) = panels()
picture(axes, name)
curves(axes, drawing, points=False)
axes.set_title(f"{len(drawing.fits[0].contour)} outline points, {stored(drawing)} stored")

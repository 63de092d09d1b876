"""
A gear with its bore
====================

Straight flanks stay straight, the bore has no seam.
"""

from canvas import curves, image, panels, stored

import shapespline as ss

drawing = ss.fit_shape(ss.read(image("fa_gear_256.png")), tolerance=0.4)

(axes,) = panels()
curves(axes, drawing, filled=True)
axes.set_title(f"{stored(drawing)} points, {sum(len(fit.pieces) for fit in drawing)} pieces")

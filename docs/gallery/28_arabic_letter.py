"""
A letter of naskh
=================

Outline and counter of the letter heh, each a smooth curve with its few corners.
"""

from canvas import curves, outline, panels, stored

import shapespline as ss

contours = [
    ss.Contour(outline(f"NotoNaskhArabic-Regular_U0647_c{index}"), closed=True) for index in (0, 1)
]
drawing = ss.fit_shape(ss.Shape(contours, parents=(-1, 0)), tolerance="0.2%")

(axes,) = panels()
curves(axes, drawing, filled=True)
axes.set_title(f"{stored(drawing)} points")

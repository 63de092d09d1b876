"""
A logo in colours
=================

One colour after another, each with the outlines of its areas.
"""

import matplotlib.pyplot as plt
from canvas import curves, image, panels, stored

import shapespline as ss

name = image("opencv_HappyFish.png")
seen, traced = panels(2)
seen.imshow(plt.imread(name))
total = 0
for color in ("#f0a020", "#ffffff", "#202020"):
    drawing = ss.fit_shape(ss.read(name, color=color, min_area=20), tolerance=0.6)
    curves(traced, drawing, filled=True, points=False, color="0.4" if color == "#ffffff" else color)
    total += stored(drawing)
traced.set_title(f"three colours, {total} points")

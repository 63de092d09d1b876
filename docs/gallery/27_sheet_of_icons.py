"""
A sheet of icons
================

Many outlines at once, in two threads.
"""

from concurrent.futures import ThreadPoolExecutor

import matplotlib.pyplot as plt
from canvas import curves, outline

import shapespline as ss

names = (
    "fa_dove_c0", "fa_guitar_c0", "fa_hand-spock_c0", "fa_leaf_c0", "mdi_airplane_c0",
    "mdi_fan_c0", "mdi_feather_c0", "mdi_leaf-maple_c0", "gameicons_turbine_c0",
    "gameicons_big-gear_c0", "gameicons_tribal-gear_c0", "gameicons_wind-turbine_c0",
)  # fmt: skip
contours = [ss.Contour(outline(name), closed=True) for name in names]
with ThreadPoolExecutor(2) as pool:
    batch = ss.fit_many(contours, tolerance="0.3%", executor=pool)

_, axes = plt.subplots(3, 4, figsize=(8, 6), layout="constrained")
for one, fit in zip(axes.flat, batch, strict=True):
    curves(one, [fit], filled=True, points=False)
    one.set_aspect("equal")
    one.set_axis_off()
    one.set_title(f"{fit.n_stored_points} points", fontsize=9)

"""
Against splprep and a polyline
==============================

Points that each needs to stay within the same distance, both ways, of four outlines.
"""

import matplotlib.pyplot as plt
import numpy as np
from canvas import BLUE, GREY, ORANGE, outline
from scipy.interpolate import splev, splprep
from scipy.spatial import cKDTree

import shapespline as ss


def splprep_points(points, tolerance):
    """Coefficients of the largest s whose curve keeps the distance to the points."""
    around = np.vstack([points, points[:1]])
    for s in np.geomspace(len(points) * tolerance**2, 1e-4 * tolerance**2, 60):
        tck, _ = splprep(around.T, s=s, per=True)
        curve = np.column_stack(splev(np.linspace(0, 1, 8000), tck))
        if max(cKDTree(curve).query(points)[0]) < tolerance:
            return len(tck[1][0]) - 3
    return len(points)


names = {
    "hand": "hand620_closed",
    "leaf": "leaf840_closed",
    "plane": "plane1100_closed",
    "dove": "fa_dove_c0",
}
ours, theirs, polylines = [], [], []
for name in names.values():
    contour = ss.Contour(outline(name), closed=True)
    ours.append(ss.fit_curve(contour, tolerance="0.3%").n_stored_points)
    polylines.append(
        ss.fit_curve(contour, tolerance="0.3%", degree=1, corners="free").n_stored_points
    )
    theirs.append(splprep_points(contour.points, 0.003 * contour.box_diagonal))

_, axes = plt.subplots(figsize=(6, 3.6), layout="constrained")
at = np.arange(len(names))
for shift, values, label, color in (
    (-0.27, ours, "shapespline", BLUE),
    (0.0, theirs, "splprep, best s", ORANGE),
    (0.27, polylines, "lines only", GREY),
):
    axes.bar(at + shift, values, 0.25, label=label, color=color)
axes.set_xticks(at, list(names))
axes.set_ylabel("stored points within 0.3 %")
axes.legend(frameon=False)

"""Pictures of fits to be looked at one by one: the whole, and the place that is farthest off."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

if TYPE_CHECKING:
    import shapespline as ss

# Width of the enlarged place, in parts of the box diagonal.
ENLARGED = 0.12
BLUE, ORANGE, GREY = "#0072B2", "#D55E00", "#8A8A8A"


def draw_fit(fit: ss.Fit, title: str) -> Figure:
    """Data, curve and ends of pieces; beside it the place of the largest distance, enlarged."""
    contour = fit.contour
    figure = Figure(figsize=(14, 7), layout="constrained")
    figure.suptitle(title)
    breaks = fit.spline.breakpoints
    curve = fit.spline(np.unique(np.concatenate([np.linspace(0, 1, 20_000), breaks])))
    ends = np.array([piece.control_points[0] for piece in fit.pieces])
    feet = fit.spline(fit.parameters)
    off = np.hypot(*(feet - contour.points[contour.source]).T)
    at = contour.points[contour.source][int(off.argmax())]
    for axes, half in zip(
        figure.subplots(1, 2), (None, 0.5 * ENLARGED * contour.box_diagonal), strict=True
    ):
        axes.plot(*contour.polyline.T, ".-", color=GREY, ms=3 if half else 1.5, lw=0.6)
        axes.plot(*curve.T, color=BLUE, lw=1.5)
        axes.plot(*ends.T, "o", color=ORANGE, ms=4)
        axes.set_aspect("equal")
        if half is not None:
            axes.set_xlim(at[0] - half, at[0] + half)
            axes.set_ylim(at[1] - half, at[1] + half)
    return figure

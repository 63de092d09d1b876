"""The noise of a contour, from what local cubics cannot follow."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

if TYPE_CHECKING:
    from shapespline.contour import Contour

# Points on each side of the middle of a local fit.
HALF_WINDOW = 5


def noise_level(contour: Contour) -> float:
    """Standard deviation of the noise in each coordinate, data units.

    A cubic is fitted to every 11 neighbours; the median over all windows of the root mean square
    of what is left, so that corners, which no cubic follows, do not count. On clean data it is
    the sampling's own roughness; 0 for fewer than 11 points.

    Examples
    --------
    >>> from shapespline import Contour
    >>> x = np.linspace(0, 10, 400)
    >>> y = np.random.default_rng(1).normal(0, 0.1, 400)
    >>> bool(0.06 < noise_level(Contour(np.column_stack([x, y]), closed=False)) < 0.08)
    True
    """
    width = 2 * HALF_WINDOW + 1
    points = contour.points - contour.points[0]
    if len(points) < width:
        return 0.0
    if contour.closed:
        points = np.concatenate([points[-HALF_WINDOW:], points, points[:HALF_WINDOW]])
    at = np.arange(-HALF_WINDOW, HALF_WINDOW + 1) / HALF_WINDOW
    powers = np.vander(at, 4)
    remainder = np.eye(width) - powers @ np.linalg.pinv(powers)
    windows = sliding_window_view(points, width, axis=0).reshape(-1, width)
    residuals = (windows @ remainder).reshape(-1, 2 * width)
    sigmas = np.sqrt((residuals**2).sum(axis=1) / (width - powers.shape[1]) / 2)
    return float(np.median(sigmas))

"""Robust losses (Huber 1964; Beaton and Tukey 1974): what an error counts, in standard deviations.

References
----------
.. [1] P. W. Holland, R. E. Welsch, Robust regression using iteratively reweighted least squares,
   1977: the constants of both losses for 95 % efficiency.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from shapespline.typing import FloatArray

# Standard deviations beyond which a loss departs from the square, [1].
LOSSES = {"huber": 1.345, "tukey": 4.685}
# Median of the absolute value of a standard normal variable.
NORMAL_MEDIAN = 0.6744897501960817


def counted(z: FloatArray, loss: str | None) -> FloatArray:
    """2 rho(z): the square near zero, then twice a line (Huber) or a constant (Tukey).

    Examples
    --------
    >>> counted(np.array([1.0, 10.0]), None).tolist()
    [1.0, 100.0]
    >>> counted(np.array([1.0, 10.0]), "huber").round(2).tolist()
    [1.0, 25.09]
    """
    size = np.abs(z)
    if loss is None:
        return size**2
    bound = LOSSES[loss]
    if loss == "huber":
        return np.where(size <= bound, size**2, bound * (2.0 * size - bound))
    part = np.minimum(size / bound, 1.0) ** 2
    return bound**2 / 3.0 * (1.0 - (1.0 - part) ** 3)


def weight_factors(z: FloatArray, loss: str | None) -> FloatArray:
    """psi(z) / z: the weight that makes a square of the loss."""
    size = np.abs(z)
    if loss is None:
        return np.ones(len(z))
    bound = LOSSES[loss]
    if loss == "huber":
        return np.minimum(1.0, bound / np.maximum(size, 1e-12))
    # Not quite zero: every point keeps a place along the curve.
    return np.maximum((1.0 - np.minimum(size / bound, 1.0) ** 2) ** 2, 1e-9)


def slope_and_square(z: FloatArray, loss: str | None) -> tuple[FloatArray, FloatArray]:
    """psi'(z), and psi(z)^2 averaged: of squares both are one."""
    if loss is None:
        return np.ones(len(z)), np.ones(len(z))
    bound = LOSSES[loss]
    if loss == "huber":
        slope, psi = (np.abs(z) <= bound).astype(float), np.clip(z, -bound, bound)
    else:
        part = np.minimum((z / bound) ** 2, 1.0)
        slope, psi = (1.0 - part) * (1.0 - 5.0 * part), z * (1.0 - part) ** 2
    # Means over all points: a single one says too little about its own error.
    return np.full(len(z), slope.mean()), np.full(len(z), (psi**2).mean())

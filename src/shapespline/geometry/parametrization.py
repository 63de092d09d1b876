"""Location parameters of data points: uniform, chord length, centripetal, Greville-matched.

Open contours get parameters from 0 to 1, closed ones from 0 up to below 1: the closing segment has
its share. All grow strictly along the data.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.errors import InvalidInputError

if TYPE_CHECKING:
    from shapespline.typing import FloatArray
    from shapespline.values import Contour

PARAMETRIZATIONS = ("uniform", "chord", "centripetal")
# Exponent of the chord length that a step in the parameter is proportional to (Lee 1989).
_EXPONENT = {"uniform": 0.0, "chord": 1.0, "centripetal": 0.5}


def parametrize(contour: Contour, kind: str = "chord") -> FloatArray:
    """Parameters in proportion to a power of the chord lengths: 0, 1 or 1/2.

    Parameters
    ----------
    contour : Contour
    kind : {"uniform", "chord", "centripetal"}

    Returns
    -------
    ndarray, shape (n,)

    References
    ----------
    Lee, E. T. Y.: Choosing nodes in parametric curve interpolation, CAD 21 (1989).

    Examples
    --------
    >>> from shapespline import Contour
    >>> contour = Contour([(0, 0), (1, 0), (5, 0)], closed=False)
    >>> parametrize(contour, "chord").tolist(), parametrize(contour, "uniform").tolist()
    ([0.0, 0.2, 1.0], [0.0, 0.5, 1.0])
    """
    if kind not in _EXPONENT:
        raise InvalidInputError(f"kind must be one of {', '.join(PARAMETRIZATIONS)}, got {kind!r}")
    steps = np.diff(contour.arc_length) ** _EXPONENT[kind]
    stations = np.concatenate([[0.0], np.cumsum(steps)])
    parameters = stations / stations[-1]
    return parameters[: len(contour)]


def greville_matched(
    contour: Contour, anchors: FloatArray, abscissae: FloatArray, period: float | None
) -> FloatArray:
    """Parameters that take given values at given arc lengths, linear in arc length between.

    A control point placed near a data point should act there, and it acts most at its Greville
    abscissa. Uniform parameters contradict unevenly spaced control points.

    Parameters
    ----------
    contour : Contour
    anchors : ndarray, shape (m,)
        Increasing arc lengths of the points that the control points were made from.
    abscissae : ndarray, shape (m,)
        Greville abscissae of these control points, increasing.
    period : float or None
        Period of the parameter for closed data, None for open.

    Returns
    -------
    ndarray, shape (n,)
        Not reduced modulo the period: increasing along the data.
    """
    at = contour.arc_length[: len(contour)]
    if period is None:
        return np.interp(at, anchors, abscissae)
    length = contour.length
    around = np.concatenate([anchors[-1:] - length, anchors, anchors[:1] + length])
    values = np.concatenate([abscissae[-1:] - period, abscissae, abscissae[:1] + period])
    return np.interp(at, around, values)

"""optimize: one start, one method, one Fit.

Moves control points and location parameters together from a start, then verifies the curve.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from shapespline.engines.least_squares import (
    DEFAULT_LIMITS,
    minimized,
    named_solver,
    summed_weights,
)
from shapespline.errors import InvalidInputError
from shapespline.fitting.verify import verified_fit
from shapespline.validation import is_number
from shapespline.values import Contour, Fit, checked_contour

if TYPE_CHECKING:
    from shapespline.engines.least_squares import Start
    from shapespline.monitor import Callback
    from shapespline.solvers import Limits, Solver
    from shapespline.typing import ArrayLike


def optimize(
    contour: Contour,
    start: Start,
    method: str | Solver[Any, Any] = "levenberg-marquardt",
    *,
    tolerance: float | None = None,
    weights: ArrayLike | None = None,
    ends: str | None = None,
    stray_weight: float = 0.0,
    limits: Limits = DEFAULT_LIMITS,
    callback: Callback | None = None,
) -> Fit:
    """Minimise the residuals over control points and location parameters, and verify the curve.

    Knots and number of control points stay those of the start. The data are moved about their
    middle while computing, so that their place costs no accuracy.

    Parameters
    ----------
    contour : Contour
    start : InitialCurve or Fit
        Curve and parameters to start from.
    method : str or Solver
        ``"levenberg-marquardt"`` (parameters eliminated), ``"d-bfgs"``, ``"d-bfgs-ns"``,
        ``"d-bfgs-inverse"``, ``"d-bfgs-inverse-ns"``, ``"oss"``, ``"oss-ns"``, ``"bfgs"``,
        ``"l-bfgs"``; for comparison ``"pdm"``, ``"tdm"``, ``"sdm"`` (point-, tangent- and
        squared-distance minimisation) and ``"fixed-parameters"``; or a solver from
        ``solvers.quasi_newton.make_solver``, which takes the start diagonal, the Wolfe conditions
        and the memory.
    tolerance : float, optional
        Stop as soon as no residual is longer, data units; the promise is then checked both ways.
    weights : array_like, shape (n_given,), optional
        One positive weight per point that was given.
    ends : {"interpolated", "fitted", "free"}, optional
        Of an open curve: held on the first and last point (default), held by their parameters
        only, or not held at all.
    stray_weight : float
        Weight, relative to that of a data point, of residuals that hold the curve on the data
        polyline where neighbours drift apart on it; 0 is the paper's problem, 0.1 keeps both
        distances alike.
    limits : Limits
        Iterations, evaluations and the tests of convergence.
    callback : callable, optional
        Called with every Iteration; a true answer cancels, and the best curve so far is returned.

    Raises
    ------
    InvalidInputError
        For an unknown method, or a start or weights that do not match the contour.

    Examples
    --------
    >>> from shapespline import Contour, Status, initial_curve
    >>> t = np.linspace(0, 2 * np.pi, 240, endpoint=False)
    >>> r = 10 + 2 * np.cos(5 * t)
    >>> flower = Contour(np.column_stack([r * np.cos(t), r * np.sin(t)]), closed=True)
    >>> fit = optimize(flower, initial_curve(flower, length=8))
    >>> fit.n_control_points, fit.rms_distance < 0.4, fit.status == Status.KEPT
    (10, True, True)
    """
    checked_contour(contour, "contour")
    solver, name = named_solver(method)
    if tolerance is not None and not (is_number(tolerance) and 0 < tolerance < np.inf):
        raise InvalidInputError(f"tolerance must be positive, got {tolerance!r}; in data units")
    found = minimized(
        contour,
        start,
        solver,
        tolerance=tolerance,
        weights=None if weights is None else summed_weights(weights, contour),
        ends=ends,
        stray_weight=stray_weight,
        limits=limits,
        callback=callback,
    )
    return verified_fit(
        contour,
        found.spline,
        tolerance=tolerance,
        method=name,
        run=found.run,
        history=found.history,
    )

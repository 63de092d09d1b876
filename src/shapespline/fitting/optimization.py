"""optimize: one start, one method, one Fit.

Moves control points and location parameters together from a start, then verifies the curve.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from shapespline.engines.least_squares import (
    RunArguments,
    checked_measurement,
    measured,
    named_solver,
    run_data,
    settings_of,
    summed_weights,
)
from shapespline.errors import InvalidInputError
from shapespline.fitting.verify import verified_fit
from shapespline.validation import is_number, whole_number
from shapespline.values import Contour, Fit, checked_contour

if TYPE_CHECKING:
    from shapespline.engines.least_squares import Start
    from shapespline.monitor import Callback
    from shapespline.solvers import Limits, Solver
    from shapespline.typing import ArrayLike, FloatArray


def optimize(
    contour: Contour,
    start: Start,
    method: str | Solver[Any, Any] | None = None,
    *,
    tolerance: float | None = None,
    weights: ArrayLike | None = None,
    ends: str | None = None,
    stray_weight: float | None = None,
    limits: Limits | None = None,
    callback: Callback | None = None,
    snapshots: int = 0,
    sigma: ArrayLike | None = None,
    loss: Literal["huber", "tukey"] | None = None,
) -> Fit:
    """Minimise the residuals over control points and location parameters, and verify the curve.

    Knots and number of control points stay those of the start. The data are moved about their
    middle while computing, so that their place costs no accuracy.

    An `initial_curve` says how to go on from it: what is not given here is as its reading has it,
    and the curve is that of `shapespline.paper.run_paper`. Other starts go on by
    Levenberg-Marquardt, held at the ends of an open curve and nowhere else.

    Parameters
    ----------
    contour : Contour
    start : InitialCurve or Fit
        Curve and parameters to start from.
    method : str or Solver, optional
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
    ends : {"fixed", "fitted", "free"}, optional
        Of an open curve: held on the first and last point, held by their parameters only, or not
        held at all.
    stray_weight : float, optional
        Weight, relative to that of a data point, of residuals that hold the curve on the data
        polyline where neighbours drift apart on it; 0 is the paper's problem, 0.1 keeps both
        distances alike.
    limits : Limits, optional
        Iterations, evaluations and the tests of convergence.
    callback : callable, optional
        Called with every Iteration; a true answer cancels, and the best curve so far is returned.
    snapshots : int
        Keep the curve of every so many iterations in ``fit.snapshots``, and the last; 0 keeps none.
    sigma : float or array_like, optional
        Standard deviations of the measured points: one length, one for each point (n,), one for
        each axis (n, 2), or covariances (n, 2, 2). Then ``fit.covariance``, ``fit.band`` and
        ``fit.uncertainty`` tell how sure the curve is, and open ends are fitted like the rest.
    loss : {"huber", "tukey"}, optional
        Instead of the square: errors beyond 1.345 standard deviations count linearly, those beyond
        4.685 not at all. Without ``sigma`` the standard deviation is that of most points.

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
    (20, True, True)
    """
    checked_contour(contour, "contour")
    settings = settings_of(start)
    solver, name = named_solver(settings.method if method is None else method, settings)
    if tolerance is not None and not (is_number(tolerance) and 0 < tolerance < np.inf):
        raise InvalidInputError(f"tolerance must be positive, got {tolerance!r}; in data units")
    kept_every = whole_number(snapshots)
    if kept_every is None or kept_every < 0:
        raise InvalidInputError(
            f"snapshots must be a whole number of iterations, 0 for none, got {snapshots!r}"
        )
    model = checked_measurement(sigma, loss, contour.source, len(contour))
    if weights is not None and (sigma is not None or loss is not None):
        raise InvalidInputError("weights and sigma or loss say the same thing: give one of them")
    data = run_data(contour, start.spline, settings)
    if len(data) > len(contour):  # the first point counts again
        model = model.again()
    if ends is None and not start.spline.periodic:
        # Points with errors are no places to pass through.
        ends = "fitted" if sigma is not None and settings.ends == "fixed" else settings.ends
    arguments = RunArguments(
        tolerance=tolerance,
        weights=None if weights is None else _weights_of(data, weights, contour),
        ends=ends,
        stray_weight=settings.stray_weight if stray_weight is None else stray_weight,
        limits=limits or settings.limits,
        callback=callback,
        snapshots=kept_every,
    )
    found, uncertainty = measured(data, start, solver, model, arguments)
    fit = verified_fit(
        contour,
        found.spline,
        tolerance=tolerance,
        method=name,
        run=found.run,
        history=found.history,
    )
    return replace(fit, snapshots=found.snapshots, uncertainty=uncertainty)


def _weights_of(data: Contour, weights: ArrayLike, contour: Contour) -> FloatArray:
    """Weights of the points of a run, that of the first again where it counts again."""
    summed = summed_weights(weights, contour)
    return np.append(summed, summed[:1]) if len(data) > len(summed) else summed

"""From a curve to a Fit: both distances measured, and a status that is a true sentence."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapespline.geometry import two_sided_distance
from shapespline.monitor import End, Monitor
from shapespline.solvers import Result, Stop
from shapespline.values import Fit, Status

if TYPE_CHECKING:
    from shapespline.geometry import Distances
    from shapespline.monitor import Iteration
    from shapespline.values import BSplineCurve, Contour, Piece


def verified_fit(
    contour: Contour,
    spline: BSplineCurve,
    *,
    tolerance: float | None,
    method: str,
    run: Result | None = None,
    history: tuple[Iteration, ...] = (),
    sections: tuple[Piece, ...] = (),
    distances: Distances | None = None,
) -> Fit:
    """The Fit of a curve.

    Parameters
    ----------
    contour : Contour
    spline : BSplineCurve
    tolerance : float or None
        The one asked for; None takes the two-sided distance that the curve keeps.
    method : str
    run : Result, optional
        How the iterations ended, where the curve is theirs.
    history, sections : tuple
        Records of the iterations; pieces of the curve.
    distances : Distances, optional
        Of this curve to this contour, if they are known.

    Examples
    --------
    >>> from shapespline import BSplineCurve, Contour
    >>> line = BSplineCurve([0, 0, 1, 1], [(0, 0), (2, 0)], degree=1)
    >>> fit = verified_fit(Contour([(0, 0), (2, 0)]), line, tolerance=0.5, method="by hand")
    >>> fit.status.value.split(":")[0]
    'tolerance 0.5 kept'
    """
    found = two_sided_distance(spline, contour) if distances is None else distances
    bound = found.hausdorff_distance
    return Fit(
        spline=spline,
        contour=contour,
        parameters=found.parameters[contour.source],
        max_distance=found.max_distance,
        rms_distance=found.rms_distance,
        hausdorff_distance=bound,
        tolerance=bound if tolerance is None else float(tolerance),
        status=status_of(found, tolerance, run),
        history=history,
        method=method,
        sections=sections,
    )


def status_of(found: Distances, tolerance: float | None, run: Result | None = None) -> Status:
    """What was reached, as a sentence with figures.

    Parameters
    ----------
    found : Distances
    tolerance : float or None
        The one asked for.
    run : Result, optional
        How the iterations ended, where the curve is theirs.
    """
    figures = f"data to curve {found.max_distance:.6g}, curve to data {found.reverse_distance:.6g}"
    steps = stop = None
    if run is not None:
        stop = run.stop
        steps = f"after {run.history[-1].iteration} iterations ({stop.value})"
    ended = f", ended {steps}" if steps else ""
    if stop is Stop.CANCELLED:
        return Status.CANCELLED.saying(f"cancelled by the callback {steps}: {figures}")
    if tolerance is not None and found.hausdorff_distance <= tolerance:
        return Status.KEPT.saying(f"tolerance {tolerance:.6g} kept{ended}: {figures}")
    if stop in (Stop.ITERATIONS, Stop.EVALUATIONS):
        return Status.BUDGET.saying(
            f"stopped {steps}: {figures}; go on from here with optimize(contour, fit)"
        )
    if tolerance is None:
        return Status.KEPT.saying(f"no tolerance asked for{ended}: {figures}")
    if run is None:
        return Status.EXCEEDED.saying(
            f"tolerance {tolerance:.6g} not kept: {figures}; take a larger one"
        )
    return Status.EXCEEDED.saying(
        f"tolerance {tolerance:.6g} not reached {steps}: {figures};"
        " take more control points or a larger tolerance"
    )


def final_status(found: Status, monitor: Monitor) -> Status:
    """The status of a fit that a monitor may have ended: how, and what was found."""
    if monitor.ended is None:
        return found
    if monitor.ended is End.CANCELLED:
        return Status.CANCELLED.saying(
            f"cancelled by the callback after {monitor.seconds:.3g} s: {found.value}"
        )
    return Status.BUDGET.saying(
        f"the time limit of {monitor.time_limit:.6g} s ran out, give more to go on: {found.value}"
    )

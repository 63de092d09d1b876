"""Verification: the one place where a candidate becomes a Fit, with a status that is true.

Both distances are measured with certified bounds (interval Hausdorff bound), unless a candidate
brings those of its own curve; a tangent that was asked for is compared with the curve's.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from shapespline.geometry import joined, turn_between, two_sided_distance
from shapespline.monitor import End
from shapespline.solvers import Stop
from shapespline.values import CORNER_TURN, EXACT_TURN, Fit, Status

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.engines.pieces import Constraints
    from shapespline.engines.spline import Fairness
    from shapespline.fitting.request import Request
    from shapespline.geometry import Distances
    from shapespline.monitor import Iteration, Monitor
    from shapespline.solvers import Result
    from shapespline.values import BSplineCurve, Contour, Piece, Regularity, Uncertainty


# Roundings of the coordinates of two control points, in parts of the larger.
ROUNDINGS, TINY = 4 * np.finfo(float).eps, np.finfo(float).tiny


@dataclass(frozen=True, eq=False, kw_only=True)
class Candidate:
    """A curve that a strategy proposes: pieces, or one spline.

    Attributes
    ----------
    method : str
        Who made it.
    rank : int
        Of curves that are as good the one with the smaller rank is taken: the simpler structure.
    pieces : tuple of Piece
        End to end; empty for one spline.
    spline : BSplineCurve or None
        None where the pieces tell it.
    distances : Distances or None
        Of this curve to the request's contour, certified, if the strategy knows them.
    fairness : Fairness or None
        Of one spline, if it was measured.
    run, history
        How the iterations ended and their records, where the curve is theirs.
    uncertainty : Uncertainty or None
        Of one spline that fits points with known errors.
    regularities : tuple of Regularity
        What the pieces keep exactly.
    """

    method: str
    rank: int = 0
    pieces: tuple[Piece, ...] = ()
    spline: BSplineCurve | None = None
    distances: Distances | None = None
    fairness: Fairness | None = None
    run: Result | None = None
    history: tuple[Iteration, ...] = ()
    uncertainty: Uncertainty | None = None
    regularities: tuple[Regularity, ...] = ()


@dataclass(frozen=True, eq=False)
class Verified:
    """A candidate as a Fit whose figures were measured, and what it misses beside distances.

    ``tangent_error`` is the larger angle between a tangent that was asked for and the curve's,
    radians.
    """

    candidate: Candidate = field(repr=False)
    fit: Fit
    tangent_error: float = 0.0

    @property
    def kept(self) -> bool:
        """Whether both distances keep the tolerance."""
        return self.fit.kept

    @property
    def fair(self) -> bool:
        """Whether the curve is fair as far as that was measured."""
        return self.candidate.fairness is None or self.candidate.fairness.kept

    @property
    def waves(self) -> bool:
        """Whether one spline turns to and fro where its data do not."""
        return self.candidate.fairness is not None and self.candidate.fairness.waves

    def meets(self, request: Request) -> bool:
        """Whether it keeps the tolerance, and tangents that the request insists on."""
        return self.kept and not (self.tangent_error and request.insists_on_tangents)


def verify(candidate: Candidate, request: Request) -> Verified:
    """The candidate, measured against what was asked for.

    Examples
    --------
    >>> from shapespline.fitting import Request, Settings
    >>> from shapespline.values import BSplineCurve
    >>> line = BSplineCurve([0, 0, 1, 1], [(0, 0), (2, 0)], degree=1)
    >>> request = Request.of([(0, 0), (2, 0)], False, Settings(tolerance=0.5))
    >>> verify(Candidate(method="by hand", spline=line), request).fit.status.value.split(":")[0]
    'tolerance 0.5 kept'
    """
    spline = candidate.spline
    if spline is None:
        spline = joined(candidate.pieces, request.style.degree)
    fit = verified_fit(
        request.contour,
        spline,
        tolerance=request.tolerance,
        method=candidate.method,
        run=candidate.run,
        history=candidate.history,
        sections=candidate.pieces,
        distances=candidate.distances,
    )
    if candidate.uncertainty is not None:
        fit = replace(fit, uncertainty=candidate.uncertainty)
    if candidate.regularities:
        fit = replace(fit, regularities=candidate.regularities)
    if request.style.smoothness == 2 and (count := _n_jumps(fit)):
        fit = replace(
            fit,
            status=Status.EXCEEDED.saying(
                f"curvature may jump in {count} places that are no corners: {fit.status.value};"
                " take a larger tolerance"
            ),
        )
    error = _tangent_error(fit.pieces, request.constraints)
    if error:
        turn = np.degrees(error)
        fit = replace(
            fit,
            status=Status.EXCEEDED.saying(
                f"an end tangent is missed by {turn:.3g} degrees: {fit.status.value}; take a larger"
                " tolerance, or a tangent nearer to the data"
            ),
        )
    return Verified(candidate, fit, error)


def _tangent_error(pieces: Sequence[Piece], constraints: Constraints) -> float:
    """The larger angle between a tangent that is kept and the curve's, radians; 0 for rounding."""
    if all(wanted is None for wanted in constraints.tangents):
        return 0.0
    errors = [0.0]
    first, last = pieces[0].control_points[:2], pieces[-1].control_points[-2:]
    for wanted, (a, b) in zip(constraints.tangents, (first, last), strict=True):
        if wanted is not None:
            (ux, uy), (vx, vy) = wanted, b - a
            error = abs(float(np.arctan2(ux * vy - uy * vx, ux * vx + uy * vy)))
            # Far from the origin coordinates have few digits left for a short arm.
            rounding = ROUNDINGS * np.abs(b).max() / max(float(np.hypot(vx, vy)), TINY)
            errors.append(error if error > max(EXACT_TURN, rounding) else 0.0)
    return max(errors)


def _n_jumps(fit: Fit) -> int:
    """Joints that are no corners, and knots inside of pieces that are not simple enough."""
    curves = [fit.spline] if not fit.sections else fit.sections
    count = 0
    for curve in curves:
        begin, end = (curve.knots[i] for i in (curve.degree, -curve.degree - 1))
        inner = curve.knots[(begin < curve.knots) & (curve.knots < end)]
        _, repeated = np.unique(inner, return_counts=True)
        count += int((repeated > curve.degree - 2).sum())
    if fit.sections:
        joints = list(pairwise(fit.sections))
        if fit.closed:
            joints.append((fit.sections[-1], fit.sections[0]))
        count += sum(abs(turn_between(*joint)) <= CORNER_TURN for joint in joints)
    elif fit.closed and not fit.spline.periodic:
        count += 1
    return count


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
    """
    found = two_sided_distance(spline, contour) if distances is None else distances
    found = found.beside(sections)
    bound = found.hausdorff_distance
    parameters = found.parameters
    if contour.n_given != len(contour):
        parameters = parameters[contour.source]
    return Fit(
        spline=spline,
        contour=contour,
        parameters=parameters,
        max_distance=found.max_distance,
        rms_distance=found.rms_distance,
        hausdorff_distance=bound,
        tolerance=bound if tolerance is None else float(tolerance),
        status=status_of(found, tolerance, run),
        history=history,
        method=method,
        sections=sections,
    )


def verified_anew(fit: Fit, found: Fit) -> Fit:
    """The curve of another fit, with what was found about it, for the data and promise of a fit."""
    again = verified_fit(
        fit.contour,
        found.spline,
        tolerance=fit.tolerance,
        method=found.method,
        history=found.history,
        sections=found.sections,
    )
    return replace(again, regularities=found.regularities)


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


def final_status(fit: Fit, monitor: Monitor) -> Status:
    """The status of a fit that a monitor may have ended: how, and what was found."""
    found = fit.status
    if monitor.ended is None or (monitor.ended is End.CANCELLED and found == Status.CANCELLED):
        return found
    if monitor.ended is End.CANCELLED:
        return Status.CANCELLED.saying(
            f"cancelled by the callback after {monitor.seconds:.3g} s: {found.value}"
        )
    figures = found.value
    if found == Status.CANCELLED:  # so the solver was told, whose sentence would be a wrong one
        figures = f"data to curve {fit.max_distance:.6g}, both ways {fit.hausdorff_distance:.6g}"
    return Status.BUDGET.saying(
        f"the time limit of {monitor.time_limit:.6g} s ran out, give more to go on: {figures}"
    )


def finished(verified: Verified, monitor: Monitor) -> Fit:
    """The fit of what was verified, saying whether the monitor ended it."""
    fit = verified.fit
    status, history = final_status(fit, monitor), fit.history or tuple(monitor.history)
    if status is fit.status and history == fit.history:
        return fit
    return replace(fit, status=status, history=history)

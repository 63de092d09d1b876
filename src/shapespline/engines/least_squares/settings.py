"""RunSettings: how a run goes on from a start, where the start says so."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol, runtime_checkable

import numpy as np

from shapespline.solvers import Limits
from shapespline.values import Contour

if TYPE_CHECKING:
    from shapespline.solvers import StartDiagonal, Wolfe
    from shapespline.values import BSplineCurve

# Enough for Levenberg-Marquardt to converge and for the quasi-Newton family to come near.
DEFAULT_LIMITS = Limits(max_iterations=300, max_evaluations=2000, relative_decrease=1e-6)


@dataclass(frozen=True, kw_only=True)
class RunSettings:
    """What a run takes where its caller says nothing.

    Attributes
    ----------
    method : str
    start_diagonal, wolfe : str
        Of a quasi-Newton method; see `solvers.make_solver`.
    ends : {"fixed", "fitted", "free"}
        Of a clamped curve.
    stray_weight : float
        See `CurveProblem`.
    closing_point : bool
        Where the curve is clamped and the data are closed, the first point counts again as last.
    limits : Limits
    """

    method: str = "levenberg-marquardt"
    start_diagonal: StartDiagonal = "gauss-newton"
    wolfe: Wolfe = "strong"
    ends: str = "fixed"
    stray_weight: float = 0.0
    closing_point: bool = False
    limits: Limits = DEFAULT_LIMITS


@runtime_checkable
class PreparedStart(Protocol):
    """A start that says how to go on."""

    @property
    def settings(self) -> RunSettings:
        """What applies where the caller says nothing."""


def settings_of(start: object) -> RunSettings:
    """The start's own settings, or those of every other run."""
    return start.settings if isinstance(start, PreparedStart) else RunSettings()


def run_data(contour: Contour, spline: BSplineCurve, settings: RunSettings) -> Contour:
    """The points that a run minimises over: of closed data the first one again, where it counts."""
    if settings.closing_point and contour.closed and not spline.periodic:
        return closed_up(contour)
    return contour


def path_of(contour: Contour, *, periodic: bool, closing_point: bool) -> Contour:
    """What a start is placed along: open for a clamped curve, and back to its begin or not."""
    if periodic or not contour.closed:
        return contour
    if closing_point:
        return closed_up(contour)
    return Contour.trusted(contour.points, False, contour.accuracy)


def closed_up(contour: Contour) -> Contour:
    """A closed contour as an open one that ends where it began."""
    points = np.concatenate([contour.points, contour.points[:1]])
    return Contour.trusted(points, False, contour.accuracy)

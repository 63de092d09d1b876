"""Fit and Status: one curve with what was verified about it."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from functools import cached_property
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from shapespline import _kernels
from shapespline.errors import InvalidInputError

if TYPE_CHECKING:
    from scipy.interpolate import BSpline

    from shapespline.monitor import Iteration
    from shapespline.typing import ArrayLike, FloatArray, IntArray
    from shapespline.values.arc import Arc
    from shapespline.values.contour import Contour
    from shapespline.values.regularity import Regularity
    from shapespline.values.snapshot import Snapshot
    from shapespline.values.uncertainty import Band, Uncertainty
from shapespline.values.curve import BSplineCurve
from shapespline.values.equality import ByValue
from shapespline.values.exchanged import Exchanged
from shapespline.values.fit_methods import FitMethods
from shapespline.values.piece import CORNER_TURN, Piece
from shapespline.values.shape import counted
from shapespline.values.shown import Shown


@dataclass(frozen=True, eq=False)
class Status:
    """How a fit ended: one of four names, and a sentence with figures and a remedy.

    Two statuses are equal when their names are: ``fit.status == Status.KEPT``.
    """

    name: str
    value: str

    KEPT: ClassVar[Status]
    EXCEEDED: ClassVar[Status]
    BUDGET: ClassVar[Status]
    CANCELLED: ClassVar[Status]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Status) and self.name == other.name

    def __hash__(self) -> int:
        return hash(self.name)

    def __str__(self) -> str:
        return self.value

    def saying(self, sentence: str) -> Status:
        """The same status with its own sentence."""
        return Status(self.name, sentence)


Status.KEPT = Status("KEPT", "both distances are within the tolerance")
Status.EXCEEDED = Status("EXCEEDED", "a distance exceeds the tolerance")
Status.BUDGET = Status("BUDGET", "a budget ran out before the fit had converged")
Status.CANCELLED = Status("CANCELLED", "the callback cancelled the fit")


@dataclass(frozen=True, eq=False, kw_only=True)
class Fit(ByValue, Shown, Exchanged, FitMethods):
    """A curve fitted to a contour, and what is known about it.

    Fits are equal when curve, data, figures and the name of the status are; their histories, which
    tell seconds, may differ.

    Attributes
    ----------
    spline : BSplineCurve
        The curve over [0, 1]; ``curve`` is the same as a scipy BSpline.
    contour : Contour
        The data.
    parameters : ndarray, shape (n_given,)
        The nearest foot parameter of every point that was given and not left out.
    max_distance, rms_distance : float
        Data to curve, data units; the maximum is an upper bound up to rounding.
    hausdorff_distance : float
        Certified upper bound of the larger of data -> curve and curve -> data polyline.
    tolerance : float
        The one asked for, or the one found: then it is ``hausdorff_distance``.
    status : Status
        ``status.value`` is a sentence with figures.
    history : tuple of Iteration
        One record per iteration, the start first.
    method : str
        Name of the solver.
    sections : tuple of Piece
        The pieces that the curve was made of, end to end; empty for a single spline.
    outliers : ndarray
        Indices, among the points that were given, of those left out on request.
    snapshots : tuple of Snapshot
        Curves on the way, where `optimize` was asked to keep them.
    regularities : tuple of Regularity
        What pieces keep exactly, where the curve is as it was drawn.
    uncertainty : Uncertainty or None
        Where the errors of the points were given.
    """

    spline: BSplineCurve
    contour: Contour
    parameters: FloatArray = field(repr=False)
    max_distance: float
    rms_distance: float
    hausdorff_distance: float
    tolerance: float
    status: Status
    history: tuple[Iteration, ...] = field(repr=False)
    method: str
    sections: tuple[Piece, ...] = field(default=(), repr=False)
    outliers: IntArray = field(default_factory=lambda: np.empty(0, dtype=np.int64), repr=False)
    snapshots: tuple[Snapshot, ...] = field(default=(), repr=False)
    regularities: tuple[Regularity, ...] = field(default=(), repr=False)
    uncertainty: Uncertainty | None = field(default=None, repr=False)

    # How the iterations went, with their seconds, is no part of the result.
    _BESIDE: ClassVar = frozenset({"history", "snapshots", "uncertainty"})

    def __post_init__(self) -> None:
        self._protect()

    def _protect(self) -> None:
        """Make the arrays read-only, as those of the curve and the contour are."""
        held = [array for piece in self.sections for array in (piece.knots, piece.control_points)]
        for array in (self.parameters, self.outliers, *held):
            array.setflags(write=False)

    # Between processes go the fields alone, and come back read-only.
    def __getstate__(self) -> dict[str, object]:
        return {item.name: getattr(self, item.name) for item in fields(self)}

    def __setstate__(self, state: dict[str, object]) -> None:
        for name, value in state.items():
            object.__setattr__(self, name, value)
        self._protect()

    def __repr__(self) -> str:
        kind = "closed" if self.closed else "open"
        return (
            f"Fit({kind}, {counted(len(self.pieces), 'piece')} of degree {self.degree},"
            f" {self.n_stored_points} stored points, distance {self.hausdorff_distance:.3g},"
            f" tolerance {self.tolerance:.3g}, {self.status.name})"
        )

    @cached_property
    def curve(self) -> BSpline:
        """The whole result as one ``scipy.interpolate.BSpline``, periodic if smooth and closed."""
        return self.spline.to_scipy()

    @property
    def control_points(self) -> FloatArray:
        """Distinct control points, shape (m, 2)."""
        return self.spline.control_points

    @property
    def n_control_points(self) -> int:
        """Number of distinct control points."""
        return self.spline.n_control_points

    @property
    def knots(self) -> FloatArray:
        """Full knot array of ``curve``."""
        return self.spline.knots

    @property
    def degree(self) -> int:
        """Degree of ``curve``."""
        return self.spline.degree

    @cached_property
    def closed(self) -> bool:
        """Whether the curve ends where it begins."""
        points = self.control_points
        return self.spline.periodic or points[0].tolist() == points[-1].tolist()

    @cached_property
    def corners(self) -> FloatArray:
        """Parameters where the curve turns by more than a degree, shape (c,)."""
        spline = self.spline
        corners = np.array(
            _kernels.corner_parameters(
                spline.knots, spline.degree, spline.coefficients, self.closed, CORNER_TURN
            )
        )
        corners.setflags(write=False)
        return corners

    @property
    def pieces(self) -> tuple[Piece, ...]:
        """The curve end to end as lines, arcs, Beziers or splines."""
        if self.sections:
            return self.sections
        spline = self.spline
        without_inner_knots = len(spline.breakpoints) == 2 and not spline.periodic
        kind = "line" if spline.degree == 1 else "bezier"
        return (
            Piece(
                kind if without_inner_knots else "spline",
                spline.degree,
                spline.knots,
                spline.coefficients,
            ),
        )

    @property
    def exact_parts(self) -> list[BSplineCurve | Arc]:
        """The curve in as few parts as it takes to tell arcs from splines; one if it has none."""
        if not any(piece.arc for piece in self.sections):
            return [self.spline]
        return [
            piece.arc or BSplineCurve(piece.knots, piece.control_points, piece.degree)
            for piece in self.sections
        ]

    @cached_property
    def n_stored_points(self) -> int:
        """Distinct points that a file of the pieces stores.

        A line counts 1, an arc or a whole circle 2, a quadratic 2, a cubic 3, a spline with k
        interior knots its degree + k; an open curve one more.
        """
        if self.spline.periodic and not self.sections:
            return self.n_control_points
        stored = sum(piece.n_stored for piece in self.pieces)
        return stored + int(not self.closed)

    @property
    def covariance(self) -> FloatArray:
        """Covariance of the control points, x and y in turn, shape (2 m, 2 m)."""
        return self._known_uncertainty().covariance

    def band(
        self,
        level: float = 0.95,
        *,
        simultaneous: bool = False,
        parameters: ArrayLike | int = 1000,
    ) -> Band:
        """The band that holds the true curve with a probability; see `confidence_band`."""
        from shapespline.geometry import confidence_band

        return confidence_band(
            self.spline,
            self._known_uncertainty(),
            level,
            simultaneous=simultaneous,
            parameters=parameters,
        )

    def _known_uncertainty(self) -> Uncertainty:
        if self.uncertainty is None:
            raise InvalidInputError(
                "fit knows no errors of its points: make it with sigma=, which fit_curve and"
                " optimize take"
            )
        return self.uncertainty

    @property
    def kept(self) -> bool:
        """Whether both bounds are within the tolerance."""
        return max(self.max_distance, self.hausdorff_distance) <= self.tolerance

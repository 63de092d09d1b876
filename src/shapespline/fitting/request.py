"""Request: all that is asked of a curve, checked together before any work.

A :class:`Request` is what `Settings` mean for one contour. The public functions, the command line
and files of settings build the same.
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, TypeAlias, get_args

import numpy as np

from shapespline.analysis import find_outliers, looks_shuffled
from shapespline.engines.drawn import NAMES
from shapespline.engines.least_squares import check_freedom, checked_measurement, given_weights
from shapespline.engines.pieces import Constraints
from shapespline.errors import (
    DegenerateContourError,
    InvalidInputError,
    ShuffledPointsWarning,
    caller_level,
)
from shapespline.fitting.goals import Estimate, Goal, OfSize, Style, Within
from shapespline.fitting.settings import Settings, plain, tolerance_length
from shapespline.validation import distinct
from shapespline.values import Contour

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from shapespline.engines.least_squares import Measurement
    from shapespline.typing import (
        ArrayLike,
        CornerChoice,
        Effort,
        FloatArray,
        IntArray,
        Loss,
    )

    Tangents: TypeAlias = tuple[FloatArray | None, FloatArray | None]

NO_INDICES: IntArray = np.empty(0, dtype=np.int64)
NO_INDICES.setflags(write=False)
NOTHING_KEPT = Constraints()
CUBIC_PIECES = Style()


@dataclass(frozen=True, eq=False, kw_only=True)
class Request:
    """What is asked of one contour.

    Attributes
    ----------
    contour : Contour
        Without the points that were left out.
    goal : Within, OfSize or Estimate
    style : Style
    constraints : Constraints
        Ends, tangents and points that are kept exactly, by indices of ``contour.points``.
    symmetric : bool
        Whether a mirror symmetry is kept at any price.
    weights : ndarray or None
        One for each point that was given and stays.
    sigma : ndarray or None
        Errors of these points as `fit_curve` takes them, a length or one entry for each.
    loss : {"huber", "tukey"} or None
        What an error counts where not its square.
    effort : {"fast", "balanced", "smallest"}
    left_out : ndarray
        Indices, among the points that were given, of outliers.
    pieces_only : bool
        Whether one spline is no answer: of a half whose mirror image goes on from it.
    is_part : bool
        Whether it asks for a window of a curve again; it may miss a tangent there.
    """

    contour: Contour
    goal: Goal
    style: Style = CUBIC_PIECES
    constraints: Constraints = NOTHING_KEPT
    symmetric: bool = False
    weights: FloatArray | None = None
    sigma: FloatArray | None = None
    loss: Loss | None = None
    effort: Effort = "balanced"
    left_out: IntArray = field(default_factory=lambda: NO_INDICES)
    pieces_only: bool = False
    is_part: bool = False

    @classmethod
    def of(cls, points: ArrayLike | Contour, closed: bool | None, settings: Settings) -> Request:
        """The request that settings make of points; outliers are left out here.

        Raises
        ------
        InvalidInputError, DegenerateContourError
            If the points are not usable, or an option does not go with them.

        Examples
        --------
        >>> request = Request.of([(0, 0), (3, 0), (3, 4)], False, Settings(tolerance="10%"))
        >>> request.goal, request.constraints.ends
        (Within(tolerance=0.5), False)
        """
        contour = _contour(points, closed)
        if looks_shuffled(contour):
            warnings.warn(
                "the points look shuffled: most steps lead across the whole outline, not to a point"
                " near by; sort them with order_points, or read them with unordered=True",
                ShuffledPointsWarning,
                stacklevel=caller_level(),
            )
        request = cls(
            contour=contour,
            goal=_goal(settings, contour),
            style=_style(settings, contour),
            constraints=_constraints(settings, contour),
            symmetric=settings.symmetric,
            weights=None if settings.weights is None else given_weights(settings.weights, contour),
            sigma=None if settings.sigma is None else np.asarray(settings.sigma),
            loss=settings.loss,
            effort=settings.effort,
        )
        request = request.without_outliers() if settings.outliers else request
        if isinstance(request.goal, Within) and not request.style.names_corners:
            for remark in request.goal.remarks(request.contour):
                warnings.warn(remark, stacklevel=caller_level())
        if isinstance(settings.tolerance, str) and len(request.left_out):
            request = replace(request, goal=_goal(settings, request.contour))
        return request.checked()

    def checked(self) -> Request:
        """The request, if there are points enough for it."""
        degree, n = self.style.degree, len(self.contour)
        model = self.measurement  # checks the errors
        one_spline = isinstance(self.goal, OfSize) or self.is_measured or self.weights is not None
        if n < degree + 1 and one_spline and not isinstance(self.goal, Within):
            raise DegenerateContourError(
                f"points must hold at least degree + 1 = {degree + 1} distinct points for degree"
                f" {degree}, got {n}; add points or lower the degree"
            )
        if isinstance(self.goal, OfSize) and self.goal.n_control_points > n:
            raise InvalidInputError(
                f"n_control_points must be at most the number of distinct points, {n},"
                f" got {self.goal.n_control_points}; lower it"
            )
        if isinstance(self.goal, OfSize) and model.covariances is not None:
            held = self.constraints.ends and not self.contour.closed
            check_freedom(n, self.goal.n_control_points, held)
        return self

    @property
    def is_measured(self) -> bool:
        """Whether the points have known errors, or a loss counts these."""
        return self.sigma is not None or self.loss is not None

    @property
    def measurement(self) -> Measurement:
        """The errors of the points of the contour, and the loss."""
        return checked_measurement(self.sigma, self.loss, self.contour.source, len(self.contour))

    @property
    def tolerance(self) -> float | None:
        """The tolerance asked for, data units."""
        return self.goal.tolerance if isinstance(self.goal, Within) else None

    @property
    def is_plain(self) -> bool:
        """Whether nothing but ends is kept exactly."""
        return not (self.constraints.anything or self.symmetric)

    @property
    def insists_on_tangents(self) -> bool:
        """Whether tangents were asked for that a curve meets at the price of points."""
        given = any(tangent is not None for tangent in self.constraints.tangents)
        return given and not (self.pieces_only or self.is_part)

    def without_outliers(self) -> Request:
        """The request for the points that do not jump off the path and back."""
        contour = self.contour
        jumping = find_outliers(contour)
        if not len(jumping):
            return self
        through = self.constraints.through
        if len(both := np.intersect1d(through, jumping)):
            raise InvalidInputError(
                f"through must hold no outliers, got {both.tolist()}; leave them out,"
                " or outliers=False"
            )
        given = np.flatnonzero(np.isin(contour.source, jumping))
        rest = Contour.silently(
            np.delete(contour.points[contour.source], given, axis=0),
            contour.closed,
            accuracy=contour.accuracy,
        )
        # What stays, by its place among the points before and after.
        first = np.unique(np.delete(contour.source, given), return_index=True)
        place = dict(zip(first[0].tolist(), rest.source[first[1]].tolist(), strict=True))

        def renumbered(indices: IntArray) -> IntArray:
            return np.unique([place[i] for i in indices.tolist() if i in place]).astype(np.int64)

        corners = self.style.corners
        if not (corners is None or isinstance(corners, str)):
            corners = renumbered(corners)
        return replace(
            self,
            contour=rest,
            style=replace(self.style, corners=corners),
            constraints=self.constraints._replace(through=renumbered(through)),
            weights=_without(given, self.weights),
            sigma=_without(given, self.sigma),
            left_out=given,
        )

    def part(
        self,
        contour: Contour,
        within: float,
        tangents: Tangents = (None, None),
        through: Sequence[int] | IntArray = NO_INDICES,
    ) -> Request:
        """The same for some of the points, in an open row whose ends are kept.

        Tangents at its ends and points ``through`` are kept as well, by indices of ``contour``.
        """
        corners = self.style.corners if not self.style.names_corners else None
        if self.style.names_corners and self.style.corners is not None:
            corners = "auto"
        free = self.style.free
        directions = tuple(None if t is None or free else _unit(t) for t in tangents)
        nodes = np.unique(np.asarray(through, dtype=np.int64))
        return Request(
            contour=contour,
            goal=Within(within),
            style=replace(self.style, corners=corners, character="fewest"),
            constraints=Constraints(True, nodes, (directions[0], directions[1])),
            effort=self.effort,
            is_part=True,
        )

    def read(self, order: IntArray, *, is_backwards: bool) -> Request:
        """The same of the points in another order, without weights."""
        contour, corners, kept = self.contour, self.style.corners, self.constraints
        place = np.empty(len(order), dtype=np.int64)
        place[order] = np.arange(len(order))
        if not (corners is None or isinstance(corners, str)):
            corners = np.sort(place[corners])
        tangents = kept.tangents
        if is_backwards:
            begin, end = (None if t is None else -t for t in tangents)
            tangents = (end, begin)
        return replace(
            self,
            contour=Contour.trusted(contour.points[order], contour.closed, contour.accuracy),
            style=replace(self.style, corners=corners),
            constraints=kept._replace(through=np.sort(place[kept.through]), tangents=tangents),
            weights=None,
        )

    def closer(self, within: float, through: IntArray | None = None) -> Request:
        """The same within another distance, through some more points."""
        more = NO_INDICES if through is None else through
        nodes = np.union1d(self.constraints.through, more)
        ends = self.constraints.ends or _at_ends(nodes, self.contour)
        constraints = self.constraints._replace(ends=ends, through=nodes)
        return replace(self, goal=Within(within), constraints=constraints, weights=None)

    def to_dict(self) -> dict[str, Any]:
        """The request as numbers, words and lists, its points among them."""
        goal = {"goal": type(self.goal).__name__, **vars(self.goal)}
        kept = self.constraints
        return {
            "points": self.contour.points[self.contour.source].tolist(),
            "closed": self.contour.closed,
            "accuracy": self.contour.accuracy,
            "goal": goal,
            "style": {name: plain(value) for name, value in vars(self.style).items()},
            "constraints": {
                "ends": kept.ends,
                "through": kept.through.tolist(),
                "tangents": [plain(tangent) for tangent in kept.tangents],
            },
            "symmetric": self.symmetric,
            "weights": plain(self.weights),
            "sigma": plain(self.sigma),
            "loss": self.loss,
            "effort": self.effort,
            "left_out": self.left_out.tolist(),
            "pieces_only": self.pieces_only,
            "is_part": self.is_part,
        }

    @classmethod
    def from_dict(cls, said: Mapping[str, Any]) -> Request:
        """The request that `to_dict` told of."""
        goals = {goal.__name__: goal for goal in get_args(Goal)}
        goal, style, kept = dict(said["goal"]), dict(said["style"]), said["constraints"]
        if isinstance(style["corners"], list):
            style["corners"] = np.array(style["corners"], dtype=np.int64)
        style["regularities"] = tuple(style["regularities"])
        begin, end = (None if t is None else np.array(t) for t in kept["tangents"])
        return cls(
            contour=Contour.silently(said["points"], said["closed"], accuracy=said["accuracy"]),
            goal=goals[goal.pop("goal")](**goal),
            style=Style(**style),
            constraints=Constraints(
                kept["ends"], np.array(kept["through"], dtype=np.int64), (begin, end)
            ),
            symmetric=said["symmetric"],
            weights=None if said["weights"] is None else np.array(said["weights"]),
            sigma=None if said["sigma"] is None else np.array(said["sigma"]),
            loss=said["loss"],
            effort=said["effort"],
            left_out=np.array(said["left_out"], dtype=np.int64),
            pieces_only=said["pieces_only"],
            is_part=said["is_part"],
        ).checked()


def _contour(points: ArrayLike | Contour, closed: bool | None) -> Contour:
    if not isinstance(points, Contour):
        return Contour(points, closed)
    if closed is None or closed == points.closed:
        return points
    return Contour.silently(points.points[points.source], closed, accuracy=points.accuracy)


def _goal(settings: Settings, contour: Contour) -> Goal:
    if settings.tolerance is not None:
        return Within(tolerance_length(settings.tolerance, contour))
    if settings.n_control_points is not None:
        return OfSize(settings.n_control_points, settings.knots, settings.method)
    return Estimate(settings.method)


def _style(settings: Settings, contour: Contour) -> Style:
    names = settings.regularities
    names = NAMES if names == "auto" else () if names is None else tuple(names)
    return Style(
        settings.degree,
        settings.form,
        _corners(settings, contour),
        "drawn" if settings.as_drawn else "fewest",
        names,
        settings.simplify,
        settings.smoothness,
    )


def _corners(settings: Settings, contour: Contour) -> CornerChoice | IntArray | None:
    if settings.corners is None or isinstance(settings.corners, str):
        return settings.corners  # type: ignore[return-value]
    return _of_contour("corners", np.asarray(settings.corners), contour)


def _constraints(settings: Settings, contour: Contour) -> Constraints:
    """What must be kept exactly, by indices of the contour's points."""
    if settings.end_tangents is not None and contour.closed:
        raise InvalidInputError("end_tangents act on open curves only: pass closed=False")
    if settings.symmetric and not contour.closed:
        raise InvalidInputError("symmetric acts on closed outlines only: pass closed=True")
    nodes = NO_INDICES
    if settings.through is not None:
        nodes = _of_contour("through", np.asarray(settings.through), contour)
    begin, end = settings.end_tangents or (None, None)
    tangents: Tangents = (
        None if begin is None else np.array(begin),
        None if end is None else np.array(end),
    )
    held = any(tangent is not None for tangent in tangents)
    ends = settings.ends == "fixed" or held or _at_ends(nodes, contour)
    return Constraints(ends, nodes, tangents)


def _without(given: IntArray, values: FloatArray | None) -> FloatArray | None:
    """One value for each point that stays, or the one of all."""
    return np.delete(values, given, axis=0) if values is not None and values.ndim else values


def _of_contour(name: str, indices: IntArray, contour: Contour) -> IntArray:
    """Indices of points as they were given, as those of the contour, sorted, each once."""
    if len(indices) and indices.max() >= contour.n_given:
        raise InvalidInputError(
            f"{name} must be indices below {contour.n_given}, got {indices.tolist()}"
        )
    return distinct(contour.source[indices])


def _at_ends(nodes: IntArray, contour: Contour) -> bool:
    """Whether one of some points is an end of an open contour."""
    return not contour.closed and not {0, len(contour) - 1}.isdisjoint(nodes.tolist())


def _unit(vector: FloatArray) -> FloatArray:
    return vector / float(np.hypot(*vector))

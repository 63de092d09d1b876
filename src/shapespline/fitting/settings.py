"""Settings: the options of a fit whatever its points are, checked against each other."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, TypeGuard, get_args

import numpy as np

from shapespline.engines.drawn import NAMES
from shapespline.engines.least_squares import named_solver
from shapespline.errors import InvalidInputError
from shapespline.monitor import checked_time_limit
from shapespline.typing import Character, CornerChoice, Effort, Ends, Form, Knots, Loss
from shapespline.validation import (
    checked_choice,
    checked_flag,
    checked_indices,
    float_array,
    is_number,
)
from shapespline.values import check_count, check_degree

if TYPE_CHECKING:
    from shapespline.typing import ArrayLike
    from shapespline.values import Contour

DEFAULT_METHOD = "levenberg-marquardt"
# Of settings in a file: a later program may read them otherwise.
SETTINGS_VERSION = 1
# The words that options may be.
WORDS = {
    "form": get_args(Form),
    "ends": get_args(Ends),
    "effort": get_args(Effort),
    "knots": get_args(Knots),
    "character": get_args(Character),
    "corners": get_args(CornerChoice),
    "loss": get_args(Loss),
}


@dataclass(frozen=True, eq=False, kw_only=True)
class Settings:
    """The options of `fit_curve` without its points, checked against each other.

    What an option means is said there. An option that would not act is refused with a sentence;
    the only ones that may be said in vain are those that hold anyway (the ends of a closed outline,
    corners that are free on one smooth spline).

    Raises
    ------
    InvalidInputError
        If an option is not usable, or acts with none of the others.

    Examples
    --------
    >>> Settings(tolerance="0.1%", effort="fast").to_dict()
    {'tolerance': '0.1%', 'effort': 'fast'}
    >>> Settings.from_dict({"n_control_points": 12}).n_control_points
    12
    """

    tolerance: float | str | None = None
    n_control_points: int | None = None
    degree: int = 3
    corners: CornerChoice | ArrayLike | None = "auto"
    form: Form = "pieces"
    ends: Ends = "free"
    end_tangents: tuple[ArrayLike | None, ArrayLike | None] | None = None
    through: ArrayLike | None = None
    symmetric: bool = False
    character: Character | None = None
    regularities: str | Sequence[str] | None = "auto"
    simplify: bool = False
    smoothness: int = 1
    effort: Effort = "balanced"
    weights: ArrayLike | None = None
    sigma: ArrayLike | None = None
    loss: Loss | None = None
    knots: Knots = "balanced"
    outliers: bool = False
    method: str = DEFAULT_METHOD
    time_limit: float | None = None

    def __post_init__(self) -> None:
        set_ = object.__setattr__
        set_(self, "degree", check_degree(self.degree))
        for name in ("form", "ends", "effort", "knots"):
            checked_choice(name, getattr(self, name), WORDS[name])
        if self.character is not None:
            checked_choice("character", self.character, WORDS["character"])
        for name in ("symmetric", "simplify", "outliers"):
            set_(self, name, checked_flag(name, getattr(self, name)))
        set_(self, "time_limit", checked_time_limit(self.time_limit))
        set_(self, "regularities", _regularities(self.regularities))
        set_(self, "smoothness", _smoothness(self.smoothness))
        named_solver(self.method)
        if self.tolerance is not None:
            _checked_tolerance(self.tolerance)
        if self.n_control_points is not None:
            set_(self, "n_control_points", check_count(self.n_control_points, self.degree))
        if not (self.corners is None or isinstance(self.corners, str)):
            expected = "'auto', 'free', None or indices of points"
            set_(self, "corners", checked_indices("corners", self.corners, expected))
        elif isinstance(self.corners, str) and self.corners not in WORDS["corners"]:
            raise InvalidInputError(
                f"corners must be 'auto', 'free', None or indices, got {self.corners!r}"
            )
        if self.end_tangents is not None:
            set_(self, "end_tangents", _directions(self.end_tangents))
        if self.through is not None:
            expected = "None or indices of points"
            set_(self, "through", checked_indices("through", self.through, expected))
        for name in ("weights", "sigma"):
            if getattr(self, name) is not None:
                set_(self, name, float_array(getattr(self, name), name))
        if self.loss is not None:
            checked_choice("loss", self.loss, WORDS["loss"])
        self._check_together()

    def _check_together(self) -> None:
        """Raise if an option would be dropped beside the others."""
        if self.tolerance is not None and self.n_control_points is not None:
            raise InvalidInputError("tolerance and n_control_points exclude each other: give one")
        sized, within = self.n_control_points is not None, self.tolerance is not None
        if self.knots != "balanced" and not sized:
            raise InvalidInputError("knots act with n_control_points only: give a number of them")
        if self.method != DEFAULT_METHOD and within:
            raise InvalidInputError(
                "method acts in least squares, not within a tolerance: leave one of them out"
            )
        if self.method != DEFAULT_METHOD and not self._one_spline:
            raise InvalidInputError(
                "method acts with n_control_points, weights, sigma, loss or form='spline': give"
                " one of them"
            )
        if self._has("sigma", "loss") and (within or self.weights is not None):
            beside = "within a tolerance" if within else "beside weights"
            raise InvalidInputError(
                f"sigma and loss act in least squares, not {beside}: leave one of them out"
            )
        if self._has("end_tangents", "through", "symmetric") and not within:
            raise InvalidInputError(
                "end_tangents, through and symmetric act within a tolerance: give one"
            )
        if sized:
            self._refuse(("corners", "form", "effort"), "with n_control_points")
        elif self._has("weights", "sigma", "loss") and not within:
            said = next(name for name in ("weights", "sigma", "loss") if self._has(name))
            self._refuse(("corners", "effort"), f"with {said} and no tolerance")
        if self.form == "spline" and not isinstance(self.corners, str | None):
            raise InvalidInputError("corners must be 'auto', 'free' or None for form='spline'")
        if self.form == "arcs":
            self._check_arcs(within)
        if self.form == "spline" and within:
            if self._has("end_tangents", "through"):
                raise InvalidInputError("end_tangents and through act with form='pieces' only")
            if self.symmetric:
                raise InvalidInputError("symmetric acts with form='pieces' only")
        self._check_drawn()
        if self.smoothness == 2:
            self._check_smooth(within)
        held = self.end_tangents is not None and self.end_tangents != (None, None)
        if held and isinstance(self.corners, str) and self.corners == "free":
            raise InvalidInputError(
                "end_tangents do not act with corners='free': joints are free there"
            )

    def _check_arcs(self, within: bool) -> None:
        """Raise if lines and arcs cannot be made, or an option does not act on them."""
        if not within:
            raise InvalidInputError("form='arcs' acts within a tolerance: give one")
        if self.degree < 3:
            raise InvalidInputError(
                f"degree must be 3 or more for form='arcs', got {self.degree}: arcs stand in the"
                " curve as cubics"
            )
        if self.symmetric:
            raise InvalidInputError("symmetric acts with form='pieces' only")

    def _check_smooth(self, within: bool) -> None:
        """Raise if joints cannot be continuous in curvature beside the other options."""
        if not within:
            raise InvalidInputError("smoothness=2 acts within a tolerance: give one")
        if self.degree < 3:
            raise InvalidInputError(
                f"degree must be 3 or more for smoothness=2, got {self.degree}: the curvature of"
                " parabolas jumps from one to the next"
            )
        if self.form != "pieces" or self.character == "drawn" or self.simplify:
            raise InvalidInputError(
                "smoothness=2 acts with form='pieces' and character='fewest' only: one spline is as"
                " smooth anyway, lines and arcs are not"
            )
        if isinstance(self.corners, str) and self.corners == "free":
            raise InvalidInputError(
                "smoothness=2 does not act with corners='free': joints are free there"
            )
        if self._has("end_tangents", "through", "symmetric"):
            raise InvalidInputError(
                "smoothness=2 holds no tangents, points or symmetry: leave end_tangents, through"
                " and symmetric out"
            )

    def _check_drawn(self) -> None:
        """Raise if the shape cannot be given as it was drawn beside the other options."""
        if self.simplify and self.tolerance is None:
            raise InvalidInputError("simplify acts within a tolerance: give one")
        if self.simplify and self.character == "fewest":
            raise InvalidInputError("simplify acts with character='drawn' only: leave one out")
        if self.character == "fewest" and self.regularities != "auto":
            raise InvalidInputError("regularities act with character='drawn' only: say it")
        asked = self.simplify or self.regularities != "auto"
        if self.character == "fewest" or (self.character is None and not asked):
            return
        said = "character='drawn'" if self.character else "simplify"
        said = said if self.character or self.simplify else "regularities"
        if self.degree < 3:
            raise InvalidInputError(
                f"degree must be 3 or more for {said}, got {self.degree}: arcs stand in the curve"
                " as cubics"
            )
        if self._one_spline:
            raise InvalidInputError(
                f"{said} cannot act where one spline is made: leave form='spline',"
                " n_control_points, weights, sigma and loss out"
            )
        if self.corners is None or not isinstance(self.corners, str) or self.corners == "free":
            raise InvalidInputError(
                f"{said} cannot act where corners are given: leave corners='auto' as it is"
            )
        if self._has("end_tangents", "through"):
            raise InvalidInputError(
                f"{said} cannot act where something else is kept: leave end_tangents and through"
                " out"
            )

    @property
    def as_drawn(self) -> bool:
        """Whether lines and arcs come first: where that is said, or nothing speaks against it."""
        if self.character is not None:
            return self.character == "drawn"
        kept = self._has("end_tangents", "through")
        finds_corners = isinstance(self.corners, str) and self.corners == "auto"
        kept = kept or self.smoothness == 2
        return self.degree >= 3 and finds_corners and not (self._one_spline or kept)

    @property
    def _one_spline(self) -> bool:
        """Whether least squares make one spline."""
        given = self._has("n_control_points", "weights", "sigma", "loss")
        return given or self.form == "spline"

    def _has(self, *names: str) -> bool:
        values = [getattr(self, name) for name in names]
        return any(value is not None and value is not False for value in values)

    def _refuse(self, names: tuple[str, ...], beside: str) -> None:
        """Raise if one of some options was said."""
        for name in names:
            value, default = getattr(self, name), type(self).__dataclass_fields__[name].default
            if not (isinstance(value, str) and value == default):
                raise InvalidInputError(f"{name} does not act {beside}: leave one of them out")

    def to_dict(self) -> dict[str, Any]:
        """What differs from the defaults, as numbers, words and lists: what JSON and TOML hold."""
        said = {item.name: getattr(self, item.name) for item in fields(self)}
        return {
            name: plain(value)
            for name, value in said.items()
            if not (
                isinstance(value, str | int | float | None)
                and value == type(self).__dataclass_fields__[name].default
            )
        }

    def to_toml(self) -> str:
        """The text of a file of settings: its version, and what differs from the defaults.

        Examples
        --------
        >>> print(Settings(tolerance=0.5, corners=None).to_toml(), end="")
        version = 1
        tolerance = 0.5
        corners = "none"
        """
        found = {"version": SETTINGS_VERSION, **self.to_dict()}
        # JSON's numbers, booleans and plain strings are TOML's, too; it has no word for None.
        return "".join(
            f"{name} = {json.dumps('none' if value is None else value)}\n"
            for name, value in found.items()
        )

    @classmethod
    def from_dict(cls, options: Mapping[str, Any]) -> Settings:
        """The settings that some options make; one that is not among them is refused."""
        known = [item.name for item in fields(cls)]
        for name in options:
            if name not in known:
                raise InvalidInputError(
                    f"{name} is not an option of a fit; these are: {', '.join(sorted(known))}"
                )
        return cls(**options)


def tolerance_length(tolerance: float | str, contour: Contour) -> float:
    """A tolerance as a length in data units: a number, or a part of the box diagonal in per cent.

    Examples
    --------
    >>> from shapespline import Contour
    >>> tolerance_length("0.5%", Contour([(0, 0), (3, 4)]))
    0.025
    """
    number, is_part = _checked_tolerance(tolerance)
    return number * (0.01 * contour.box_diagonal) if is_part else number


def _checked_tolerance(tolerance: object) -> tuple[float, bool]:
    """The number of a tolerance, and whether it is a part of the box diagonal in per cent."""
    number, is_part = np.nan, False
    if isinstance(tolerance, str):
        text = tolerance.strip()
        is_part = text.endswith("%")
        with suppress(ValueError):
            number = float(text.removesuffix("%"))
    elif is_number(tolerance):
        number = float(tolerance)  # type: ignore[arg-type]
    if not 0 < number < np.inf:
        raise InvalidInputError(
            "tolerance must be a positive length in data units, or a part of the box diagonal"
            f" such as '0.1%', got {tolerance!r}"
        )
    return number, is_part


def _directions(
    end_tangents: object,
) -> tuple[tuple[float, float] | None, tuple[float, float] | None]:
    """A pair of unit vectors, None where the direction is free."""
    message = (
        "end_tangents must be a pair of vectors (x, y), None where the direction is free,"
        f" got {end_tangents!r}"
    )
    if isinstance(end_tangents, str) or not isinstance(end_tangents, Sequence | np.ndarray):
        raise InvalidInputError(message)
    if len(end_tangents) != 2:
        raise InvalidInputError(message)
    found: list[tuple[float, float] | None] = []
    for tangent in end_tangents:
        if tangent is None:
            found.append(None)
            continue
        given = float_array(tangent, "end_tangents")
        length = float(np.hypot(*given)) if given.shape == (2,) else 0.0
        if not 0 < length < np.inf:
            raise InvalidInputError(message)
        x, y = (given / length).tolist()
        found.append((x, y))
    return found[0], found[1]


def _smoothness(value: object) -> int:
    """1 or 2 as a number of Python."""
    if isinstance(value, bool) or not is_number(value) or value not in (1, 2):
        raise InvalidInputError(
            "smoothness must be 1 (tangents have no jumps) or 2 (curvature has none either),"
            f" got {value!r}"
        )
    return int(value)


def _regularities(value: object) -> str | tuple[str, ...] | None:
    """Names of regularities, or the word or None that stands for all or none."""
    if value is None or (isinstance(value, str) and value == "auto"):
        return value
    names = (value,) if isinstance(value, str) else tuple(value) if _is_list(value) else None
    if names is None or any(name not in NAMES for name in names):
        raise InvalidInputError(
            f"regularities must be 'auto', None or some of {', '.join(NAMES)}, got {value!r}"
        )
    return names


def _is_list(value: object) -> TypeGuard[Sequence[str]]:
    return isinstance(value, Sequence) and all(isinstance(item, str) for item in value)


def plain(value: Any) -> Any:
    """Arrays and tuples as lists."""
    if isinstance(value, np.ndarray):
        return value.tolist()
    return [plain(item) for item in value] if isinstance(value, tuple) else value

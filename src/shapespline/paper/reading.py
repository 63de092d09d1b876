"""Reading: how the open points of the paper are taken (METHOD, section 2)."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Literal

from shapespline.analysis import check_window
from shapespline.engines.least_squares import ENDS, METHODS, STARTS, RunSettings
from shapespline.errors import InvalidInputError
from shapespline.geometry import PARAMETRIZATIONS
from shapespline.solvers import Limits
from shapespline.validation import is_number, whole_number

if TYPE_CHECKING:
    from collections.abc import Iterable

    from shapespline.solvers import StartDiagonal, Wolfe

_CHOICES = {
    "start": tuple(STARTS),
    "offset": ("difference", "curvature", "cpda", "squared", "none"),
    "normals": ("chord", "neighbours"),
    "parametrization": ("greville", *PARAMETRIZATIONS),
    "method": METHODS,
    "start_diagonal": ("gauss-newton", "identity"),
    "wolfe": ("strong", "weak"),
    "ends": ENDS,
}
_TRUTH = {"true": True, "yes": True, "1": True, "false": False, "no": False, "0": False}


@dataclass(frozen=True)
class Reading:
    """The open points of the paper, each as a choice; ``SENSIBLE`` by default.

    The first half of the fields makes the initial curve, the second says how it is optimised.

    Attributes
    ----------
    signed : bool
        Signed CPDA sums (reading 4).
    window : int or None
        Moving average in points, None grows with L and noise (reading 7).
    prominence : float or None
        Part of the largest H that a maximum must rise, None takes every one (reading 8).
    spacing : int or None
        Least number of points between maxima, None for half the chord length (reading 8).
    start : str
        What gets a control point: the maxima of H with the gaps between them filled at equal
        integrals of the root of the curvature (``"cpda-filled"``), with wide gaps halved by index
        (``"cpda-halved"``), or alone as published (``"cpda-maxima"``); points at equal integrals
        (``"curvature"``), at equal arc length (``"arc-length"``), or every so many
        (``"every-nth"``). Or a curve that is solved for, for comparison: ``"park-lee"``,
        ``"dominant"``, ``"uniform"`` (one linear solve at uniform parameters), ``"balanced"``
        (several short fits); these take their own knots and parameters.
    offset : {"difference", "curvature", "cpda", "squared", "none"}
        How a control point leaves its dominant point (reading 9): against (p + 1) / 24 of the
        second difference of the dominant points (quasi-interpolation); or along the normal by
        (p + 1) / 24 k h^2 with the curvature k and the control spacing h, by H_r, or by the
        paper's (max H) H_r, which is a squared length; or not at all.
    normals : {"chord", "neighbours"}
        Differences over the chord length with the side of the signed CPDA sum, none below its
        floor; or differences of neighbours (reading 10).
    parametrization : {"greville", "uniform", "chord", "centripetal"}
        Parameters of the data (reading 11).
    clamped : bool
        Clamped knots and P_0 = Q_0, P_m = Q_n for closed data too (reading 12).
    closing_point : bool
        Of closed data on clamped knots, Q_n repeats Q_0: the curve comes back to where it began.
    resampled : bool
        Take CPDA on points at equal arc length (reading 6).
    method : str
        The optimiser, a name of :func:`shapespline.optimize`.
    start_diagonal : {"gauss-newton", "identity"}
        What a quasi-Newton method takes for the Hessian at first.
    wolfe : {"strong", "weak"}
        Its line search.
    ends : {"fixed", "fitted", "free"}
        Whether the ends of a clamped curve are held.
    stray_weight : float
        Weight of the residuals that hold the curve on the data between the points.
    relative_decrease : float
        The run ends when the cost falls by less than this part of it, three times in a row.
    max_evaluations : int
        The run ends after so many evaluations, and so many iterations.

    Examples
    --------
    >>> Reading(offset="cpda").signed, LITERAL.offset
    (True, 'squared')
    """

    signed: bool = True
    window: int | None = None
    prominence: float | None = 0.02
    spacing: int | None = None
    start: str = "cpda-filled"
    offset: str = "difference"
    normals: str = "chord"
    parametrization: str = "greville"
    clamped: bool = False
    closing_point: bool = True
    resampled: bool = True
    method: str = "d-bfgs"
    start_diagonal: StartDiagonal = "gauss-newton"
    wolfe: Wolfe = "strong"
    ends: Literal["fixed", "fitted", "free"] = "fixed"
    stray_weight: float = 0.1
    relative_decrease: float = 1e-6
    max_evaluations: int = 4000

    def __post_init__(self) -> None:
        for name, choices in _CHOICES.items():
            value = getattr(self, name)
            if value not in choices:
                raise InvalidInputError(
                    f"{name} must be one of {', '.join(choices)}, got {value!r}"
                )
        if self.window is not None:
            check_window(self.window)
        if self.spacing is not None and (whole_number(self.spacing) or 0) < 1:
            raise InvalidInputError(
                f"spacing must be None or at least 1 point, got {self.spacing!r}"
            )
        if self.prominence is not None and not 0 <= self.prominence < 1:
            raise InvalidInputError(
                "prominence must be None or a part of the largest H, 0 to below 1,"
                f" got {self.prominence!r}"
            )
        if not (is_number(self.stray_weight) and 0 <= self.stray_weight < float("inf")):
            raise InvalidInputError(
                f"stray_weight must be 0 or a positive number, got {self.stray_weight!r}; try 0.1"
            )
        self.limits  # noqa: B018 - checks the two fields that it is made of

    @property
    def limits(self) -> Limits:
        """When a run ends."""
        return Limits(
            max_iterations=self.max_evaluations,
            max_evaluations=self.max_evaluations,
            relative_decrease=self.relative_decrease,
        )

    @property
    def settings(self) -> RunSettings:
        """What `optimize` takes from a start of this reading."""
        return RunSettings(
            method=self.method,
            start_diagonal=self.start_diagonal,
            wolfe=self.wolfe,
            ends=self.ends,
            stray_weight=self.stray_weight,
            closing_point=self.closing_point,
            limits=self.limits,
        )

    def changed(self, changes: Iterable[str]) -> Reading:
        """The same with fields set by words such as ``window=7``.

        Raises
        ------
        InvalidInputError
            For a word without ``=``, an unknown field, or a value that it cannot take.

        Examples
        --------
        >>> SENSIBLE.changed(["window=7", "clamped=yes"]).window
        7
        """
        values: dict[str, object] = {}
        kinds = {field.name: str(field.type) for field in fields(self)}
        for change in changes:
            name, is_set, text = change.partition("=")
            if name not in kinds or not is_set:
                raise InvalidInputError(
                    f"reading must be set by FIELD=VALUE with a field of {', '.join(kinds)},"
                    f" got {change!r}"
                )
            values[name] = _value(name, kinds[name], text)
        return replace(self, **values)  # type: ignore[arg-type]


def _value(name: str, kind: str, text: str) -> object:
    """A word as the value of a field of this kind."""
    if "None" in kind and text.lower() == "none":
        return None
    try:
        if kind == "bool":
            return _TRUTH[text.lower()]
        if kind.startswith("int"):
            return int(text)
        return float(text) if kind.startswith("float") else text
    except (KeyError, ValueError):
        kind = kind.replace("bool", "true or false").replace(" | ", " or ")
        raise InvalidInputError(f"{name} must be {kind}, got {text!r}") from None


SENSIBLE = Reading()
# MATLAB's moving average, which the paper had at hand, spans 5 points unless told otherwise. The
# last point of a closed outline, Q_n, is its first once more: the curve ends in it.
LITERAL = Reading(
    signed=False,
    window=5,
    prominence=None,
    spacing=1,
    start="cpda-maxima",
    offset="squared",
    normals="neighbours",
    parametrization="uniform",
    clamped=True,
    closing_point=True,
    resampled=False,
    method="d-bfgs-inverse",
    start_diagonal="identity",
    wolfe="weak",
    ends="free",
    stray_weight=0.0,
    # The paper names no stopping rule: until the run stands still.
    relative_decrease=1e-6,
    max_evaluations=50_000,
)

"""Reading: how the open points of the paper are taken (METHOD, section 2)."""

from __future__ import annotations

from dataclasses import dataclass

from shapespline.analysis import check_window
from shapespline.errors import InvalidInputError
from shapespline.geometry import PARAMETRIZATIONS
from shapespline.validation import whole_number

_CHOICES = {
    "offset": ("difference", "curvature", "cpda", "squared", "none"),
    "normals": ("chord", "neighbours"),
    "parametrization": ("greville", *PARAMETRIZATIONS),
}


@dataclass(frozen=True)
class Reading:
    """The open points of the paper, each as a choice; ``SENSIBLE`` by default.

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
    supplemented : bool
        Halve the widest gaps where there are fewer maxima than the degree needs (reading 3).
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
    resampled : bool
        Take CPDA on points at equal arc length (reading 6).

    Examples
    --------
    >>> Reading(offset="cpda").signed, LITERAL.offset
    (True, 'squared')
    """

    signed: bool = True
    window: int | None = None
    prominence: float | None = 0.02
    spacing: int | None = None
    supplemented: bool = True
    offset: str = "difference"
    normals: str = "chord"
    parametrization: str = "greville"
    clamped: bool = False
    resampled: bool = True

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


SENSIBLE = Reading()
LITERAL = Reading(
    signed=False,
    window=3,
    prominence=None,
    spacing=1,
    supplemented=False,
    offset="squared",
    normals="neighbours",
    parametrization="uniform",
    clamped=True,
    resampled=False,
)

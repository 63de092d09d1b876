"""Goals of a request, and the style of the curve that meets one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from shapespline.engines.drawn import NAMES
from shapespline.fitting.settings import DEFAULT_METHOD

if TYPE_CHECKING:
    from shapespline.typing import Character, CornerChoice, Form, IntArray, Knots


@dataclass(frozen=True)
class Within:
    """The fewest stored points whose curve keeps a tolerance, both ways; data units."""

    tolerance: float


@dataclass(frozen=True)
class OfSize:
    """One spline of a number of control points by least squares."""

    n_control_points: int
    knots: Knots = "balanced"
    method: str = DEFAULT_METHOD


@dataclass(frozen=True)
class Estimate:
    """The curve behind points of which nothing else is known."""

    method: str = DEFAULT_METHOD


Goal = Within | OfSize | Estimate


@dataclass(frozen=True, eq=False)
class Style:
    """How the curve is made: degree, form and corners (a word, or indices of the contour).

    ``character`` says whether structure comes before few points, ``regularities`` which may be
    taken then, ``simplify`` whether features below the tolerance are left out. ``smoothness`` is 1
    where tangents have no jumps but in corners, 2 where curvature has none either.
    """

    degree: int = 3
    form: Form = "pieces"
    corners: CornerChoice | IntArray | None = "auto"
    character: Character = "fewest"
    regularities: tuple[str, ...] = NAMES
    simplify: bool = False
    smoothness: int = 1

    @property
    def free(self) -> bool:
        """Whether corners may be rounded and made."""
        return isinstance(self.corners, str) and self.corners == "free"

    @property
    def names_corners(self) -> bool:
        """Whether the caller knows the corners, or that there are none."""
        return not isinstance(self.corners, str)

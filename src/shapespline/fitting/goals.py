"""Goals of a request, and the style of the curve that meets one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from shapespline.analysis import largest_bulge
from shapespline.engines.drawn import NAMES
from shapespline.errors import PictureWarning, SparsePointsWarning
from shapespline.fitting.settings import DEFAULT_METHOD

if TYPE_CHECKING:
    from shapespline.typing import Character, CornerChoice, Form, IntArray, Knots
    from shapespline.values import Contour

# A smooth curve may pass its points by a tolerance on one side, their chords by one on the other.
SPARSE = 2.0
# What is nearer to a traced outline than so many times its accuracy follows its errors (FIT-41).
FOLLOWED = 2.5


@dataclass(frozen=True)
class Within:
    """The fewest stored points whose curve keeps a tolerance, both ways; data units."""

    tolerance: float

    def remarks(self, contour: Contour) -> list[UserWarning]:
        """What to know of a contour's curve within the tolerance before it is looked for."""
        found = self._of_sparse(contour), self._of_errors(contour)
        return [remark for remark in found if remark is not None]

    def _of_sparse(self, contour: Contour) -> SparsePointsWarning | None:
        """That a smooth curve through the points does not keep it between them."""
        bulge = largest_bulge(contour)
        if bulge <= SPARSE * self.tolerance:
            return None
        return SparsePointsWarning(
            "the points are sparse for their tolerance: a smooth curve through them lies up to"
            f" {bulge:.3g} off the chords between them, and tolerance={self.tolerance:.3g} is kept"
            " between points, too, by corners if need be; give more points or"
            f" tolerance={1.1 * bulge:.2g} for a smooth curve"
        )

    def _of_errors(self, contour: Contour) -> PictureWarning | None:
        """That a picture tells the contour less exactly than the curve is to follow it."""
        if contour.level_line is None or not contour.accuracy:
            return None
        told = FOLLOWED * contour.accuracy
        if self.tolerance >= told:
            return None
        return PictureWarning(
            f"the picture tells an outline to {told:.2g} only: a curve within"
            f" tolerance={self.tolerance:.3g} follows the steps of its pixels or its grain by"
            " many pieces; leave the tolerance out, or give"
            f" tolerance={1.05 * told:.2g} or more"
        )


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

"""What a drawn shape is made of: lines, arcs, free-form runs, and what they keep."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from shapespline.typing import FloatArray
    from shapespline.values import Arc, Regularity


@dataclass(frozen=True, eq=False)
class DrawnLine:
    """A straight edge."""

    begin: FloatArray
    end: FloatArray


@dataclass(frozen=True, eq=False)
class DrawnArc:
    """Part of a circle, and its ends as its neighbours have them."""

    arc: Arc
    begin: FloatArray
    end: FloatArray


@dataclass(frozen=True, eq=False)
class FreeRun:
    """Data that neither explains: points with both ends, and tangents there that are known."""

    points: FloatArray
    tangents: tuple[FloatArray | None, FloatArray | None]
    closed: bool = False


Part = DrawnLine | DrawnArc | FreeRun


@dataclass(frozen=True, eq=False)
class Drawn:
    """Parts end to end, and the regularities that they keep, by their places among the parts.

    ``is_told`` if these are enough to tell that it was drawn so; ``n_unknowns`` numbers of lines
    and arcs are what they leave free; ``supposed`` is the standard deviation that these tell of
    points whose neighbours tell none, 0 of others, ``precisions`` (n,) those over that of most
    of the points where these are supposed not to be alike. ``errors_go_on`` from point to point if
    neighbours tend to lie on the same side of their element. ``otherwise`` is what noisy points
    tell otherwise: with only those regularities that they nearly meet, or with other errors.
    """

    parts: tuple[Part, ...]
    regularities: tuple[Regularity, ...]
    is_told: bool
    n_unknowns: int
    supposed: float = 0.0
    precisions: FloatArray | None = None
    errors_go_on: bool = False
    otherwise: Drawn | None = None

    def or_else(self, other: Drawn | None) -> Drawn:
        """The same, another reading after all that it may be otherwise."""
        last = other if self.otherwise is None else self.otherwise.or_else(other)
        return replace(self, otherwise=last)

    @property
    def has_runs(self) -> bool:
        """Whether some of it is neither line nor arc."""
        return any(isinstance(part, FreeRun) for part in self.parts)

    @property
    def size(self) -> int:
        """Stored points of lines and arcs, one and two each."""
        return sum(
            2 if isinstance(part, DrawnArc) else 1
            for part in self.parts
            if not isinstance(part, FreeRun)
        )

    @property
    def share(self) -> float:
        """Part of the length that lines and arcs make up."""
        lengths = [_length_of(part) for part in self.parts]
        free = (isinstance(part, FreeRun) for part in self.parts)
        return 1.0 - sum(s for s, one in zip(lengths, free, strict=True) if one) / sum(lengths)


def _length_of(part: Part) -> float:
    if isinstance(part, DrawnArc):
        return part.arc.length()
    points = part.points if isinstance(part, FreeRun) else np.stack([part.begin, part.end])
    return float(np.hypot(*np.diff(points, axis=0).T).sum())

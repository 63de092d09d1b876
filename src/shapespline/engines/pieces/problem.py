"""A contour made ready for a search within a tolerance: order and unit, corners, straight runs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from shapespline.analysis import GENTLE_TURN, NormalizedContour, find_corners
from shapespline.engines.pieces.constraints import Constraints
from shapespline.errors import InvalidInputError

if TYPE_CHECKING:
    from shapespline.typing import ArrayLike, IntArray
    from shapespline.values import Contour

CornerChoice = Literal["auto", "free"]


class PiecesProblem(NamedTuple):
    """What a search within a tolerance knows about a contour before it begins.

    ``frame`` holds the points in its order and unit, ``tolerance`` is in that unit too. ``corners``
    are indices of its points, ``gentle`` (n,) is 1 where the outline hardly turns, ``held`` is in
    its order and direction. ``dense`` are points as they came, in that unit, where the frame holds
    thinned ones.
    """

    frame: NormalizedContour
    tolerance: float
    corners: IntArray
    gentle: IntArray
    held: Constraints = Constraints()
    dense: Contour | None = None

    @classmethod
    def of(
        cls,
        contour: Contour,
        tolerance: float,
        corners: CornerChoice | ArrayLike | None,
        held: Constraints | None = None,
    ) -> PiecesProblem:
        """The outline of a contour; corners as `fit_pieces` takes them.

        Examples
        --------
        >>> from shapespline import Contour
        >>> side = np.linspace(0, 1, 20, endpoint=False)
        >>> x = np.concatenate([side, 1 + 0 * side, 1 - side, 0 * side])
        >>> square = Contour(np.column_stack([x, np.roll(x, 20)]), closed=True)
        >>> outline = PiecesProblem.of(square, 0.01, "auto")
        >>> len(outline.corners)
        4
        """
        frame = NormalizedContour.of(contour)
        aim, n = tolerance * frame.scale, len(contour)
        gentle = np.ones(n, dtype=np.int64)
        held = _in_frame(Constraints() if held is None else held, frame)
        if corners is None:
            return cls(frame, aim, np.empty(0, dtype=np.int64), gentle, held)
        if isinstance(corners, str):
            if corners not in ("auto", "free"):
                raise InvalidInputError(
                    f"corners must be 'auto', 'free', None or indices, got {corners!r}"
                )
            found = find_corners(frame.contour, aim)
            gentle = (found.turns < GENTLE_TURN).astype(np.int64)
            return cls(frame, aim, found.indices, gentle, held)
        given = np.asarray(corners)
        if given.ndim != 1 or (given.size and given.dtype.kind not in "iu"):
            raise InvalidInputError(f"corners must be one list of whole numbers, got {corners!r}")
        if given.size and (given.min() < 0 or given.max() >= n):
            raise InvalidInputError(f"corners must be indices below {n}, got {given.tolist()}")
        return cls(frame, aim, np.unique(frame.place[given.astype(np.int64)]), gentle, held)

    def thinned(self) -> PiecesProblem:
        """The outline without the points that the search does not need, its tolerance less so."""
        stay = np.union1d(self.corners, self.held.through)
        frame = self.frame.thinned(self.tolerance, stay)
        if frame is self.frame:
            return self
        place = self.frame.place[frame.order]
        return self._replace(
            frame=frame,
            tolerance=self.tolerance - frame.slack,
            corners=np.flatnonzero(np.isin(place, self.corners)),
            gentle=self.gentle[place],
            held=self.held._replace(through=np.flatnonzero(np.isin(place, self.held.through))),
        )


def _in_frame(held: Constraints, frame: NormalizedContour) -> Constraints:
    """What is held, in the order and direction of a frame."""
    begin, end = held.tangents
    if frame.reversed:
        begin, end = (None if t is None else -t for t in (end, begin))
    through = np.unique(frame.place[held.through]) if len(held.through) else held.through
    return held._replace(through=through, tangents=(begin, end))

"""A contour made ready for a search within a tolerance: order and unit, corners, constraints."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.analysis import LOW_TURN, NormalizedContour, find_corners
from shapespline.engines.pieces.constraints import Constraints
from shapespline.errors import InvalidInputError
from shapespline.validation import distinct

if TYPE_CHECKING:
    from shapespline.typing import ArrayLike, CornerChoice, IntArray
    from shapespline.values import Contour


class PiecesProblem(NamedTuple):
    """What a search within a tolerance knows about a contour before it begins.

    ``normalized`` holds the points in canonical order and pose, ``tolerance`` is in its unit, too.
    ``corners`` are indices of its points, ``low_turn`` (n,) is 1 where the data turn less than
    `LOW_TURN`, ``constraints`` are in its order and direction. ``dense`` are points as they came,
    in that unit, where the contour holds thinned ones.
    """

    normalized: NormalizedContour
    tolerance: float
    corners: IntArray
    low_turn: IntArray
    constraints: Constraints = Constraints()
    dense: Contour | None = None

    @classmethod
    def of(
        cls,
        contour: Contour,
        tolerance: float,
        corners: CornerChoice | ArrayLike | None,
        constraints: Constraints | None = None,
    ) -> PiecesProblem:
        """The problem of a contour; its corners are found here, or named by their indices.

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
        normalized = NormalizedContour.posed(contour, tolerance)
        search_tolerance, n = normalized.length(tolerance), len(contour)
        low_turn = np.ones(n, dtype=np.int64)
        constraints = _in_order(Constraints() if constraints is None else constraints, normalized)
        if corners is None:
            return cls(
                normalized, search_tolerance, np.empty(0, dtype=np.int64), low_turn, constraints
            )
        if isinstance(corners, str):
            if corners not in ("auto", "free"):
                raise InvalidInputError(
                    f"corners must be 'auto', 'free', None or indices, got {corners!r}"
                )
            found = find_corners(normalized.contour, search_tolerance)
            low_turn = (found.turns < LOW_TURN).astype(np.int64)
            return cls(normalized, search_tolerance, found.indices, low_turn, constraints)
        given = np.asarray(corners)
        if given.ndim != 1 or (given.size and given.dtype.kind not in "iu"):
            raise InvalidInputError(f"corners must be one list of whole numbers, got {corners!r}")
        if given.size and (given.min() < 0 or given.max() >= n):
            raise InvalidInputError(f"corners must be indices below {n}, got {given.tolist()}")
        return cls(
            normalized,
            search_tolerance,
            distinct(normalized.new_index[given.astype(np.int64)]),
            low_turn,
            constraints,
        )

    def thinned(self) -> PiecesProblem:
        """The problem without points that no search needs, its tolerance less by their error."""
        stay = distinct(self.corners, self.constraints.through)
        normalized = self.normalized.thinned(self.tolerance, stay)
        if normalized is self.normalized:
            return self
        index = self.normalized.new_index[normalized.order]
        return self._replace(
            normalized=normalized,
            tolerance=self.tolerance - normalized.error_used,
            corners=np.flatnonzero(np.isin(index, self.corners)),
            low_turn=self.low_turn[index],
            constraints=self.constraints._replace(
                through=np.flatnonzero(np.isin(index, self.constraints.through))
            ),
        )


def _in_order(constraints: Constraints, normalized: NormalizedContour) -> Constraints:
    """Constraints in the order, direction and pose of a normalised contour."""
    begin, end = (None if t is None else normalized.direction(t) for t in constraints.tangents)
    if normalized.reversed:
        begin, end = (None if t is None else -t for t in (end, begin))
    through = constraints.through
    if len(through):
        through = distinct(normalized.new_index[through])
    return constraints._replace(through=through, tangents=(begin, end))

"""Asked: what a page wants of a document: Settings for all, and those of single outlines."""

from __future__ import annotations

from dataclasses import dataclass, field
from inspect import signature
from math import isfinite
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from shapespline.errors import InvalidInputError
from shapespline.fitting import Settings, fit_shape
from shapespline.validation import is_number
from shapespline.values import Contour

if TYPE_CHECKING:
    from collections.abc import Mapping

    from shapespline.studio.documents import Document
    from shapespline.typing import FloatArray

# What may differ between outlines: indices of points, and directions at ends.
OWN = ("corners", "through", "end_tangents", "moved")
MOST_MOVED = 1000
# `fit_shape` takes these, and fits a document as the command line does.
OF_SHAPES = frozenset(signature(fit_shape).parameters)


class Move(NamedTuple):
    """A point moved by hand; its neighbours follow, ever less, to a length on either side."""

    point: int
    dx: float
    dy: float
    before: float
    after: float


@dataclass(frozen=True, eq=False)
class Asked:
    """Settings for all outlines of a document, and for single ones.

    ``common`` are options of `Settings`; ``own`` holds for some outlines what differs, corners and
    points to go through as indices of ``contour.points``.
    """

    document: Document
    common: Mapping[str, Any]
    own: Mapping[int, Mapping[str, Any]] = field(default_factory=dict)

    @classmethod
    def of(cls, said: Mapping[str, Any], document: Document) -> Asked:
        """What a page said, checked as a whole."""
        common, own = said.get("settings"), said.get("own", {})
        if not isinstance(common, dict) or not isinstance(own, dict):
            raise InvalidInputError("settings must be names with values; reload the page")
        n_outlines, found = len(document.shape), {}
        for key, options in own.items():
            if not (str(key).isdecimal() and int(key) < n_outlines and isinstance(options, dict)):
                raise InvalidInputError(f"outline must be below {n_outlines}, got {key!r}")
            for name in options:
                if name not in OWN:
                    raise InvalidInputError(f"{name} is no option of a single outline")
            if options:
                found[int(key)] = options
        asked = cls(document, common, found)
        for index in {0, *found}:
            asked.settings(index)
        return asked

    @property
    def is_plain(self) -> bool:
        """Whether `fit_shape` answers: nothing is asked of single outlines."""
        return not self.own and self.common.keys() <= OF_SHAPES

    @property
    def shared_boundaries(self) -> bool:
        """Whether boundaries are fitted once, as the command line does for areas of colours."""
        within = self.common.get("tolerance") is not None and not self.common.get("outliers")
        return within and self.document.is_picture and any(self.document.shape.colors)

    def settings(self, index: int) -> Settings:
        """The settings of an outline."""
        contour, options = self.document.shape.contours[index], dict(self.common)
        if not contour.closed and options.get("symmetric"):
            options["symmetric"] = False
        for name, value in self.own.get(index, {}).items():
            if name in ("corners", "through") and isinstance(value, list):
                options[name] = _as_given(name, value, contour)
            elif name != "moved":
                options[name] = value
        moves = self.moves(index)
        if moves:
            through = [
                *options.get("through", ()),
                *_as_given("moved", [move.point for move in moves], contour),
            ]
            options["through"] = sorted(set(through))
        return Settings.from_dict(options)

    def moves(self, index: int) -> list[Move]:
        """The points of an outline that were moved by hand."""
        said = self.own.get(index, {}).get("moved", [])
        n_points = len(self.document.shape.contours[index])
        if not isinstance(said, list) or len(said) > MOST_MOVED:
            raise InvalidInputError(f"moved must be a list of at most {MOST_MOVED} points")
        moves = []
        for move in said:
            numbers = isinstance(move, list) and len(move) == 5 and all(map(_is_finite, move))
            if not numbers or not 0 <= int(move[0]) < n_points:
                raise InvalidInputError(
                    f"moved must hold lists of a point, dx, dy and two lengths, got {move!r}"
                )
            moves.append(Move(int(move[0]), *map(float, move[1:])))
        return moves

    def contour(self, index: int) -> Contour:
        """An outline, its points where they were moved to."""
        contour, moves = self.document.shape.contours[index], self.moves(index)
        if not moves:
            return contour
        points = carried(contour, moves)[contour.source]
        return Contour.silently(points, contour.closed, accuracy=contour.accuracy)


def carried(contour: Contour, moves: list[Move]) -> FloatArray:
    """The points of a contour after moves, shape (n, 2); what is near a moved point follows it.

    A raised cosine of the arc length carries them: the outline stays as smooth as it was, and what
    lies beyond the lengths of the move stays where it was.

    Examples
    --------
    >>> line = Contour([(0, 0), (1, 0), (2, 0), (3, 0), (4, 0)])
    >>> carried(line, [Move(2, 0.0, 1.0, 2.0, 2.0)])[:, 1].round(3).tolist()
    [0.0, 0.5, 1.0, 0.5, 0.0]
    """
    points, at = contour.points.copy(), contour.arc_length[: len(contour)]
    for move in moves:
        ahead = at - at[move.point]
        if contour.closed:
            ahead = (ahead + 0.5 * contour.length) % contour.length - 0.5 * contour.length
        reach = np.where(ahead < 0, max(move.before, 0.0), max(move.after, 0.0))
        part = np.clip(np.divide(np.abs(ahead), reach, out=np.ones_like(at), where=reach > 0), 0, 1)
        part[move.point] = 0.0
        points += (0.5 + 0.5 * np.cos(np.pi * part))[:, None] * (move.dx, move.dy)
    return points


def _is_finite(value: Any) -> bool:
    return is_number(value) and isfinite(value)


def _as_given(name: str, indices: list[Any], contour: Contour) -> list[int]:
    """Indices of the points of a contour as those of the points that were given."""
    if not all(isinstance(i, int) and 0 <= i < len(contour) for i in indices):
        raise InvalidInputError(f"{name} must be indices below {len(contour)}")
    first = np.unique(contour.source, return_index=True)[1]
    return [int(first[i]) for i in indices]

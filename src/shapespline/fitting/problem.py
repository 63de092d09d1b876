"""Problem: a request and what its points tell, each found once and when it is asked for."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from shapespline.analysis import NormalizedContour, filled, has_straight_runs
from shapespline.engines.drawn import as_drawn, drawn_between_corners
from shapespline.engines.pieces import PiecesProblem, chords_found
from shapespline.errors import InvalidInputError
from shapespline.geometry import PointsByX

if TYPE_CHECKING:
    from shapespline.engines.drawn import Drawn
    from shapespline.engines.pieces import Chords
    from shapespline.fitting.request import Request
    from shapespline.values import Contour


class Problem:
    """A request for a curve within a tolerance, normalised, thinned, its corners found.

    Parameters
    ----------
    request : Request
    pieces : PiecesProblem, optional
        The view that the pieces engine has of it, where it is known.
    dense : Contour, optional
        The points as they came, in data units, where the request's stand for them.
    """

    def __init__(
        self,
        request: Request,
        pieces: PiecesProblem | None = None,
        dense: Contour | None = None,
    ) -> None:
        self.request = request
        if pieces is not None:
            self.__dict__["pieces"] = pieces
        self._dense = request.contour if dense is None else dense

    @property
    def contour(self) -> Contour:
        """The data."""
        return self.request.contour

    @property
    def tolerance(self) -> float:
        """The tolerance of the request, data units."""
        if self.request.tolerance is None:
            raise InvalidInputError("the request has no tolerance")
        return self.request.tolerance

    @cached_property
    def pieces(self) -> PiecesProblem:
        """The contour as the pieces engine sees it, all points there."""
        request = self.request
        return PiecesProblem.of(
            self.contour, self.tolerance, request.style.corners, request.constraints
        )

    @cached_property
    def thinned(self) -> PiecesProblem:
        """The same without the points that a search does not need."""
        return self.pieces.thinned()

    @cached_property
    def chords(self) -> Chords:
        """A polyline through some of these points, found in one pass."""
        return chords_found(self.thinned)

    @property
    def normalized(self) -> NormalizedContour:
        """The contour in canonical order and pose."""
        return self.pieces.normalized

    @cached_property
    def upright(self) -> NormalizedContour:
        """The contour in canonical order and unit, its axes kept, whatever the goal."""
        return NormalizedContour.of(self.contour)

    @property
    def seen(self) -> Contour:
        """The points as they came, in the unit of `upright`, where vertices stand for them."""
        if self._dense is self.request.contour:
            return self.upright.contour
        return self.upright.taken_over(self._dense)

    @cached_property
    def lines_and_arcs(self) -> Drawn | None:
        """Lines, arcs and the rest that the points tell, within the tolerance if there is one."""
        request, scale = self.request, self.upright.scale
        accuracy = None if self.contour.level_line is None else self.contour.accuracy
        return as_drawn(
            self.seen,
            None if accuracy is None else accuracy * scale,
            request.style.regularities,
            np.inf if request.tolerance is None else request.tolerance * scale,
            holds_ends=request.constraints.ends,
        )

    @cached_property
    def between_corners(self) -> list[Drawn]:
        """Free-form runs from corner to corner beside long elements, if noisy points may be so."""
        request = self.request
        return drawn_between_corners(
            self.seen, request.style.regularities, holds_ends=request.constraints.ends
        )

    @property
    def has_corners(self) -> bool:
        """Whether the data have corners that stay, as far as a tolerance tells them."""
        if self.request.tolerance is None:
            return False
        return len(self.pieces.corners) > 0 and not self.request.style.free

    @property
    def has_straight_runs(self) -> bool:
        """Whether some of the data, as they came, are straight, or too noisy to tell."""
        dense = self.pieces.dense
        seen = self.normalized.contour if dense is None else dense
        return has_straight_runs(seen, self.pieces.tolerance)

    @property
    def looks_smooth(self) -> bool:
        """Whether one smooth spline may be what was drawn: no corner, no straight run."""
        return not (len(self.pieces.corners) or self.has_straight_runs)

    @cached_property
    def drawn(self) -> PointsByX:
        """The data as they came, with points along edges that were drawn as lines."""
        return PointsByX.of(filled(self._dense).points)

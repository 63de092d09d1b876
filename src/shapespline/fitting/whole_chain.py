"""A polygon of pixels, of which programs leave out what is straight, as the chain that it was."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from shapespline.analysis import along_pixels
from shapespline.fitting.problem import Problem

if TYPE_CHECKING:
    from shapespline.fitting.strategies import Ask, Proposals
    from shapespline.monitor import Monitor


@dataclass(frozen=True)
class WholeChain:
    """What all pixels of a polygon tell; nothing where it is none of these."""

    ask: Ask

    def propose(self, problem: Problem, monitor: Monitor) -> Proposals:
        """One curve, if the polygon goes along pixels in stairs."""
        request = problem.request
        if not request.is_plain or request.style.names_corners:
            return
        chain = along_pixels(problem.contour)
        if chain is not None:
            yield self.ask(Problem(replace(request, contour=chain)), monitor).candidate

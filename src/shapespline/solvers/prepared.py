"""Prepared: another method, from a better start."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, Protocol

if TYPE_CHECKING:
    from shapespline.solvers.iteration import Solver, State
    from shapespline.typing import FloatArray


class PreparableProblem(Protocol):
    """A problem that can better one half of its unknowns with the other held."""

    def projected(self, x: FloatArray, /) -> FloatArray:
        """Return the point with its parameters at their feet."""

    def solved(self, x: FloatArray, /) -> FloatArray:
        """Return the point with its control points at their best."""


@dataclass(frozen=True, slots=True)
class Prepared:
    """A method that first projects the data (``"feet"``) or solves for the curve (``"linear"``)."""

    first: Literal["feet", "linear"]
    solver: Solver[Any, Any]

    @property
    def patience(self) -> int:
        """See `iteration.Solver.patience`."""
        return self.solver.patience

    def init(self, problem: PreparableProblem, x: FloatArray) -> State:
        """Better the start, then begin."""
        x = problem.projected(x) if self.first == "feet" else problem.solved(x)
        state: State = self.solver.init(problem, x)
        return state

    def step(self, problem: Any, state: Any, max_evaluations: int) -> State:
        """A step of the method."""
        following: State = self.solver.step(problem, state, max_evaluations)
        return following

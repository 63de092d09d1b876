"""The generalised BFGS family: one update formula, and cheap approximations of the Hessian.

Every method builds its matrix as ``B+ = BFGS(B~, s, y)`` (Eq. 8 and 9 of the paper) from a cheap
approximation ``B~`` of the last one, with ``s`` the step and ``y`` the change of the gradient:

==================  =====================================================  ==================
name                B~                                                     direction
==================  =====================================================  ==================
d-bfgs              diagonal of B (Eq. 10)                                 secant, -B+^-1 g
d-bfgs-ns           diagonal of B (Eq. 10)                                 -diag(B+)^-1 g
d-bfgs-inverse      B~^-1 = diagonal of H = B^-1 (Algorithm 1, Eq. 11)     secant, -H+ g
d-bfgs-inverse-ns   B~^-1 = diagonal of H = B^-1 (Algorithm 1, Eq. 11)     -diag(H+) g
oss                 the start diagonal (one-step secant)                   secant, -B+^-1 g
oss-ns              the start diagonal                                     -B~^-1 g
bfgs                B itself, as a dense inverse                           -H+ g
l-bfgs              the last ``memory`` updates of the start diagonal      -H+ g
==================  =====================================================  ==================

Each approximation is an immutable value (`HessianModel`) that gives a direction and takes an
update; `QuasiNewton` adds the line search and the restarts. An update is skipped when the curvature
``y's`` is not sufficiently positive, which after a successful Wolfe search cannot happen.

Memory: at the peak of a step, x0 included, 13 vectors at most for the diagonal methods and
``2 memory + 9`` for ``l-bfgs``; ``memory=2`` is the most that stays within 13.

References
----------
.. [1] Eur. Phys. J. Plus 2022, DOI 10.1140/epjp/s13360-022-02604-y: Eq. 4 to 11, Algorithm 1.
.. [2] J. Nocedal and S. J. Wright, Numerical Optimization, 2nd ed., 2006: Eq. 6.17 (BFGS, inverse
   form), Algorithm 7.4 (two loops), Eq. 7.20 (scaling of the start).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Final, Literal, get_args

import numpy as np

from shapespline.errors import InvalidInputError
from shapespline.solvers.hessian_model import (
    DenseInverse,
    DirectDiagonal,
    FixedDiagonal,
    HessianModel,
    InverseDiagonal,
    LimitedMemory,
    Pair,
)
from shapespline.solvers.iteration import State
from shapespline.solvers.line_search import LineSearchResult, Wolfe, dot, wolfe_search

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapespline.solvers.iteration import Problem
    from shapespline.typing import FloatArray

StartDiagonal = Literal["gauss-newton", "identity"]

_LEAST_CURVATURE = 1e-3  # y's over -s'g; the Wolfe conditions with c2 = 0.9 guarantee 0.1
_SEARCH_EVALUATIONS = 30
_MOST_DENSE_UNKNOWNS = 5000  # 200 MB a matrix, three of them during an update


@dataclass(frozen=True, slots=True, kw_only=True)
class QuasiNewtonState(State):
    """The loop's fields, the gradient, the start diagonal and the model.

    ``fresh`` says that the model has taken no update since the start or the last restart.
    """

    gradient: FloatArray
    scale: FloatArray
    model: HessianModel
    fresh: bool = True


@dataclass(frozen=True, slots=True)
class QuasiNewton:
    """A Hessian model, a line search, and restarts from the start diagonal.

    The gradient norm in the history is ``sqrt(g' D0^-1 g)`` with the start diagonal D0: Euclidean
    for the identity, free of the variables' units for a diagonal that has them.
    """

    start: Callable[[FloatArray], HessianModel]
    start_diagonal: StartDiagonal = "gauss-newton"
    wolfe: Wolfe = "strong"
    c1: float = 1e-4
    c2: float = 0.9
    patience: int = 3

    def init(self, problem: Problem, x: FloatArray) -> QuasiNewtonState:
        """Evaluate the start; one evaluation."""
        scale = self._start_scale(problem, x)
        model = self.start(scale)
        cost, gradient = problem.cost_and_gradient(x)
        norm = _norm(gradient, scale)
        return QuasiNewtonState(
            x=x, cost=cost, gradient_norm=norm, gradient=gradient, scale=scale, model=model
        )

    def step(
        self, problem: Problem, state: QuasiNewtonState, max_evaluations: int
    ) -> QuasiNewtonState:
        """Search along the model's direction, and once more from a fresh model if that fails."""
        model, fresh, used = state.model, state.fresh, 0
        while True:
            direction = model.direction(state.gradient)
            found = self._search(problem, state, direction, max_evaluations - used)
            used += 0 if found is None else found.evaluations
            if found is not None and found.step > 0.0:
                break
            if fresh or used >= max_evaluations:
                return replace(state, evaluations=state.evaluations + used, step=0.0, stalled=True)
            del direction
            model, fresh = self.start(state.scale), True
        descent = -found.step * dot(state.gradient, direction)
        s, y = direction, found.gradient - state.gradient
        s *= found.step  # the direction is not needed any more, its memory is
        rho = dot(s, y)
        if rho > _LEAST_CURVATURE * descent:
            model, fresh = model.updated(Pair(s, y, rho)), False
        del y
        return replace(
            state,
            x=state.x + s,
            cost=found.cost,
            gradient_norm=_norm(found.gradient, state.scale),
            evaluations=state.evaluations + used,
            step=found.step,
            gradient=found.gradient,
            model=model,
            fresh=fresh,
        )

    def _start_scale(self, problem: Problem, x: FloatArray) -> FloatArray:
        """Return the start diagonal; the identity takes no memory."""
        if self.start_diagonal == "identity":
            return np.broadcast_to(np.float64(1.0), x.shape)
        scale = problem.scale(x)
        if scale.shape != x.shape or not (np.isfinite(scale).all() and (scale > 0.0).all()):
            msg = f"problem.scale must return {x.size} positive finite numbers; floor them"
            raise InvalidInputError(msg)
        return scale

    def _search(
        self, problem: Problem, state: QuasiNewtonState, direction: FloatArray, evaluations: int
    ) -> LineSearchResult | None:
        """Search along a direction; None if it does not descend."""
        if not -math.inf < dot(state.gradient, direction) < 0.0:
            return None
        f, x, budget = problem.cost_and_gradient, state.x, min(evaluations, _SEARCH_EVALUATIONS)
        return wolfe_search(
            f,
            x,
            state.cost,
            state.gradient,
            direction,
            wolfe=self.wolfe,
            c1=self.c1,
            c2=self.c2,
            max_evaluations=budget,
        )


def _norm(gradient: FloatArray, scale: FloatArray) -> float:
    """sqrt(g' D0^-1 g)."""
    return math.sqrt(dot(gradient, gradient / scale))


def _diagonal(kind: type[FixedDiagonal], secant: bool, scale: FloatArray) -> HessianModel:
    """Start a diagonal model."""
    return kind(1.0 / scale if kind is InverseDiagonal else scale, secant)


def _dense(scale: FloatArray) -> HessianModel:
    """Start the full model, if it can be held."""
    if scale.size > _MOST_DENSE_UNKNOWNS:
        msg = (
            f"bfgs stores a dense matrix and takes at most {_MOST_DENSE_UNKNOWNS} unknowns, "
            f"got {scale.size}; use l-bfgs"
        )
        raise InvalidInputError(msg)
    return DenseInverse(np.diag(1.0 / scale))


_STARTS: Final[dict[str, Callable[[FloatArray], HessianModel]]] = {
    "d-bfgs": partial(_diagonal, DirectDiagonal, True),
    "d-bfgs-ns": partial(_diagonal, DirectDiagonal, False),
    "d-bfgs-inverse": partial(_diagonal, InverseDiagonal, True),
    "d-bfgs-inverse-ns": partial(_diagonal, InverseDiagonal, False),
    "oss": partial(_diagonal, FixedDiagonal, True),
    "oss-ns": partial(_diagonal, FixedDiagonal, False),
    "bfgs": _dense,
}
METHODS: Final = (*_STARTS, "l-bfgs")
"""The names that `make_solver` knows."""


def make_solver(
    name: str,
    *,
    start_diagonal: StartDiagonal = "gauss-newton",
    wolfe: Wolfe = "strong",
    c1: float = 1e-4,
    c2: float = 0.9,
    memory: int = 10,
) -> QuasiNewton:
    """Return a method of the family by its name.

    Parameters
    ----------
    name : str
        One of `METHODS`.
    start_diagonal : {"gauss-newton", "identity"}
        Where the Hessian starts: at ``problem.scale(x0)``, or at the identity as published.
    wolfe : {"strong", "weak"}
        The line search's curvature condition; the published one is the weak (Eq. 6).
    c1, c2 : float
        Its constants, 0 < c1 < c2 < 1.
    memory : int
        Pairs that ``l-bfgs`` keeps; two vectors each.

    Raises
    ------
    InvalidInputError
        For an unknown name or choice, or a memory below 1.

    Examples
    --------
    >>> make_solver("d-bfgs", wolfe="weak").wolfe
    'weak'
    """
    if name not in METHODS:
        msg = f"name must be one of {', '.join(METHODS)}, got {name!r}"
        raise InvalidInputError(msg)
    for argument, value, choices in (
        ("start_diagonal", start_diagonal, get_args(StartDiagonal)),
        ("wolfe", wolfe, get_args(Wolfe)),
    ):
        if value not in choices:
            msg = f"{argument} must be one of {', '.join(choices)}, got {value!r}"
            raise InvalidInputError(msg)
    if memory < 1:
        msg = f"memory must be at least 1, got {memory}; 5 to 20 is usual"
        raise InvalidInputError(msg)
    start = _STARTS.get(name, partial(LimitedMemory, capacity=memory))
    return QuasiNewton(start, start_diagonal, wolfe, c1, c2)

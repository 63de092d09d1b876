"""The methods of optimisation by their names.

======================  ==============================================================  ============
name                    what it does                                                    known from
======================  ==============================================================  ============
levenberg-marquardt     damped Gauss-Newton, parameters eliminated                      METHOD 4
gauss-newton            joint Gauss-Newton with a line search                           [42] [44]
variable-projection     parameters alone, control points follow                         [43]
d-bfgs ... l-bfgs       the generalised BFGS family (`solvers.quasi_newton`)            the paper
l-bfgs-feet             L-BFGS on everything, from the foot points                      [45]
linear-d-bfgs           one linear solve at the start's parameters, then D-BFGS         [46]
pdm, tdm, sdm           foot points on the whole curve in turn with a quadratic form    [11]
insertion-removal       SDM, and knots that move: in where it errs, out where they idle [40]
differential-evolution  knots by chance, an inner linear solve for each                 [48] to [54]
fixed-parameters        one linear solve                                                de Boor
======================  ==============================================================  ============

The numbers are those of the paper's references.
"""

from __future__ import annotations

from typing import Any, Literal

from shapespline.engines.least_squares.adjustment import InsertionRemoval
from shapespline.engines.least_squares.evolution import KnotEvolution
from shapespline.engines.least_squares.settings import RunSettings
from shapespline.errors import InvalidInputError
from shapespline.solvers import METHODS as QUASI_NEWTON
from shapespline.solvers import (
    Alternation,
    FixedParameters,
    GaussNewton,
    LevenbergMarquardt,
    Prepared,
    QuasiNewton,
    Solver,
    VariableProjection,
    make_solver,
)

Method = Solver[Any, Any] | InsertionRemoval | KnotEvolution

_PLAIN: dict[str, Method] = {
    "levenberg-marquardt": LevenbergMarquardt(),
    "gauss-newton": GaussNewton(),
    "variable-projection": VariableProjection(),
    "pdm": Alternation("point"),
    "tdm": Alternation("tangent"),
    "sdm": Alternation("squared"),
    "insertion-removal": InsertionRemoval(),
    "differential-evolution": KnotEvolution(),
    "fixed-parameters": FixedParameters(),
}
# Name -> what comes first, and the quasi-Newton method that follows.
_PREPARED: dict[str, tuple[Literal["feet", "linear"], str]] = {
    "l-bfgs-feet": ("feet", "l-bfgs"),
    "linear-d-bfgs": ("linear", "d-bfgs"),
}
METHODS = (
    "levenberg-marquardt",
    "gauss-newton",
    "variable-projection",
    *QUASI_NEWTON,
    *_PREPARED,
    "pdm",
    "tdm",
    "sdm",
    "insertion-removal",
    "differential-evolution",
    "fixed-parameters",
)
_MADE_BY_HAND = (
    LevenbergMarquardt,
    GaussNewton,
    VariableProjection,
    QuasiNewton,
    Prepared,
    Alternation,
    InsertionRemoval,
    KnotEvolution,
    FixedParameters,
)


def named_solver(method: str | Method, settings: RunSettings | None = None) -> tuple[Method, str]:
    """The solver of a method's name, or one that was made by hand; and its name."""
    if isinstance(method, _MADE_BY_HAND):
        return method, type(method).__name__
    if not isinstance(method, str) or method not in METHODS:
        raise InvalidInputError(f"method must be one of {', '.join(METHODS)}, got {method!r}")
    if method in _PLAIN:
        return _PLAIN[method], method
    settings = settings or RunSettings()
    first, name = _PREPARED.get(method, (None, method))
    solver = make_solver(name, start_diagonal=settings.start_diagonal, wolfe=settings.wolfe)
    return (Prepared(first, solver) if first else solver), method

"""Solvers for smooth unconstrained minimisation; they know vectors and costs, no geometry.

`iteration` holds the one loop, its stopping rules and its history; `quasi_newton` the
generalised BFGS family, `levenberg_marquardt` the damping policy, `line_search` the Wolfe search,
`alternation` foot points and control points in turn, `fixed_parameters` the linear problem.
"""

from shapespline.solvers.alternation import Alternation, Metric
from shapespline.solvers.fixed_parameters import FixedParameters
from shapespline.solvers.iteration import Limits, Result, Solver, Stop, minimize
from shapespline.solvers.levenberg_marquardt import LevenbergMarquardt, Proposal
from shapespline.solvers.quasi_newton import METHODS, QuasiNewton, make_solver

__all__ = [
    "METHODS",
    "Alternation",
    "FixedParameters",
    "LevenbergMarquardt",
    "Limits",
    "Metric",
    "Proposal",
    "QuasiNewton",
    "Result",
    "Solver",
    "Stop",
    "make_solver",
    "minimize",
]

"""Solvers for smooth unconstrained minimisation; they know vectors and costs, no geometry.

`iteration` holds the one loop, its stopping rules and its history; `quasi_newton` the
generalised BFGS family, `levenberg_marquardt` the damping policy, `line_search` the Wolfe search,
`alternation` foot points and control points in turn, `fixed_parameters` the linear problem,
`gauss_newton` all unknowns at once, `variable_projection` the parameters alone.
"""

from shapespline.solvers.alternation import Alternation, Metric
from shapespline.solvers.fixed_parameters import FixedParameters
from shapespline.solvers.gauss_newton import GaussNewton
from shapespline.solvers.iteration import Limits, Result, Solver, Stop, minimize
from shapespline.solvers.levenberg_marquardt import LevenbergMarquardt, Proposal
from shapespline.solvers.line_search import Wolfe
from shapespline.solvers.prepared import Prepared
from shapespline.solvers.quasi_newton import METHODS, QuasiNewton, StartDiagonal, make_solver
from shapespline.solvers.variable_projection import VariableProjection

__all__ = [
    "METHODS",
    "Alternation",
    "FixedParameters",
    "GaussNewton",
    "LevenbergMarquardt",
    "Limits",
    "Metric",
    "Prepared",
    "Proposal",
    "QuasiNewton",
    "Result",
    "Solver",
    "StartDiagonal",
    "Stop",
    "VariableProjection",
    "Wolfe",
    "make_solver",
    "minimize",
]

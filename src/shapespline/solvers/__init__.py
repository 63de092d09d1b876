"""Solvers for smooth unconstrained minimisation; they know vectors and costs, no geometry.

`iteration` holds the one loop, its stopping rules and its history; `quasi_newton` the
generalised BFGS family, `levenberg_marquardt` the damping policy, `line_search` the Wolfe search,
`alternation` foot points and control points in turn, `fixed_parameters` the linear problem.
"""

"""Slow and obvious: everything from its definition, in extended precision, without the kernel.

Where numpy's long double has no more digits than double, the bounds of the tests hold twice the
rounding instead of once; they have room for it.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

EPS = float(np.finfo(np.float64).eps)
LONG = np.longdouble


# --- B-splines ---------------------------------------------------------------------------------


def wrapped(knots, degree, parameters, periodic):
    """Parameters in [begin, end) if periodic, as they are if not."""
    u = np.atleast_1d(np.asarray(parameters, dtype=LONG))
    begin, end = LONG(knots[degree]), LONG(knots[-degree - 1])
    return begin + np.mod(u - begin, end - begin) if periodic else u


def spans(knots, degree, parameters):
    """For each u the k with knots[k] <= u < knots[k + 1]; the first or last non-empty outside."""
    filled = [k for k in range(degree, len(knots) - degree - 1) if knots[k] < knots[k + 1]]
    found = np.full(len(parameters), filled[0])
    for k in filled:
        found[parameters >= knots[k]] = k
    return found


def basis_matrix(knots, degree, parameters, periodic=False, absolute=False):
    """Values of all basis functions at each parameter, (n, n_coefficients): Cox and de Boor.

    N_i,0 = 1 on the span of u alone; N_i,p = (u - u_i)/(u_i+p - u_i) N_i,p-1
    + (u_i+p+1 - u)/(u_i+p+1 - u_i+1) N_i+1,p-1; 0/0 = 0. Outside the domain these are the
    polynomials of the end spans. With absolute, of absolute values: what rounding multiplies.
    """
    t = np.asarray(knots, dtype=LONG)
    u = wrapped(knots, degree, parameters, periodic)
    size = np.abs if absolute else np.asarray
    values = np.zeros((len(u), len(t) - 1), dtype=LONG)
    values[np.arange(len(u)), spans(t, degree, u)] = 1
    for p in range(1, degree + 1):
        longer = np.zeros((len(u), len(t) - 1 - p), dtype=LONG)
        for i in range(longer.shape[1]):
            if t[i + p] > t[i]:
                longer[:, i] += size(u - t[i]) / (t[i + p] - t[i]) * values[:, i]
            if t[i + p + 1] > t[i + 1]:
                width = t[i + p + 1] - t[i + 1]
                longer[:, i] += size(t[i + p + 1] - u) / width * values[:, i + 1]
        values = longer
    return values


def folded(matrix, m):
    """Columns of unrolled control points added onto the m distinct ones."""
    distinct = np.zeros((len(matrix), m), dtype=matrix.dtype)
    for i in range(matrix.shape[1]):
        distinct[:, i % m] += matrix[:, i]
    return distinct


def differentiated(knots, coefficients, degree, absolute=False):
    """Knots and coefficients of the derivative, one degree lower."""
    t, c = np.asarray(knots, dtype=LONG), np.asarray(coefficients, dtype=LONG)
    lower = np.zeros((len(c) - 1, *c.shape[1:]), dtype=LONG)
    for i in range(len(lower)):
        width = t[i + degree + 1] - t[i + 1]
        if width > 0:
            step = np.abs(c[i + 1]) + np.abs(c[i]) if absolute else c[i + 1] - c[i]
            lower[i] = degree * step / width
    return t[1:-1], lower


def _unrolled(knots, control_points, degree):
    n = len(knots) - degree - 1
    return np.asarray(control_points, dtype=LONG)[np.arange(n) % len(control_points)]


def evaluated(knots, control_points, degree, parameters, periodic=False, derivative=0):
    """Points or derivatives, (n, 2)."""
    t, c = np.asarray(knots, dtype=LONG), _unrolled(knots, control_points, degree)
    for _ in range(derivative):
        t, c = differentiated(t, c, degree)
        degree -= 1
    return basis_matrix(t, degree, parameters, periodic) @ c


def evaluation_bound(knots, control_points, degree, parameters, periodic=False, derivative=0):
    """Bound of the rounding of a double evaluation at these parameters, (n, 2).

    Algorithm A2.2 makes at most 6 roundings a level of numbers without cancellation (two
    differences, their sum, a quotient, a product, a sum), the combination p + 1 more, every
    derivative 4: (7 p + 4 derivative + 3) units of the sum of absolute values. A unit is taken as
    EPS, twice the rounding. Outside the domain the sum of the two differences cancels: it is in
    error by their size over the knot interval, at every level.
    """
    t, c = np.asarray(knots, dtype=LONG), np.abs(_unrolled(knots, control_points, degree))
    roundings = 7 * degree + 4 * derivative + 3
    u = wrapped(knots, degree, parameters, periodic)
    begin, end = t[degree], t[-degree - 1]
    outside = np.maximum(np.maximum(begin - u, u - end), 0)
    steps = np.diff(t)
    cancelled = 4 * degree * outside / steps[steps > 0].min()
    for _ in range(derivative):
        t, c = differentiated(t, c, degree, absolute=True)
        degree -= 1
    majorant = basis_matrix(t, degree, parameters, periodic, absolute=True) @ c
    return EPS * (roundings + cancelled)[:, None] * majorant


# --- chord-to-point distance accumulation ------------------------------------------------------


def cpda(points, length, closed):
    """Signed and unsigned sums: over s = 1..L-1 the distance of Q_r to the line Q_r-L+s Q_r+s."""
    q = np.asarray(points, dtype=LONG)
    n = len(q)

    def at(i):
        if closed:
            return q[i % n]
        if i < 0:
            return 2 * q[0] - q[-i]
        return q[i] if i < n else 2 * q[n - 1] - q[2 * (n - 1) - i]

    signed, unsigned = np.zeros(n, dtype=LONG), np.zeros(n, dtype=LONG)
    for r in range(n):
        for s in range(1, length):
            a, b = at(r - length + s), at(r + s)
            chord, offset = b - a, q[r] - a
            if (chord == 0).all():
                distance = np.sqrt(offset @ offset)
            else:
                area = offset[0] * chord[1] - offset[1] * chord[0]
                distance = area / np.sqrt(chord @ chord)
            signed[r] += distance
            unsigned[r] += abs(distance)
    return signed, unsigned


# --- the least-squares problem -----------------------------------------------------------------


class Stray(NamedTuple):
    """A residual that holds the curve to the data polyline between two neighbours."""

    parameter: float
    target: np.ndarray
    weight: float


def stray_residuals(knots, degree, points, parameters, stray_weight, periodic):
    """Where neighbours are more than 1/8 of a mean span apart: places between them.

    Eight a span, rounded up to whole spans. Each is compared with the point of the segment at the
    same fraction; the weights add up to stray_weight times the square of the excess over 1/8 of a
    span, in that unit. All gaps together have samples for nine times the spans of the curve, and
    are thinned out in proportion where they want more.
    """
    begin, end = knots[degree], knots[-degree - 1]
    domain = np.unique(np.asarray(knots)[degree : len(knots) - degree])
    span = (end - begin) / (len(domain) - 1)
    q, t = list(points), list(parameters)
    if periodic:
        q, t = [*q, q[0]], [*t, t[0] + (end - begin)]
    gaps = np.diff(np.asarray(t))
    spans = np.clip(np.ceil(gaps / span), 1, len(domain) - 1)
    wanted = spans[gaps > span / 8].sum()
    thinning = min(1.0, 9 * (len(domain) - 1) / wanted) if wanted else 1.0
    found = []
    for j in range(len(q) - 1):
        excess = gaps[j] / (span / 8) - 1
        if excess > 0:
            count = max(1, int(thinning * 8 * spans[j]))
            weight = stray_weight * excess**2 / count
            for i in range(1, count + 1):
                s = i / (count + 1)
                target = (1 - s) * np.asarray(q[j]) + s * np.asarray(q[j + 1])
                found.append(Stray(t[j] + s * (t[j + 1] - t[j]), target, weight))
    return found


class Dense(NamedTuple):
    """The linearised problem as full matrices, extended precision."""

    basis: np.ndarray  # (k, m): data, then strays
    residuals: np.ndarray  # (k, 2)
    tangents: np.ndarray  # (k, 2), zero for strays
    weights: np.ndarray  # (k,)
    n_data: int

    @property
    def cost(self):
        return float(0.5 * (self.weights * (self.residuals**2).sum(axis=1)).sum())

    def gradient(self):
        """Of the plain cost (no strays): (m, 2) and (n,)."""
        n = self.n_data
        pull = (self.weights[:, None] * self.residuals)[:n]
        return self.basis[:n].T @ pull, (pull * self.tangents[:n]).sum(axis=1)

    def jacobian(self):
        """Of all residuals, weighted by the square root, x and y interleaved: (2 k, 2 m + n)."""
        k, m = self.basis.shape
        jac = np.zeros((2 * k, 2 * m + self.n_data), dtype=LONG)
        root = np.sqrt(self.weights)
        for j in range(k):
            for axis in (0, 1):
                jac[2 * j + axis, axis : 2 * m : 2] = root[j] * self.basis[j]
                if j < self.n_data:
                    jac[2 * j + axis, 2 * m + j] = root[j] * self.tangents[j, axis]
        return jac


def dense(curve, points, parameters, weights=None, stray_weight=0.0):
    """The problem at a curve and parameters."""
    n = len(points)
    weights = np.ones(n) if weights is None else weights
    strays = (
        stray_residuals(curve.knots, curve.degree, points, parameters, stray_weight, curve.periodic)
        if stray_weight
        else []
    )
    at = np.array([*parameters, *(s.parameter for s in strays)])
    targets = np.array([*points, *(s.target for s in strays)], dtype=LONG)
    known = (curve.knots, curve.control_points, curve.degree, at, curve.periodic)
    tangents = evaluated(*known, derivative=1)
    tangents[n:] = 0
    rows = basis_matrix(curve.knots, curve.degree, at, curve.periodic)
    return Dense(
        folded(rows, curve.n_control_points),
        evaluated(*known) - targets,
        tangents,
        np.array([*weights, *(s.weight for s in strays)], dtype=LONG),
        n,
    )


class DampedSystem(NamedTuple):
    """matrix @ [dP, dt] = rhs of METHOD section 4, nothing eliminated; undamped matrix of dP."""

    matrix: np.ndarray
    rhs: np.ndarray
    reduced: np.ndarray
    reduced_rhs: np.ndarray


def damped_system(problem, damping, held=(), control_ends_fixed=False):
    """The damped normal equations of control points and parameters together, dense.

    The parameters are damped by lambda w |T|^2. The control points by lambda D, D the diagonal of
    the matrix that is left when the parameters are eliminated, plus 1e-11 of its largest entry.
    """
    m = problem.basis.shape[1]
    jac = problem.jacobian()
    fixed = [2 * m + j for j in held]
    full = jac.T @ jac
    rhs = -jac.T @ (np.sqrt(problem.weights)[:, None] * problem.residuals).ravel()
    moves = np.arange(2 * m, len(full))
    full[moves, moves] *= 1 + LONG(damping)
    for i in fixed + [int(i) for i in moves if full[i, i] == 0]:
        full[i, :] = full[:, i] = 0
        full[i, i] = 1
        rhs[i] = 0
    h = np.diag(full)[2 * m :]
    cross = full[: 2 * m, 2 * m :]
    reduced = full[: 2 * m, : 2 * m] - (cross / h) @ cross.T
    reduced_rhs = rhs[: 2 * m] - cross @ (rhs[2 * m :] / h)
    diagonal = np.diag(reduced).copy()
    i = np.arange(2 * m)
    full[i, i] += damping * (diagonal + LONG(1e-11) * diagonal.max())
    if control_ends_fixed:
        for i in (0, 1, 2 * m - 2, 2 * m - 1):
            full[i, :] = full[:, i] = 0
            full[i, i] = 1
            rhs[i] = 0
            reduced_rhs[i] = 0
    return DampedSystem(full, rhs, reduced, reduced_rhs)


# --- differences -------------------------------------------------------------------------------


def central_difference(function, x, step):
    """Central differences of a scalar function along every axis of x."""
    x = np.asarray(x, dtype=LONG)
    found = np.zeros(len(x), dtype=LONG)
    for i in range(len(x)):
        e = np.zeros(len(x), dtype=LONG)
        e[i] = step
        found[i] = (function(x + e) - function(x - e)) / (2 * LONG(step))
    return found

"""Least squares over all points of a stream, by sums that its chunks bring home.

A pass moves the parameter of every point to its foot and adds up what a chunk says about the
control points: the moments of each span of the curve, made into normal equations. Only these
travel, and control points. The parameters are held nowhere: each pass finds them anew, from those
of a sample and in the order of the points, without which a curve would rather fill a noisy band
than run through its middle.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline import _kernels
from shapespline.engines.least_squares.problem import CurveProblem
from shapespline.engines.least_squares.solve import minimized, parameters_in_order, with_paper_error
from shapespline.engines.least_squares.starts.equidistribution import (
    STRAY_WEIGHT,
    Balanced,
    balanced_start,
)
from shapespline.errors import InvalidInputError
from shapespline.geometry import CentredCurve, nondecreasing, two_sided_distance
from shapespline.solvers import LevenbergMarquardt, Limits, Proposal, minimize
from shapespline.streaming import SAMPLE
from shapespline.values import BSplineCurve, Contour

if TYPE_CHECKING:
    from shapespline.engines.least_squares.solve import Start
    from shapespline.monitor import Iteration, Monitor
    from shapespline.solvers import Result
    from shapespline.streaming import Passes, Seen
    from shapespline.typing import FloatArray

# Passes at most, and when they end. The start is the least-squares curve of a sample: after two
# steps or three the sum of squares falls by less, on and on, as knots fit themselves to the noise.
MOST_PASSES = 20
LIMITS = Limits(max_evaluations=MOST_PASSES, relative_decrease=2e-4)


class SquaresFit(NamedTuple):
    """A least-squares curve of all points, how it was found, and the sample it began with."""

    spline: BSplineCurve
    sample: Contour
    run: Result
    history: tuple[Iteration, ...]


class Parameters(NamedTuple):
    """Parameters of some of the points, between which those of the others lie.

    ``indices`` and ``values`` (k,) do not decrease.
    """

    indices: FloatArray
    values: FloatArray

    @classmethod
    def of(
        cls, sample: Contour, along: FloatArray, domain: tuple[float, float], n_points: int
    ) -> Parameters:
        """From those of a sample of evenly many points, the end of an open outline included."""
        source, (begin, end) = sample.source, domain
        if sample.closed:  # but for the first point repeated as the last
            source = source[: 1 + np.flatnonzero(source)[-1]]
        values = along[source]
        indices = -(-n_points // SAMPLE) * np.arange(len(values), dtype=np.float64)
        if sample.closed:
            return cls(np.append(indices, n_points), np.append(values, values[0] + end - begin))
        indices[-1] = n_points - 1.0
        values[[0, -1]] = begin, end
        return cls(indices, values)

    def around(self, begin: int, end: int) -> Parameters:
        """Those that tell of the points from one to before another."""
        first = int(np.searchsorted(self.indices, begin, side="right")) - 1
        last = int(np.searchsorted(self.indices, end - 1))
        return Parameters(self.indices[first : last + 1], self.values[first : last + 1])


class StreamProblem:
    """The squared residuals of all points as a function of the control points alone.

    Parameters
    ----------
    passes : Passes
    sample : Contour
        Of the points, evenly many.
    start : Start
        To the sample: gives knots, degree, number of control points, and the parameters from which
        those of all points are found.
    middle : ndarray, shape (2,)
        What control points are counted from.

    Notes
    -----
    What `LevenbergMarquardt` asks for. The normal equations are those with the parameters
    eliminated (`CurveProblem.damped_step`); a step that is dropped needs no pass. Where the points
    leave a gap nothing of them holds the curve: there the stray residuals of the sample do.
    """

    def __init__(self, passes: Passes, sample: Contour, start: Start, middle: FloatArray) -> None:
        self._passes, self._template, self._middle = passes, start.spline, middle
        along = parameters_in_order(start, sample)
        self._sample = sample.points - middle, along
        begins = passes.stream.begins
        known = Parameters.of(sample, along, start.spline.domain, passes.stream.n_points)
        self._known = [known.around(*ends) for ends in pairwise(begins)]
        self._sums: dict[bytes, FloatArray] = {}
        self._base = b""

    def curve(self, x: FloatArray) -> CentredCurve:
        """The curve that a vector stands for."""
        template, points = self._template, x.reshape(-1, 2)
        moved = BSplineCurve(template.knots, points, template.degree, template.periodic)
        return CentredCurve(moved, self._middle)

    def cost(self, x: FloatArray) -> float:
        """Half the sum of the squared residuals, in a pass over all points."""
        return float(self._summed(x)[0])

    def damped_step(self, x: FloatArray, damping: float) -> Proposal | None:
        """Levenberg-Marquardt step; None if it has no solution."""
        template, step = self._template, np.empty_like(x)
        self._base = x.tobytes()
        solved, decrease, gradient_norm = _kernels.eliminated_step(
            template.degree,
            template.periodic,
            self._summed(x),
            damping,
            step.reshape(-1, 2),
        )
        return Proposal(x + step, decrease, gradient_norm) if solved else None

    def _summed(self, x: FloatArray) -> FloatArray:
        """The sums over all chunks, in their order; those of two vectors are kept."""
        key = x.tobytes()
        if key not in self._sums:
            curve, begins = self.curve(x), self._passes.stream.begins
            asked = [
                (curve, begin, known) for begin, known in zip(begins, self._known, strict=False)
            ]
            found = self._passes.over_all(chunk_equations, asked)
            no_weights = np.zeros(len(self._sample[0]))
            found.append(_equations(curve.moved, *self._sample, no_weights, STRAY_WEIGHT))
            kept = {self._base: self._sums[self._base]} if self._base in self._sums else {}
            self._sums = kept | {key: np.sum(found, axis=0)}
        return self._sums[key]


def chunk_equations(
    points: FloatArray, curve: CentredCurve, begin: int, known: Parameters
) -> FloatArray:
    """What a chunk of points says about the control points."""
    spline, moved = curve.moved, points - curve.middle
    problem = CurveProblem(moved, spline)
    parameters = np.interp(np.arange(begin, begin + len(points)), *known)
    first, last = parameters[0], parameters[-1]
    near = problem.projected_nearby(problem.pack(spline.control_points, parameters))
    parameters = nondecreasing(problem.unpack(near)[1])
    if not spline.periodic:  # ends of the data stay ends of the curve
        low, high = spline.domain
        parameters[0] = low if first == low else parameters[0]
        parameters[-1] = high if last == high else parameters[-1]
    return _equations(spline, moved, parameters, None, 0.0)


def _equations(
    spline: BSplineCurve,
    points: FloatArray,
    parameters: FloatArray,
    weights: FloatArray | None,
    stray_weight: float,
) -> FloatArray:
    """Cost, right side and matrix of the normal equations, one after another."""
    form, control_points = (spline.degree, spline.periodic), spline.control_points
    equations = np.empty(_kernels.eliminated_size(len(control_points), *form))
    problem = _kernels.LeastSquares(spline.knots, *form, points, weights, stray_weight=stray_weight)
    problem.eliminated_equations(control_points, parameters, equations)
    return equations


def least_squares(
    passes: Passes, seen: Seen, closed: bool, count: int, degree: int, monitor: Monitor
) -> SquaresFit:
    """The least-squares curve of a number of control points for all points.

    It begins with that of a sample, whose knots it keeps.
    """
    ends = seen.sample if closed else np.concatenate([seen.sample, seen.last[None]])
    sample = Contour.silently(ends, closed)
    if count > len(sample):
        raise InvalidInputError(
            f"n_control_points must be at most {len(sample)}, the number of points that the start"
            f" is made from, got {count}; lower it"
        )
    # An open curve that is held at noisy ends turns back on itself there.
    fitted = "free" if closed else "fitted"
    first = minimized(
        sample,
        balanced_start(sample, count, degree, ends="fitted"),
        LevenbergMarquardt(),
        ends=fitted,
        stray_weight=STRAY_WEIGHT,
        callback=monitor.of_iterations,
        ask=monitor.ends,
    ).spline
    start = Balanced(first, two_sided_distance(first, sample).parameters)
    middle = 0.5 * (seen.low + seen.high)
    n = passes.stream.n_points
    problem = StreamProblem(passes, sample, start, middle)
    run = minimize(
        LevenbergMarquardt(),
        problem,
        (start.spline.control_points - middle).ravel(),
        limits=LIMITS,
        callback=lambda record: monitor.iterated(with_paper_error(record, n)),
    )
    passes.reach(1 + MOST_PASSES)
    moved = problem.curve(run.x).moved
    points = moved.control_points + middle
    spline = BSplineCurve(moved.knots, points, degree, moved.periodic)
    history = tuple(with_paper_error(record, n) for record in run.history)
    return SquaresFit(spline, sample, run, history)

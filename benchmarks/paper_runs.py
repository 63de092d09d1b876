"""What ``make paper`` measures: every figure of docs/paper.md but its words and pictures.

Everything here but the seconds is the same from run to run.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from benchmarks.predecessor import PredecessorStart, predecessor_solver, predecessor_start
from shapespline import LITERAL, SENSIBLE, Contour, initial_curve, optimize, read
from shapespline.analysis.cpda import chord_to_point
from shapespline.geometry.distances import two_sided_distance
from shapespline.paper.run import (
    LITERAL_LIMITS,
    SENSIBLE_LIMITS,
    SENSIBLE_STRAY_WEIGHT,
    TIMED_RUNS,
    PaperRun,
    TimedStart,
    paper_error,
    run_paper,
    timed_start,
)
from shapespline.solvers.iteration import Limits
from shapespline.solvers.quasi_newton import METHODS, make_solver

if TYPE_CHECKING:
    from shapespline.engines.least_squares import Start
    from shapespline.geometry.distances import Distances
    from shapespline.monitor import Iteration
    from shapespline.values.fit import Fit

REPOSITORY = Path(__file__).resolve().parents[1]
DATA = REPOSITORY / "examples" / "data" / "paper"

LENGTHS = (5, 4, 3, 2)
# The full matrix costs a hundred times as much an evaluation as the others.
PREDECESSOR_LIMITS = Limits(max_evaluations=600, relative_decrease=1e-6)
METHOD_EVALUATIONS = 10_000
BFGS_EVALUATIONS = 600
# "Reaches the error the literal run ends at": the literal run itself is counted until it is this
# near its end, not until it stops.
NEAR_ITS_END = 1.01
STRICTER = 0.5
LITERAL_CONFIGURATION = "d-bfgs-inverse, as published"


class Published(NamedTuple):
    """A row of the paper's Table 2."""

    n_control_points: int
    start_error: float
    final_error: float
    seconds: float


@dataclass(frozen=True)
class Outline:
    """One of the three examples, and what the paper reports of its own."""

    name: str
    figure: int
    file: str
    length: int
    ours: Published
    predecessor: Published

    @property
    def contour(self) -> Contour:
        """The closed outline, bounding box diagonal 10."""
        return read(DATA / self.file, closed=True).longest


OUTLINES = (
    Outline(
        "leaf",
        4,
        "leaf840.csv",
        2,
        Published(36, 0.7462, 0.0170, 0.21),
        Published(42, 0.7506, 0.0173, 0.29),
    ),
    Outline(
        "palm",
        5,
        "palm620.csv",
        3,
        Published(49, 1.2755, 0.0451, 0.16),
        Published(53, 1.2862, 0.0510, 0.26),
    ),
    Outline(
        "airplane",
        6,
        "airplane1100.csv",
        4,
        Published(70, 0.4506, 0.0216, 0.36),
        Published(77, 0.4525, 0.0221, 0.45),
    ),
)
# Length -> number of control points and seconds, the paper's Table 1.
PUBLISHED_LENGTHS = {5: (25, 0.2604), 4: (27, 0.2586), 3: (28, 0.2570), 2: (35, 0.2535)}


class Entry(NamedTuple):
    """A row of Table 2."""

    label: str
    n_control_points: int
    start_error: float
    fit: Fit
    start_seconds: float


class MethodRun(NamedTuple):
    """How a method did: the records where it met each target (None if not), and its last."""

    reached: tuple[Iteration | None, ...]
    last: Iteration


@dataclass(frozen=True)
class OutlineRuns:
    """Everything measured on one outline."""

    outline: Outline
    contour: Contour
    lengths: dict[tuple[int, bool], TimedStart]
    literal: PaperRun
    sensible: PaperRun
    same_count: PaperRun
    held: Fit
    start_distances: dict[bool, Distances]
    predecessors: dict[bool, tuple[PredecessorStart, Fit, float]]
    methods: dict[bool, dict[str, MethodRun]]
    at_literal_count: MethodRun
    n_at_literal_count: int

    @property
    def entries(self) -> list[Entry]:
        """The rows of Table 2 that were measured."""
        rows = [
            Entry("ours, literal", *_row(self.literal)),
            Entry("ours, sensible", *_row(self.sensible)),
            Entry("ours, sensible, number as published", *_row(self.same_count)),
        ]
        shown = self.shown
        label = "the larger of the two starts, Levenberg-Marquardt, held"
        held = (shown.start.n_control_points, shown.start_error, self.held, shown.start_seconds)
        rows.append(Entry(label, *held))
        for literal, (start, fit, seconds) in self.predecessors.items():
            label = f"predecessor (stand-in), {'literal' if literal else 'sensible'}"
            rows.append(Entry(label, fit.n_control_points, start.error, fit, seconds))
        return rows

    @property
    def shown(self) -> PaperRun:
        """The sensible run of Figures 4 to 6: the published number of points if that is more."""
        return _larger(self.sensible, self.same_count)

    @property
    def literal_near_end(self) -> Iteration:
        """The first record of the literal run within 1 % of the error that it ends at."""
        found = first_within(self.literal.fit, NEAR_ITS_END * self.literal.final_error)
        return found or self.literal.fit.history[-1]

    @property
    def direct(self) -> Iteration | None:
        """Where direct D-BFGS from the sensible start meets the literal run's end error."""
        return self.methods[False]["d-bfgs"].reached[0]


def _larger(one: PaperRun, other: PaperRun) -> PaperRun:
    """The run with more control points."""
    return max(one, other, key=lambda run: run.fit.n_control_points)


def _row(run: PaperRun) -> tuple[int, float, Fit, float]:
    return run.fit.n_control_points, run.start_error, run.fit, run.start_seconds


def measure(outline: Outline) -> OutlineRuns:
    """Run everything on one outline."""
    contour, length = outline.contour, outline.length
    literal = run_paper(contour, length, literal=True)
    sensible = run_paper(contour, length)
    same = run_paper(contour, length, n_control_points=outline.ours.n_control_points)
    counted = initial_curve(contour, length, n_control_points=literal.fit.n_control_points)
    shown = _larger(sensible, same)
    targets = (literal.final_error, STRICTER * literal.final_error)
    return OutlineRuns(
        outline,
        contour,
        {
            (chord, as_published): timed_start(contour, chord, literal=as_published)
            for chord in LENGTHS
            for as_published in (True, False)
        },
        literal,
        sensible,
        same,
        optimize(contour, shown.start, stray_weight=SENSIBLE_STRAY_WEIGHT),
        {run.literal: two_sided_distance(run.start.spline, contour) for run in (literal, sensible)},
        {run.literal: _predecessor(contour, length, run) for run in (literal, sensible)},
        {run.literal: compare_methods(contour, run.start, targets) for run in (literal, sensible)},
        run_method(contour, counted, "d-bfgs", targets),
        counted.n_control_points,
    )


def _predecessor(
    contour: Contour, length: int, ours: PaperRun
) -> tuple[PredecessorStart, Fit, float]:
    """The stand-in in the same reading as a run of ours, and the seconds of its initial curve."""
    reading = LITERAL if ours.literal else SENSIBLE
    times = []
    for _ in range(TIMED_RUNS):
        began = time.perf_counter()
        start = predecessor_start(contour, length, ours.start_error, reading)
        times.append(time.perf_counter() - began)
    seconds = median(times)
    limits = PREDECESSOR_LIMITS if ours.literal else SENSIBLE_LIMITS
    fit = optimize(contour, start, predecessor_solver(), ends="free", limits=limits)
    return start, fit, seconds


# Methods


def compare_methods(
    contour: Contour, start: Start, targets: tuple[float, ...]
) -> dict[str, MethodRun]:
    """Every method from one start to the same errors."""
    names = (LITERAL_CONFIGURATION, *METHODS, "levenberg-marquardt")
    return {name: run_method(contour, start, name, targets) for name in names}


def run_method(contour: Contour, start: Start, name: str, targets: tuple[float, ...]) -> MethodRun:
    """Run one method until it meets the last target or stops, and find where it met each."""
    method = name
    if name == LITERAL_CONFIGURATION:
        method = make_solver("d-bfgs-inverse", start_diagonal="identity", wolfe="weak")
    most = BFGS_EVALUATIONS if name == "bfgs" else METHOD_EVALUATIONS
    if name == LITERAL_CONFIGURATION:
        most = LITERAL_LIMITS.max_evaluations
    limits = Limits(
        max_iterations=most,
        max_evaluations=most,
        relative_decrease=1e-6,
        target_cost=0.5 * targets[-1] ** 2 * (len(contour) - 1),
    )
    fit = optimize(contour, start, method, ends="free", limits=limits)
    return MethodRun(tuple(first_within(fit, error) for error in targets), fit.history[-1])


def first_within(fit: Fit, error: float) -> Iteration | None:
    """The first record of a fit with no larger error (but for rounding)."""
    met = (record for record in fit.history if record.paper_error <= error * (1 + 1e-12))
    return next(met, None)


# The other claims


class UnitRow(NamedTuple):
    """Errors of both readings relative to the box diagonal, in one unit."""

    diagonal: float
    literal_start: float
    literal_final: float
    sensible_start: float
    sensible_final: float


def units(contour: Contour, length: int, factors: tuple[float, ...]) -> list[UnitRow]:
    """The same outline in several units."""
    rows = []
    for factor in factors:
        scaled = Contour(factor * contour.points, closed=True)
        runs = [run_paper(scaled, length, literal=literal) for literal in (True, False)]
        errors = [e / scaled.box_diagonal for r in runs for e in (r.start_error, r.final_error)]
        rows.append(UnitRow(scaled.box_diagonal, *errors))
    return rows


class Shaken(NamedTuple):
    """What comes of an outline whose coordinates change in the tenth digit."""

    literal_counts: list[int]
    sensible_counts: list[int]
    sensible_errors: list[float]


def under_rounding(contour: Contour, length: int, n_draws: int = 8) -> Shaken:
    """Numbers of control points, and final errors of the sensible run."""
    shaken = Shaken([], [], [])
    random = np.random.default_rng(0)
    for _ in range(n_draws):
        noise = 1e-9 * contour.box_diagonal * random.standard_normal(contour.points.shape)
        moved = Contour(contour.points + noise, closed=True)
        for counts, reading in (
            (shaken.literal_counts, LITERAL),
            (shaken.sensible_counts, SENSIBLE),
        ):
            counts.append(initial_curve(moved, length, reading=reading).n_control_points)
        shaken.sensible_errors.append(run_paper(moved, length).final_error)
    return shaken


def pixel_chain(contour: Contour, pixels: int) -> Contour:
    """The chain of pixels that an outline passes through in an image of that many across."""
    scale = pixels / float(np.ptp(contour.points, axis=0).max())
    cells = np.rint(scale * contour.resampled(8 * pixels).points)
    new = np.any(cells != np.roll(cells, 1, axis=0), axis=1)
    return Contour(cells[new], closed=True)


def pixel_counts(contour: Contour, length: int) -> tuple[int, int]:
    """Control points of a pixel chain: every local maximum, and the prominent ones."""
    literal = chord_to_point(contour, length, signed=False, window=3)
    prominent = initial_curve(contour, length)
    return len(literal.maxima) + 2, prominent.n_control_points


class GoingOn(NamedTuple):
    """What a run of direct D-BFGS has reached when it stops at a relative decrease."""

    relative_decrease: float
    plain: Fit
    held: Fit


def going_on(contour: Contour, start: Start) -> list[GoingOn]:
    """The same start with ever stricter stopping rules."""
    rows = []
    for fraction in (1e-2, 1e-3, 1e-4, 1e-5):
        limits = replace(SENSIBLE_LIMITS, relative_decrease=fraction, max_iterations=4000)
        plain = optimize(contour, start, "d-bfgs", limits=limits)
        held = optimize(contour, start, "d-bfgs", limits=limits, stray_weight=SENSIBLE_STRAY_WEIGHT)
        rows.append(GoingOn(fraction, plain, held))
    return rows


class Growth(NamedTuple):
    """Seconds an iteration and an evaluation for a number of points."""

    n_points: int
    per_iteration: float
    per_evaluation: float


def growth(contour: Contour, sizes: tuple[int, ...], n_iterations: int = 30) -> list[Growth]:
    """Time of direct D-BFGS on the same outline, sampled ever more densely."""
    rows = []
    for n in sizes:
        dense = contour.resampled(n)
        start = initial_curve(dense, arc_length=dense.length / 100)
        limits = Limits(max_iterations=n_iterations, relative_decrease=0, gradient_tolerance=0)
        best = None
        for _ in range(5):
            last = optimize(dense, start, "d-bfgs", limits=limits).history[-1]
            if best is None or last.seconds < best.seconds:
                best = last
        rows.append(Growth(n, best.seconds / best.iteration, best.seconds / best.evaluations))
    return rows


class Parameters(NamedTuple):
    """Start error of the literal control points with several location parameters."""

    uniform: float
    centripetal: float
    chord: float
    greville: float


def parameter_errors(contour: Contour, length: int) -> Parameters:
    """What the choice of the location parameters alone does to the literal initial curve."""
    errors = []
    for kind in Parameters._fields:
        start = initial_curve(contour, length, reading=replace(LITERAL, parametrization=kind))
        errors.append(paper_error(contour, start.spline, start.parameters))
    return Parameters(*errors)

"""The pictures of docs/engines, each from a run of an engine on a shape of examples/data.

python -m benchmarks.engine_figures
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

import shapespline as ss
from benchmarks.drawn.profiles import noisy_profile
from benchmarks.figure_style import (
    BLUE,
    ENGINES,
    FONT_SIZE,
    GREEN,
    GREY,
    INK,
    KINDS,
    ORANGE,
    PALE,
    RED,
    canvas,
    draw_pieces,
    labelled,
    outline,
    plane,
    sampled,
    save,
)
from benchmarks.least_squares_figures import (
    estimation_size,
    methods_convergence,
    stray_residuals,
)
from shapespline import _kernels
from shapespline.engines.least_squares import CurveProblem
from shapespline.engines.pieces import PiecesProblem
from shapespline.engines.pieces.search import BUDGETS, PiecesSolver
from shapespline.fitting import Request, Settings
from shapespline.fitting.problem import Problem
from shapespline.fitting.repair.assignment import DataRun
from shapespline.fitting.repair.clearance import Sides, moved
from shapespline.fitting.solve import search
from shapespline.geometry import crossing_pairs, nearest
from shapespline.monitor import Monitor
from shapespline.solvers import LevenbergMarquardt, Limits, minimize

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

    from shapespline.typing import FloatArray
    from shapespline.values import Contour, Fit, Piece


def by_pieces(contour: Contour, tolerance: float) -> Fit:
    """What the strategies in pieces find, nothing repaired."""
    request = Request.of(contour, None, Settings(tolerance=tolerance))
    return search(Problem(replace(request, pieces_only=True)), Monitor()).fit


def by_removal(contour: Contour, tolerance: float, monitor: Monitor) -> Fit:
    """What knot removal finds until the monitor ends it."""
    settings = Settings(tolerance=tolerance, form="spline")
    return search(Problem(Request.of(contour, None, settings)), monitor).fit


def stored(pieces: Sequence[Piece]) -> int:
    """Points that a closed row of pieces stores."""
    return sum(len(piece.control_points) - 1 for piece in pieces)


def pieces_stages() -> None:
    """Corners of the data, the path of sections, what is left after the moves."""
    contour = outline("hand620_closed")
    tolerance = 0.001 * contour.box_diagonal
    problem = PiecesProblem.of(contour, tolerance, "auto").thinned()
    solver = PiecesSolver(problem, 3, True, True, Monitor())
    budget = BUDGETS["balanced"][0]
    path = solver.run(0.999 * problem.tolerance, budget._replace(passes=0, thorough=False))
    moved = by_pieces(contour, tolerance).sections
    work = problem.normalized
    figure, axes = canvas(13.0, 5.2, 3)
    axes[0].plot(*contour.polyline.T, ".", ms=2.0, color=GREY)
    corners = work.contour.points[problem.corners] / work.scale + work.middle
    axes[0].plot(*corners.T, "o", ms=5.5, color=INK)
    plane(axes[0], f"{len(contour)} points, {len(corners)} corners of the data")
    for one, pieces, title in (
        (axes[1], work.restored(path), "cheapest path of sections"),
        (axes[2], moved, "after moves with free nodes"),
    ):
        one.plot(*contour.polyline.T, ".", ms=1.5, color=PALE)
        draw_pieces(one, pieces, contour.closed)
        plane(one, f"{title}: {stored(pieces)} points")
    for kind, color in KINDS.items():
        axes[2].plot([], [], color=color, lw=2, label=kind)
    axes[2].plot([], [], "o", color=INK, label="corner")
    axes[2].plot([], [], "o", mfc="white", mec=INK, label="smooth node")
    figure.legend(loc="outside lower center", ncols=5, frameon=False, fontsize=FONT_SIZE)
    save(figure, ENGINES / "pieces-stages.png")


def lawson_rounds() -> None:
    """Weights times distances, round by round: a lower bound meets the largest distance."""
    contour = outline("loop500_open")
    points = contour.points[70:150:2]
    points = points / contour.box_diagonal * 100.0
    template = ss.BSplineCurve(
        [0, 0, 0, 0, 1, 1, 1, 1], np.linspace(points[0], points[-1], 4), degree=3
    )
    steps = np.hypot(*np.diff(points, axis=0).T)
    parameters = np.concatenate([[0.0], np.cumsum(steps)]) / steps.sum()
    weights, solver, rounds = np.ones(len(points)), LevenbergMarquardt(), []
    guess = template.control_points
    for _ in range(10):
        problem = CurveProblem(points, template, weights, ends="fixed")
        start = problem.control_points_for(parameters, guess)
        run = minimize(
            solver, problem, problem.pack(start, parameters), limits=Limits(max_iterations=60)
        )
        guess, parameters = (part.copy() for part in problem.unpack(run.x))
        distances = np.hypot(*(problem.curve(run.x)(parameters) - points).T)
        bound = float(np.sqrt((weights * distances**2).sum() / weights.sum()))
        rounds.append((distances, float(distances.max()), bound))
        weights = weights * (distances / distances.max() + 1e-3)
        weights = np.maximum(weights * len(points) / weights.sum(), 1e-4)
    figure, (left, right) = canvas(12.0, 4.2, 2)
    for at, color, label in ((0, GREY, "first round"), (2, ORANGE, "third"), (9, BLUE, "tenth")):
        left.plot(rounds[at][0], "-o", ms=3.5, lw=1.5, color=color, label=label)
    left.axhline(rounds[-1][1], color=BLUE, lw=0.9, ls="--")
    left.set_ylim(0.0, 1.25 * rounds[0][1])
    labelled(left, "data point", "distance, % of the diagonal", "one cubic, the distances even out")
    left.legend(frameon=False, fontsize=FONT_SIZE, ncols=3, loc="upper center")
    count = np.arange(1, len(rounds) + 1)
    right.plot(count, [r[1] for r in rounds], "-o", color=RED, label="largest distance")
    right.plot(count, [r[2] for r in rounds], "-o", color=GREEN, label="weighted rms: lower bound")
    right.set_ylim(0.0, None)
    labelled(right, "round", "% of the diagonal", "no cubic can be nearer than the lower bound")
    right.legend(frameon=False, fontsize=FONT_SIZE)
    save(figure, ENGINES / "pieces-lawson.png")


def spline_stages() -> None:
    """The start by insertion, after the cheapest removals, at the end."""
    contour = outline("hand620_closed")
    tolerance = 0.001 * contour.box_diagonal
    results = []
    for calls in (1, 2, 99):
        seen = []

        def ends(record: object, calls: int = calls, seen: list[object] = seen) -> bool:
            # Stages only: between them the count of stages stays.
            if not seen or record.iteration != seen[-1].iteration:  # type: ignore[attr-defined]
                seen.append(record)
            return len(seen) >= calls

        results.append(by_removal(contour, tolerance, Monitor(ends)).spline)
    titles = ("start by insertion", "cheapest knots removed", "after harder attempts")
    figure = Figure(figsize=(13.0, 5.6), layout="constrained")
    axes = figure.subplots(2, 3, height_ratios=[4, 1], sharey="row")
    polygons = np.concatenate([curve.control_points for curve in results])
    low, high = polygons[:, 0].min(), polygons[:, 0].max()
    for column, (curve, title) in enumerate(zip(results, titles, strict=True)):
        one, below = axes[0][column], axes[1][column]
        closed = np.concatenate([curve.control_points, curve.control_points[:1]])
        one.plot(*closed.T, "-", color=PALE, lw=1.0)
        one.plot(*curve(np.linspace(0, 1, 2000)).T, color=BLUE, lw=1.8)
        one.plot(*curve(curve.breakpoints).T, "o", ms=4.5, mfc="white", mec=RED, mew=1.2)
        one.set_xlim(low - 5 * tolerance, high + 5 * tolerance)
        plane(one, f"{title}: {curve.n_control_points} control points")
        gaps = np.diff(curve.breakpoints)
        below.bar(np.arange(len(gaps)), gaps / gaps.min(), color=RED, width=0.8)
        below.set_yscale("log")
        below.spines[["top", "right"]].set_visible(False)
        below.tick_params(labelsize=FONT_SIZE - 1)
        below.set_xlabel("span", fontsize=FONT_SIZE)
    axes[1][0].set_ylabel("interval / smallest", fontsize=FONT_SIZE)
    save(figure, ENGINES / "spline-stages.png")


def _halved(points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """A Bezier's halves by de Casteljau's construction."""
    left, right = [points[0]], [points[-1]]
    while len(points) > 1:
        points = 0.5 * (points[1:] + points[:-1])
        left.append(points[0])
        right.append(points[-1])
    return np.array(left), np.array(right[::-1])


def _strip(axes: Axes) -> None:
    """A piece of a curve, its chord, and the strip about it that holds polyline and piece."""
    contour = outline("loop500_n0.2_open")
    spline = ss.fit_curve(contour, n_control_points=14).spline
    piece = spline.beziers().points[5]
    piece, _ = _halved(piece)
    begin, end = piece[0], piece[-1]
    ends = [int(np.hypot(*(contour.points - node).T).argmin()) for node in (begin, end)]
    near = contour.points[min(ends) : max(ends) + 1]
    along = (end - begin) / np.hypot(*(end - begin))
    across = np.array([-along[1], along[0]])
    second = np.diff(piece, 2, axis=0)
    from_chord = 0.125 * 3 * 2 * np.hypot(*second.T).max()
    widest = np.abs((near - begin) @ across).max()

    def turned(points: FloatArray) -> FloatArray:
        return np.column_stack([(points - begin) @ along, (points - begin) @ across])

    around = contour.points[max(min(ends) - 3, 0) : max(ends) + 4]
    t = np.linspace(0, 1, 100)[:, None]
    cubic = (
        (1 - t) ** 3 * piece[0]
        + 3 * (1 - t) ** 2 * t * piece[1]
        + 3 * (1 - t) * t**2 * piece[2]
        + t**3 * piece[3]
    )
    length = float(np.hypot(*(end - begin)))
    axes.axhspan(-widest, widest, color=PALE, alpha=0.5, lw=0, label="strip of half-width s")
    axes.plot([0, length], [0, 0], color=INK, lw=1.0, ls="--", label="chord")
    axes.plot(*turned(around).T, "-o", ms=4, color=GREY, lw=1.2, label="data polyline")
    axes.plot(*turned(cubic).T, color=BLUE, lw=2.2, label="piece of the curve")
    axes.plot(*turned(piece).T, "s", ms=5, mfc="white", mec=BLUE, label="its control points")
    axes.annotate(
        "", (0.5 * length, from_chord), (0.5 * length, 0), arrowprops={"arrowstyle": "<->"}
    )
    axes.text(0.52 * length, 0.5 * from_chord, "b", fontsize=FONT_SIZE + 1, style="italic")
    top = max(widest, from_chord)
    axes.set_ylim(-1.3 * top, 3.2 * top)
    labelled(axes, "along the chord", "across it", "no point of the piece is farther than s + b")
    axes.legend(frameon=False, fontsize=FONT_SIZE - 1, ncols=2, loc="upper center")


def certified_bounds() -> None:
    """Bounds of the distance from curve to data, as tight as asked for."""
    contour = outline("plane1100_closed")
    fit = ss.fit_curve(contour, tolerance="0.5%")
    curve = fit.spline
    gaps = np.array([1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001])
    bounds = np.array(
        [
            _kernels.curve_deviation(
                curve.knots, curve.degree, curve.coefficients, contour.polyline, gap, 1e-9
            )[:2]
            for gap in gaps
        ]
    )
    figure, (left, right) = canvas(12.5, 4.6, 2)
    _strip(left)
    right.semilogx(gaps, bounds[:, 1], "-o", color=RED, label="certified upper bound")
    right.semilogx(gaps, bounds[:, 0], "-o", color=GREEN, label="a curve point is this far")
    right.axhline(fit.tolerance, color=INK, lw=1.0, ls="--")
    right.text(0.5, fit.tolerance, "tolerance", va="bottom", ha="center", fontsize=FONT_SIZE)
    right.invert_xaxis()
    labelled(right, "relative gap asked for", "distance, data units", "halving closes the gap")
    right.legend(frameon=False, fontsize=FONT_SIZE)
    save(figure, ENGINES / "certification-bounds.png")


def _where_it_crosses(pieces: Sequence[Piece]) -> FloatArray:
    """The place nearest to all points of two pieces that cross, away from their common node."""
    lines = [sampled(piece) for piece in pieces]
    i, j = min(crossing_pairs(lines))
    apart = np.hypot(*(lines[i][:-3, None] - lines[j][None, 3:]).transpose(2, 0, 1))
    return np.array(lines[i][np.unravel_index(apart.argmin(), apart.shape)[0]])


def crossings_repaired() -> None:
    """A clearance narrower than the tolerance: crossing curves, points moved, curves apart."""
    contour = outline("mdi_fish_c0")
    tolerance = 0.005 * contour.box_diagonal
    within = 0.75 * tolerance
    found = by_pieces(contour, tolerance)
    before = found.spline
    after = ss.fit_curve(contour, tolerance=tolerance).spline
    feet = before(nearest(before, contour.points).parameters)
    run = DataRun(contour.points, contour.arc_length[: len(contour)])
    across = Sides([contour]).across(run, 0, reach=2 * within, least=within)
    aside = moved(contour.points, feet, across, within, tolerance - within)
    figure, axes = canvas(13.0, 3.1, 3)
    middle = _where_it_crosses(found.sections)
    for one in axes:
        one.plot(*contour.polyline.T, "-o", ms=3.0, lw=0.8, color=GREY)
    dense = np.linspace(0.0, 1.0, 20_000)
    axes[0].plot(*before(dense).T, color=RED, lw=2.0)
    axes[1].plot(*before(dense).T, color=RED, lw=0.8)
    axes[1].plot(*aside.T, "o", ms=4.0, color=ORANGE)
    axes[1].plot(*np.stack([contour.points, aside], axis=1).T, color=ORANGE, lw=1.2)
    axes[2].plot(*after(dense).T, color=BLUE, lw=2.0)
    titles = (
        "within the tolerance, and crossing",
        "points moved apart by up to \u03c4/4",
        "fitted again within 3\u03c4/4",
    )
    for one, title in zip(axes, titles, strict=True):
        one.set_xlim(middle[0] - 4 * tolerance, middle[0] + 8 * tolerance)
        one.set_ylim(middle[1] - 1.8 * tolerance, middle[1] + 4.2 * tolerance)
        plane(one, title)
        x, y = middle + np.array([-3.5, -1.5]) * tolerance
        one.plot([x, x + tolerance], [y, y], color=INK, lw=3)
        one.text(x + 1.2 * tolerance, y, "\u03c4", va="center", fontsize=FONT_SIZE + 1)
    save(figure, ENGINES / "repairs-crossings.png")


def estimation_profiles() -> None:
    """Noisy points of a cover and a spade: the fewest points, and as they were drawn."""
    figure, axes = canvas(14.0, 4.2, 4)
    for pair, name, draw in ((axes[:2], "cover", 1), (axes[2:], "spade (aside)", 1)):
        samplings = noisy_profile(name, draw, 10)
        points = next(points for key, points, _ in samplings if key == (0.5, 1000))
        for one, character in zip(pair, ("fewest", "drawn"), strict=True):
            fit = ss.fit_curve(points, closed=True, character=character)
            one.plot(*points.T, ".", ms=2.0, color=PALE)
            if fit.sections:
                draw_pieces(one, fit.sections, closed=True)
            else:
                one.plot(*fit.curve(np.linspace(0.0, 1.0, 1000)).T, color=RED, lw=2.0)
            plane(one, f"{character}: {fit.n_stored_points} points, {len(fit.corners)} corners")
    save(figure, ENGINES / "estimation-profiles.png")


FIGURES = (
    pieces_stages,
    lawson_rounds,
    spline_stages,
    methods_convergence,
    stray_residuals,
    estimation_size,
    estimation_profiles,
    crossings_repaired,
    certified_bounds,
)


def main() -> None:
    """Draw them all."""
    for figure in FIGURES:
        figure()


if __name__ == "__main__":
    main()

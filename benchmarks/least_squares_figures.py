"""The pictures of docs/engines about least squares and estimation.

:mod:`benchmarks.engine_figures` draws them with the others.
"""

from __future__ import annotations

import numpy as np

import shapespline as ss
from benchmarks.figure_style import (
    BLUE,
    ENGINES,
    FONT_SIZE,
    GREEN,
    GREY,
    INK,
    ORANGE,
    RED,
    canvas,
    labelled,
    outline,
    plane,
    save,
)
from shapespline.analysis import noise_level
from shapespline.engines.least_squares.smoothing import PENALTY, cheapest, sizes_tried, smoothed_to
from shapespline.monitor import Monitor
from shapespline.solvers import Limits


def methods_convergence() -> None:
    """Cost over iterations from one start, by method; feet before and after."""
    contour = outline("loop500_open")
    start = ss.initial_curve(contour, 12, n_control_points=9)
    limits = Limits(max_iterations=100, max_evaluations=1000, relative_decrease=1e-9)
    figure, (left, right) = canvas(12.5, 4.6, 2)
    fit = ss.optimize(contour, start, method="levenberg-marquardt")
    for curve, color, label in (
        (start.spline, ORANGE, "start"),
        (fit.spline, BLUE, "result"),
    ):
        left.plot(*curve(np.linspace(0, 1, 800)).T, color=color, lw=1.8, label=label)
    left.plot(*contour.points.T, ".", ms=2.0, color=GREY, zorder=0, label="data")
    plane(left, f"{fit.n_control_points} control points, parameters free")
    left.legend(frameon=False, fontsize=FONT_SIZE, loc="lower left")
    names = ("levenberg-marquardt", "l-bfgs", "d-bfgs", "sdm", "tdm", "pdm")
    colors = (BLUE, GREEN, ORANGE, RED, INK, GREY)
    runs = [ss.optimize(contour, start, method=name, limits=limits) for name in names]
    costs = [np.array([record.cost for record in run.history]) for run in runs]
    least = min(float(cost.min()) for cost in costs)
    for name, color, cost in zip(names, colors, costs, strict=True):
        right.semilogy(np.maximum(cost / least - 1.0, 1e-6), color=color, lw=1.8, label=name)
    right.set_ylim(1e-5, None)
    labelled(right, "iteration", "cost over the least, minus 1", "the same start, six methods")
    right.legend(frameon=False, fontsize=FONT_SIZE)
    save(figure, ENGINES / "least-squares-methods.png")


def stray_residuals() -> None:
    """The curve between its data, without and with residuals that hold it."""
    contour = outline("hand620_closed")
    start = ss.initial_curve(contour, 3)
    figure, axes = canvas(12.0, 5.0, 2)
    for one, weight in zip(axes, (0.0, 0.1), strict=True):
        fit = ss.optimize(contour, start, method="levenberg-marquardt", stray_weight=weight)
        dense = fit.spline(np.linspace(0, 1, 20_000))
        one.plot(*contour.points.T, ".", ms=3.0, color=GREY)
        one.plot(*dense.T, color=RED if weight == 0 else BLUE, lw=1.6)
        off = 100 * fit.hausdorff_distance / contour.box_diagonal
        there = 100 * fit.max_distance / contour.box_diagonal
        name = "residuals of the data alone" if weight == 0 else "with stray residuals, weight 0.1"
        one.set_xlim(contour.points[:, 0].min() - 15, contour.points[:, 0].max() + 15)
        one.set_ylim(contour.points[:, 1].min() - 12, contour.points[:, 1].max() + 32)
        plane(one, f"{name}\ndata to curve {there:.2f} %, both ways {off:.2f} % of the diagonal")
    save(figure, ENGINES / "least-squares-stray.png")


def estimation_size() -> None:
    """Noisy points, the criterion over the number of control points, the curve behind them."""
    contour, truth = outline("loop500_n1_open"), outline("loop500_open")
    noise = noise_level(contour)
    found = cheapest(sizes_tried(contour, 3, noise, monitor=Monitor()))
    sizes = [*range(4, 24), *range(24, 61, 4)]
    runs = [smoothed_to(size, contour, 3, noise, monitor=Monitor()) for size in sizes]
    price = np.array([PENALTY * size for size in sizes])
    cost = np.array([run.cost for run in runs])
    figure, (left, right) = canvas(12.5, 4.8, 2)
    left.plot(*contour.points.T, ".", ms=3.0, color=GREY, label="noisy points")
    left.plot(*truth.points.T, color=ORANGE, lw=1.6, label="truth")
    left.plot(*found.points.T, color=BLUE, lw=1.6, label="estimate")
    plane(left, f"noise {noise:.2f} found, {found.n_control_points} control points chosen")
    left.legend(frameon=False, fontsize=FONT_SIZE)
    right.plot(sizes, cost, "-o", ms=3.5, color=BLUE, label="cost")
    right.plot(sizes, cost - price, color=GREEN, label=r"$\sum |r|^2 / \sigma^2$")
    right.plot(sizes, price, color=RED, label=f"{PENALTY} a control point")
    right.plot(found.n_control_points, found.cost, "o", ms=10, mfc="none", mec=INK, mew=1.5)
    right.set_ylim(0, 3.0 * found.cost)
    labelled(
        right, "control points", "units of the variance", "of the sizes tried the cheapest is taken"
    )
    right.legend(frameon=False, fontsize=FONT_SIZE)
    save(figure, ENGINES / "estimation-size.png")

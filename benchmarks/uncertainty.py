"""How often bands hold the truth: ``python -m benchmarks.uncertainty``, some minutes."""

from __future__ import annotations

import time

import numpy as np

import shapespline as ss
from shapespline.engines.least_squares import STARTS
from shapespline.geometry import nearest
from shapespline.solvers import Limits
from shapespline.values import periodic_knots

REPETITIONS = 1000
LIMITS = Limits(max_iterations=50, relative_decrease=1e-8)
N_POINTS, RADIUS = 150, 10.0


class Start:
    """A curve and parameters."""

    def __init__(self, spline: ss.BSplineCurve, parameters: np.ndarray) -> None:
        self.spline, self.parameters = spline, parameters


def in_the_space() -> ss.BSplineCurve:
    """A closed cubic of ten control points."""
    angle = 2 * np.pi * np.arange(10) / 10
    r = RADIUS + 1.5 * np.cos(3 * angle)
    points = np.column_stack([r * np.cos(angle), r * np.sin(angle)])
    return ss.BSplineCurve(periodic_knots(10, 3), points, 3, True)


def flower(n: int) -> np.ndarray:
    """A closed curve that is no spline."""
    angle = 2 * np.pi * np.arange(n) / n
    r = RADIUS + 2.0 * np.cos(5 * angle)
    return np.column_stack([r * np.cos(angle), r * np.sin(angle)])


def held(fit: ss.Fit, off: object, rng: np.random.Generator) -> tuple[bool, bool]:
    """Whether the bands hold the truth at one place, and everywhere."""
    places = np.linspace(0, 1, 300)
    band = fit.band(0.95, simultaneous=True, parameters=places)
    distance = off(band.points)
    one = int(rng.integers(300))
    narrow = fit.band(0.95, parameters=places[one : one + 1])
    return bool(distance[one] <= narrow.half_width[0]), bool((distance <= band.half_width).all())


def fixed(sigma: float) -> tuple[float, float]:
    """Coverage with the truth in the space and its own size."""
    curve, rng = in_the_space(), np.random.default_rng(0)
    u = np.arange(N_POINTS) / N_POINTS
    found = []
    for _ in range(REPETITIONS):
        noise = rng.normal(0, sigma, (N_POINTS, 2))
        contour = ss.Contour(curve(u) + noise, True)
        fit = ss.optimize(
            contour, Start(curve, u), "levenberg-marquardt", sigma=sigma, limits=LIMITS
        )
        found.append(held(fit, lambda p: np.sqrt(nearest(curve, p).distances_sq), rng))
    return tuple(np.mean(found, axis=0).tolist())


def chosen(sigma: float) -> tuple[float, float, float]:
    """Coverage with a size that minimises chi squared and 3.5 a control point, from 8 to 40."""
    dense, rng = flower(20_000), np.random.default_rng(0)
    found, sizes = [], []
    for _ in range(REPETITIONS // 10):
        contour = ss.Contour(flower(N_POINTS) + rng.normal(0, sigma, (N_POINTS, 2)), True)
        fits = [
            ss.optimize(
                contour,
                STARTS["arc-length"](contour, size, 3, None),
                "levenberg-marquardt",
                sigma=sigma,
                limits=LIMITS,
            )
            for size in range(8, 41, 4)
        ]
        best = min(fits, key=lambda f: f.uncertainty.chi_squared + 3.5 * f.n_control_points)
        sizes.append(best.n_control_points)

        def off(points: np.ndarray) -> np.ndarray:
            return np.sqrt(((points[:, None] - dense[None, ::10]) ** 2).sum(axis=2).min(axis=1))

        found.append(held(best, off, rng))
    return (*np.mean(found, axis=0).tolist(), float(np.mean(sizes)))


def main() -> None:
    """Print the tables of docs/uncertainties.md."""
    print("| errors, of the radius | one place | whole curve |\n|---:|---:|---:|")
    for sigma in (0.0002, 0.001, 0.005, 0.02):
        one, whole = fixed(sigma * RADIUS)
        print(f"| {sigma:.2%} | {one:.3f} | {whole:.3f} |")
    print("\n| errors, of the radius | one place | whole curve | control points, mean |")
    print("|---:|---:|---:|---:|")
    for sigma in (0.001, 0.005):
        one, whole, size = chosen(sigma * RADIUS)
        print(f"| {sigma:.2%} | {one:.2f} | {whole:.2f} | {size:.0f} |")
    contour = ss.Contour(flower(10_000), True)
    start = STARTS["arc-length"](contour, 100, 3, None)
    fit = ss.optimize(contour, start, sigma=0.01, limits=Limits(max_iterations=2))
    for simultaneous in (False, True):
        began = time.perf_counter()
        fit.band(0.95, simultaneous=simultaneous, parameters=10_000)
        kind = "whole curve" if simultaneous else "each place"
        print(f"\nband of 10 000 places, 100 control points, {kind}:", end=" ")
        print(f"{1e3 * (time.perf_counter() - began):.0f} ms")


if __name__ == "__main__":
    main()

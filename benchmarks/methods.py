"""Every method on every choice of knots, at an equal number of control points.

python -m benchmarks.methods

Box diagonal 100. Two-sided distances are certified bounds; splprep at the same count beside them.
"""

from __future__ import annotations

import time

import shapespline as ss
from benchmarks.foundation import _errors, outline, splprep_at

COUNTS = (
    ("hand620_closed", 36),
    ("leaf840_closed", 70),
    ("plane1100_closed", 60),
    ("loop500_open", 24),
)
KNOTS = ("balanced", "dominant", "uniform")
METHODS = (
    "levenberg-marquardt",
    "l-bfgs",
    "d-bfgs",
    "pdm",
    "tdm",
    "sdm",
    "fixed-parameters",
)


def main() -> None:
    """Print one table an outline."""
    for name, count in COUNTS:
        contour = outline(name, closed=name.endswith("closed"))
        print(f"## {name}, {count} control points: rms / two-sided / iterations / ms\n")
        print("| method | " + " | ".join(KNOTS) + " |\n|---|" + "---|" * len(KNOTS))
        for method in METHODS:
            cells = []
            for knots in KNOTS:
                began = time.perf_counter()
                fit = ss.fit_curve(contour, n_control_points=count, knots=knots, method=method)
                seconds = time.perf_counter() - began
                cells.append(
                    f"{fit.rms_distance:.4f} / {fit.hausdorff_distance:.3f}"
                    f" / {fit.history[-1].iteration} / {1e3 * seconds:.0f}"
                )
            print(f"| {method} | " + " | ".join(cells) + " |", flush=True)
        curve, _ = splprep_at(contour, count)
        print(f"\nsplprep: rms, two-sided | {_errors(curve, contour)} |\n")


if __name__ == "__main__":
    main()

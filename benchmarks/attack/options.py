"""Options drawn at random, those that go together."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.random import Generator
    from numpy.typing import NDArray

# Parts of the box diagonal.
TOLERANCES = (0.0002, 0.001, 0.005, 0.02)


def drawn_options(
    rng: Generator, points: NDArray[np.float64], closed: bool, *, cheap: bool = False
) -> dict[str, Any]:
    """Keyword arguments of `fit_curve` for some points; cheap ones search fast."""
    diagonal = float(np.hypot(*np.ptp(points, axis=0)))
    efforts, odds = ("fast", "balanced", "smallest"), (0.6, 0.35, 0.05)
    effort = "fast" if cheap else str(rng.choice(efforts, p=odds))
    options: dict[str, Any] = {
        "closed": closed,
        "tolerance": float(rng.choice(TOLERANCES)) * diagonal,
        "effort": effort,
        "degree": int(rng.choice([1, 2, 3, 3, 3, 3, 4, 5])),
    }
    kind = int(rng.integers(8))
    n = len(points)
    if kind == 0:
        options["form"] = "spline"
    elif kind == 1:
        options["corners"] = rng.choice(["free", "none"])
        options["corners"] = None if options["corners"] == "none" else "free"
    elif kind == 2:
        options["through"] = sorted({int(i) for i in rng.integers(0, n, 3)})
    elif kind == 3 and not closed:
        angle = rng.uniform(0, 2 * np.pi, 2)
        both = [(float(np.cos(a)), float(np.sin(a))) for a in angle]
        options["end_tangents"] = (both[0], both[1] if rng.random() < 0.5 else None)
        if rng.random() < 0.5:
            options["through"] = [int(rng.integers(0, n))]
    elif kind == 4:
        options["corners"] = sorted({int(i) for i in rng.integers(0, n, 2)})
    elif kind == 5 and not closed:
        options["ends"] = "fixed"
    elif kind == 6:
        weights = np.ones(n)
        weights[rng.integers(0, n, 2)] = 5.0
        options["weights"] = weights
    return options

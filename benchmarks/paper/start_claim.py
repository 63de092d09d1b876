"""The paper's main claim, that its start helps: start x method x outline at equal counts."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from benchmarks.paper.tables import Table, geometric, mean_and_scatter
from shapespline import LITERAL, SENSIBLE, Contour, Reading, initial_curve, optimize

# Errors are noted after so many iterations, and at the end.
STAGES = (5, 20, 300)
LENGTH = 4


class Setting(NamedTuple):
    """Where starts are compared: a reading, the starts by label, the reference, the methods."""

    name: str
    reading: Reading
    starts: dict[str, Reading]
    reference: str
    methods: tuple[str, ...]
    budget: int


def _published() -> Setting:
    base = replace(LITERAL, offset="none")
    starts = {"the paper's: maxima of H, offset": LITERAL, "maxima of H, on the data": base}
    for label, start in {
        "every (n/m)-th point": "every-nth",
        "equal arc length": "arc-length",
        "curvature density": "curvature",
        "one linear solve [46]": "uniform",
        "Park-Lee [41]": "park-lee",
    }.items():
        starts[label] = replace(base, start=start)
    methods = ("d-bfgs-inverse", "l-bfgs")
    return Setting("published", LITERAL, starts, "every (n/m)-th point", methods, 3000)


def _sensible() -> Setting:
    starts = {
        label: replace(SENSIBLE, start=start)
        for label, start in {
            "maxima of H, gaps filled by curvature": "cpda-filled",
            "maxima of H, gaps halved": "cpda-halved",
            "every (n/m)-th point": "every-nth",
            "equal arc length": "arc-length",
            "curvature density": "curvature",
            "one linear solve [46]": "uniform",
            "Park-Lee [41]": "park-lee",
            "balanced (several fits)": "balanced",
        }.items()
    }
    methods = ("levenberg-marquardt", "d-bfgs", "l-bfgs")
    return Setting("sensible", SENSIBLE, starts, "equal arc length", methods, 2000)


SETTINGS = (_published(), _sensible())


class Errors(NamedTuple):
    """E at the start and after the stages, rms and two-sided distance at the end."""

    start: float
    stages: tuple[float, ...]
    rms: float
    two_sided: float
    evaluations: int


class Compared(NamedTuple):
    """A setting and its errors by (method, start label, outline)."""

    setting: Setting
    errors: dict[tuple[str, str, str], Errors]

    def ratios(self, method: str, label: str, of: str) -> list[float]:
        """A quantity of a start relative to the reference, outline by outline."""
        found = []
        for name in dict.fromkeys(outline for _, _, outline in self.errors):
            here = self.errors[method, label, name]
            there = self.errors[method, self.setting.reference, name]
            found.append(_quantity(here, of) / _quantity(there, of))
        return found


def _quantity(errors: Errors, of: str) -> float:
    if of.isdigit():
        return errors.stages[STAGES.index(int(of))]
    return float(getattr(errors, of))


def compare(setting: Setting, outlines: dict[str, Contour]) -> Compared:
    """Run every start by every method on every outline, at the count that the reading takes."""
    errors = {}
    for name, contour in outlines.items():
        count = initial_curve(contour, LENGTH, reading=setting.reading).n_control_points
        for label, reading in setting.starts.items():
            reading = replace(reading, max_evaluations=setting.budget)
            start = initial_curve(contour, LENGTH, reading=reading, n_control_points=count)
            for method in setting.methods:
                errors[method, label, name] = _errors(contour, start, method)
    return Compared(setting, errors)


def _errors(contour: Contour, start: object, method: str) -> Errors:
    fit = optimize(contour, start, method)
    history = [record.paper_error for record in fit.history]
    stages = tuple(history[min(stage, len(history) - 1)] for stage in STAGES)
    return Errors(
        history[0], stages, fit.rms_distance, fit.hausdorff_distance, fit.history[-1].evaluations
    )


def table(compared: Compared) -> Table:
    """Geometric means with their scatter, relative to the reference start."""
    setting = compared.setting
    header = ("method", "start", "E_0", *(f"E after {stage}" for stage in STAGES), "rms, end")
    rows = [
        (
            f"`{method}`",
            label,
            *(
                mean_and_scatter(compared.ratios(method, label, of))
                for of in ("start", *map(str, STAGES), "rms", "two_sided")
            ),
        )
        for method in setting.methods
        for label in setting.starts
    ]
    return Table(f"starts-{setting.name}", (*header, "two-sided, end"), rows, words=2)


def single_runs(compared: Compared) -> Table:
    """Every run behind the means."""
    header = ("method", "start", "outline", "E_0", *(f"E_{stage}" for stage in STAGES))
    rows = [
        (
            method,
            label,
            outline,
            *(f"{value:.6g}" for value in (e.start, *e.stages, e.rms, e.two_sided)),
            e.evaluations,
        )
        for (method, label, outline), e in compared.errors.items()
    ]
    header = (*header, "rms", "two-sided", "evaluations")
    return Table(f"starts-{compared.setting.name}-runs", header, rows, words=3)


def better(compared: Compared, method: str, label: str, of: str) -> tuple[float, float, int, int]:
    """Mean ratio to the reference, its scatter, on how many outlines it is below 1, of how many."""
    ratios = compared.ratios(method, label, of)
    return *geometric(ratios), int(np.sum(np.array(ratios) < 1.0)), len(ratios)

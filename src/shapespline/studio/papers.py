"""Papers: the published method on one outline, step by step, for the page's film."""

from __future__ import annotations

from time import monotonic
from typing import TYPE_CHECKING, Any

import numpy as np

from shapespline.errors import InvalidInputError
from shapespline.fitting import optimize
from shapespline.paper import LITERAL, SENSIBLE, timed_start
from shapespline.studio.sketch import curve_cubics

if TYPE_CHECKING:
    from collections.abc import Mapping

    from shapespline.paper import InitialCurve, TimedStart
    from shapespline.studio.jobs import Ticket
    from shapespline.studio.sketch import Sketch
    from shapespline.typing import FloatArray
    from shapespline.values import Contour

METHODS = (
    "d-bfgs", "l-bfgs", "oss", "bfgs", "levenberg-marquardt", "gauss-newton", "pdm", "tdm", "sdm",
)  # fmt: skip
# Frames of a film, the first iterations the densest; a run ends after so many seconds.
FRAMES, RUN_SECONDS = 60, 20.0


def begun(said: Mapping[str, Any], contour: Contour) -> TimedStart:
    """The initial curve for a chord length and a reading that a page names."""
    reading = LITERAL if said.get("literal") else SENSIBLE
    length, degree = said.get("length", 8), said.get("degree", 3)
    count = said.get("n_control_points")
    return timed_start(contour, length, reading=reading, degree=degree, n_control_points=count)


def first_sketch(timed: TimedStart, contour: Contour, origin: FloatArray) -> Sketch:
    """H with its maxima, tangents and normals, and the initial curve."""
    from shapespline.studio.sketch import Sketch

    start = timed.start
    cpda, where = start.cpda, start.samples
    figures = {
        "length": cpda.length,
        "window": cpda.window,
        "floor": cpda.floor,
        "n_control_points": start.n_control_points,
        "error": timed.error,
        "seconds": timed.seconds,
        "closed": contour.closed,
        "methods": list(METHODS),
        "method": start.reading.method,
    }
    at = where.arc_length[: len(where)]
    arrays = {
        "h": np.column_stack([at, cpda.values]),
        "places": where.points - origin,
        "maxima": cpda.maxima,
        "stations": start.stations,
        "tangents": start.frames.tangents,
        "normals": start.frames.normals,
        "control": start.control_points - origin,
        "cubics": curve_cubics(start.spline) - origin,
    }
    return Sketch(figures, arrays)


def run(start: InitialCurve, contour: Contour, method: str, ticket: Ticket) -> Sketch:
    """One method from a start: its records, and a film of some of its curves."""
    from shapespline.studio.sketch import Sketch

    if method not in METHODS:
        raise InvalidInputError(f"method must be one of {', '.join(METHODS)}, got {method!r}")
    # The paper's literal reading names its own variant of the method.
    if method == "d-bfgs":
        method = start.reading.method
    began = monotonic()

    def ends(_: object) -> bool:
        ticket.check()
        return monotonic() - began > RUN_SECONDS

    fit = optimize(contour, start, method, callback=ends, snapshots=1)
    shown = fit.snapshots
    if len(shown) > FRAMES:
        at = np.unique(np.geomspace(1, len(shown), FRAMES).astype(int)) - 1
        shown = tuple(shown[i] for i in at)
    figures = {
        "method": method,
        "sentence": fit.status.value,
        "n_iterations": len(fit.history) - 1,
        "seconds": fit.history[-1].seconds,
        "error": fit.history[-1].paper_error,
        "hausdorff_distance": fit.hausdorff_distance,
        "iterations": [one.iteration for one in shown],
    }
    arrays = {
        "history": np.array([(one.iteration, one.paper_error, one.seconds) for one in fit.history]),
        "control": np.stack([one.spline.control_points for one in shown]),
        "cubics": np.stack([curve_cubics(one.spline) for one in shown]),
    }
    return Sketch(figures, arrays)

"""What a command says of a file that it worked on: for people, or for scripts."""

from __future__ import annotations

import json
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from shapespline.cli.places import unnamed_stream
from shapespline.cli.words import own_words

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline import Drawing, Fit
    from shapespline.fitting import Settings

# How the status of a fit begins for which no tolerance was asked.
UNASKED = "no tolerance asked for"


def say(message: object) -> None:
    """One line on standard error."""
    sentence = own_words(unnamed_stream(" ".join(str(message).split()))) or type(message).__name__
    print(f"shapespline: {sentence}", file=sys.stderr)


@dataclass
class Report:
    """The outcome of one input.

    ``text`` is for people; ``record`` holds the same for scripts; ``error`` is a sentence where
    the input failed, ``remarks`` what else its user should know; ``exceeded`` whether a curve
    keeps less than its tolerance.
    """

    source: str
    text: str = ""
    record: dict[str, Any] = field(default_factory=dict)
    remarks: list[str] = field(default_factory=list)
    error: str | None = None
    exceeded: bool = False

    def show(self, as_json: bool, named: bool, on_stderr: bool = False) -> None:
        """Print; ``named`` says which input an error or a remark concerns, where there are many."""
        stream = sys.stderr if on_stderr else sys.stdout
        if as_json:
            record = {"input": unnamed_stream(self.source), **self.record, "remarks": self.remarks}
            if self.error is not None:
                record["error"] = own_words(unnamed_stream(self.error))
            print(json.dumps(record, ensure_ascii=False), file=stream)
        elif self.text:
            print(unnamed_stream(self.text), file=stream)
        for message in [*self.remarks, *([self.error] if self.error is not None else [])]:
            known = Path(self.source).name in message
            name = f"{self.source}: " if named and not known else ""
            say(f"{name}{message}")


def drawing_record(drawing: Drawing) -> dict[str, Any]:
    """Figures of every curve of a drawing, for scripts."""
    return {"curves": [_fit_record(fit) for fit in drawing], "parents": list(drawing.parents)}


def _fit_record(fit: Fit) -> dict[str, Any]:
    return {
        "closed": fit.closed,
        "degree": fit.degree,
        "data_points": fit.contour.n_given,
        "control_points": fit.n_control_points,
        "stored_points": fit.n_stored_points,
        "pieces": len(fit.pieces),
        "corners": len(fit.corners),
        "max_distance": fit.max_distance,
        "rms_distance": fit.rms_distance,
        "hausdorff_distance": fit.hausdorff_distance,
        "source_distance": fit.source_distance,
        "tolerance": fit.tolerance,
        "kept": fit.kept,
        "status": fit.status.name,
        "sentence": fit.status.value,
        "outliers": len(fit.outliers),
    }


def drawing_text(output: str, drawing: Drawing, seconds: float, settings: Settings) -> str:
    """One line on what was written, and what was chosen where nothing else was asked for."""
    fits = drawing.fits
    points = sum(fit.n_stored_points for fit in fits)
    farthest = max(fit.hausdorff_distance for fit in fits)
    curves = "1 curve" if len(fits) == 1 else f"{len(fits)} curves"
    return (
        f"{output}: {curves}, {points} points{_chosen_text(fits, settings)}, data and curve within"
        f" {farthest:.4g} of each other{_level_text(fits)}, {seconds:.2f} s"
    )


def _chosen_text(fits: Sequence[Fit], settings: Settings) -> str:
    """Kinds of pieces of curves that were estimated, without a tolerance or a size."""
    estimated = all(fit.status.value.startswith(UNASKED) for fit in fits)
    if settings.n_control_points is not None or not estimated:
        return ""
    kinds = [piece.kind for fit in fits for piece in fit.pieces]
    counts = {kind: kinds.count(kind) for kind in ("line", "arc")}
    counts["spline"] = len(kinds) - sum(counts.values())
    said = [f"{n} {kind}{'s' if n > 1 else ''}" for kind, n in counts.items() if n]
    return f", estimated: {', '.join(said)}"


def _level_text(fits: Sequence[Fit]) -> str:
    """How far the curves are from the level lines of a picture, if that is what they come from."""
    found = [fit.source_distance for fit in fits]
    known = [distance for distance in found if distance is not None]
    return f" ({max(known):.4g} from the level line)" if known else ""


def drawing_remarks(drawing: Drawing) -> list[str]:
    """A line for every fit that keeps less than was asked, or was ended."""
    return [
        f"curve {index}: {fit.status.value}"
        for index, fit in enumerate(drawing)
        if fit.status.name != "KEPT"
    ]

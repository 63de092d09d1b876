"""Help in panels: what goes in, how it is fitted, what comes out; examples and exit codes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from typer.core import TyperCommand

if TYPE_CHECKING:
    from collections.abc import Sequence

INPUT, PICTURE, FIT, OUTPUT, RUN = "Input", "Pictures", "Fit", "Output", "Run"
PANELS = (INPUT, PICTURE, FIT, OUTPUT, RUN)
OTHERS = "Others"

UNITS = (
    "Lengths are in the unit of the data: pixels of a picture, or --unit.",
    "A tolerance of 0.1% is a part of the diagonal of the bounding box.",
)
EXIT_CODES = (
    "0  everything written, every tolerance kept",
    "1  an input could not be read, fitted or written",
    "2  wrong usage",
    "3  written, but a curve keeps less than its tolerance",
    "130  interrupted",
)


class PanelCommand(TyperCommand):
    """A command whose help shows its options in panels."""

    def format_options(self, ctx: Any, formatter: Any) -> None:
        """Write one section for each panel that has options."""
        rows: dict[str, list[tuple[str, str]]] = {}
        for parameter in self.get_params(ctx):
            record = parameter.get_help_record(ctx)
            if record is not None:
                panel = getattr(parameter, "rich_help_panel", None) or OTHERS
                rows.setdefault(panel, []).append(record)
        for panel in (*PANELS, OTHERS):
            if panel in rows:
                with formatter.section(panel):
                    formatter.write_dl(rows[panel])


def closing(examples: Sequence[str]) -> str:
    """The end of a help text: examples, units and exit codes, each on its own line."""
    parts = [("Examples:", examples), ("Units:", UNITS), ("Exit codes:", EXIT_CODES)]
    lines = [line for head, rows in parts for line in ("\b", head, *(f"  {r}" for r in rows), "")]
    return "\n".join(lines)

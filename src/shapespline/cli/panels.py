"""Help in panels: what goes in, how it is fitted, what comes out; examples and exit codes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

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


class PanelCommand(click.Command):
    """A command whose help shows its options in panels, and says what its arguments are.

    Parameters
    ----------
    panels : mapping
        Name of a parameter -> its panel.
    arguments : mapping
        Name of an argument -> how it is written, and its help.
    """

    def __init__(
        self,
        name: str,
        panels: Mapping[str, str],
        arguments: Mapping[str, tuple[str, str]],
        **more: Any,
    ) -> None:
        super().__init__(name, **more)
        self.panels, self.arguments = panels, arguments

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write one section for each panel that has options."""
        rows: dict[str, list[tuple[str, str]]] = {}
        for parameter in self.get_params(ctx):
            name = parameter.name or ""
            record = self.arguments.get(name) or parameter.get_help_record(ctx)
            if record is not None:
                rows.setdefault(self.panels.get(name, OTHERS), []).append(record)
        for panel in (*PANELS, OTHERS):
            if panel in rows:
                with formatter.section(panel):
                    formatter.write_dl(rows[panel])


def closing(examples: Sequence[str]) -> str:
    """The end of a help text: examples, units and exit codes, each on its own line."""
    parts = [("Examples:", examples), ("Units:", UNITS), ("Exit codes:", EXIT_CODES)]
    lines = [line for head, rows in parts for line in ("\b", head, *(f"  {r}" for r in rows), "")]
    return "\n".join(lines)

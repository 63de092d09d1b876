"""The published method, step by step."""

from shapespline.paper.initial import InitialCurve, initial_curve
from shapespline.paper.reading import LITERAL, SENSIBLE, Reading
from shapespline.paper.report import check_folder, write_report
from shapespline.paper.run import run_paper

__all__ = [
    "LITERAL",
    "SENSIBLE",
    "InitialCurve",
    "Reading",
    "check_folder",
    "initial_curve",
    "run_paper",
    "write_report",
]

"""The published method, step by step."""

from shapespline.paper.film import film
from shapespline.paper.initial import Frames, InitialCurve, initial_curve
from shapespline.paper.reading import LITERAL, SENSIBLE, Reading
from shapespline.paper.report import check_folder, write_report
from shapespline.paper.run import PaperRun, TimedStart, paper_error, run_paper, timed_start

__all__ = [
    "LITERAL",
    "SENSIBLE",
    "Frames",
    "InitialCurve",
    "PaperRun",
    "Reading",
    "TimedStart",
    "check_folder",
    "film",
    "initial_curve",
    "paper_error",
    "run_paper",
    "timed_start",
    "write_report",
]

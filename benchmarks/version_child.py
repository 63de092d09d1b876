"""Fits of one version of the package, whichever is installed: sizes and seconds of the processor.

    python -P benchmarks/version_child.py TASKS FOUND

What `benchmarks.versions` runs; it imports nothing of the project but the package itself.
"""

import json
import pickle
import sys
import time
import warnings
from pathlib import Path

import shapespline as ss

REPEATS = 3


def seconds_and_points(task):
    """The best of some runs, and the stored points; none where it is refused."""
    points, closed, path, options = task
    if path is not None:
        shape = ss.read(path)
        fits = lambda: list(ss.fit_shape(shape, **options))  # noqa: E731
    else:
        fits = lambda: [ss.fit_curve(points, closed=closed, **options)]  # noqa: E731
    best = float("inf")
    for _ in range(REPEATS):
        began = time.process_time()
        try:
            found = fits()
        except ss.ShapesplineError:
            return None
        best = min(best, time.process_time() - began)
    return best, sum(fit.n_stored_points for fit in found)


def main():
    """All tasks of a file, the answers into another."""
    warnings.simplefilter("ignore")
    tasks, answers = map(Path, sys.argv[1:])
    found = [seconds_and_points(task) for task in pickle.loads(tasks.read_bytes())]
    answers.write_text(json.dumps(found), encoding="utf-8")


if __name__ == "__main__":
    main()

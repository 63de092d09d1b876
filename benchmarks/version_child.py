"""Fits of one version of the package: sizes and seconds of the processor.

    python -P benchmarks/version_child.py TASKS FOUND [PACKAGES]

The version is the installed one, or the one in a folder of packages.

What `benchmarks.versions` runs; it imports nothing of the project but the package itself.
"""

import json
import pickle
import sys
import time
import warnings
from pathlib import Path

if len(sys.argv) > 3:
    # An editable installation finds its own package before any path does.
    sys.meta_path = [one for one in sys.meta_path if "Redirecting" not in type(one).__name__]
    sys.path.insert(0, sys.argv[3])

import shapespline as ss

if len(sys.argv) > 3 and not Path(ss.__file__).is_relative_to(sys.argv[3]):
    sys.exit(f"the package found is {ss.__file__}, none of {sys.argv[3]}")
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
    tasks, answers = map(Path, sys.argv[1:3])
    found = [seconds_and_points(task) for task in pickle.loads(tasks.read_bytes())]
    answers.write_text(json.dumps(found), encoding="utf-8")


if __name__ == "__main__":
    main()

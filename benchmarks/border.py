"""How often a fit crosses the border to the kernel: ``python -m benchmarks.border``.

Counted on a noisy estimate of 300 points: every call of a compiled function or method. Each is
wrapped while the modules that call it are told of the wrapper in place of the kernel.
"""

import sys
import time
from collections import Counter
from contextlib import contextmanager

import numpy as np

import shapespline
from shapespline import _kernels


class Counted:
    """The kernel, or an object of it, whose calls are counted by name."""

    def __init__(self, inner, calls):
        self._inner, self._calls = inner, calls

    def __getattr__(self, name):
        inner, calls = getattr(self._inner, name), self._calls
        if not callable(inner):
            return inner

        def call(*args, **kwargs):
            calls[name] += 1
            plain = (a._inner if isinstance(a, Counted) else a for a in args)
            found = inner(*plain, **kwargs)
            return Counted(found, calls) if name in ("LeastSquares", "RemovalSearch") else found

        return call


@contextmanager
def counted():
    """The calls of the kernel, by name, as long as this lasts."""
    calls = Counter()
    callers = [
        module
        for name, module in list(sys.modules.items())
        if name.startswith("shapespline.") and getattr(module, "_kernels", None) is _kernels
    ]
    for module in callers:
        module._kernels = Counted(_kernels, calls)
    try:
        yield calls
    finally:
        for module in callers:
            module._kernels = _kernels


def noisy_outline(n=300, noise=0.05):
    """A closed outline with five petals, radius 10."""
    angle = 2 * np.pi * np.arange(n) / n
    radius = 10 + 2 * np.cos(5 * angle)
    points = np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])
    return points + np.random.default_rng(7).normal(0, noise, (n, 2))


def main():
    """Print the calls by name, and the time of runs that are not counted."""
    points = noisy_outline()
    times = []
    for _ in range(6):  # the first one loads modules
        begin = time.perf_counter()
        fit = shapespline.fit_curve(points, closed=True)
        times.append(time.perf_counter() - begin)
    with counted() as calls:
        shapespline.fit_curve(points, closed=True)
    for name, count in calls.most_common():
        print(f"{count:8d} {name}")
    print(f"{calls.total():8d} crossings, {min(times):.3f} s, {fit.n_stored_points} stored points")


if __name__ == "__main__":
    main()

"""No outline of 2000 points takes long; a long search is heard of and ends when it is told to.

``python -m benchmarks.time_bounds`` prints the seconds. The bounds here are four times what is
promised: the machine does other things, too. What they catch is a search gone wild.
"""

from __future__ import annotations

import time
from itertools import pairwise

import pytest
from benchmarks.time_bounds import POINTS, SECONDS, hard_outlines, seconds_of

import shapespline as ss

pytestmark = pytest.mark.slow
OUTLINES = {name: (points, closed) for name, points, closed in hard_outlines(0)}


# Measured before there were bounds: 8.4, 6.8, 6.6 and 2.7 s.
@pytest.mark.parametrize(
    ("name", "tolerance"),
    [
        (f"scribble of {POINTS}", 0.02),
        (f"noisy ring of {POINTS}, 0.01", 0.005),
        (f"noisy ring of {POINTS}, 0.001", 0.0002),
        (f"walk of {POINTS}", 0.005),
    ],
)
def test_hard_outlines_take_seconds(name, tolerance):
    points, closed = OUTLINES[name]
    assert seconds_of(points, closed=closed, tolerance=tolerance)[0] < 4 * SECONDS


def test_a_long_search_is_heard_of_and_ends_at_its_limit():
    points, closed = OUTLINES[f"scribble of {POINTS}"]  # the slowest
    contour = ss.Contour(points, closed)
    tolerance, heard = 0.0002 * contour.box_diagonal, [time.monotonic()]
    ss.fit_curve(contour, tolerance=tolerance, callback=lambda _: heard.append(time.monotonic()))
    gaps = [after - before for before, after in pairwise(heard)]
    assert len(heard) > 1 + 5 * (heard[-1] - heard[0])
    assert max(gaps) < SECONDS  # asked every 50 ms inside the kernel, repairs in between
    began = time.monotonic()
    fit = ss.fit_curve(contour, tolerance=tolerance, time_limit=0.3)
    assert time.monotonic() - began < 0.3 + SECONDS
    assert "time limit" in fit.status.value
    assert fit.hausdorff_distance < 0.1 * contour.box_diagonal

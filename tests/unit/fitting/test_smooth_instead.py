"""What hinders a spline in the place of pieces does not hang on the direction of the data."""

from __future__ import annotations

import numpy as np
import pytest

import shapespline as ss
from shapespline.fitting import Request, Settings
from shapespline.fitting.problem import Problem
from shapespline.fitting.smooth_instead import _has_hooks
from shapespline.geometry import chords_for_hooks, hooks, reversed_curve

# A turn of 150 degrees within less than a tolerance, and back over more than five: which two of its
# three corners are named as the hook depends on the direction.
TURNS = np.radians([50.0, 50.0, 50.0] + 10 * [-15.0])
STEPS = [6.0, 0.3, 0.3] + 10 * [0.5] + [6.0]


def hooked():
    """The curve, and data that turn by 60 degrees 2.5 tolerances from where the hook is."""
    headings = np.concatenate([[0.0], np.cumsum(TURNS)])
    steps = np.array(STEPS)[:, None] * np.column_stack([np.cos(headings), np.sin(headings)])
    line = np.concatenate([[(0.0, 0.0)], np.cumsum(steps, axis=0)])
    knots = np.concatenate([[0.0], np.arange(len(line)), [len(line) - 1.0]])
    corner = 5.89 + 2.5  # the hook is at 5.84 read one way, at 5.95 the other
    data = np.array([(0.0, 0.0), (corner, 0.0), (corner + 5.0, 5.0 * np.sqrt(3.0))])
    return ss.BSplineCurve(knots, line, 1), data


@pytest.mark.filterwarnings("ignore:the points are sparse")
def test_a_hook_is_one_whichever_way_the_data_run():
    curve, data = hooked()
    # The case is one where the direction would matter.
    line = chords_for_hooks(curve, 1.0)
    there, back = (hooks(line[::way], data[::way], 1.0, closed=False).tolist() for way in (1, -1))
    assert bool(there) != bool(back)
    found = [
        _has_hooks(one, Problem(Request.of(points, False, Settings(tolerance=1.0))))
        for one, points in ((curve, data), (reversed_curve(curve), data[::-1]))
    ]
    assert found[0] == found[1]

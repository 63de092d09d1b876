"""The least squares that `python -m benchmarks.drawn` compares lines, arcs and corners with."""

import numpy as np
import pytest
from benchmarks.drawn.limits import errors, told
from benchmarks.drawn.shapes import box
from benchmarks.drawn.truth import sampled

import shapespline as ss


@pytest.fixture
def drawing():
    outline = box(100, 60, 15)
    return outline, ss.Contour(sampled(outline, 0.02), closed=True).resampled(400).points


def test_clean_points_leave_what_their_sampling_does(drawing):
    outline, clean = drawing
    lines, arcs, corners = errors(outline, told(outline, clean, clean))
    # Points on chords of 0.02 of circles of radius 15 are off by less than 4e-6.
    assert max(lines.max(), arcs.max()) < 1e-5
    assert not len(corners)


def test_errors_are_those_of_statistics(drawing):
    outline, clean = drawing
    deviation = 0.1
    found = []
    for seed in range(20):
        noise = np.random.default_rng(seed).normal(0, deviation, clean.shape)
        found.append(errors(outline, told(outline, clean + noise, clean))[0])
    # A line of n points leaves sqrt(2 / n) of their deviation at them, fewer where arcs that touch
    # it know more, up to a third; the mean of 80 is known to 8 %, of which three are allowed.
    n = 400 * np.array([30, 70]).mean() / (2 * 30 + 2 * 70 + 30 * np.pi)
    alone = deviation * (2 / n) ** 0.5
    assert 0.6 * alone < np.sqrt(np.mean(np.square(found))) < 1.25 * alone

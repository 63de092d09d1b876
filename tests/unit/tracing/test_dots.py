"""Dots and holes of a few pixels are circles and upright squares, as they were drawn."""

from __future__ import annotations

import numpy as np
import pytest
from tests.support.rendering import coverage, dark

import shapespline as ss

# Ink is counted by samples of a 32nd, one of which may lie within or without along a whole circle
# at the worst, and less by far as a rule.
READ = 1 / 32
RANDOM = np.random.default_rng(5)


def fitted(inside, size=40):
    return list(ss.fit_shape(ss.trace(dark(coverage(inside, size, size)))))


@pytest.mark.parametrize("radius", [1.0, 1.5, 2.0, 2.5])
@pytest.mark.parametrize("is_hole", [False, True])
def test_equal_dots_are_equal_circles(radius, is_hole):
    places = [(9 + 11 * i + a, 9 + 11 * j + b) for i in range(3) for j in range(3)
              for a, b in [RANDOM.uniform(0, 1, 2)]]  # fmt: skip

    def dots(x, y):
        ink = np.zeros(x.shape, dtype=bool)
        for px, py in places:
            ink |= np.hypot(x - px, y - py) <= radius
        return (np.abs(x - 20) < 17) & (np.abs(y - 20) < 17) & ~ink if is_hole else ink

    fits = fitted(dots)[int(is_hole) :]
    assert [[piece.kind for piece in fit.pieces] for fit in fits] == [["arc"]] * 9
    found = [fit.pieces[0].arc for fit in fits]
    np.testing.assert_allclose([arc.radius for arc in found], radius, atol=READ)
    for arc in found:
        assert min(np.abs(np.subtract(arc.centre, place)).max() for place in places) < READ


@pytest.mark.parametrize("side", [2.0, 2.5, 3.0, 4.0])
@pytest.mark.parametrize("place", [(20.0, 20.0), (20.25, 19.5)])
def test_small_squares_are_no_dots(side, place):
    def frame(x, y):
        square = np.maximum(np.abs(x - place[0]), np.abs(y - place[1]))
        return (square < 0.5 * side + 6) & (square > 0.5 * side)

    _outer, inner = fitted(frame)
    assert [piece.kind for piece in inner.pieces] == ["line"] * 4
    half = np.abs(np.array(inner.control_points) - place).max()
    assert half == pytest.approx(0.5 * side, abs=1 / 32)


def test_what_is_neither_stays_as_it_is_traced():
    (fit,) = fitted(lambda x, y: ((x - 20.2) / 2.6) ** 2 + ((y - 19.7) / 1.7) ** 2 <= 1)
    assert [piece.kind for piece in fit.pieces] not in (["arc"], ["line"] * 4)

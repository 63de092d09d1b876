"""The quick part of the attack: shapes and options drawn at random, judged from outside."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from benchmarks.attack.judge import FAULTS, judged
from benchmarks.attack.options import drawn_options
from benchmarks.attack.shapes import FAMILIES, Drawn, drawn
from hypothesis import given, settings
from hypothesis import strategies as st

import shapespline as ss

pytestmark = [
    pytest.mark.slow,  # some ten seconds of shapes drawn at random
    pytest.mark.filterwarnings(
        "ignore::shapespline.DroppedPointsWarning", "ignore::shapespline.ShuffledPointsWarning"
    ),
]


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("seed", [56, 7001, 7002])
def test_nothing_is_wrong(family, seed):
    shape = drawn(seed, family)
    rng = np.random.default_rng([seed, 2])
    options = drawn_options(rng, shape.points, shape.closed, cheap=True)
    assert not judged(shape, options) & set(FAULTS)


coordinates = st.one_of(st.integers(-3, 3).map(float), st.floats(-3, 3, width=32))


@given(
    points=st.lists(st.tuples(coordinates, coordinates), min_size=2, max_size=8),
    closed=st.booleans(),
    seed=st.integers(0, 1000),
)
@settings(max_examples=40)
def test_a_few_points_are_no_error(points, closed, seed):
    shape = Drawn("polyline", np.array(points), closed)
    if np.ptp(shape.points, axis=0).max() < 1e-6:
        return
    options = drawn_options(np.random.default_rng(seed), shape.points, closed, cheap=True)
    assert not judged(shape, options, thorough=False) & set(FAULTS)


def test_the_judge_sees_what_is_wrong(monkeypatch):
    shape = drawn(7, "fourier")
    tolerance = 0.005 * float(np.hypot(*np.ptp(shape.points, axis=0)))
    options = {"closed": True, "tolerance": tolerance, "effort": "fast"}
    assert not judged(shape, options) & set(FAULTS)
    fit = ss.fit_curve

    def refused(points, **given):
        raise ss.InvalidInputError("no")

    def by_no_index(points, **given):
        return fit(points, **{name: given[name] for name in options})

    def moved(points, **given):
        found = fit(points + 2 * tolerance, **given)
        return replace(found, contour=ss.Contour(points, True))

    def of_the_first_point(points, **given):
        return fit(points * (1 + 1e-3 * (points[0, 0] > 0.5)), **given)

    def from_its_end(points, **given):
        half = points[: len(points) // 2]
        return replace(fit(half[::-1], **given), contour=ss.Contour(half, False))

    for wrong, fault, more in (
        (refused, "error", {}),
        (from_its_end, "end", {"closed": False}),
        (by_no_index, "index", {"through": [3]}),
        (moved, "promise", {}),
        (of_the_first_point, "start", {}),
    ):
        monkeypatch.setattr(ss, "fit_curve", wrong)
        assert fault in judged(shape, options | more)

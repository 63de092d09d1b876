"""Lines and arcs of measured points that repeat nothing: told by their points alone."""

from __future__ import annotations

import numpy as np
import pytest
from benchmarks.drawn.few_points import fitted, is_outline
from benchmarks.drawn.random_plates import plate, points_of
from benchmarks.drawn.truth import sampled
from benchmarks.quality import own_corpus

import shapespline as ss


def measured(form: str, draw: int, count: int, noise: float):
    """An irregular plate, and points of it."""
    outline = plate(form, draw, regular=False)
    random = np.random.default_rng([draw, *form.encode()])
    return outline, points_of(sampled(outline, 0.02), count, noise, random)


@pytest.mark.parametrize("tolerance", [None, 0.003])
@pytest.mark.parametrize("form", ["T", "steps"])
def test_a_measured_plate_that_repeats_nothing_is_its_lines_and_arcs(form, tolerance):
    # Eight edges and eight unequal fillets, points of a few to an arc. Without regularities they
    # were Beziers, as those of larger noise were not.
    outline, points = measured(form, 0, 1000, 0.0002)
    assert is_outline(fitted(points, tolerance), outline)


@pytest.mark.parametrize("form", ["T", "U"])
def test_exact_points_of_one_hold_after_they_are_shared_anew(form):
    # Its lines and arcs were those that were read, but for points beside their nodes (DRA-65).
    outline, points = measured(form, 3, 1000, 0.0)
    assert is_outline(fitted(points, None), outline)


@pytest.mark.parametrize(("form", "draw", "count"), [("T", 0, 200), ("T", 2, 400), ("Z", 1, 400)])
def test_few_points_of_one_tell_it_without_a_tolerance(form, draw, count):
    outline, points = measured(form, draw, count, 0.0002)
    assert is_outline(fitted(points, None), outline)


def test_a_fillet_of_two_points_is_one_among_lines_and_arcs():
    # Its fourth fillet is as long as two steps; all was one spline.
    outline, points = measured("L", 3, 200, 0.0002)
    assert is_outline(fitted(points, None), outline)


@pytest.mark.parametrize(
    ("name", "seed"), [("leaf840_closed", 0), *(("fa_dove_c0", k) for k in range(5))]
)
def test_a_chain_of_lines_and_arcs_is_no_drawing(name, seed):
    # Of a dove in noise nine arcs and eight lines leave little more than a spline of more numbers.
    (outline,) = (one.contour for one in own_corpus() if one.name == name)
    even = outline.resampled(1000)
    noise = np.random.default_rng(seed).normal(0, 0.001 * even.box_diagonal, even.points.shape)
    fit = ss.fit_curve(even.points + noise, closed=True, tolerance=0.006 * even.box_diagonal)
    assert fit.kept
    assert not any(piece.kind == "arc" for piece in fit.pieces)

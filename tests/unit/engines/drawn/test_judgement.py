"""What speaks for lines and arcs as what was drawn."""

from __future__ import annotations

import numpy as np
import pytest
from benchmarks.drawn import random_plates
from benchmarks.drawn.random_plates import plate
from benchmarks.drawn.truth import sampled
from benchmarks.quality import own_corpus

from shapespline import Contour, fit_curve
from shapespline.engines.drawn import DrawnArc, DrawnLine, as_drawn


def points_of(form: str, draw: int, n: int) -> np.ndarray:
    """Exact points of a plate with eight edges and fillets, no two alike."""
    dense = sampled(plate(form, draw, regular=False), 0.02)
    return random_plates.points_of(dense, n, 0.0, np.random.default_rng(0))


def kinds(pieces) -> tuple[int, int, int]:
    names = [piece.kind for piece in pieces]
    return names.count("line"), names.count("arc"), len(names)


@pytest.mark.parametrize("form", ["T", "U"])
@pytest.mark.parametrize("tolerance", [None, 0.1, 0.4])
def test_exact_points_of_edges_and_fillets_that_repeat_nothing_are_these(form, tolerance):
    # Sixteen elements, each tangent to the next and like no other: Beziers before, chamfers within
    # 0.4.
    points = points_of(form, 0, 1000)
    fit = fit_curve(points, closed=True, tolerance=tolerance)
    assert kinds(fit.pieces) == (8, 8, 16)
    own = sorted(one.radius for one in plate(form, 0, regular=False) if hasattr(one, "radius"))
    radii = sorted(piece.arc.radius for piece in fit.pieces if piece.arc is not None)
    # Exact to the fifth digit of a box of 100; a radius is seen through the sagitta of its arc, a
    # few times less exactly.
    np.testing.assert_allclose(radii, own, atol=0.02)


@pytest.mark.parametrize(("form", "draw"), [("T", 3), ("U", 5), ("Z", 0)])
def test_few_exact_points_of_an_arc_are_exact_enough(form, draw):
    # At 300 points an arc has five: with those beside its nodes it was no arc to the fifth digit.
    found = as_drawn(Contour(points_of(form, draw, 300), closed=True))
    assert found is not None
    assert found.is_told
    parts = [type(part) for part in found.parts]
    assert (parts.count(DrawnLine), parts.count(DrawnArc), len(parts)) == (8, 8, 16)


@pytest.mark.parametrize("name", ["leaf840_closed", "hand620_closed", "fa_dove_c0"])
def test_exact_points_of_curves_are_no_lines_and_arcs(name):
    contour = next(outline.contour for outline in own_corpus() if outline.name == name)
    found = as_drawn(contour)
    assert found is None or found.has_runs or not found.is_told or found.share < 1.0


def test_edges_alone_within_a_tolerance_are_compared_with_curves():
    # Corners lie between points: cut off as told they took eight lines and six.
    corners = np.array([[0.0, 0.0], [90.0, 7.0], [71.0, 52.0], [-8.0, 33.0]])
    sides = zip(corners, np.roll(corners, -1, axis=0), strict=True)
    dense = np.concatenate([np.linspace(a, b, 4000, endpoint=False) for a, b in sides])
    dense = np.roll(dense, 500, axis=0)
    for n in (250, 400):
        points = Contour(dense, closed=True).resampled(n).points
        fit = fit_curve(points, closed=True, tolerance=0.1)
        assert [piece.kind for piece in fit.pieces] == ["line"] * 4


def test_what_noise_allows_does_not_speak_for_a_drawing():
    # A leaf among much noise: elements of a few points that may be level, parallel and tangent.
    contour = next(one.contour for one in own_corpus() if one.name == "fa_leaf_c0")
    points = contour.resampled(400).points
    noise = np.random.default_rng(4).normal(0, 0.006 * contour.box_diagonal, points.shape)
    fit = fit_curve(Contour(points + noise, closed=True))
    assert [piece.kind for piece in fit.pieces] == ["spline"]


def test_arcs_that_meet_edges_at_some_degrees_are_no_exact_ones():
    # The nose of an aeroplane: two arcs eight times less exactly than its points, that meet an edge
    # at five degrees.
    contour = next(one.contour for one in own_corpus() if one.name == "mdi_airplane_c0")
    for tolerance in (None, 0.001 * contour.box_diagonal):
        fit = fit_curve(contour, tolerance=tolerance)
        assert "arc" not in [piece.kind for piece in fit.pieces]


def test_what_nearly_holds_is_a_second_reading():
    # With all that noise allows, two nearly parallel edges meet too far from a point.
    contour = next(one.contour for one in own_corpus() if one.name == "plane1100_closed")
    points = contour.resampled(400).points
    noise = np.random.default_rng(4).normal(0, 0.001 * contour.box_diagonal, points.shape)
    fit = fit_curve(Contour(points + noise, closed=True))
    assert [piece.kind for piece in fit.pieces] == ["line"] * 30

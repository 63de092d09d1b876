"""The initial curve: both readings on shapes made by hand, every field, invariances, errors."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from tests.support.reference import EPS
from tests.support.shapes import flower, moved, on_circle, rectangle, wave

from shapespline.analysis.cpda import accumulate
from shapespline.errors import DegenerateContourError, InvalidInputError
from shapespline.geometry.parametrization import PARAMETRIZATIONS, parametrize
from shapespline.paper.initial import CHORD_STEPS, initial_curve
from shapespline.paper.reading import LITERAL, SENSIBLE, Reading
from shapespline.values.contour import Contour
from shapespline.values.knots import clamped_knots, greville_abscissae, periodic_knots

degrees = pytest.mark.parametrize("degree", range(1, 10))
# Petals and the bends between them at every 24th point, steps equal to 1 in 1000: not resampled.
EVEN = flower(2400).resampled(240)
MAXIMA = replace(SENSIBLE, start="cpda-maxima")


def consistent(start, contour, degree, periodic):
    """What holds for every initial curve."""
    assert start.spline.degree == degree
    assert start.spline.periodic is periodic
    m = start.n_control_points
    assert_array_equal(
        start.spline.knots, (periodic_knots if periodic else clamped_knots)(m, degree)
    )
    assert len(start.stations) == len(start.dominant) == m - (0 if periodic else 2)
    assert len(start.frames.tangents) == len(start.frames.normals) == len(start.stations)
    assert (np.diff(start.stations) > 0).all()
    again = contour.closed and not periodic and start.reading.closing_point
    assert start.parameters.shape == (len(contour) + again,)
    assert (np.diff(start.parameters) >= 0).all()
    assert np.isfinite(start.control_points).all()
    if not periodic:
        assert_array_equal(start.control_points[[0, -1]], contour.points[[0, 0 if again else -1]])
        assert start.parameters[[0, -1]].tolist() == [0, 1]
    else:
        assert start.parameters[-1] <= start.parameters[0] + 1


# --- the sensible reading ----------------------------------------------------------------------


def test_a_flower_has_a_control_point_on_every_bend():
    contour = EVEN
    start = initial_curve(contour, length=8, reading=MAXIMA)
    consistent(start, contour, 3, True)
    assert start.dominant.tolist() == list(range(0, 240, 24))
    assert start.samples is contour
    assert start.cpda.length == 8


def test_a_rectangle_has_its_corners():
    contour = rectangle(40, 20)
    start = initial_curve(contour, length=6, reading=MAXIMA)
    assert start.dominant.tolist() == [0, 40, 60, 100]
    # The difference offset pushes every corner outwards by (p + 1)/24 of the second difference.
    around = np.array([[0, 0], [40, 0], [40, 20], [0, 20]], dtype=float)
    bend = np.roll(around, 1, axis=0) - 2 * around + np.roll(around, -1, axis=0)
    assert np.abs(start.control_points - (around - bend / 6)).max() <= 8 * EPS * 40


def test_open_data():
    contour = wave()
    start = initial_curve(contour, length=8, reading=MAXIMA)
    consistent(start, contour, 3, False)
    assert 2 <= len(start.dominant) <= 8


@degrees
@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("reading", [SENSIBLE, LITERAL], ids=["sensible", "literal"])
def test_degrees(degree, closed, reading):
    contour = Contour(flower(240, petals=9).points, closed)
    start = initial_curve(contour, length=4, degree=degree, reading=reading)
    consistent(start, contour, degree, closed and not reading.clamped)


@degrees
def test_a_circle_without_maxima_still_has_a_curve(degree):
    contour = Contour(on_circle(64, 4.0), True)
    start = initial_curve(contour, length=8, degree=degree)
    consistent(start, contour, degree, True)
    assert start.n_control_points == degree + 1
    line = Contour(np.column_stack([np.arange(30.0), np.arange(30.0)]), closed=False)
    start = initial_curve(line, length=8, degree=degree)
    consistent(start, line, degree, False)
    assert start.n_control_points == degree + 1


def test_the_number_of_samples_matters_little_with_an_arc_length():
    # The same outline at 300 to 3000 points: the chord is as long, so the bends are the same.
    found = [initial_curve(flower(n), arc_length=4.0, reading=MAXIMA) for n in (300, 1000, 3000)]
    assert [start.n_control_points for start in found] == [10, 10, 10]
    for start in found:
        step = start.samples.length / len(start.samples)
        # The number of samples is rounded: half a sample in all of them.
        assert start.cpda.length * step == pytest.approx(4.0, rel=1 / len(start.samples))


def test_a_coarse_outline_is_resampled_for_the_chord():
    contour = rectangle(2, 1, spacing=10.0)
    start = initial_curve(contour, arc_length=8.0, reading=MAXIMA)
    assert start.cpda.length == CHORD_STEPS
    assert len(start.samples) == 60 * CHORD_STEPS / 8
    assert start.dominant.tolist() == [0, 2, 3, 5]


def test_uneven_points_are_resampled():
    t = np.linspace(0, 1, 240, endpoint=False)
    t = t + 0.1 * np.sin(2 * np.pi * t)
    r = 10 + 2 * np.cos(10 * np.pi * t)
    angle = 2 * np.pi * t
    contour = Contour(np.column_stack([r * np.cos(angle), r * np.sin(angle)]), True)
    start = initial_curve(contour, length=8, reading=MAXIMA)
    steps = np.diff(start.samples.arc_length)
    assert len(start.samples) == 240
    assert steps.max() / steps.min() < 1.1
    assert start.n_control_points == 10
    raw = initial_curve(contour, length=8, reading=replace(SENSIBLE, resampled=False))
    assert raw.samples is contour


@pytest.mark.parametrize("closed", [True, False])
def test_similarity_transforms_commute(closed):
    contour = Contour(flower(200, petals=7).points, closed)
    start = initial_curve(contour, length=7)
    angle, scale, shift = 0.6, 3.5, (20.0, -30.0)
    other = Contour(moved(contour.points, angle, scale, shift), closed)
    found = initial_curve(other, length=7)
    assert_array_equal(found.dominant, start.dominant)
    # Control points are the dominant points and second differences of them: a few roundings of
    # coordinates up to 100.
    expected = moved(start.control_points, angle, scale, shift)
    assert np.abs(found.control_points - expected).max() <= 16 * EPS * 100
    # Arc lengths: 200 sums of steps rounded at coordinates of 100 over steps of 1.
    assert np.abs(found.parameters - start.parameters).max() <= 200 * 100 * EPS


@pytest.mark.parametrize("shift", [1, 24, 100])
def test_the_start_point_of_closed_data_does_not_matter(shift):
    contour = EVEN
    start = initial_curve(contour, length=8)
    other = initial_curve(Contour(np.roll(contour.points, shift, axis=0), True), length=8)
    found = np.sort((other.dominant - shift) % 240)
    assert_array_equal(found, np.sort(start.dominant))
    order = np.argsort((other.dominant - shift) % 240)
    assert np.abs(other.control_points[order] - start.control_points).max() <= 64 * EPS * 12


def test_reversed_data_give_the_same_curve():
    contour = EVEN
    start = initial_curve(contour, length=8)
    other = initial_curve(Contour(contour.points[::-1], True), length=8)
    assert_array_equal(np.sort(239 - other.dominant), start.dominant)


def test_semi_closed_data_keep_their_corner_at_the_seam():
    # A half disc: from the upper end of its diameter round, and up the diameter again.
    arc = on_circle(200, 5.0)[50:151]
    line = np.column_stack([np.zeros(64), np.linspace(-5, 5, 64)])
    points = np.concatenate([arc, line[1:]])
    points[[0, 100, -1]] = [[0, 5], [0, -5], [0, 5]]
    contour = Contour(points, closed=False)
    assert contour.semi_closed
    start = initial_curve(contour, length=8)
    consistent(start, contour, 3, False)
    ends = start.spline([0.0, 1.0])
    assert np.abs(ends[0] - ends[1]).max() <= 8 * EPS * 9
    tangents = start.spline([0.0, 1.0], derivative=1)
    cosine = tangents[0] @ tangents[1] / np.prod(np.hypot(*tangents.T))
    assert cosine < 0.7  # a right angle, cut a little by the first control points


# --- the literal reading -----------------------------------------------------------------------


def test_the_literal_reading_is_the_papers():
    contour = flower(240)
    start = initial_curve(contour, length=8, reading=LITERAL)
    consistent(start, contour, 3, False)
    assert_array_equal(start.parameters, np.arange(241) / 240)
    assert start.samples is contour
    assert (start.cpda.window, start.cpda.floor) == (5, 0)
    _, unsigned = accumulate(contour, 8)
    assert_array_equal(start.cpda.raw, unsigned)
    # P_r = Q_r - (max H) H_r N_r with differences of neighbours for T and N.
    h, r = start.cpda.values, start.stations
    expected = contour.points[r] - h.max() * h[r][:, None] * start.frames.normals
    assert_array_equal(start.control_points[1:-1], expected)
    tangents = np.roll(contour.points, -1, axis=0) - np.roll(contour.points, 1, axis=0)
    tangents /= np.hypot(*tangents.T)[:, None]
    assert np.abs(start.frames.tangents - tangents[r]).max() <= 8 * EPS
    bends = np.roll(tangents, -1, axis=0) - np.roll(tangents, 1, axis=0)
    bends /= np.hypot(*bends.T)[:, None]
    # Tangents turn by 1/40 at a step: normalising their difference amplifies rounding as much.
    assert np.abs(start.frames.normals - bends[r]).max() <= 8 * EPS * 200


def test_the_literal_reading_takes_every_maximum():
    noisy = flower(240).points + np.random.default_rng(2).normal(0, 0.02, (240, 2))
    contour = Contour(noisy, True)
    literal = initial_curve(contour, length=4, reading=LITERAL)
    sensible = initial_curve(contour, length=4)
    assert literal.n_control_points > 1.5 * sensible.n_control_points


# --- every field of a reading ------------------------------------------------------------------


def with_field(**fields):
    return initial_curve(EVEN, length=8, reading=replace(MAXIMA, **fields))


def test_unsigned():
    assert_array_equal(with_field(signed=False).cpda.raw, accumulate(EVEN, 8)[1])


def test_window():
    assert with_field(window=9).cpda.window == 9
    assert with_field().cpda.window == 5


def test_prominence():
    # Tips and the bends between them differ in height: a high bar leaves the higher five.
    assert with_field(prominence=0.02).n_control_points == 10
    values = with_field().cpda.values
    low, high = sorted([values[0], values[24]])
    higher = 0 if values[0] == high else 24
    bar = float((0.5 * (low + high) - values.min()) / values.max())
    expected = [higher, *range(higher + 48, 240, 48)]
    assert with_field(prominence=bar).dominant.tolist() == expected


def test_offsets():
    contour = EVEN
    found = {
        kind: with_field(offset=kind)
        for kind in ("difference", "curvature", "cpda", "squared", "none")
    }
    on_data = contour.points[found["none"].dominant]
    assert_array_equal(found["none"].control_points, on_data)
    cpda, normals = found["cpda"].cpda, found["cpda"].frames.normals
    at = found["cpda"].stations
    h = cpda.values[at][:, None]
    assert_array_equal(found["cpda"].control_points, on_data - h * normals)
    assert_array_equal(found["squared"].control_points, on_data - cpda.values.max() * h * normals)
    bend = np.roll(on_data, 1, axis=0) - 2 * on_data + np.roll(on_data, -1, axis=0)
    assert np.abs(found["difference"].control_points - (on_data - bend / 6)).max() <= 16 * EPS * 12
    # (p + 1)/24 k h^2, never more than a quarter of the spacing, against the normal.
    spacing = contour.length / 10
    k = np.abs(cpda.curvature(contour.length / 240)[at])
    distance = np.minimum(k * spacing**2 / 6, 0.25 * spacing)[:, None]
    gap = found["curvature"].control_points - (on_data - distance * normals)
    assert np.abs(gap).max() <= 240 * EPS * 70 * 4
    outwards = found["curvature"].control_points - on_data
    tips = np.arange(0, 10, 2)
    assert ((outwards * on_data).sum(axis=1)[tips] > 0).all()
    for kind in ("cpda", "squared"):
        assert (((found[kind].control_points - on_data) * on_data).sum(axis=1)[tips] > 0).all()


@pytest.mark.parametrize("kind", PARAMETRIZATIONS)
@pytest.mark.parametrize("closed", [True, False])
def test_parametrizations(kind, closed):
    contour = Contour(flower(240).points, closed)
    start = initial_curve(contour, length=8, reading=replace(SENSIBLE, parametrization=kind))
    consistent(start, contour, 3, closed)
    expected = parametrize(contour, kind)
    slack = 4 * EPS
    assert np.abs(np.diff(start.parameters) - np.diff(expected)).max() <= slack
    if closed:  # the first control point's abscissa at its own point
        at = start.parameters[start.dominant[0]]
        assert at == pytest.approx(start.spline.greville[0], abs=slack)


def test_greville_parameters():
    start = with_field()
    abscissae = greville_abscissae(start.spline.knots, 3)[:10]
    assert np.abs(start.parameters[start.dominant] - abscissae).max() <= 4 * EPS


def test_clamped():
    contour = EVEN
    start = with_field(clamped=True)
    consistent(start, contour, 3, False)
    uniform = with_field(clamped=True, parametrization="uniform")
    assert_array_equal(uniform.parameters, np.arange(241) / 240)


def test_bad_readings():
    with pytest.raises(InvalidInputError, match=r"offset must be one of difference, .* got 'nor'"):
        Reading(offset="nor")
    with pytest.raises(
        InvalidInputError, match=r"parametrization must be one of greville, .*'foley'"
    ):
        Reading(parametrization="foley")


@pytest.mark.parametrize("fields", [{"window": 4}, {"window": 0}, {"window": -3}])
def test_a_window_that_is_not_odd(fields):
    with pytest.raises(InvalidInputError, match="window"):
        initial_curve(flower(), reading=replace(SENSIBLE, **fields))


# --- errors ------------------------------------------------------------------------------------


def test_too_few_points():
    contour = Contour(on_circle(3), True)
    with pytest.raises(
        DegenerateContourError,
        match=r"at least degree \+ 1 = 4 points, got 3; add points or lower the degree",
    ):
        initial_curve(contour, length=2)
    with pytest.raises(InvalidInputError, match="length must be at most 2 for 4 points, got 8"):
        initial_curve(Contour(on_circle(4), True))
    for degree in range(1, 10):
        for closed in (True, False):
            fewest = Contour(on_circle(max(degree + 1, 4), 3.0), closed)
            start = initial_curve(fewest, length=2, degree=degree)
            consistent(start, fewest, degree, closed)


@pytest.mark.parametrize("degree", [0, 10, 2.5])
def test_bad_degree(degree):
    with pytest.raises(InvalidInputError, match="degree must be an integer from 1 to 9"):
        initial_curve(flower(), degree=degree)


def test_lengths():
    with pytest.raises(InvalidInputError, match="give one of them"):
        initial_curve(flower(), 8, arc_length=4.0)
    for bad in (0, -1, 1e6, np.nan):
        with pytest.raises(InvalidInputError, match=r"arc_length must be positive and below half"):
            initial_curve(flower(), arc_length=bad)
    with pytest.raises(InvalidInputError, match="length must be a whole number"):
        initial_curve(flower(), 1)


def test_the_literal_reading_needs_maxima():
    line = Contour(np.column_stack([np.arange(30.0), np.zeros(30)]), closed=False)
    with pytest.raises(
        DegenerateContourError,
        match=r"length 8 finds 0 maxima, at least 2 are needed; shorten the length",
    ):
        initial_curve(line, reading=LITERAL)


# --- real shapes -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "name",
    ["leaf840_closed", "hand620_closed", "plane1100_closed", "loop500_open", "naca2412_open"],
)
def test_the_start_is_near_the_data(outline, name):
    contour = outline(name.replace("naca2412_open", "naca2412"))
    start = initial_curve(contour, length=5)
    off = np.hypot(*(start.spline(start.parameters) - contour.points).T)
    # A control point for every bend: the start is somewhere near, not somewhere else.
    assert np.sqrt(np.mean(off**2)) < 0.05 * contour.box_diagonal

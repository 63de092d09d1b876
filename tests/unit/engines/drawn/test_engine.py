"""Lines, arcs and regularities out of points of known drawings."""

from itertools import pairwise

import numpy as np
import pytest

from shapespline import _kernels
from shapespline.engines.drawn import NAMES, DrawnArc, DrawnLine, FreeRun, as_drawn
from shapespline.engines.drawn.ends import at_corners
from shapespline.engines.drawn.model import Model
from shapespline.engines.drawn.observed import Observed
from shapespline.engines.drawn.segments import FREE, LINE, Segment, Segments, segmented
from shapespline.values import Contour


def arc(centre, radius, begin, sweep, n):
    angle = np.radians(begin + sweep * np.arange(n) / n)
    return np.asarray(centre) + radius * np.column_stack([np.cos(angle), np.sin(angle)])


def side(a, b, n):
    return np.asarray(a) + np.arange(n)[:, None] / n * (np.asarray(b) - np.asarray(a, dtype=float))


def slot(n=60):
    """Two sides of length 40 and two half circles of radius 8."""
    return np.concatenate(
        [
            side((-20, -8), (20, -8), n),
            arc((20, 0), 8, -90, 180, n // 2),
            side((20, 8), (-20, 8), n),
            arc((-20, 0), 8, 90, 180, n // 2),
        ]
    )


def turned(points, degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return points @ np.array([[c, s], [-s, c]])


def kinds(found):
    letters = {DrawnLine: "L", DrawnArc: "A", FreeRun: "C"}
    return "".join(letters[type(part)] for part in found.parts)


def names(found):
    return {one.name for one in found.regularities}


@pytest.mark.parametrize("degrees", [0.0, 30.7])
def test_a_slot_is_two_lines_and_two_arcs(degrees):
    found = as_drawn(Contour(turned(slot(), degrees), closed=True))
    assert sorted(kinds(found)) == list("AALL")
    arcs = [part.arc for part in found.parts if isinstance(part, DrawnArc)]
    lines = [part for part in found.parts if isinstance(part, DrawnLine)]
    # The data are exact: what is left is rounding of coordinates of some tens.
    assert np.allclose([one.radius for one in arcs], 8, atol=1e-9)
    assert np.allclose([abs(one.sweep) for one in arcs], np.pi, atol=1e-9)
    assert np.allclose([np.hypot(*(one.end - one.begin)) for one in lines], 40, atol=1e-9)
    assert {"tangent", "equal-radius"} <= names(found)


def test_noise_keeps_the_structure_and_its_edges_exactly_level():
    shaken = slot() + np.random.default_rng(1).normal(0, 0.02, (180, 2))
    found = as_drawn(Contour(shaken, closed=True))
    assert sorted(kinds(found)) == list("AALL")
    lines = [part for part in found.parts if isinstance(part, DrawnLine)]
    assert all(one.begin[1] == one.end[1] for one in lines)
    arcs = [part.arc for part in found.parts if isinstance(part, DrawnArc)]
    # Least squares over 30 points of a half circle: its standard error is below a third of a
    # point's, four of them.
    assert np.allclose([one.radius for one in arcs], 8, atol=4 * 0.02 / 3)
    assert arcs[0].radius == pytest.approx(arcs[1].radius, abs=1e-9)


def test_regularities_are_switched():
    shaken = Contour(slot() + np.random.default_rng(1).normal(0, 0.02, (180, 2)), closed=True)
    assert names(as_drawn(shaken, regularities=("axis-parallel",))) == {"axis-parallel"}
    free = as_drawn(shaken, regularities=())
    assert not free.regularities
    lines = [part for part in free.parts if isinstance(part, DrawnLine)]
    assert any(one.begin[1] != one.end[1] for one in lines)
    assert names(as_drawn(shaken)) <= set(NAMES)


def test_a_circle_is_one_arc_and_a_pebble_none():
    circle = as_drawn(Contour(arc((3, 4), 5, 0, 360, 100), closed=True))
    (whole,) = circle.parts
    assert whole.arc.radius == pytest.approx(5, abs=1e-9)
    assert abs(whole.arc.sweep) == 2 * np.pi
    t = np.linspace(0, 2 * np.pi, 400, endpoint=False)
    r = 35 + 8 * np.cos(2 * t + 0.4) + 5 * np.sin(3 * t) + 2.5 * np.cos(5 * t + 1)
    pebble = np.column_stack([r * np.cos(t), r * np.sin(t)])
    assert as_drawn(Contour(pebble, closed=True)) is None
    assert as_drawn(Contour(pebble[:10], closed=True)) is None  # too few to tell


def stepped(corners, step=1.0):
    """Points of a polygon as a picture has them, about a pixel apart."""
    return np.concatenate(
        [
            side(a, b, max(int(np.hypot(*(b - a)) / step), 1))
            for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True)
        ]
    )


def test_a_picture_that_was_drawn_with_polygons_for_arcs_has_arcs():
    """Some renderers draw curves as chords, here 0.15 pixels off: as exact as they are, many."""
    ends = [arc((x, 0), 40, begin, 180, 18) for x, begin in ((60, -90), (-60, 90))]
    corners = np.concatenate([ends[0], [(60, 40)], ends[1], [(-60, -40)]])
    assert 40 * (1 - np.cos(np.radians(5))) == pytest.approx(0.15, abs=0.005)
    contour = Contour(stepped(corners), closed=True)
    found = as_drawn(contour, 0.02)
    assert sorted(kinds(found)) == list("AALL")
    radii = [part.arc.radius for part in found.parts if isinstance(part, DrawnArc)]
    assert np.allclose(radii, 40, atol=0.15)
    # A tolerance that leaves no room for that takes the picture at its word.
    tight = as_drawn(contour, 0.02, tolerance=0.1)
    sides = [part for part in tight.parts if isinstance(part, DrawnLine)]
    assert len(sides) == 2  # its level sides, the chords are curves
    assert not any(isinstance(part, DrawnArc) for part in tight.parts)


@pytest.mark.parametrize(("chords", "up"), [(14, 0.0), (16, 0.1), (18, 0.06)])
def test_chords_that_end_on_quarters_of_rows_are_arcs_between_level_edges(chords, up):
    """So Chromium draws: what it rounds misses by more than independent errors would."""
    ends = [arc((x, up), 36, begin, 180, chords) for x, begin in ((70, -90), (-70, 90))]
    corners = np.concatenate([ends[0], [(70, 36 + up)], ends[1], [(-70, -36 + up)]])
    corners[:, 1] = np.round(4 * corners[:, 1]) / 4
    found = as_drawn(Contour(stepped(corners), closed=True), 0.02)
    assert sorted(kinds(found)) == list("AALL")


def test_a_picture_of_a_polygon_whose_corners_show_stays_one():
    corners = arc((0, 0), 60, 0, 360, 12)
    found = as_drawn(Contour(stepped(corners), closed=True), 0.02)
    assert kinds(found) == 12 * "L"


def test_flat_arcs_beside_corners_are_told_from_lines():
    """Tips and roots of a gear are a fifth of a pixel higher than their chords."""
    rows = []
    for k in range(24):
        for radius, begin in ((107.5, 15 * k), (90.3, 15 * k + 7.5)):
            rows.append(arc((0, 0), radius, begin + 0.5, 6.5, 12))
            a = arc((0, 0), radius, begin + 7.0, 1, 1)[0]
            b = arc((0, 0), 197.8 - radius, begin + 8.0, 1, 1)[0]
            rows.append(side(a, b, 17))
    found = as_drawn(Contour(np.concatenate(rows), closed=True), 0.02)
    assert sorted(kinds(found)) == sorted(48 * "AL")


def test_an_open_row_ends_where_it_does():
    row = np.concatenate([side((0, 0), (30, 0), 40), arc((30, 10), 10, -90, 90, 30), [[40, 10]]])
    found = as_drawn(Contour(row, closed=False))
    assert kinds(found) == "LA"
    assert np.allclose(found.parts[0].begin, 0, atol=1e-9)
    assert np.allclose(found.parts[1].end, (40, 10), atol=1e-9)


def test_a_star_turns_and_is_mirrored():
    corner = np.pi * np.arange(10) / 5 + 0.1
    radius = np.where(np.arange(10) % 2, 20, 45)
    tips = np.column_stack([radius * np.cos(corner), radius * np.sin(corner)])
    points = np.concatenate(
        [side(a, b, 25) for a, b in zip(tips, np.roll(tips, -1, 0), strict=True)]
    )
    shaken = points + np.random.default_rng(2).normal(0, 0.05, points.shape)
    found = as_drawn(Contour(shaken, closed=True))
    assert kinds(found) == 10 * "L"
    assert ("rotation", 5) in {(one.name, one.order) for one in found.regularities}
    nodes = np.array([part.begin for part in found.parts])
    away = np.hypot(*(nodes - nodes.mean(axis=0)).T)
    # Equal to rounding, which equations that are solved to 1e-11 of the extent leave.
    assert max(np.ptp(away[::2]), np.ptp(away[1::2])) < 1e-8


def test_equations_are_met_and_the_rest_is_least_squares():
    shaken = Contour(slot() + np.random.default_rng(1).normal(0, 0.02, (180, 2)), closed=True)
    seen = Observed.of(shaken, None)
    model = Model.of(seen, segmented(seen))
    line = next(k for k in model.at if k not in model.ways)
    circle = next(iter(model.ways))
    model.constraints.append(
        _kernels.LineTouches(model.at[line], model.at[circle], model.ways[circle])
    )
    model.solve()
    assert model.meets_constraints(1e-10)
    assert model.n_free == len(model.x) - 1
    # Along the equation nothing is left to gain: half of chi squared has no slope there but what
    # differences of it have, h^2 times a third derivative, and rounding over h.
    h = 1e-4
    slope, touch = np.empty(len(model.x)), np.empty(len(model.x))
    for i, step in enumerate(h * np.eye(len(model.x))):
        there, here = model.x + step, model.x - step
        slope[i] = (half_chi_sq(model, there) - half_chi_sq(model, here)) / (2 * h)
        off = [_kernels.equation_values(model.constraints, x)[0] for x in (there, here)]
        touch[i] = (off[0] - off[1]) / (2 * h)
    along = slope - (slope @ touch) / (touch @ touch) * touch
    assert np.abs(along).max() < 1e-5 * np.abs(slope).max()


def half_chi_sq(model, x):
    other = Model.of(model.seen, model.row)
    other.x = x
    return 0.5 * other.chi_sq


@pytest.mark.parametrize("seed", [9, 18, 20])
def test_level_edges_of_an_outline_that_is_its_own_image_are_level(seed):
    # That the corners of a rounded square are images of each other follows from its edges, which
    # no rounding may turn into an equation for their direction (DRA-41).
    half, run = 40 + seed, np.arange(120)[:, None] / 120
    angle = np.linspace(0, np.pi / 2, int(18.84 * 60 / half), endpoint=False)
    corners = half * np.array([(1, 1), (-1, 1), (-1, -1), (1, -1)])
    parts = []
    for k, corner in enumerate(corners):
        around = angle + k * np.pi / 2
        way = np.round([-np.sin(around[0]), np.cos(around[0])])
        parts.append(corner + 12 * np.column_stack([np.cos(around), np.sin(around)]))
        parts.append(corner + 12 * way + run * (corners[(k + 1) % 4] - corner))
    points = np.concatenate(parts)
    shaken = points + np.random.default_rng(seed).normal(0, 0.002, points.shape)
    found = as_drawn(Contour(shaken, closed=True), 0.02)
    assert {"rotation", "mirror"} <= {one.name for one in found.regularities}
    lines = [part for part in found.parts if isinstance(part, DrawnLine)]
    assert len(lines) == 4
    assert all((line.begin == line.end).any() for line in lines)


@pytest.mark.parametrize("end", [43, 44, 46])
def test_an_edge_goes_on_to_the_corner_and_no_run_is_turned_inside_out(end):
    corners = [(0, 0), (20, 0), (20, 20), (0, 20), (0, 0)]
    points = np.concatenate([side(a, b, 20) for a, b in pairwise(corners)])
    row = np.vstack([points, points[:1]])
    # The top edge ends two points before its corner, the left one begins behind it.
    kinds = [(0, 20, LINE), (20, 38, LINE), (38, end, FREE), (end, 60, LINE), (60, 80, LINE)]
    found = tuple(Segment(*one) for one in kinds)
    segments = Segments(row, np.arange(81.0), np.ones(81), 0, found)
    seen = Observed(points, True, 0.02, 0.02, 0.0, 1.0)
    moved = at_corners(Model.of(seen, segments))
    assert [s.begin for s in moved.found] == [0, 20, 40, end, 60]
    assert [s.end for s in moved.found] == [20, 40, end, 60, 80]


def test_small_and_odd_outlines_are_no_error():
    random = np.random.default_rng(1)
    for trial in range(30):
        angle = np.linspace(0, random.uniform(4, 6.2), random.integers(12, 40))
        points = 4 * np.column_stack([np.cos(angle), np.sin(angle)])
        tip = random.uniform(-8, 8, (1, 2))
        shaken = np.concatenate([points, tip]) + random.normal(0, 0.01, (len(points) + 1, 2))
        contour = Contour(shaken, closed=trial % 2 == 0)
        found = as_drawn(contour, [None, 0.02][trial % 3 == 0], tolerance=0.3)
        for part in () if found is None else found.parts:
            if not isinstance(part, FreeRun):
                assert np.isfinite([part.begin, part.end]).all()


def cornered(cut, radius, n, noise, seed):
    """A box of 215 by 129 whose corners are cut off, or rounded, at equal steps, with noise."""
    x, y = 215.0, 129.0
    if radius:
        at = [(x - radius, radius), (x - radius, y - radius), (radius, y - radius), (radius,) * 2]
        loop = np.concatenate([arc(c, radius, 90 * k - 90, 90, 400) for k, c in enumerate(at)])
    else:
        ends = [(cut, 0), (x - cut, 0), (x, cut), (x, y - cut), (x - cut, y), (cut, y)]
        loop = np.array([*ends, (0, y - cut), (0, cut)], dtype=float)
    points = Contour(loop, closed=True).resampled(n).points
    return points + np.random.default_rng(seed).normal(0, noise, points.shape)


@pytest.mark.parametrize("seed", [1, 2, 3])
@pytest.mark.parametrize("n", [200, 1000])
def test_noisy_fillets_are_no_chamfers_and_chamfers_no_fillets(n, seed):
    """At 1.25 a chamfer and its corners fit a fillet of 32 as well, but take more numbers."""
    rounded = as_drawn(Contour(cornered(0, 32, n, 1.25, seed), closed=True))
    assert kinds(rounded) in ("ALALALAL", "LALALALA")
    cut = as_drawn(Contour(cornered(30, 0, n, 1.25, seed), closed=True))
    assert kinds(cut) == 8 * "L"


def test_points_beside_a_tangent_node_belong_to_the_element_on_their_side():
    """Shared anew, elements fit better; their radii come within four standard errors."""
    radii = []
    for seed in range(6):
        found = as_drawn(Contour(cornered(0, 32, 1000, 0.25, seed), closed=True), regularities=())
        radii += [part.arc.radius for part in found.parts if isinstance(part, DrawnArc)]
    # Where both edges stay, a larger radius moves the points of a tangent quarter inwards by
    # sqrt(2) cos(t) - 1 of itself, 0.30 in the mean square. 79 points lie there.
    error = 0.25 / (0.30 * 79**0.5)
    assert abs(np.mean(radii) - 32) < 4 * error / len(radii) ** 0.5

"""Equal outlines of a drawing, through the public functions."""

from dataclasses import replace

import numpy as np
import pytest

import shapespline as ss

NOISE = 0.02


def circle(x, y, r, n=90):
    t = 2 * np.pi * np.arange(n) / n
    return np.column_stack([x + r * np.cos(t), y + r * np.sin(t)])


def slot(x, y):
    """60 by 16, round ends: about a point a unit."""
    along, a = np.arange(44) + 0.5, np.pi * np.arange(25) / 25
    end = np.column_stack([22 + 8 * np.sin(a), -8 * np.cos(a)])
    half = np.vstack([np.column_stack([along - 22, 0 * along - 8]), end])
    return np.vstack([half, -half]) + np.array([x, y])


def fitted(outlines, **options):
    random = np.random.default_rng(4)
    shaken = [points + random.normal(0, NOISE, points.shape) for points in outlines]
    shape = ss.Shape([ss.Contour(points, closed=True) for points in shaken])
    return ss.fit_shape(shape, tolerance=0.2, character="drawn", **options)


def test_holes_of_a_plate_are_equal_and_in_a_row_to_the_bit(tmp_path):
    drawing = fitted([circle(30 * k, 7, 9) for k in range(4)])
    arcs = [fit.pieces[0].arc for fit in drawing]
    assert len({arc.radius for arc in arcs}) == len({arc.centre[1] for arc in arcs}) == 1
    assert np.ptp(np.diff([arc.centre[0] for arc in arcs])) < 1e-12
    assert all(fit.kept for fit in drawing)
    told = {one.name: one for one in drawing.regularities}
    assert set(told) == {"equal-radius", "axis-parallel", "equal-spacing"}
    assert all(one.pieces == (0, 1, 2, 3) for one in told.values())
    ss.write(tmp_path / "plate.json", drawing)
    assert ss.read(tmp_path / "plate.json") == drawing
    doubled = ss.read(tmp_path / "plate.json", scale=2)
    assert doubled.regularities[0].off == 2 * drawing.regularities[0].off
    alone = fitted([circle(30 * k, 7, 9) for k in range(4)], regularities=None)
    assert alone.regularities == ()
    assert len({fit.pieces[0].arc.radius for fit in alone}) == 4


def test_equal_slots_are_one_slot_in_several_places():
    drawing = fitted([slot(0, 0), np.roll(slot(3, 30), 31, axis=0), slot(0, 60), circle(0, 99, 9)])
    told = {one.name: one for one in drawing.regularities}
    assert told["equal-copies"].pieces == (0, 1, 2)
    first, *others = drawing.fits[:3]
    nodes = [np.array([piece.control_points[0] for piece in fit.pieces]) for fit in drawing][:3]
    for fit, own in zip(others, nodes[1:], strict=True):
        assert fit.kept
        # The same four corners, each beginning somewhere else, moved.
        off = own - own.mean(axis=0) - (nodes[0] - nodes[0].mean(axis=0))[:, None]
        assert np.hypot(*np.moveaxis(off, -1, 0)).min(axis=0).max() < 1e-12
        assert {piece.arc.radius for piece in fit.pieces if piece.arc} == {
            piece.arc.radius for piece in first.pieces if piece.arc
        }
        assert len(fit.regularities) == len(first.regularities)


def test_an_outline_that_its_points_contradict_stays_as_it_was(monkeypatch):
    from shapespline.fitting import across

    outlines = [circle(30 * k, 7, 9) for k in range(4)]
    asked, refitted = [], across._refitted

    def worse_for_one(fit, *rest):
        asked.append(fit)
        found = refitted(fit, *rest)
        return replace(found, rms_distance=9.0) if fit.contour.points[0, 0] > 90 else found

    monkeypatch.setattr(across, "_refitted", worse_for_one)
    drawing = fitted(outlines)
    assert {k for one in drawing.regularities for k in one.pieces} == {0, 1, 2}
    assert len({fit.pieces[0].arc.radius for fit in drawing}) == 2


def turned(points, angle, about=(0.0, 0.0)):
    c, s = np.cos(angle), np.sin(angle)
    return points @ np.array([[c, s], [-s, c]]) + about


def kidney():
    """Between radii of 20 and 40, 0.4 to both sides of the first axis."""
    a = np.linspace(-0.4, 0.4, 60)[:, None]
    arc = np.hstack([np.cos(a), np.sin(a)])
    share = np.linspace(0, 1, 20)[1:-1, None]
    ends = [(40 - 20 * share) * arc[-1], (20 + 20 * share) * arc[0]]
    return np.vstack([40 * arc, ends[0], 20 * arc[::-1], ends[1]])


def bracket():
    """Six edges, alike under no turn and no mirror."""
    corners = np.array([(0, 0), (30, 0), (30, 10), (12, 10), (12, 40), (0, 40)], dtype=float)
    sides = []
    for begin, end in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        count = int(1.5 * np.hypot(*(end - begin)))
        sides.append(begin + np.arange(count)[:, None] / count * (end - begin))
    return np.vstack(sides)


def nodes_of(fit):
    return np.array([piece.control_points[0] for piece in fit.pieces])


def nearest(points, others):
    """How far each point is from the nearest of others."""
    return np.hypot(*np.moveaxis(points[:, None] - others, -1, 0)).min(axis=1)


@pytest.mark.parametrize("order", [3, 4, 5, 6, 7])
def test_openings_of_a_wheel_are_one_that_is_turned(order):
    drawing = fitted([turned(kidney(), 0.1 + 2 * np.pi * k / order) for k in range(order)])
    told = {one.name: one for one in drawing.regularities}
    assert told["equal-copies"].pieces == tuple(range(order))
    assert told["rotation"].order == order
    nodes = [nodes_of(fit) for fit in drawing]
    centre = np.mean(nodes, axis=(0, 1))
    for own, following in zip(nodes, nodes[1:] + nodes[:1], strict=True):
        images = turned(own - centre, 2 * np.pi / order, centre)
        assert nearest(images, following).max() < 1e-11
    assert len({arc.radius for fit in drawing for _, arc in own_arcs(fit)}) == 2
    assert all(fit.kept for fit in drawing)


def own_arcs(fit):
    return [(k, piece.arc) for k, piece in enumerate(fit.pieces) if piece.arc]


@pytest.mark.parametrize("runs_back", [False, True])
def test_mirrored_and_turned_brackets_are_one_bracket(runs_back):
    mirrored = bracket() * [-1, 1] - [5, 0]
    there = [bracket(), mirrored[::-1] if runs_back else mirrored]
    there += [turned(bracket(), np.pi / 2, (0, 60)), bracket() * [1, -1] + [90, 0]]
    drawing = fitted(there)
    (copies,) = (one for one in drawing.regularities if one.name == "equal-copies")
    assert copies.pieces == (0, 1, 2, 3)
    maps = [np.diag([1, 1]), np.diag([-1, 1]), np.array([[0, -1], [1, 0]]), np.diag([1, -1])]
    first = nodes_of(drawing.fits[0])
    for fit, linear in zip(drawing, maps, strict=True):
        assert fit.kept
        own = nodes_of(fit)
        images = (first - first.mean(axis=0)) @ linear.T
        assert nearest(images, own - own.mean(axis=0)).max() < 1e-12
        level = [one.pieces[0] for one in fit.regularities if one.name == "axis-parallel"]
        assert sorted(level) == list(range(6))
        assert (np.roll(own, -1, axis=0) == own).any(axis=1).all()


def test_a_bracket_turned_by_thirty_degrees_is_one_but_its_edges_are_not_level():
    drawing = fitted([bracket(), turned(bracket(), np.pi / 6, (100, 0))])
    assert [one.name for one in drawing.regularities] == ["equal-copies"]
    first, other = (nodes_of(fit) - nodes_of(fit).mean(axis=0) for fit in drawing)
    assert nearest(turned(first, np.pi / 6), other).max() < 1e-12
    names = {one.name for one in drawing.fits[1].regularities}
    assert "axis-parallel" not in names


def test_another_size_and_another_slant_is_no_copy():
    sheared = bracket() @ np.array([[1.0, 0.0], [0.1, 1.0]])
    drawing = fitted([bracket(), 1.02 * bracket() + [60, 0], sheared + np.array([120, 0])])
    assert "equal-copies" not in {one.name for one in drawing.regularities}

"""Equal outlines of a drawing, through the public functions."""

from dataclasses import replace

import numpy as np

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

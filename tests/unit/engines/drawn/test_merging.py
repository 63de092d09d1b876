"""Neighbours on one circle or line are one; what is left keeps what it kept."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose

from shapespline.engines.drawn.merging import merged
from shapespline.engines.drawn.parts import Drawn, DrawnArc, DrawnLine
from shapespline.values import Arc, Regularity


def arc(centre, first, sweep):
    """In degrees, of radius 2."""
    own = Arc(centre, 2.0, *np.radians((first, sweep)))
    return DrawnArc(own, np.array(own.begin), np.array(own.end))


def slot(*cuts):
    """Two edges and two half circles, these cut at some angles."""
    right = [arc((10, 0), a, b - a) for a, b in zip((-90, *cuts), (*cuts, 90), strict=True)]
    left = [arc((0, 0), a + 180, b - a) for a, b in zip((-90, *cuts), (*cuts, 90), strict=True)]
    lower = DrawnLine(np.array([0.0, -2]), np.array([10.0, -2]))
    upper = DrawnLine(np.array([10.0, 2]), np.array([0.0, 2]))
    return [lower, *right, upper, *left]


def test_a_fillet_cut_in_two_is_one_arc():
    found = (
        Regularity("tangent", (0, 1), 0.1),
        Regularity("tangent", (1, 2), 0.2),
        Regularity("concentric", (1, 2), 0.3),
        Regularity("axis-parallel", (3,), 0.4),
        Regularity("equal-radius", (1, 4), 0.5),
        Regularity("equal-radius", (2, 5), 0.6),
    )
    drawn = merged(Drawn(tuple(slot(20)), found, True, 9), closed=True)
    whole = slot()
    assert len(drawn.parts) == 4
    for part, wanted in zip(drawn.parts, whole, strict=True):
        assert type(part) is type(wanted)
        assert_allclose([part.begin, part.end], [wanted.begin, wanted.end], atol=1e-14)
    assert_allclose([part.arc.sweep for part in drawn.parts[1::2]], np.pi, rtol=1e-15)
    assert [(one.name, one.pieces, one.off) for one in drawn.regularities] == [
        ("tangent", (0, 1), 0.1),
        ("axis-parallel", (2,), 0.4),
        ("equal-radius", (1, 3), 0.5),
    ]


def test_across_the_seam_of_a_closed_outline_alone():
    parts = slot(20)
    turned = (*parts[-1:], *parts[:-1])  # begins within the left arc
    told = (Regularity("tangent", (0, 1), 0.1), Regularity("tangent", (4, 5), 0.2))
    drawn = merged(Drawn(turned, told, True, 9), closed=True)
    assert len(drawn.parts) == 4
    assert_allclose(drawn.parts[0].begin, slot()[3].begin, atol=1e-14)
    assert [one.pieces for one in drawn.regularities] == [(0, 1), (3, 0)]
    assert len(merged(Drawn(turned, told, True, 9), closed=False).parts) == 5


def test_other_circles_other_ways_and_whole_turns_stay():
    for pair in (
        (arc((0, 0), 0, 90), arc((0, 1e-3), 90, 90)),
        (arc((0, 0), 0, 90), arc((0, 0), 90, -90)),
        (arc((0, 0), 0, 200), arc((0, 0), 200, 160)),
    ):
        drawn = Drawn(pair, (), True, 3)
        assert merged(drawn, closed=False) is drawn


def square(*cuts):
    """Of side 4, its lower edge cut at some places."""
    ends = [(0, 0), *((cut, 0) for cut in cuts), (4, 0), (4, 4), (0, 4)]
    ends = np.array(ends, dtype=float)
    return [DrawnLine(a, b) for a, b in zip(ends, np.roll(ends, -1, axis=0), strict=True)]


def test_an_edge_cut_in_two_is_one_line():
    found = (
        Regularity("axis-parallel", (0,), 0.1),
        Regularity("collinear", (0, 1), 0.2),
        Regularity("parallel", (1, 3), 0.3),
    )
    drawn = merged(Drawn(tuple(square(1)), found, True, 9), closed=True)
    assert [(*part.begin, *part.end) for part in drawn.parts] == [
        (*part.begin, *part.end) for part in square()
    ]
    assert [(one.name, one.pieces) for one in drawn.regularities] == [
        ("axis-parallel", (0,)),
        ("parallel", (0, 2)),
    ]
    several = (*square(1, 2, 3)[2:], *square(1, 2, 3)[:2])  # begins within the lower edge
    assert len(merged(Drawn(several, (), True, 9), closed=True).parts) == 4


def test_lines_that_turn_or_turn_back_stay_two():
    for middle, end in (((2.0, 1e-4), (4.0, 0.0)), ((4.0, 0.0), (2.0, 0.0))):
        lines = [
            DrawnLine(np.zeros(2), np.array(middle)),
            DrawnLine(np.array(middle), np.array(end)),
        ]
        assert len(merged(Drawn(tuple(lines), (), True, 9), closed=False).parts) == 2

"""Straight runs of the data."""

import numpy as np
import pytest
from tests.support.scattered import noisy_walk
from tests.support.shapes import flower, on_circle, rectangle

from shapespline import Contour
from shapespline.analysis import has_straight_runs, with_points_on_lines
from shapespline.analysis.normalization import NormalizedContour


@pytest.mark.parametrize(
    ("contour", "straight"),
    [
        (flower(2000), False),
        (Contour(on_circle(3000, 7.0), closed=True), False),
        (rectangle(400, 300, 0.1), True),
        (Contour(noisy_walk(2000, 0.01), closed=False), True),  # too noisy to tell
    ],
)
def test_straight_runs_of_the_data_are_seen(contour, straight):
    work = NormalizedContour.of(contour)
    assert has_straight_runs(work.contour, 0.05 * work.scale) is straight


def fillet_corners(chords):
    """A rectangle of 60 by 40 with fillets of radius 8, as ends of edges and of chords."""
    centres = [(52, 32), (8, 32), (8, 8), (52, 8)]
    angle = np.linspace(0, np.pi / 2, chords + 1)
    return np.concatenate(
        [
            np.array(centre) + 8 * np.column_stack([np.cos(a), np.sin(a)])
            for k, centre in enumerate(centres)
            for a in [angle + k * np.pi / 2]
        ]
    )


def test_points_lie_on_edges_alone():
    points = fillet_corners(9)
    found = with_points_on_lines(points, True)
    added = [tuple(point) for point in found if not (point == points).all(axis=1).any()]
    assert len(added) == 8
    # Between the fillets, a third and two thirds of the way.
    assert all(x in (0, 60) or y in (0, 40) for x, y in np.round(added, 9).tolist())
    assert len(found) == len(points) + 8
    assert [tuple(p) for p in found if (p == points).all(axis=1).any()] == [*map(tuple, points)]


def test_long_chords_of_a_wide_arc_beside_small_ones_are_no_lines():
    # As programs export it: chords as long as the root of the radius asks for.
    wide = np.linspace(0.3, np.pi - 0.3, 13)
    arch = 200 * np.column_stack([np.cos(wide), np.sin(wide)])
    small = np.linspace(0.3, np.pi - 0.3, 25)
    left = arch[-1] + 3 * np.column_stack([np.cos(small) - 1, -np.sin(small)])
    points = np.concatenate([arch, left[1:]])
    steps = np.hypot(*np.diff(points, axis=0).T)
    assert steps.max() > 3 * np.median(steps)
    assert (with_points_on_lines(points, False) == points).all()


def test_even_points_stay_as_they_are():
    points = flower(200).points
    assert with_points_on_lines(points, True) is points


def test_an_open_row_begins_and_ends_as_it_did():
    points = np.array([(0.0, 0.0), (9.0, 0.0), (9.0, 1.0), (9.5, 1.0), (9.5, 2.0), (9.0, 2.0)])
    found = with_points_on_lines(points, False)
    assert found.tolist() == [[0, 0], [3, 0], [6, 0], *points[1:].tolist()]

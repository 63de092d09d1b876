"""What the outlines of a drawing repeat."""

import numpy as np
import pytest

from shapespline.engines.drawn import NAMES, Feature, repeated_outlines

NOISE = 0.01
TURN = np.radians(23.0)
TURNED = np.array([[np.cos(TURN), np.sin(TURN)], [-np.sin(TURN), np.cos(TURN)]])
GRID = np.array([(50 + 40 * i, 60 + 30 * j) for i in range(4) for j in range(3)], dtype=float)


def circle_of(count, phase):
    angle = phase + 2 * np.pi * np.arange(count) / count
    return np.array([100.0, 90.0]) + 50 * np.column_stack([np.cos(angle), np.sin(angle)])


def solved(places, *, angle=0.0, allowed=NAMES, radii=8.0):
    shaken = np.column_stack([places, np.broadcast_to(radii, len(places))])
    shaken = shaken + np.random.default_rng(1).normal(0, NOISE, shaken.shape)
    features = [Feature(*row, NOISE**2, NOISE**2) for row in shaken.tolist()]
    values, found = repeated_outlines(features, 256.0, allowed, angle)
    before, after = (np.abs(one[:, :2] - places).max() for one in (shaken, values))
    return values, found, before, after


def test_a_grid_of_holes_is_level_equally_spaced_and_nearer_to_the_truth():
    values, found, before, after = solved(GRID)
    x, y, radii = (sorted(set(column)) for column in values.T.tolist())
    assert (len(x), len(y), len(radii)) == (4, 3, 1)
    assert np.ptp(np.diff(x)) < 1e-12
    assert np.ptp(np.diff(y)) < 1e-12
    assert after < before
    assert {one.name for one in found} == {"equal-radius", "axis-parallel", "equal-spacing"}
    # The largest of twelve is seldom below 1, never above 6 standard errors.
    assert all(one.off < 6 * NOISE for one in found)


def test_a_turned_grid_is_parallel_to_the_edges():
    values, found, before, after = solved(GRID @ TURNED, angle=TURN)
    back = values[:, :2] @ TURNED.T
    assert np.ptp(back[:3, 0]) < 1e-11
    assert np.ptp(np.diff(back[::3, 0])) < 1e-11
    assert after < before
    assert {one.name for one in found} == {"equal-radius", "parallel", "equal-spacing"}


@pytest.mark.parametrize("count", [3, 4, 6])
def test_a_ring_of_holes_has_the_centre_of_what_lies_there(count):
    places = np.vstack([circle_of(count, 0.3), [(100.0, 90.0)]])
    values, found, before, after = solved(places, radii=[8.0] * count + [20.0])
    ring, centre = values[:count, :2], values[count, :2]
    assert np.ptp(np.hypot(*(ring - centre).T)) < 1e-11
    assert np.hypot(*(ring.mean(axis=0) - centre)) < 1e-11
    assert after < before
    assert [one.order for one in found if one.name == "rotation"] == [count]


def test_a_row_in_any_direction_has_equal_steps():
    values, found, _, _ = solved(GRID[::3] @ TURNED)
    assert np.abs(np.diff(values[:, :2], n=2, axis=0)).max() < 1e-11
    assert "equal-spacing" in {one.name for one in found}


def test_what_the_data_do_not_tell_or_nobody_allows_is_not_taken():
    scattered = np.random.default_rng(2).uniform(0, 256, (6, 2))
    _, found, _, _ = solved(scattered, radii=np.array([5.0, 6, 7, 8, 9, 10]))
    assert found == []
    values, found, before, after = solved(GRID, allowed=["equal-radius"])
    assert [one.name for one in found] == ["equal-radius"]
    assert after == before
    # Ten standard errors off its place is another place.
    moved = GRID.copy()
    moved[4] += 10 * NOISE
    values, found, _, _ = solved(moved)
    assert all(4 not in one.pieces for one in found if one.name != "equal-radius")
    assert abs(values[4, 0] - moved[4, 0]) < 6 * NOISE

"""Where elements end: in their corners, cut off only where no point comes near."""

from __future__ import annotations

import numpy as np
import pytest

import shapespline as ss


@pytest.mark.parametrize("turn", [0.0, 0.3])
@pytest.mark.parametrize("within", [0.05, 0.1, 0.2])
def test_corners_of_many_points_are_no_farther_than_those_that_lie_in_them(turn, within):
    # Every other point is looked at, and those in the corners are not among them; chords of these
    # pass two of the corners by 0.11.
    t = np.arange(625) / 625
    side = np.column_stack([100 * t, 0 * t])
    square = [side, side[:, ::-1] + [100, 0], [100, 100] - side, [0, 100] - side[:, ::-1]]
    points = np.roll(np.concatenate(square), 1, axis=0)
    c, s = np.cos(turn), np.sin(turn)
    fit = ss.fit_curve(points @ np.array([[c, s], [-s, c]]), closed=True, tolerance=within)
    assert [piece.kind for piece in fit.pieces] == ["line"] * 4

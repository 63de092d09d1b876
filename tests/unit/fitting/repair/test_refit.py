"""Windows of pieces fitted again: which neighbours, with what held, and put back in the row."""

from dataclasses import replace

import numpy as np
import pytest
from tests.support.promise import SMOOTH
from tests.support.shapes import flower

import shapespline as ss
from checks import gaps, turns
from shapespline.fitting.repair.assignment import PieceAssignment
from shapespline.fitting.repair.refit import (
    Window,
    fitted_again,
    turned_apart,
    verified_row,
    windows_around,
)


@pytest.mark.parametrize(
    ("found", "beside", "windows"),
    [
        ([4], 0, [(4, 5)]),
        ([4], 2, [(2, 7)]),
        ([0], 1, [(0, 2)]),
        ([8], 3, [(5, 9)]),
        ([6, 1, 3], 1, [(0, 8)]),  # neighbours of one are those of the next
        ([1, 5], 1, [(0, 3), (4, 7)]),
        ([1, 2], 0, [(1, 2), (2, 3)]),
        ([], 1, []),
    ],
)
def test_windows_by_hand(found, beside, windows):
    assert windows_around(found, beside, 9) == windows


def bounces(n=300):
    """An open way with corners, and pieces between them."""
    t = np.linspace(0, 3, n)
    return ss.Contour(np.column_stack([10 * t, 3 * np.abs(np.sin(4 * t))]), closed=False)


def row_of(contour, tolerance=0.02):
    row = PieceAssignment.of(0, ss.fit_curve(contour, tolerance=tolerance))
    assert len(row.parts) >= 4
    return row


def test_a_closed_row_begins_away_from_what_is_fitted_again():
    row = row_of(flower(300))
    count = len(row.parts)
    found = [0, 1, count - 1]
    turned, again = turned_apart(row, found)
    for at, now in zip(found, again, strict=True):
        assert turned.parts[now].piece is row.parts[at].piece
        assert 0 < now < count - 1
    assert turned.parts[0].piece is not row.parts[0].piece


class Asked:
    """Fits as it is asked to, and keeps what it was asked."""

    holds_ends = False

    def __init__(self):
        self.calls = []

    def __call__(self, contour, within, tangents, through):
        self.calls.append((contour, within, tangents, through))
        return ss.fit_curve(
            contour,
            closed=False,
            tolerance=within,
            ends="fixed",
            end_tangents=None if all(t is None for t in tangents) else tangents,
            through=list(through) or None,
        )


@pytest.mark.parametrize("contour", [flower(300), bounces()], ids=["closed", "open"])
def test_a_window_goes_to_its_own_points_with_its_ends_held(contour):
    row, asked = row_of(contour), Asked()
    window = Window(1, 3, 0.005)
    again = fitted_again(row, [window], asked)
    (given, within, tangents, through), *_ = asked.calls
    assert within == 0.005
    assert through == []
    begin, end = row.parts[1].begin, row.parts[2].end
    own = {tuple(p) for p in row.data.points[begin:end]}
    assert {tuple(p) for p in given.points[1:-1]} <= own
    assert len(given) >= end - begin - 4
    nodes = row.parts[1].piece.control_points[0], row.parts[2].piece.control_points[-1]
    assert given.points[[0, -1]].tolist() == [node.tolist() for node in nodes]
    # Tangents are held where the row is smooth: everywhere, or not at the corners.
    turn = np.abs(turns([part.piece for part in row.parts], closed=contour.closed))
    joints = turn[[1, 3]] if contour.closed else turn[[0, 2]]
    assert [tangent is not None for tangent in tangents] == (joints < SMOOTH).tolist()
    # The others are the same, the row is one curve, and its new joints are as smooth as they were.
    kept = {id(part.piece) for part in row.parts}
    new = [part.piece for part in again.parts]
    assert sum(id(piece) in kept for piece in new) == len(row.parts) - 2
    assert gaps(new, closed=row.fit.closed).max() <= 1e-12 * 20
    if contour.closed:
        assert np.abs(turns(new, closed=True)).max() <= SMOOTH
    bounds = [part.begin for part in again.parts] + [again.parts[-1].end]
    assert bounds == sorted(bounds)
    assert bounds[-1] - bounds[0] == len(row.data.points)


def test_points_of_a_window_are_gone_through_and_named_in_it():
    row, asked = row_of(bounces()), Asked()
    begin, end = row.parts[1].begin, row.parts[2].end
    at = (begin + end) // 2
    fitted_again(row, [Window(1, 3, 0.02, (at,))], asked)
    (given, _, _, (through,)), *_ = asked.calls
    assert given.points[through].tolist() == row.data.points[at].tolist()


def test_points_at_free_ends_are_ends_already():
    row, asked = row_of(bounces()), Asked()
    count, n = len(row.parts), len(row.data.points)
    inside = n - 5
    fitted_again(row, [Window(count - 1, count, 0.02, (inside, n - 1))], asked)
    fitted_again(row, [Window(0, 1, 0.02, (0, 4))], asked)
    (last, _, _, (one,)), (first, _, _, (other,)) = asked.calls
    assert last.points[one].tolist() == row.data.points[inside].tolist()
    assert first.points[other].tolist() == row.data.points[4].tolist()


def test_a_free_end_goes_with_its_points():
    row, asked = row_of(bounces()), Asked()
    count = len(row.parts)
    up = np.array([0.0, 0.01])
    fitted_again(
        row,
        [Window(0, 1, 0.02), Window(count - 1, count, 0.02)],
        asked,
        lambda row, window, data: data.points + up,
    )
    (last, *_), (first, *_) = asked.calls
    assert first.points[0].tolist() == (row.data.points[0] + up).tolist()
    assert last.points[-1].tolist() == (row.data.points[-1] + up).tolist()
    asked.holds_ends = True
    fitted_again(row, [Window(0, 1, 0.02)], asked)
    held = asked.calls[-1][0]
    assert held.points[0].tolist() == row.parts[0].piece.control_points[0].tolist()


@pytest.mark.parametrize("fold", [0.0, 0.02])
def test_a_repair_that_makes_a_hook_is_not_taken(fold):
    row = row_of(bounces())
    at = max(range(len(row.parts)), key=lambda k: row.parts[k].end - row.parts[k].begin)
    line = row.parts[at].line
    step = line[51] - line[50]
    aside = 0.01 * np.array([-step[1], step[0]]) / np.hypot(*step)
    back = line[50] - fold * step / np.hypot(*step) + aside
    way = np.concatenate([line[:51], [back, line[50] + 2 * aside] if fold else line[:0], line[51:]])
    fit = ss.fit_curve(way, closed=False, tolerance=1e-6, degree=1, character="fewest")
    answer = replace(fit, status=ss.Status.KEPT)

    class Answering(Asked):
        def __call__(self, contour, within, tangents, through):
            return answer

    again = fitted_again(row, [Window(at, at + 1, 0.02)], Answering())
    assert (again.parts == row.parts) == bool(fold)


def test_a_row_that_would_break_the_promise_is_not_taken():
    row = row_of(flower(300))
    assert verified_row(row).kept
    moved = row.parts[0].piece._replace(control_points=row.parts[0].piece.control_points + 1.0)
    broken = row._replace(parts=(row.parts[0]._replace(piece=moved), *row.parts[1:]))
    assert verified_row(broken) is row.fit

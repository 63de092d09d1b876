"""Outlines that a file draws run by run, one after the other."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapespline.formats.places import places

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.values import Piece


def loops_in_order(runs: Sequence[Sequence[Piece]], near: float) -> list[list[int]]:
    """Numbers of runs, each beginning where the one before ends, back to where the first began.

    None visits a place twice, or has a run in common with another: of those that would, the one
    with the most runs is taken, the earlier of two. A run that is closed itself is none of them.

    Parameters
    ----------
    runs : sequence of sequences of Piece
        In the order of the file.
    near : float
        Ends within this distance are one place.

    Examples
    --------
    >>> from shapespline.formats import bezier
    >>> corners = [(0, 0), (4, 0), (4, 3), (0, 0), (-1, -1)]
    >>> lines = [[bezier(ends)] for ends in zip(corners, corners[1:])]
    >>> loops_in_order(lines, 1e-6)
    [[0, 1, 2]]
    """
    of_ends = places(runs, near).of_ends.tolist()
    found: list[tuple[int, int]] = []
    latest: dict[int, int] = {}  # the run that begins at a place
    first = 0
    for run, (begin, end) in enumerate(zip(of_ends[::2], of_ends[1::2], strict=True)):
        if begin == end or (run and of_ends[2 * run - 1] != begin):
            latest, first = {}, run
        if begin == end:
            continue
        latest[begin] = run
        since = latest.get(end, -1)
        if since >= first:
            found.append((since, run))
            first = since + 1
    taken: set[int] = set()
    loops = []
    for since, run in sorted(found, key=lambda loop: (loop[0] - loop[1], loop[0])):
        numbers = range(since, run + 1)
        if len(numbers) > 2 and taken.isdisjoint(numbers):
            taken.update(numbers)
            loops.append([*numbers])
    return sorted(loops)

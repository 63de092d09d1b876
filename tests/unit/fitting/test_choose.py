"""The order of preference: each rule decides before those that come after it."""

from __future__ import annotations

import numpy as np
import pytest
from tests.support.shapes import flower, rectangle

from shapespline.engines.spline import Fairness
from shapespline.fitting import Request, Settings
from shapespline.fitting.choose import ROUGH_PART, Shortlist
from shapespline.fitting.problem import Problem
from shapespline.fitting.strategies import LINES, MIRRORED, ONE_SPLINE, PIECES
from shapespline.fitting.verify import Candidate, Verified
from shapespline.values import Fit, Status

FAIR, CUSP = Fairness(2.0, 0.5, 0, 0), Fairness(2.0, 1e-6, 0, 0)


class Known(Fit):
    """A fit of which only the figures are looked at."""

    def __init__(self, kept=True, points=10, distance=0.01, sections=(), corners=()):
        figures = {"_kept": kept, "_points": points, "hausdorff_distance": distance}
        for name, value in {**figures, "sections": sections, "_corners": corners}.items():
            object.__setattr__(self, name, value)
        object.__setattr__(self, "status", Status.KEPT)

    kept = property(lambda self: self._kept)
    n_stored_points = property(lambda self: self._points)
    corners = property(lambda self: np.array(self._corners))


def candidate(rank, tangent_error=0.0, fairness=None, **figures):
    return Verified(
        Candidate(method="by hand", rank=rank, fairness=fairness), Known(**figures), tangent_error
    )


def shortlist(contour, *verified, **options):
    found = Shortlist(Problem(Request.of(contour, None, Settings(tolerance=0.01, **options))))
    for one in verified:
        found.add(one)
    return found


A, B = ("line",), ("bezier",)


@pytest.mark.parametrize(
    ("better", "worse"),
    [
        # 1 the tolerance before points, 2 a tangent before points
        (candidate(PIECES, points=90), candidate(ONE_SPLINE, kept=False, points=5)),
        (candidate(PIECES, points=90), candidate(PIECES, 0.1, points=5)),
        # 5 points, or of what misses the tolerance the distance; 6 the simpler structure
        (candidate(LINES, points=9), candidate(ONE_SPLINE, points=10)),
        (
            candidate(LINES, kept=False, points=90, distance=0.1),
            candidate(PIECES, kept=False, points=9, distance=0.2),
        ),
        (candidate(MIRRORED), candidate(PIECES)),
    ],
)
def test_what_counts_first_decides(better, worse):
    assert shortlist(flower(), worse, better).best is better
    assert shortlist(flower(), better, worse).best is better


def test_a_cusp_counts_where_the_data_have_corners_only():
    cusp = candidate(ONE_SPLINE, fairness=CUSP, points=5)
    fair = candidate(ONE_SPLINE, fairness=FAIR, points=6)
    pieces = candidate(PIECES, points=9, sections=A)
    assert shortlist(rectangle(60, 40), cusp, pieces).best is pieces
    assert shortlist(rectangle(60, 40), fair, pieces).best is fair
    assert shortlist(flower(), cusp, pieces).best is cusp


def test_corners_where_the_data_have_none_lose_to_a_smooth_curve_that_follows():
    smooth = candidate(ONE_SPLINE, points=12)
    cornered = candidate(PIECES, points=9, sections=B, corners=(0.5,))
    assert shortlist(flower(), cornered, smooth).best is smooth
    # Not if the smooth one only threads through rough data, nor where corners are free.
    rough = candidate(ONE_SPLINE, points=int(ROUGH_PART * len(flower())) + 1)
    assert shortlist(flower(), cornered, rough).best is cornered
    assert shortlist(flower(), cornered, smooth, corners="free").best is cornered


def test_of_equals_the_first_is_taken():
    first, second = candidate(PIECES), candidate(PIECES)
    assert shortlist(flower(), first, second).best is first


def test_among_some_ranks():
    lines, pieces = candidate(LINES, points=8), candidate(PIECES, points=9)
    found = shortlist(flower(), lines, pieces)
    assert found.among(PIECES) is pieces
    assert found.among(PIECES, LINES) is lines
    assert found.among(ONE_SPLINE) is None
    assert found.kept
    assert len(found) == 2


def test_one_alone_is_not_compared(monkeypatch):
    one, other = candidate(PIECES), candidate(LINES)
    found = shortlist(flower(), one, other)
    monkeypatch.setattr(Shortlist, "_preference", None)  # which would look for corners
    assert found.among(PIECES) is one
    assert found.among(MIRRORED) is None

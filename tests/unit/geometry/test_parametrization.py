"""Location parameters: by hand and by their definitions."""

from __future__ import annotations

import numpy as np
import pytest
from tests.support.reference import EPS
from tests.support.shapes import flower, moved

from shapespline.errors import InvalidInputError
from shapespline.geometry.parametrization import PARAMETRIZATIONS, greville_matched, parametrize
from shapespline.values.contour import Contour

STEPS = [1.0, 4.0, 9.0]
LINE = Contour([(0, 0), (1, 0), (5, 0), (14, 0)])
kinds = pytest.mark.parametrize("kind", PARAMETRIZATIONS)


@pytest.mark.parametrize(
    ("kind", "expected"),
    [
        ("uniform", [0, 1 / 3, 2 / 3, 1]),
        ("chord", [0, 1 / 14, 5 / 14, 1]),
        ("centripetal", [0, 1 / 6, 3 / 6, 1]),
    ],
)
def test_open_by_hand(kind, expected):
    assert parametrize(LINE, kind) == pytest.approx(expected, abs=2 * EPS)


@pytest.mark.parametrize(
    ("kind", "expected"),
    [
        ("uniform", [0, 1 / 3, 2 / 3]),
        ("chord", [0, 3 / 12, 7 / 12]),
        ("centripetal", np.array([0, 3**0.5, 3**0.5 + 2]) / (3**0.5 + 2 + 5**0.5)),
    ],
)
def test_closed_by_hand(kind, expected):
    triangle = Contour([(0, 0), (3, 0), (3, 4)], closed=True)
    assert parametrize(triangle, kind) == pytest.approx(expected, abs=2 * EPS)


@kinds
@pytest.mark.parametrize("closed", [False, True])
def test_they_grow_from_zero_and_do_not_depend_on_place_and_unit(kind, closed):
    contour = Contour(flower(100).points, closed)
    u = parametrize(contour, kind)
    assert u.shape == (100,)
    assert u[0] == 0
    assert (np.diff(u) > 0).all()
    assert (u[-1] < 1) if closed else (u[-1] == 1)
    other = Contour(moved(contour.points, 0.7, 2.5, (3, -4)), closed)
    # Coordinates up to 34 rounded at steps of 1.5 and more, summed 100 times.
    assert np.abs(parametrize(other, kind) - u).max() <= 100 * 34 / 1.5 * EPS


def test_unknown_kind():
    with pytest.raises(InvalidInputError, match="kind must be one of uniform, chord, centripetal,"):
        parametrize(LINE, "foley")


def test_greville_matched_open():
    u = greville_matched(LINE, np.array([0.0, 3.0, 14.0]), np.array([0.0, 0.6, 1.0]), None)
    assert u == pytest.approx([0, 0.2, 0.6 + 0.4 * 2 / 11, 1], abs=4 * EPS)


def test_greville_matched_closed():
    triangle = Contour([(0, 0), (3, 0), (3, 4)], closed=True)
    anchors, abscissae = np.array([1.0, 4.0, 10.0]), np.array([-0.1, 0.2, 0.6])
    u = greville_matched(triangle, anchors, abscissae, 1.0)
    # Before the first anchor: from (10 - 12, 0.6 - 1) to (1, -0.1).
    expected = [-0.4 + 0.3 * 2 / 3, -0.1 + 0.3 * 2 / 3, 0.2 + 0.4 * 3 / 6]
    assert u == pytest.approx(expected, abs=4 * EPS)

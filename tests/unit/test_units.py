"""Units: those of the trade, and what one is in another."""

from __future__ import annotations

import pytest

from shapespline.units import MILLIMETRES, UNITS, checked_unit, conversion


def test_units_are_those_of_the_trade():
    assert MILLIMETRES["in"] == 25.4
    assert MILLIMETRES["ft"] == 304.8
    assert MILLIMETRES["mi"] == pytest.approx(1609344.0, rel=1e-15)
    assert 72 * MILLIMETRES["pt"] == pytest.approx(25.4, rel=1e-15)
    assert all(checked_unit(unit) == unit for unit in (*UNITS, None))


@pytest.mark.parametrize("one", sorted(MILLIMETRES))
@pytest.mark.parametrize("other", ["mm", "in", "px"])
def test_there_and_back_again(one, other):
    there, back = conversion(one, other, dpi=300.0), conversion(other, one, dpi=300.0)
    assert there * back == pytest.approx(1.0, rel=1e-15)

"""Values are equal when what they hold is, have the hash of their value and survive a pickle."""

from __future__ import annotations

import copy
import pickle
from dataclasses import replace

import numpy as np
import pytest
from tests.support.make_fit import blob, fit_of, history, nested, wave

import shapespline as ss

SQUARE = [(0.0, 0.0), (4, 0), (4, 2), (0, 2)]


def values():
    contour = ss.Contour(SQUARE, closed=True)
    fit = ss.fit_curve(contour.resampled(60), tolerance=0.01)
    return {
        "contour": contour,
        "open": ss.Contour(SQUARE, closed=False),
        "accurate": ss.Contour(SQUARE, closed=True, accuracy=0.1),
        "other": ss.Contour([*SQUARE[:3], (0, 2.5)], closed=True),
        "shape": ss.Shape([contour]),
        "with a unit": ss.Shape([contour], unit="mm"),
        "curve": blob(9),
        "clamped": wave(9),
        "piece": fit.pieces[0],
        "next piece": fit.pieces[1],
        "fit": fit,
        "looser": replace(fit, tolerance=0.02),
        "exceeded": replace(fit, status=ss.Status.EXCEEDED),
        "drawing": nested(),
        "one": ss.Drawing([fit]),
    }


@pytest.mark.slow
@pytest.mark.parametrize("name", values())
def test_equal_to_itself_made_again_and_to_nothing_else(name):
    mine = values()[name]
    for other, value in values().items():
        assert (mine == value) == (name == other)
        assert (mine != value) == (name != other)
    assert hash(mine) == hash(values()[name])
    assert mine != 1
    assert len({mine, values()[name]}) == 1


@pytest.mark.parametrize("name", values())
def test_pickles_and_copies_are_equal_and_read_only(name):
    mine = values()[name]
    for again in (pickle.loads(pickle.dumps(mine)), copy.deepcopy(mine)):
        assert again == mine
        assert hash(again) == hash(mine)
    if name == "fit":
        mine.curve  # noqa: B018 - what was computed is not sent along
        again = pickle.loads(pickle.dumps(mine))
        assert "curve" not in vars(again)
        assert not again.parameters.flags.writeable
        assert not again.pieces[0].control_points.flags.writeable


def test_how_long_it_took_is_no_part_of_a_value():
    fit = fit_of(blob(9))
    assert fit == replace(fit, history=history(rate=0.3))


def test_negative_zero_is_zero():
    one, other = ss.Contour([(0.0, 1), (1, 0)]), ss.Contour([(-0.0, 1), (1, -0.0)])
    assert one == other
    assert hash(one) == hash(other)


def test_arrays_of_a_fit_are_read_only():
    fit = values()["fit"]
    for array in (fit.parameters, fit.outliers, fit.pieces[0].control_points, fit.knots):
        with pytest.raises(ValueError, match="read-only"):
            array[:] = 0
    assert np.isfinite(fit.parameters).all()

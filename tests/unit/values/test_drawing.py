"""Drawing: fits and which lies in which."""

from __future__ import annotations

import pytest
from tests.support.make_fit import fit_of, nested, wave

from shapespline.errors import InvalidInputError
from shapespline.values.drawing import Drawing
from shapespline.values.view_box import ViewBox


def test_a_drawing_keeps_its_nesting():
    drawing = nested()
    assert len(drawing) == 4
    assert list(drawing) == list(drawing.fits)
    assert drawing.parents == (-1, 0, 1, -1)
    assert [drawing.is_hole(i) for i in range(4)] == [False, True, False, False]
    alone = Drawing([fit_of(wave())], frame=ViewBox(0, 0, 2, 1))
    assert (alone.parents, alone.frame.height) == ((-1,), 1)
    assert Drawing(iter(drawing.fits)).parents == (-1,) * 4


@pytest.mark.parametrize("parents", [[-1], [0, -1, 5], [3, -1], [1, 0], [-1, 1], [1, 7]])
def test_bad_nesting(parents):
    fit = fit_of(wave())
    with pytest.raises(InvalidInputError, match="parents must"):
        Drawing([fit, fit], parents)


def test_an_empty_drawing():
    with pytest.raises(InvalidInputError, match="fits must hold at least one Fit, got none"):
        Drawing([])

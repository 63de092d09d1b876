"""How strokes look: what can be drawn, and what is refused."""

from __future__ import annotations

import pytest
from tests.support.make_fit import fit_of, wave

import shapespline as ss

LINE = ss.Contour([(0, 0), (4, 0)])


def test_a_stroke_is_a_round_black_pen():
    assert ss.Stroke() == ("#000000", "round", "round")


def test_strokes_belong_to_widths():
    look = ss.Stroke("#c0392b", cap="butt", join="bevel")
    shape = ss.Shape([LINE, LINE], widths=[2, None], strokes=[look, None])
    assert shape.strokes == (look, None)
    assert ss.Shape([LINE]).strokes == (None,)
    drawing = ss.Drawing.of(shape, [fit_of(wave()), fit_of(wave())])
    assert drawing.strokes == drawing.shape.strokes == (look, None)


@pytest.mark.parametrize(
    ("strokes", "message"),
    [
        ([ss.Stroke()], "expected 2, got 1"),
        ([ss.Stroke("red"), None], "like Stroke"),
        ([ss.Stroke(cap="flat"), None], "like Stroke"),
        ([ss.Stroke(join="sharp"), None], "like Stroke"),
        ([("#c0392b", "butt", "bevel"), None], "like Stroke"),
        ([None, ss.Stroke()], "a width each"),
    ],
)
def test_bad_strokes(strokes, message):
    with pytest.raises(ss.InvalidInputError, match=f"strokes must .*{message}"):
        ss.Drawing([fit_of(wave()), fit_of(wave())], widths=[2.0, None], strokes=strokes)


def test_a_width_beyond_all_numbers_is_refused():
    with pytest.raises(ss.InvalidInputError, match="widths must be None or positive numbers"):
        ss.Shape([LINE], widths=[10**400])

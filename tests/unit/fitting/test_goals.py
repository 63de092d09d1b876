"""Goals: what is said of a tolerance that follows the errors of a picture."""

from __future__ import annotations

import re
import warnings

import numpy as np
import pytest
from tests.support.rendering import coverage, dark

import shapespline as ss


def disc(one_bit):
    cover = coverage(lambda x, y: np.hypot(x - 20.2, y - 19.7) <= 14.3, 40, 40)
    return dark(np.round(cover) if one_bit else cover)


def test_steps_of_pixels_are_said_and_what_does_not_follow_them():
    contour = ss.trace(disc(one_bit=True)).longest
    with pytest.warns(ss.PictureWarning, match="tells an outline to 0.62 only") as caught:
        ss.fit_curve(contour, tolerance=0.35)
    enough = re.search(r"give tolerance=([\d.]+)", str(caught[0].message))
    fit = ss.fit_curve(contour, tolerance=float(enough[1]))  # a warning would be an error
    assert fit.n_stored_points <= ss.fit_curve(contour).n_stored_points


@pytest.mark.parametrize(
    "contour",
    [
        ss.trace(disc(one_bit=False)).longest,
        ss.Contour(ss.trace(disc(one_bit=True)).longest.points, closed=True),
    ],
    ids=["greys", "points"],
)
def test_other_outlines_are_followed(contour):
    with warnings.catch_warnings():
        warnings.simplefilter("error", ss.PictureWarning)
        ss.fit_curve(contour, tolerance=0.35)

"""Values shown in a notebook: one line, and a small picture that another reader understands."""

from __future__ import annotations

import io
import re

import numpy as np
import pytest
from svgelements import SVG, Path
from tests.support.make_fit import blob, fit_of, nested, wave

import shapespline as ss

SQUARE = ss.Contour([(0, 0), (4, 0), (4, 2), (0, 2)], closed=True)
HOLE = ss.Contour([(1, 0.5), (2, 0.5), (2, 1.5)], closed=True)
VALUES = [
    SQUARE,
    ss.Contour([(0, 0), (1, 1e-12)]),
    ss.Shape([SQUARE, HOLE, ss.Contour([(5, 0), (6, 3)])], [-1, 0, -1], unit="mm"),
    fit_of(blob(12)),
    fit_of(wave()),
    nested(),
]


def test_one_line_with_sizes_and_status():
    fit = ss.fit_curve(SQUARE.resampled(60), tolerance=0.01)
    assert repr(SQUARE) == "Contour(closed, 4 points, length 12)"
    assert repr(VALUES[2]) == "Shape(3 contours, 9 points, mm)"
    assert repr(ss.Shape([SQUARE])) == "Shape(1 contour, 4 points)"
    assert re.fullmatch(
        r"Fit\(closed, 4 pieces of degree 3, 4 stored points, distance \S+, tolerance 0.01, KEPT\)",
        repr(fit),
    )
    assert re.fullmatch(
        r"Drawing\(1 curve, 4 stored points, distance \S+, 1 of 1 kept\)", repr(ss.Drawing([fit]))
    )
    assert repr(blob(12)) == "BSplineCurve(periodic, degree 3, 12 control points)"
    assert all("\n" not in repr(value) and len(repr(value)) < 120 for value in VALUES)


@pytest.mark.parametrize("value", VALUES, ids=repr)
def test_the_picture_is_small_and_read_by_others(value):
    text = value._repr_svg_()
    assert text == value._repr_svg_()
    read = SVG.parse(io.StringIO(text))
    paths = [element for element in read.elements() if isinstance(element, Path)]
    assert paths
    # The longer side is 240 pixels, 8 of them free on both ends; coordinates are rounded to 0.1.
    low_x, low_y, high_x, high_y = np.transpose(
        [path.bbox() for path in paths if path.values.get("stroke-linecap") != "round"]
    )
    sides = [high_x.max() - low_x.min(), high_y.max() - low_y.min()]
    assert max(sides) == pytest.approx(224, abs=0.2)
    assert min(low_x.min(), low_y.min()) == pytest.approx(8, abs=0.1)
    html = value._repr_html_()
    assert text in html
    assert repr(value) in html


def test_the_picture_of_many_points_stays_small():
    angle = np.linspace(0, 2 * np.pi, 200_000, endpoint=False)
    ring = ss.Contour(np.column_stack([np.cos(angle), np.sin(angle)]), closed=True)
    # A circle of 224 pixels has a circumference of 704: that many tenths, of 11 letters at most.
    assert len(ring._repr_svg_()) < 704 * 10 * 2 * 11


def test_nesting_is_filled_together():
    text = nested()._repr_svg_()
    # Ring and hole in one path, the island in another, the open stroke unfilled, the dots.
    assert len(re.findall("<path", text)) == 4
    assert len(re.findall("fill-rule", text)) == 2
    assert text.split(' d="')[1].split('"')[0].count("M") == 2

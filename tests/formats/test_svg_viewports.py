"""Pages and viewports of SVG: units, percentages, and view boxes that are fitted or stretched."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.support.svg_pages import path, points

from shapespline.geometry.exact import exact_drawing
from shapespline.values.view_box import ViewBox


@pytest.mark.parametrize(
    ("attributes", "scale", "unit"),
    [
        ('viewBox="0 0 40 30"', 1.0, "px"),
        ('width="400" height="300" viewBox="0 0 40 30"', 1.0, "px"),
        ('width="40mm" height="30mm" viewBox="0 0 40 30"', 1.0, "mm"),
        ('width="80mm" height="60mm" viewBox="0 0 40 30"', 2.0, "mm"),
        ('width="4in" height="3in" viewBox="0 0 40 30"', 0.1, "in"),
        ('width="8cm" viewBox="0 0 40 30"', 0.2, "cm"),
        ('width="80mm" height="30mm" viewBox="0 0 40 30"', 1.0, "mm"),  # fitted into the page
        ('width="96mm" height="72mm"', 25.4 / 96, "mm"),  # without view box: CSS pixels
        ('width="100%" height="100%" viewBox="0 0 40 30"', 1.0, "px"),
    ],
)
def test_pages_and_units(drawn, attributes, scale, unit):
    found = drawn(path("M1 2L3 5"), attributes)
    assert found.unit == unit
    assert found.frame.width == pytest.approx(96 if "viewBox" not in attributes else 40 * scale)
    begin, end = np.array(points(found)[0])
    assert (end - begin).tolist() == pytest.approx([2 * scale, -3 * scale], rel=1e-14)
    assert begin[1] == pytest.approx(found.frame.height - 2 * scale, rel=1e-14)


def test_a_view_box_off_the_origin_keeps_its_place(drawn):
    found = drawn(path("M12 22L13 23"), 'viewBox="10 20 40 30"')
    assert points(found) == [[[12.0, 48.0], [13.0, 47.0]]]
    assert found.frame == ViewBox(10, 20, 40, 30)


def test_without_a_page_y_turns_within_its_own_box(drawn):
    found = drawn(path("M0 1L2 5"), "")
    assert points(found) == [[[0.0, 5.0], [2.0, 1.0]]]
    assert found.frame is None


def test_lengths_with_units_are_exact(drawn):
    found = drawn('<rect x="25.4mm" y="0" width="1in" height="72pt"/>')
    assert points(found)[0][1] == pytest.approx([192, 30], rel=1e-14)
    assert points(found)[1][1] == pytest.approx([192, -66], rel=1e-14)


def boxes(outlines):
    return [[round(side, 9) for side in fit.bounds] for fit in exact_drawing(outlines)]


def test_percentages_are_parts_of_the_view_box(drawn):
    found = drawn(
        '<rect x="10%" y="10%" width="50%" height="50%"/><circle cx="80%" cy="50%" r="10%"/>'
        '<use href="#s" x="5%" y="10%"/><defs><rect id="s" width="1%" height="1%"/></defs>',
        'viewBox="3 4 200 100"',
    )
    radius = 10 * math.sqrt((2**2 + 1**2) / 2)  # of the diagonal over the root of two
    assert boxes(found) == [
        pytest.approx(box, abs=1e-8)
        for box in (
            [20, 48, 120, 98],
            [160 - radius, 58 - radius, 160 + radius, 58 + radius],
            [10, 97, 12, 98],
        )
    ]
    page = drawn('<rect width="100%" height="100%"/>', 'width="40" height="30"')
    assert boxes(page) == [[0, 0, 40, 30]]


@pytest.mark.parametrize(
    ("attributes", "expected"),
    [
        ('x="10" y="5"', [11, 22, 13, 23]),
        ('x="10" y="5" width="20" height="10" viewBox="1 1 4 4"', [15, 20, 20, 22.5]),
        ('width="20" height="10" viewBox="0 0 4 4" preserveAspectRatio="none"', [5, 22.5, 15, 25]),
        ('width="20" height="10" viewBox="0 0 4 4" preserveAspectRatio="xMaxYMin"',
         [12.5, 22.5, 17.5, 25]),
        ('width="20" height="10" viewBox="0 0 4 4" preserveAspectRatio="xMidYMax slice"',
         [5, 25, 15, 30]),
        ('x="50%" width="25%" height="50%"', [21, 27, 23, 28]),
    ],
)  # fmt: skip
def test_viewports_in_viewports(drawn, attributes, expected):
    found = drawn(f'<svg {attributes}><rect x="1" y="2" width="2" height="1"/></svg>')
    assert boxes(found) == [expected]


def test_percentages_in_a_viewport_are_parts_of_it(drawn):
    found = drawn('<svg x="10" width="20" height="10"><rect width="50%" height="50%"/></svg>')
    assert boxes(found) == [[10, 25, 20, 30]]


@pytest.mark.parametrize(
    ("attributes", "expected"),
    [
        ('width="100mm" height="50mm" preserveAspectRatio="none"', [10, 5, 90, 45]),
        ('width="100mm" height="50mm"', [5, 5, 45, 45]),
        ('width="100mm" height="50mm" preserveAspectRatio="xMidYMid slice"', [10, 10, 90, 90]),
        ('width="400" height="100" preserveAspectRatio="none"', [4, 1, 36, 9]),
    ],
)
def test_a_page_may_stretch_its_view_box(drawn, attributes, expected):
    found = drawn('<rect x="1" y="1" width="8" height="8"/>', f'{attributes} viewBox="0 0 10 10"')
    assert boxes(found) == [expected]
    assert found.frame.width == pytest.approx(10 / 8 * (expected[2] - expected[0]))


def test_a_stretched_circle_is_an_ellipse(drawn):
    page = 'width="40mm" height="20mm" viewBox="0 0 10 10" preserveAspectRatio="none"'
    fit = exact_drawing(drawn('<circle cx="5" cy="5" r="4"/>', page)).fits[0]
    x, y = (fit.spline(np.linspace(0, 1, 999)) - (20, 10)).T
    assert np.abs(np.hypot(x / 4, y / 2) - 4).max() <= 1.1e-9 * 4

"""The usual pen of branches: most of their length counts, not junctions and bends."""

from __future__ import annotations

import numpy as np
import pytest

from shapespline.tracing.strokes.graph import Branch
from shapespline.tracing.strokes.pen import Pen, usual_pen


def branch(radii):
    points = np.column_stack([np.arange(len(radii)), np.zeros(len(radii))])
    return Branch(points, np.asarray(radii, dtype=float), (-1, -1))


def test_larger_discs_in_junctions_do_not_count():
    radii = [4.0] * 60 + list(np.linspace(4.0, 7.0, 40))
    pen = usual_pen([branch(radii)])
    assert pen is not None
    assert pen.radius == pytest.approx(4.0, abs=1e-9)
    assert pen.spread == pytest.approx(0.0, abs=1e-9)


def test_a_stroke_that_swells_has_no_pen():
    assert usual_pen([branch(np.linspace(1.0, 10.0, 100))]) is None


def test_without_strokes_there_is_none():
    assert usual_pen([]) is None


def test_an_uneven_pen_is_given_more_slack():
    assert Pen(4.0, 0.5).slack > Pen(4.0, 0.0).slack
    assert Pen(4.0, 0.5).apart > Pen(4.0, 0.0).apart

"""One engine alone, asked through the same plan, verification and order of preference."""

from __future__ import annotations

from dataclasses import replace

from shapespline.fitting import Request, Settings
from shapespline.fitting.solve import answer
from shapespline.monitor import Monitor


def fit_pieces(contour, tolerance, **options):
    """The Fit that the strategies in pieces make of a contour, nothing repaired."""
    request = Request.of(contour, None, Settings(tolerance=tolerance, **options))
    return answer(replace(request, pieces_only=True), Monitor())


def fit_spline(contour, tolerance, monitor=None, **options):
    """The Fit that knot removal makes of a contour."""
    settings = Settings(tolerance=tolerance, form="spline", **options)
    return answer(Request.of(contour, None, settings), monitor or Monitor())

"""Snapshot: a curve on the way to a fit."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from shapespline.values.curve import BSplineCurve


class Snapshot(NamedTuple):
    """The curve after an iteration; 0 is the start."""

    iteration: int
    spline: BSplineCurve

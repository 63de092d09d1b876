"""ViewBox: the rectangle that a drawing lives in."""

from __future__ import annotations

from typing import NamedTuple


class ViewBox(NamedTuple):
    """The rectangle a drawing lives in (an image, a view box), y up, in the unit of the data."""

    x: float
    y: float
    width: float
    height: float

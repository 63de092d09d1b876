"""Stroke: how a line that is drawn along a curve looks."""

from __future__ import annotations

import re
import sys
from typing import TYPE_CHECKING, NamedTuple, TypeVar

from shapespline.errors import InvalidInputError
from shapespline.validation import is_number

if TYPE_CHECKING:
    from collections.abc import Sequence

T = TypeVar("T")
COLOR = re.compile("#[0-9a-f]{6}")
BLACK = "#000000"
CAPS, JOINS = ("round", "butt", "square"), ("round", "miter", "bevel")


class Stroke(NamedTuple):
    """How a stroke looks; how wide it is stands in ``widths`` of its shape or drawing.

    Attributes
    ----------
    color : str
        As #rrggbb.
    cap, join : str
        How it ends ("round", "butt" or "square") and turns ("round", "miter" or "bevel"), as in
        SVG.

    Examples
    --------
    >>> Stroke("#c0392b").join
    'round'
    """

    color: str = BLACK
    cap: str = "round"
    join: str = "round"


def one_for_each(
    items: Sequence[T | None] | None, name: str, noun: str, count: int
) -> tuple[T | None, ...]:
    """As many items as asked for; None for each by default.

    Raises
    ------
    InvalidInputError
        If there are not as many.
    """
    if items is None:
        return (None,) * count
    listed = tuple(items)
    if len(listed) != count:
        raise InvalidInputError(
            f"{name} must name one {noun} for each: expected {count}, got {len(listed)}"
        )
    return listed


def checked_widths(widths: Sequence[float | None] | None, count: int) -> tuple[float | None, ...]:
    """For each of ``count`` items the width of its stroke, None for none (the default).

    Raises
    ------
    InvalidInputError
        If there are not as many, or one is no positive number.
    """
    listed = one_for_each(widths, "widths", "width", count)
    for width in listed:
        if width is not None and not (is_number(width) and 0 < width <= sys.float_info.max):
            raise InvalidInputError(f"widths must be None or positive numbers, got {width!r:.40}")
    return tuple(None if width is None else float(width) for width in listed)


def checked_strokes(
    strokes: Sequence[Stroke | None] | None, widths: Sequence[float | None]
) -> tuple[Stroke | None, ...]:
    """For each width how its stroke looks, None for a round black pen (the default).

    Raises
    ------
    InvalidInputError
        If there are not as many, one is no Stroke that can be drawn, or it has no width.
    """
    listed = one_for_each(strokes, "strokes", "Stroke", len(widths))
    for stroke, width in zip(listed, widths, strict=True):
        if stroke is None:
            continue
        if not isinstance(stroke, Stroke) or not (
            isinstance(stroke.color, str)
            and COLOR.fullmatch(stroke.color)
            and stroke.cap in CAPS
            and stroke.join in JOINS
        ):
            raise InvalidInputError(
                f"strokes must be None or like Stroke('#c0392b', cap='butt'), got {stroke!r}"
            )
        if width is None:
            raise InvalidInputError(f"strokes must have a width each, got none for {stroke!r}")
    return listed

"""G-code (RS-274, ISO 6983) for mills, plotters and lasers: G0, G1, and arcs as G2 and G3.

Absolute coordinates; the centre of an arc is told by I and J, from its beginning. Every outline is
approached at a safe height, cut at one depth and left again, holes before the outline around them.
Spindle, tool and coolant are the machine's affair: set them before the program begins.
"""

from __future__ import annotations

from math import ceil, sin, sqrt
from typing import TYPE_CHECKING, cast

import numpy as np

from shapespline.errors import FormatError, InvalidInputError
from shapespline.formats.arc_accuracy import arc_tolerance_of
from shapespline.geometry import in_unit, lines_and_arcs
from shapespline.units import MILLIMETRES, PIXEL
from shapespline.validation import is_number
from shapespline.values import nesting_depth

if TYPE_CHECKING:
    from collections.abc import Iterator

    from shapespline.typing import FloatArray
    from shapespline.values import Arc, Drawing, Fit

# Programs are in one of the two units that machines know.
UNITS = {"mm": "G21", "in": "G20"}
# Decimals that are written: a tenth of a thousandth of a millimetre, and less of an inch.
DECIMALS = {"mm": 4, "in": 5}
FEED, SAFE_HEIGHT = 500.0, 5.0  # mm a minute, mm
# Arcs of larger radius, mm, become chords: controllers that count in single precision keep seven
# digits, of which a centre so far away leaves a micron.
LARGEST_RADIUS = 10_000.0
# Arcs that bow by less than so many of the last decimal are lines.
LEAST_BOW = 2.0
MOST_CHORDS = 100_000


def encode(
    drawing: Drawing,
    *,
    feed: float | None = None,
    depth: float = 0.0,
    safe_height: float | None = None,
    arc_tolerance: float | None = None,
) -> bytes:
    """Text of a G-code program.

    Parameters
    ----------
    drawing : Drawing
        In millimetres (G21) or inches (G20); other lengths become millimetres, numbers without a
        unit are taken for them.
    feed : float, optional
        Units a minute, 500 mm if not given.
    depth : float
        How far below Z0 the tool cuts.
    safe_height : float, optional
        Above Z0, where the tool moves from one outline to the next; 5 mm if not given.
    arc_tolerance : float, optional
        Largest distance between a curve and its arcs, in the unit of the program; a quarter of the
        tolerance of the fit if not given. Lines and arcs of the drawing stay what they are.

    Returns
    -------
    bytes
        ASCII; the same for the same drawing.

    Raises
    ------
    InvalidInputError
        If an option is out of range.
    FormatError
        If the drawing is in pixels.

    Notes
    -----
    Within ``arc_tolerance`` of the curves, both ways, and what four decimals of a millimetre leave:
    arcs that bow by less than 0.0002 mm are lines, and centres are rounded, too.

    Examples
    --------
    >>> import shapespline as ss
    >>> line = ss.fit_curve([(0, 0), (40, 30)], closed=False, tolerance=0.01)
    >>> print(encode(ss.Drawing([line], unit="mm"), depth=2).decode().split("outline 1 of 1)")[1])
    <BLANKLINE>
    G0 X0 Y0
    G1 Z-2 F500
    G1 X40 Y30 F500
    G0 Z5
    M2
    <BLANKLINE>
    """
    if drawing.unit == PIXEL:
        raise FormatError(
            "a machine needs a length and the drawing is in pixels: give unit='mm' and scale, the"
            " size of a pixel"
        )
    unit = drawing.unit if drawing.unit in UNITS else "mm"
    if drawing.unit not in (None, unit):
        drawing = cast("Drawing", in_unit(drawing, unit))
    millimetre = 1.0 / MILLIMETRES[unit]
    feed = round(FEED * millimetre, 1) if feed is None else feed
    safe_height = round(SAFE_HEIGHT * millimetre, 1) if safe_height is None else safe_height
    for name, value, least in (("feed", feed, "positive"), ("safe_height", safe_height, "positive"),
                               ("depth", depth, "0 or more")):  # fmt: skip
        if not (is_number(value) and 0 <= value < np.inf and (value > 0 or least == "0 or more")):
            raise InvalidInputError(f"{name} must be a number, {least}, got {value!r}")
    program = _Program(DECIMALS[unit], millimetre, float(feed))
    order = sorted(range(len(drawing)), key=lambda index: -nesting_depth(drawing.parents, index))
    lines = [
        f"(lines and arcs of {len(drawing)} outline{'s' * (len(drawing) > 1)}, {unit})",
        f"G17 {UNITS[unit]} G90 G91.1 G94",
        f"G0 Z{program.number(safe_height)}",
    ]
    for number, index in enumerate(order, start=1):
        fit = drawing.fits[index]
        accuracy = arc_tolerance_of(fit, arc_tolerance)
        lines += [
            f"(outline {number} of {len(drawing)}{_said(fit, accuracy, unit)})",
            *program.outline(fit, accuracy, float(depth)),
            f"G0 Z{program.number(safe_height)}",
        ]
    return "\n".join([*lines, "M2", ""]).encode("ascii")


def _said(fit: Fit, accuracy: float, unit: str) -> str:
    """How near arcs come to a curve that has others."""
    if all(piece.arc or piece.kind == "line" for piece in fit.pieces):
        return ""
    return f", arcs within {accuracy:.3g} {unit} of its curve"


class _Program:
    """Blocks of a program, in its own unit, as rounded numbers."""

    def __init__(self, decimals: int, millimetre: float, feed: float) -> None:
        self.decimals, self.last = decimals, 10.0**-decimals
        self.largest_radius = LARGEST_RADIUS * millimetre
        self.feed = f"F{self.number(feed)}"

    def number(self, value: float) -> str:
        """A number without exponent, and without zeros that say nothing."""
        text = f"{value:.{self.decimals}f}"
        text = text.rstrip("0").rstrip(".")
        return "0" if text == "-0" else text

    def _place(self, point: FloatArray) -> FloatArray:
        return np.round(point, self.decimals)

    def _to(self, point: FloatArray) -> str:
        return f"X{self.number(point[0])} Y{self.number(point[1])}"

    def outline(self, fit: Fit, accuracy: float, depth: float) -> Iterator[str]:
        """The way to one outline, down and around."""
        pieces = lines_and_arcs(fit, accuracy)
        at = self._place(pieces[0].control_points[0])
        yield f"G0 {self._to(at)}"
        yield f"G1 Z{self.number(-depth)} {self.feed}"
        for piece in pieces:
            points = piece.control_points
            for end, arc in _moves(piece.arc, points, accuracy, self.largest_radius):
                to = self._place(end)
                if (to == at).all():  # an arc to its own beginning would be a whole circle
                    continue
                yield self._block(at, to, arc)
                at = to

    def _block(self, at: FloatArray, to: FloatArray, arc: Arc | None) -> str:
        """A move along a line or an arc, between rounded places."""
        if arc is not None:
            bow = 2.0 * arc.radius * sin(0.25 * arc.sweep) ** 2
            if bow > LEAST_BOW * self.last:
                i, j = np.asarray(arc.centre) - at
                way = "G3" if arc.sweep > 0 else "G2"
                return f"{way} {self._to(to)} I{self.number(i)} J{self.number(j)} {self.feed}"
        return f"G1 {self._to(to)} {self.feed}"


def _moves(
    arc: Arc | None, points: FloatArray, accuracy: float, largest_radius: float
) -> Iterator[tuple[FloatArray, Arc | None]]:
    """Where each move of a piece ends: along a line, or an arc of half a turn at most."""
    if arc is None:
        yield from ((point, None) for point in points[1:])
        return
    # A chord over an angle bows by R angle^2 / 8; a whole circle would end where it begins.
    flat = arc.radius > largest_radius
    largest = sqrt(8.0 * accuracy / arc.radius) if flat else np.pi
    count = max(1, min(MOST_CHORDS, ceil(abs(arc.sweep) / largest - 1e-9)))
    for k in range(count):
        part = arc.part(k / count, (k + 1) / count)
        yield points[-1] if k == count - 1 else part.end, None if flat else part

"""Centre lines of strokes: open curves that meet in junctions, instead of outlines around the ink.

Each part of the ink is read in two ways: as strokes of any width, whose middles are its medial
axis, and as strokes of one round pen, whose middle each side of the ink tells alone. What would
leave the ink that is there is given back.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.errors import DegenerateContourError
from shapespline.tracing.strokes.ink import Ink
from shapespline.tracing.strokes.medial_axis import medial_axis
from shapespline.tracing.strokes.medial_strokes import medial_strokes
from shapespline.tracing.strokes.pen import usual_pen
from shapespline.tracing.strokes.pen_strokes import pen_strokes
from shapespline.tracing.strokes.stroke import Stroke
from shapespline.values import Contour, Shape

if TYPE_CHECKING:
    from collections.abc import Sequence

    from scipy.spatial import cKDTree

    from shapespline.tracing.strokes.graph import Branch, Graph
    from shapespline.tracing.strokes.pen import Pen
    from shapespline.typing import FloatArray, IntArray

# A part of the ink has a pen of its own if its strokes are so many radii long; others were drawn
# with that of the whole picture.
OWN_PEN = 6.0
# Pens whose radii differ by less than this part are one.
SAME_PEN = 0.02
# Thinner strokes have sides of too few pixels to tell one by one.
LEAST_RADIUS = 1.6
# Ink is a pen's if its outlines are in the mean within so many pixels and this part of the radius
# of where the pen leaves them, and if it is not drawn much more than once (TRC-26).
FITS, FITS_PART, TWICE = 0.35, 0.01, 1.35
# The pen is believed where its strokes explain the outlines as well, but for this part and so many
# pixels (TRC-26).
AS_WELL, AS_WELL_PIXELS = 1.05, 0.02
# So many radii from the end of a stroke are around it.
AROUND = 1.2
# Where ink is out of the reach of the pen it is if they do so by this part, and that ink is within
# so many radii: some stroke was not led on as it should.
BETTER, REACH = 0.8, 2.0
# Pixels that a dot is long as a stroke, at least.
DOT_LENGTH = 0.1


class _Discs(NamedTuple):
    """Discs within the ink that touch its outline on two sides."""

    places: FloatArray
    radii: FloatArray


def centerlines(shape: Shape) -> Shape:
    """Centre lines of the ink within outlines and outside their holes.

    Parameters
    ----------
    shape : Shape
        As traced: closed contours, nested, in pixels.

    Returns
    -------
    Shape
        Open contours from end to end, end to junction or junction to junction, which share their
        junctions to the bit, and closed ones of rings; the longest first. A line ends where the
        pen did: at a square end of the ink, in the middle of a round one. Dots are lines of a tenth
        of a pixel. ``widths`` holds the usual width of each stroke.

    Raises
    ------
    DegenerateContourError
        If there is no stroke: dots alone have no centre line.

    Examples
    --------
    >>> bar = Contour([(0, 0), (40, 0), (40, 4), (0, 4)], closed=True)
    >>> shape = centerlines(Shape([bar]))
    >>> (line,) = shape
    >>> line.closed, bool(np.abs(line.points[:, 1] - 2).max() < 1e-9), round(line.length, 9)
    (False, True, 40.0)
    >>> round(shape.widths[0], 6)
    4.0
    """
    ink = Ink.of(shape)
    axis = medial_axis(shape, ink.outlines)
    branches = list(axis.branches())
    # Strokes that are hardly longer than wide are spurs of each other.
    pen = usual_pen(branches or medial_axis(shape, ink.outlines, with_spurs=True).branches())
    strokes = _strokes(ink, axis, branches, pen)
    if not strokes:
        raise DegenerateContourError(
            "no stroke in the picture: what there is has no centre line longer than it is wide;"
            " trace its outline instead"
        )
    lines = [Contour.silently(stroke.points, stroke.closed) for stroke in strokes]
    order = sorted(range(len(lines)), key=lambda index: -lines[index].length)
    return Shape(
        [lines[index] for index in order],
        frame=shape.frame,
        unit=shape.unit,
        widths=[strokes[index].width for index in order],
    )


def _strokes(ink: Ink, axis: Graph, branches: Sequence[Branch], usual: Pen | None) -> list[Stroke]:
    """Of all parts, each by the way that explains it; no dots alone."""
    of_part: dict[int, list[Branch]] = {part: [] for part in ink.parts}
    for branch in branches:
        of_part[ink.part_at(branch.points[len(branch.points) // 2])].append(branch)
    discs, part_of_disc = _discs(ink, axis)
    strokes, dots = [], []
    for part, own in of_part.items():
        within = _Discs(*(values[part_of_disc == part] for values in discs))
        found = medial_strokes(axis, own, ink.tree)
        found = _explaining(found, ink.outlines_of(part), ink.tree, _pens(usual, own), within)
        strokes += found
        if not found:
            dots.append(_dot(np.concatenate(ink.outlines_of(part)[:1])))
    return [*strokes, *dots] if strokes else []


def _pens(usual: Pen | None, branches: Sequence[Branch]) -> list[Pen]:
    """Pens that may have drawn a part of the ink."""
    pens = [] if usual is None else [usual]
    length = sum(_length(branch.points) for branch in branches)
    if usual is not None and length > OWN_PEN * usual.radius:
        own = usual_pen(branches)
        if own is not None:
            is_usual = abs(own.radius - usual.radius) <= SAME_PEN * usual.radius
            pens = [own] if is_usual else [usual, own]
    return [pen for pen in pens if pen.radius >= LEAST_RADIUS]


def _discs(ink: Ink, axis: Graph) -> tuple[_Discs, IntArray]:
    """The largest discs in the ink, and the part that each is in."""
    nodes = np.array(sorted(axis.links), dtype=int)
    places = axis.points[nodes]
    return _Discs(places, axis.radii[nodes]), ink.part_of_point[ink.tree.query(places)[1]]


def _explaining(
    found: list[Stroke],
    outlines: Sequence[FloatArray],
    tree: cKDTree,
    pens: Sequence[Pen],
    discs: _Discs,
) -> list[Stroke]:
    """Strokes of a part: those of a pen, if they leave its ink as well as those that were found.

    Of what is wider than the pen some ink is out of its reach.
    """
    from scipy.spatial import cKDTree

    outline, area = np.concatenate(outlines), sum(_area(points) for points in outlines)
    best, least, as_found = found, np.inf, _misfit(found, outline)
    for pen in pens:
        drawn = pen_strokes(outlines, pen, tree)
        misfit = _misfit(drawn, outline)
        length = sum(_length(stroke.points) for stroke in drawn)
        is_one_pen = misfit <= FITS + FITS_PART * pen.radius
        if misfit >= least or not is_one_pen or length > TWICE * area / (2.0 * pen.radius):
            continue
        places = discs.places[discs.radii > pen.radius - pen.slack]
        off = cKDTree(np.concatenate([stroke.points for stroke in drawn])).query(places)[0]
        out_of_reach = float(off.max(initial=0.0)) - pen.slack
        allowed = AS_WELL * as_found + AS_WELL_PIXELS
        if out_of_reach > pen.radius:
            allowed = BETTER * as_found if out_of_reach <= REACH * pen.radius else 0.0
        if misfit <= allowed:
            best, least = drawn, misfit
    return best


def _length(points: FloatArray) -> float:
    return float(np.hypot(*np.diff(points, axis=0).T).sum())


def _area(outline: FloatArray) -> float:
    """Of the ink within an outline; of a hole negative."""
    x, y = outline.T
    return 0.5 * float(x @ np.roll(y, -1) - np.roll(x, -1) @ y)


def _misfit(strokes: Sequence[Stroke], outline: FloatArray) -> float:
    """How far, in the mean, an outline is from that of the ink that strokes would leave.

    What is around the end of a stroke does not count: it may be square.
    """
    from scipy.spatial import cKDTree

    if not strokes:
        return np.inf
    points = np.concatenate([stroke.points for stroke in strokes])
    sizes = [len(stroke.points) for stroke in strokes]
    radii = np.repeat([0.5 * stroke.width for stroke in strokes], sizes)
    is_end = np.zeros(len(points), dtype=bool)
    last = np.cumsum(sizes) - 1
    is_end[last] = is_end[last - np.array(sizes) + 1] = True
    off, nearest = cKDTree(points).query(outline)
    around = is_end[nearest] & (off <= AROUND * radii[nearest])
    misfits = np.minimum(np.abs(off - radii[nearest]), radii[nearest])[~around]
    return float(misfits.mean()) if len(misfits) else 0.0


def _dot(outline: FloatArray) -> Stroke:
    """A stroke as short as a dot is wider one way than the other."""
    middle = 0.5 * (outline.min(axis=0) + outline.max(axis=0))
    _, _, axes = np.linalg.svd(outline - outline.mean(axis=0), full_matrices=False)
    long, wide = (float(np.ptp(outline @ axis)) for axis in axes)
    half = 0.5 * max(long - wide, DOT_LENGTH) * axes[0]
    return Stroke(np.array([middle - half, middle + half]), closed=False, width=wide)

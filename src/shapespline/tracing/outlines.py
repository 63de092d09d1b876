"""Image to shape: sub-pixel outlines of what stands out from the background.

The picture is reduced to one value per pixel and cut at one level. The level line leads along the
edges; where the grey across an edge is that of a drawing, the outline is put where it was drawn
(:mod:`shapespline.tracing.edges`), corners included (:mod:`shapespline.tracing.corners`).
Everything automatic here looks at the whole picture once: the level is Otsu's, the background is
what most of the rim is, or the light corners beside a figure that fills the picture. That is right
for drawings, scans, glyphs and objects on an even ground; it is no segmentation of busy
photographs, where a picture with the object cut out (transparent ground) serves better.
"""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Literal, TypeAlias

import numpy as np

from shapespline.errors import DegenerateContourError, PictureWarning, caller_level
from shapespline.geometry import containing, signed_area
from shapespline.monitor import silent
from shapespline.tracing.edges import level_shares
from shapespline.tracing.lines import distinct, drawn_lines
from shapespline.tracing.specks import is_speck, loop_areas
from shapespline.units import PIXEL
from shapespline.values import Contour, Shape, ViewBox, nesting_depth

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.monitor import Say
    from shapespline.tracing.crossings import Crossings
    from shapespline.tracing.field import Field
    from shapespline.tracing.lines import Line
    from shapespline.tracing.seeing import Seeing
    from shapespline.typing import ArrayLike, BoolArray, FloatArray

Selection: TypeAlias = Literal["all", "longest"]

SELECTIONS = ("all", "longest")

# Outlines that stand out from the noise; with more a picture is no drawing.
MOST_OUTLINES = 20_000


def ink_outlines(
    image: ArrayLike,
    seeing: Seeing,
    contours: Selection = "all",
    min_area: float | None = None,
    say: Say = silent,
) -> tuple[Shape, int]:
    """Outlines of ink, between the pixels; as :func:`shapespline.trace` tells.

    Of a picture that was enlarged they are those of the smaller one: the factor is returned beside.
    """
    field, found = seeing.field(image, say)
    places = found.places(field.shape[0], level_shares(field, found))
    areas = loop_areas(places, found.loops)
    kept = _kept(field, found, places, areas, min_area)
    if contours == "longest":
        longest = max(np.flatnonzero(kept), key=lambda index: _length(places[found.loops[index]]))
        kept, selected = np.arange(len(kept)) == longest, kept
    else:
        selected = kept
    drawn = drawn_lines(field, found, places, kept, say)
    # Around a pixel that differs from the level by a rounding there is no outline.
    lines = [line for line in drawn if min(len(line.points), len(line.level_line)) > 2]
    if not lines:
        raise DegenerateContourError(
            "the outlines of the picture enclose nothing; choose another level or channel"
        )
    specks = [places[found.loops[index]] for index in np.flatnonzero(~selected)]
    return _shape(lines, specks, field), field.scale


def _kept(
    field: Field, found: Crossings, places: FloatArray, areas: FloatArray, min_area: float | None
) -> BoolArray:
    """Which outlines are more than specks, at least one; a warning tells of the others."""
    sizes = np.abs(areas) * field.scale**2
    if min_area is not None:
        kept = sizes >= min_area
        if not kept.any():
            raise DegenerateContourError(
                f"no outline encloses {min_area:g} square pixels, the largest"
                f" {sizes.max(initial=0.0):.3g}; lower min_area or choose another level or channel"
            )
    else:
        kept = ~is_speck(field, found, places, areas)
        if not kept.any():
            raise DegenerateContourError(
                f"no outline stands out from the noise of the picture, {len(kept)} specks do not;"
                " blur it, choose another level or channel, or keep them with min_area=0"
            )
    if kept.sum() > MOST_OUTLINES:
        raise DegenerateContourError(
            f"the picture has {kept.sum()} outlines, more than {MOST_OUTLINES}: it is noise or a"
            " texture; blur it, scale it down or give a min_area"
        )
    if min_area is None and not kept.all():
        specks = "1 speck" if (~kept).sum() == 1 else f"{(~kept).sum()} specks"
        least = max(1, int(np.ceil(sizes[~kept].max())))
        warnings.warn(
            f"{specks} below {least} square pixel{'s' * (least > 1)} left out as noise or texture:"
            " --min-area 0 (min_area=0) keeps them",
            PictureWarning,
            stacklevel=caller_level(),
        )
    return kept


def _shape(lines: Sequence[Line], specks: Sequence[FloatArray], field: Field) -> Shape:
    """Outlines by area, oriented, their nesting found along the level lines, which do not cross."""
    height, width = field.shape
    parents, order, turned = nesting([line.level_line for line in lines])
    contours = [
        # Corners that are put back may meet in noise.
        Contour.silently(
            lines[index].points[:: -1 if turn else 1],
            closed=True,
            accuracy=lines[index].accuracy,
            level_line=lines[index].level_line[:: -1 if turn else 1],
        )
        for index, turn in zip(order, turned, strict=True)
    ]
    left_out = [Contour(points, closed=True) for points in map(distinct, specks) if len(points) > 2]
    return Shape(contours, parents, ViewBox(0, 0, width, height), PIXEL, left_out=left_out)


def nesting(outlines: Sequence[FloatArray]) -> tuple[list[int], list[int], list[bool]]:
    """Order, orientation and nesting of outlines that do not cross.

    Parameters
    ----------
    outlines : sequence of ndarray, shape (n_i, 2)
        Vertices of simple polygons, none crossing another.

    Returns
    -------
    parents : list of int
        In the new order, which is that of falling areas: a parent comes before its children.
    order : list of int
        The outlines in that order.
    turned : list of bool
        Which of them have to be reversed for outer ones to run counter-clockwise, and those inside
        an odd number of others clockwise.

    Examples
    --------
    >>> square = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    >>> nesting([square, 4 * square - 1])
    ([-1, 0], [1, 0], [False, True])
    """
    areas = [signed_area(points) for points in outlines]
    order = sorted(range(len(outlines)), key=lambda i: -abs(areas[i]))
    parents = containing([outlines[i] for i in order])
    outers = [nesting_depth(parents, index) % 2 == 0 for index in range(len(order))]
    turned = [outer != (areas[i] > 0) for i, outer in zip(order, outers, strict=True)]
    return parents, order, turned


def _length(points: FloatArray) -> float:
    steps = points - np.roll(points, 1, axis=0)
    return float(np.hypot(steps[:, 0], steps[:, 1]).sum())

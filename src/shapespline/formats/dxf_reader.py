"""DXF drawings as exact curves, by ezdxf: entities that meet end to end become outlines."""

from __future__ import annotations

import logging
import math
import warnings
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from shapespline.errors import FormatError, SkippedContentWarning, caller_level
from shapespline.formats.chains import chained
from shapespline.formats.elliptic import elliptical_arc
from shapespline.formats.pieces import bezier, size_of
from shapespline.formats.splines import spline_pieces
from shapespline.geometry import Outlines, bulge_piece

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator
    from pathlib import Path

    from ezdxf.document import Drawing as Document

    from shapespline.typing import FloatArray
    from shapespline.values import Piece

# Each kind has attributes of its own.
Entity: TypeAlias = Any
# $INSUNITS
UNITS = {1: "in", 2: "ft", 3: "mi", 4: "mm", 5: "cm", 6: "m", 7: "km", 9: "mil", 10: "yd",
         13: "um", 14: "dm"}  # fmt: skip
# Entities of all blocks after they have been exploded, vertices of their polylines and splines, and
# how deep blocks lie in one another (FMT-09).
MOST_ENTITIES, MOST_VERTICES = 200_000, 1_000_000
DEEPEST = 50
# Points that a spline without control points goes through: ezdxf's system for them is quadratic.
MOST_FIT_POINTS = 1000
# Control points of a two-dimensional polyline that its curve does not pass.
FRAME_POINT = 16
# Heights that differ by more, of the size of the drawing, make it three-dimensional.
FLAT = 1e-6


def read(path: Path) -> Outlines:
    """Read the outlines in the model space of a DXF drawing.

    LINE, ARC, CIRCLE, LWPOLYLINE, POLYLINE and SPLINE are exact; ELLIPSE becomes cubics within a
    billionth of its size, as do splines with weights that are no arcs of circles. Blocks are
    exploded, and entities that meet end to end are joined. Layers that are off or frozen are left
    out; heights are, too.

    Parameters
    ----------
    path : Path

    Returns
    -------
    Outlines
        In the unit that $INSUNITS names, if it does.

    Raises
    ------
    FormatError
        If the file is no DXF, is cut off or damaged, or holds no curve.

    Warns
    -----
    SkippedContentWarning
        If there are entities that are no curves, such as text, that repeat others, or heights that
        differ.
    OpenOutlinesWarning
        If ends of open outlines almost meet.
    """
    document = _document(path)
    runs: list[list[Piece]] = []
    heights: list[float] = []
    skipped: dict[str, None] = {}
    for entity in _shown(document):
        kind = entity.dxftype()
        convert = PIECES.get(kind)
        if convert is None:
            skipped[kind] = None
            continue
        try:
            points = convert(entity, heights)
        except (ValueError, TypeError, ArithmeticError, LookupError, AttributeError) as error:
            raise FormatError(f"a {kind} cannot be understood: {error}") from error
        if not points:
            skipped[f"{kind} without a curve"] = None
        runs.append(points)
    finite = [run for run in runs if _is_finite(run)]
    if len(finite) < len(runs):
        raise FormatError("a coordinate is not a finite number")
    curves = chained(runs, path.name)
    if not curves:
        raise FormatError(
            "the model space holds no curve" + (f", only {', '.join(skipped)}" if skipped else "")
        )
    size = size_of([piece for pieces in curves for piece in pieces])
    remarks = []
    if skipped:
        remarks.append(f"entities that are no curves were left out: {', '.join(skipped)}")
    if np.ptp(heights or [0.0]) > FLAT * size:
        remarks.append("the drawing is not flat, and was taken as seen from above")
    for remark in remarks:
        warnings.warn(f"{path.name}: {remark}", SkippedContentWarning, stacklevel=caller_level())
    return Outlines(curves, None, UNITS.get(document.header.get("$INSUNITS", 0)))


def _document(path: Path) -> Document:
    import ezdxf

    logging.getLogger("ezdxf").setLevel(logging.CRITICAL)
    try:
        return ezdxf.readfile(path)
    except MemoryError:
        raise
    except Exception as error:  # whatever a damaged file makes the library stumble over
        sentence = " ".join(f"{error!s}".replace(str(path), path.name).split())
        raise FormatError(
            f"no DXF drawing, or damaged: {sentence or type(error).__name__}"
        ) from error


def _shown(document: Document) -> list[Entity]:
    try:
        return list(_visible(document))
    except (FormatError, MemoryError):
        raise
    except Exception as error:  # whatever a damaged block makes the library stumble over
        raise FormatError(f"its blocks cannot be exploded: {error}") from error


def _visible(document: Document) -> Iterator[Entity]:
    """Entities of the model space that are shown, blocks exploded."""
    hidden = {
        layer.dxf.name.lower() for layer in document.layers if layer.is_off() or layer.is_frozen()
    }
    _check_blocks(document)

    def exploded(entities: Iterable[Entity]) -> Iterator[Entity]:
        for entity in entities:
            kind = entity.dxftype()
            if kind not in PIECES and kind != "INSERT":
                yield entity  # to be named; it may lack the attributes asked for below
            elif entity.dxf.get("invisible", 0) or entity.dxf.layer.lower() in hidden:
                continue
            elif kind != "INSERT":
                yield entity
            elif entity.mcount > 1:
                yield from exploded(entity.multi_insert())
            else:
                yield from exploded(entity.virtual_entities())

    yield from exploded(document.modelspace())


def _check_blocks(document: Document) -> None:
    """Raise if the blocks make too much, before any of them is exploded."""
    known: dict[str, FloatArray] = {}

    def made_by(entities: Iterable[Entity], inside: tuple[str, ...]) -> FloatArray:
        """Entities and vertices, floats: products of arrays in arrays grow beyond integers."""
        total = np.zeros(2)
        for entity in entities:
            if entity.dxftype() != "INSERT":
                total += (1, _n_vertices(entity))
                continue
            name = str(entity.dxf.get("name", "")).lower()
            if name in inside:
                raise FormatError(f"the block {name!r} holds itself; purge the drawing")
            if len(inside) >= DEEPEST:
                raise FormatError(f"blocks lie in one another more than {DEEPEST} deep")
            if name not in known:
                known[name] = made_by(entity.block() or (), (*inside, name))
            total += entity.mcount * (known[name] + (1, 0))
        return total

    inserts = [entity for entity in document.modelspace() if entity.dxftype() == "INSERT"]
    for made, most, what in zip(
        made_by(inserts, ()), (MOST_ENTITIES, MOST_VERTICES), ("entities", "vertices"), strict=True
    ):
        if made > most:
            raise FormatError(
                f"its blocks make {made:.0f} {what}, more than {most}; explode and thin them in the"
                " drawing program"
            )


def _n_vertices(entity: Entity) -> int:
    """Points that an entity of a block copies."""
    kind = entity.dxftype()
    if kind == "SPLINE":
        return len(entity.control_points) + len(entity.fit_points)
    if kind in ("LWPOLYLINE", "POLYLINE"):
        return len(entity)
    return 1


def _is_finite(run: list[Piece]) -> bool:
    return all(bool(np.isfinite(piece.control_points).all()) for piece in run)


# Pieces of each kind of entity; heights are noted.


def _flat(points: Iterable[object], heights: list[float]) -> FloatArray:
    """Points of the world without their heights, shape (n, 2)."""
    from ezdxf.math import Vec3

    found = np.array([Vec3(point).xyz for point in points], dtype=np.float64).reshape(-1, 3)
    heights += [float(found[:, 2].min()), float(found[:, 2].max())] if len(found) else []
    return found[:, :2]


def _line(entity: Entity, heights: list[float]) -> list[Piece]:
    return [bezier(_flat((entity.dxf.start, entity.dxf.end), heights))]


def _arc(entity: Entity, heights: list[float]) -> list[Piece]:
    ocs, radius = entity.ocs(), entity.dxf.radius
    centre = _flat([ocs.to_wcs(entity.dxf.center)], heights)[0]
    first, second = _flat([ocs.to_wcs((radius, 0, 0)), ocs.to_wcs((0, radius, 0))], [])
    if entity.dxftype() == "CIRCLE":
        return elliptical_arc(centre, first, second, 0.0, 2 * math.pi)
    begin, end = math.radians(entity.dxf.start_angle), math.radians(entity.dxf.end_angle)
    return elliptical_arc(centre, first, second, begin, _turn(begin, end))


def _ellipse(entity: Entity, heights: list[float]) -> list[Piece]:
    centre = _flat([entity.dxf.center], heights)[0]
    first, second = _flat([entity.dxf.major_axis, entity.minor_axis], [])
    begin, end = entity.dxf.start_param, entity.dxf.end_param
    return elliptical_arc(centre, first, second, begin, _turn(begin, end))


def _turn(begin: float, end: float) -> float:
    """Anticlockwise angle, above 0 and up to a full turn."""
    turn = math.fmod(end - begin, 2 * math.pi)
    # Angles come in degrees or with few digits: a rounding short of a turn is a turn.
    return turn + 2 * math.pi if turn <= 1e-12 else turn


def _polyline(entity: Entity, heights: list[float]) -> list[Piece]:
    ocs = entity.ocs()
    if entity.dxftype() == "LWPOLYLINE":
        given = [(x, y, entity.dxf.elevation, bulge) for x, y, bulge in entity.get_points("xyb")]
        closed = entity.closed
    else:
        if not (entity.is_2d_polyline or entity.is_3d_polyline):
            return []  # meshes
        vertices = [v.dxf for v in entity.vertices if not v.dxf.flags & FRAME_POINT]
        given = [(*v.location.xyz, v.get("bulge", 0.0)) for v in vertices]
        closed = entity.is_closed
        if entity.is_3d_polyline:
            ocs = None
    if len(given) < 2:
        return []
    points, bulges = np.array(given)[:, :3], np.array(given)[:, 3]
    world = _flat(points if ocs is None else ocs.points_to_wcs(points), heights)
    # Seen from behind, left is right.
    bulges = bulges if ocs is None or ocs.uz.z >= 0 else -bulges
    after = np.roll(world, -1, axis=0)
    last = len(world) if closed else len(world) - 1
    return [bulge_piece(world[k], after[k], float(bulges[k])) for k in range(last)]


def _spline(entity: Entity, heights: list[float]) -> list[Piece]:
    if not entity.control_point_count() and entity.fit_point_count() > MOST_FIT_POINTS:
        raise FormatError(
            f"a SPLINE has {entity.fit_point_count()} fit points and no control points, more than"
            f" {MOST_FIT_POINTS}; save it with control points"
        )
    spline = entity.construction_tool()  # makes a curve of fit points where there is no other
    points = _flat(spline.control_points, heights)
    weights = list(spline.weights()) or None
    return spline_pieces(spline.degree, list(spline.knots()), points, weights)


PIECES: dict[str, Callable[[Entity, list[float]], list[Piece]]] = {
    "LINE": _line,
    "ARC": _arc,
    "CIRCLE": _arc,
    "ELLIPSE": _ellipse,
    "LWPOLYLINE": _polyline,
    "POLYLINE": _polyline,
    "SPLINE": _spline,
}

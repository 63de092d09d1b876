"""JSON: our own format, versioned and lossless; every field of every fit, bit for bit.

It is one object::

    format   "shapespline"
    version  1, or 2 if there are arcs or regularities
    unit     of all lengths, such as "mm", or null
    frame    {x, y, width, height} or null
    parents  for each fit the index of the one directly around it, -1 for none
    colors   for each fit its colour as #rrggbb or null; not there if no fit has one
    widths   for each fit how wide the stroke along it is, or null; not there if there are none
    strokes  for each fit [color, cap, join] of its stroke, or null; not there if there are none
    reference  name of the coordinate reference system; not there if it is not known
    regularities  as of a fit, with indices of fits for pieces; not there if there are none
    fits     objects with the fields of shapespline.drawing.Fit:
        spline       {degree, periodic, knots, control_points: distinct, as [x, y]}
        contour      {closed, points: as [x, y], source: null if each point stands for itself,
                     accuracy: null if not known, level_line: as [x, y], if there is one}
        parameters   one for each point that was given
        max_distance, rms_distance, hausdorff_distance, tolerance
        status       {name, value}
        history      columns, one value for each iteration; null where it was not computed
        method       name of the solver
        sections     {kind, degree, knots, control_points} end to end; none for a single spline;
                     of an arc also arc {centre, radius, start_angle, sweep}, whose twin the
                     others are
        outliers     indices of the points left out
        regularities {name, pieces: indices of sections, off, order}; not there if there are none
        uncertainty  null, or covariance of the control points, chi_squared, degrees_of_freedom,
                     precisions

Numbers are written with the shortest digits that read back to the same double.
"""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from shapespline.errors import FormatError, InvalidInputError
from shapespline.formats.json_pieces import (
    checked_pieces,
    checked_regularities,
    piece_document,
    regularities_document,
)
from shapespline.formats.json_uncertainty import checked_uncertainty, uncertainty_document
from shapespline.formats.json_values import (
    checked_boolean,
    checked_indices,
    checked_integer,
    checked_list,
    checked_number,
    checked_number_or_null,
    checked_numbers,
    checked_object,
    checked_points,
    checked_string,
    refused,
    stroke_or_null,
    without_repeats,
)
from shapespline.monitor import Iteration
from shapespline.units import UNITS
from shapespline.values import (
    BSplineCurve,
    Contour,
    Drawing,
    Fit,
    Status,
    ViewBox,
)

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from shapespline.typing import FloatArray

T = TypeVar("T")
FORMAT, VERSION, AS_DRAWN = "shapespline", 1, 2
LINE_LENGTH = 100
DISTANCES = ("max_distance", "rms_distance", "hausdorff_distance", "tolerance")
FIT_FIELDS: tuple[str, ...] = ("spline", "contour", "parameters", *DISTANCES)
FIT_FIELDS += ("status", "history", "method", "sections", "outliers", "uncertainty")
LISTED = (
    "colors",
    "widths",
    "strokes",
)  # for each fit; in a document, as others, only where there are some
NOT_ALWAYS = (*LISTED, "reference", "regularities")
DRAWING_FIELDS = ("format", "version", "unit", "frame", "parents", "fits")
CONTOUR_FIELDS: tuple[str, ...] = ("closed", "points", "source", "accuracy")
COUNTS = ("iteration", "evaluations")  # the columns of the history that hold integers
KNOWN = (Status.KEPT, Status.EXCEEDED, Status.BUDGET, Status.CANCELLED)
STATUSES = {status.name: status for status in KNOWN}


def encode(drawing: Drawing) -> bytes:
    r"""Text of a JSON file that :func:`read` turns back into the same drawing.

    Parameters
    ----------
    drawing : Drawing

    Returns
    -------
    bytes
        UTF-8, ASCII only; the same for the same drawing.

    Raises
    ------
    FormatError
        If a value is infinite, or NaN elsewhere than in a history: JSON has no such numbers.

    Examples
    --------
    >>> from shapespline.values import clamped_knots
    >>> fit = Fit(
    ...     spline=BSplineCurve(clamped_knots(2, 1), [(0, 0), (8, 0)], degree=1),
    ...     contour=Contour([(0, 0), (8, 0)]), parameters=np.array([0.0, 1.0]),
    ...     max_distance=0.0, rms_distance=0.0, hausdorff_distance=0.0, tolerance=0.1,
    ...     status=Status.KEPT, history=(), method="by hand",
    ... )
    >>> encode(Drawing([fit])).decode().splitlines()[1]
    ' "format": "shapespline",'
    """
    frame = drawing.frame
    document: dict[str, Any] = {
        "format": FORMAT,
        "version": AS_DRAWN if _is_drawn(drawing) else VERSION,
        "unit": drawing.unit,
        "frame": None if frame is None else _numbers_of(frame._asdict(), "frame"),
        "parents": list(drawing.parents),
        "fits": [_fit_document(fit) for fit in drawing],
    }
    document |= {name: [*getattr(drawing, name)] for name in LISTED if any(getattr(drawing, name))}
    document |= {"reference": drawing.reference} if drawing.reference else {}
    document |= regularities_document(drawing.regularities)
    return (_laid_out(document, 0) + "\n").encode("ascii")


def read(path: Path) -> Drawing:
    """Read a drawing that :func:`encode` made.

    Parameters
    ----------
    path : Path

    Returns
    -------
    Drawing
        Equal to the one written in every bit.

    Raises
    ------
    FormatError
        If the file is no JSON, is cut off, is of another format or version, lacks a field, has
        one too many or one of the wrong type, or holds values that do not belong together.
    """
    try:
        document = json.loads(
            path.read_bytes().decode("utf-8"),
            object_pairs_hook=without_repeats,
            parse_constant=refused,
        )
    except RecursionError:
        raise FormatError("no shapespline drawing: nested too deeply") from None
    except ValueError as error:
        raise FormatError(f"no JSON, or cut off: {error}") from error
    return _drawing(document)


# Writing


def _fit_document(fit: Fit) -> dict[str, Any]:
    contour, spline = fit.contour, fit.spline
    line = contour.level_line
    each_itself = np.array_equal(contour.source, np.arange(len(contour)))
    return {
        "spline": {
            "degree": spline.degree,
            "periodic": spline.periodic,
            "knots": spline.knots.tolist(),
            "control_points": spline.control_points.tolist(),
        },
        "contour": {
            "closed": contour.closed,
            "points": contour.points.tolist(),
            "source": None if each_itself else contour.source.tolist(),
            "accuracy": contour.accuracy,
            **({} if line is None else {"level_line": line.tolist()}),
        },
        "parameters": _finite(fit.parameters, "parameters"),
        **_numbers_of({name: getattr(fit, name) for name in DISTANCES}, "fit"),
        "status": {"name": fit.status.name, "value": fit.status.value},
        "history": {
            name: [_recorded(getattr(record, name), name) for record in fit.history]
            for name in Iteration._fields
        },
        "method": fit.method,
        "sections": [piece_document(piece) for piece in fit.sections],
        "outliers": np.asarray(fit.outliers).tolist(),
        "uncertainty": uncertainty_document(fit.uncertainty),
        **regularities_document(fit.regularities),
    }


def _is_drawn(drawing: Drawing) -> bool:
    """Whether there are arcs or regularities."""
    found = any(fit.regularities or any(piece.arc for piece in fit.sections) for fit in drawing)
    return found or bool(drawing.regularities)


def _finite(array: FloatArray, name: str) -> list[float]:
    """Values of an array, all of which JSON can hold."""
    if not np.isfinite(array).all():
        raise FormatError(f"{name} must be finite to be written as JSON, got NaN or infinity")
    return [float(value) for value in array]


def _numbers_of(fields: dict[str, float], where: str) -> dict[str, float]:
    """Convert the fields to floats that JSON can hold."""
    for name, value in fields.items():
        if not math.isfinite(value):
            raise FormatError(f"{where}.{name} must be finite to be written as JSON, got {value}")
    return {name: float(value) for name, value in fields.items()}


def _recorded(value: float, name: str) -> int | float | None:
    """Value of a history record; a solver may not have computed one (NaN)."""
    if name in COUNTS:
        return int(value)
    if math.isinf(value):
        raise FormatError(f"history.{name} must be finite to be written as JSON, got {value}")
    return None if math.isnan(value) else float(value)


def _laid_out(value: object, indent: int) -> str:
    """Write a value on one line if it fits, else one field a line, numbers filling theirs."""
    line = json.dumps(value, allow_nan=False)
    if indent + len(line) <= LINE_LENGTH or not isinstance(value, dict | list) or not value:
        return line
    inner, outer = "\n" + " " * (indent + 1), "\n" + " " * indent
    if isinstance(value, dict):
        items = [f'"{name}": {_laid_out(item, indent + 1)}' for name, item in value.items()]
        return "{" + inner + ("," + inner).join(items) + outer + "}"
    items = [_laid_out(item, indent + 1) for item in value]
    lines = items if isinstance(value[0], dict) else _filled(items, LINE_LENGTH - indent - 1)
    return "[" + inner + ("," + inner).join(lines) + outer + "]"


def _filled(items: list[str], width: int) -> list[str]:
    """Items joined by commas to lines no longer than a width."""
    lines = [items[0]]
    for item in items[1:]:
        if len(lines[-1]) + len(item) + 3 <= width:
            lines[-1] += ", " + item
        else:
            lines.append(item)
    return lines


# Reading: every function takes a value and where it stands, and returns it checked.


def _drawing(document: object) -> Drawing:
    if not isinstance(document, dict) or document.get("format") != FORMAT:
        raise FormatError('no shapespline drawing: it does not begin with "format": "shapespline"')
    version = checked_integer(document.get("version"), "version")
    if version not in (VERSION, AS_DRAWN):
        raise FormatError(
            f"version {version} is unknown, this program reads versions {VERSION} and {AS_DRAWN}"
        )
    known = DRAWING_FIELDS + tuple(name for name in NOT_ALWAYS if name in document)
    fields = checked_object(document, "the drawing", known)
    items = checked_list(fields["fits"], "fits")
    parents = checked_indices(fields["parents"], "parents", -1, len(items))
    if not items or len(parents) != len(items):
        counts = f"{len(items)} and {len(parents)}"
        raise FormatError(f"fits and parents must be equally many, at least one, found {counts}")
    frame = fields["frame"]
    if frame is not None:
        sides = checked_object(frame, "frame", ViewBox._fields)
        frame = ViewBox(*(checked_number(sides[name], f"frame.{name}") for name in ViewBox._fields))
    unit = fields["unit"]
    if unit is not None and unit not in UNITS:
        raise FormatError(f"unit must be null or one of {', '.join(UNITS)}, found {unit!r}")
    fits = [_fit(item, f"fits[{i}]") for i, item in enumerate(items)]
    listed = {name: checked_list(fields[name], name) for name in LISTED if name in fields}
    if "strokes" in listed:
        listed["strokes"] = [stroke_or_null(item, "strokes") for item in listed["strokes"]]
    found = checked_regularities(fields.get("regularities", []), "regularities", len(fits))
    try:
        return Drawing(fits, parents, frame, unit, reference=fields.get("reference"),
                       regularities=found, **listed)  # fmt: skip
    except InvalidInputError as error:
        raise FormatError(str(error)) from error


def _fit(value: object, where: str) -> Fit:
    known = isinstance(value, dict) and "regularities" in value
    fields = checked_object(value, where, FIT_FIELDS + (("regularities",) if known else ()))
    contour = _built(_contour, fields["contour"], f"{where}.contour")
    parameters = checked_numbers(fields["parameters"], f"{where}.parameters")
    if len(parameters) != contour.n_given:
        raise FormatError(
            f"{where}.parameters must be one for each of {contour.n_given} points,"
            f" found {len(parameters)}"
        )
    listed = checked_list(fields["outliers"], f"{where}.outliers")
    n_points = contour.n_given + len(listed)
    outliers = checked_indices(listed, f"{where}.outliers", 0, n_points)
    distances = {name: checked_number(fields[name], f"{where}.{name}") for name in DISTANCES}
    sections = checked_pieces(fields["sections"], f"{where}.sections")
    listed = fields.get("regularities", [])
    return Fit(
        spline=_built(_spline, fields["spline"], f"{where}.spline"),
        contour=contour,
        parameters=parameters,
        max_distance=distances["max_distance"],
        rms_distance=distances["rms_distance"],
        hausdorff_distance=distances["hausdorff_distance"],
        tolerance=distances["tolerance"],
        sections=sections,
        regularities=checked_regularities(listed, f"{where}.regularities", len(sections)),
        status=_status(fields["status"], f"{where}.status"),
        history=_history(fields["history"], f"{where}.history"),
        method=checked_string(fields["method"], f"{where}.method"),
        outliers=np.array(outliers, dtype=np.int64),
        uncertainty=checked_uncertainty(fields["uncertainty"], f"{where}.uncertainty"),
    )


def _built(build: Callable[[object, str], T], value: object, where: str) -> T:
    """Build a value whose own checks then speak of the file."""
    try:
        return build(value, where)
    except InvalidInputError as error:
        raise FormatError(f"{where}: {error}") from error


def _spline(value: object, where: str) -> BSplineCurve:
    fields = checked_object(value, where, ("degree", "periodic", "knots", "control_points"))
    return BSplineCurve(
        checked_numbers(fields["knots"], f"{where}.knots"),
        checked_points(fields["control_points"], f"{where}.control_points"),
        checked_integer(fields["degree"], f"{where}.degree"),
        checked_boolean(fields["periodic"], f"{where}.periodic"),
    )


def _contour(value: object, where: str) -> Contour:
    """Return the contour of the points as they were given, so that ``source`` comes back too."""
    known = CONTOUR_FIELDS
    if isinstance(value, dict) and "level_line" in value:
        known += ("level_line",)
    fields = checked_object(value, where, known)
    points = checked_points(fields["points"], f"{where}.points")
    source = list(range(len(points)))
    if fields["source"] is not None:
        source = checked_indices(fields["source"], f"{where}.source", 0, len(points))
    accuracy, line = fields["accuracy"], fields.get("level_line")
    contour = Contour.silently(
        points[source],
        checked_boolean(fields["closed"], f"{where}.closed"),
        accuracy=None if accuracy is None else checked_number(accuracy, f"{where}.accuracy"),
        level_line=None if line is None else checked_points(line, f"{where}.level_line"),
    )
    if contour.source.tolist() != source or len(contour) != len(points):
        raise FormatError(f"{where}: source does not lead to the points, or two neighbours agree")
    return contour


def _status(value: object, where: str) -> Status:
    fields = checked_object(value, where, ("name", "value"))
    name = checked_string(fields["name"], f"{where}.name")
    if name not in STATUSES:
        raise FormatError(f"{where}.name must be one of {', '.join(STATUSES)}, found {name!r}")
    return STATUSES[name].saying(checked_string(fields["value"], f"{where}.value"))


def _history(value: object, where: str) -> tuple[Iteration, ...]:
    """Return the records of columns of equal length."""
    fields = checked_object(value, where, Iteration._fields)
    columns = []
    for name in Iteration._fields:
        check = checked_integer if name in COUNTS else checked_number_or_null
        items = checked_list(fields[name], f"{where}.{name}")
        columns.append([check(item, f"{where}.{name}[{i}]") for i, item in enumerate(items)])
    lengths = sorted({len(column) for column in columns})
    if len(lengths) > 1:
        raise FormatError(f"{where} must have columns of one length, found {lengths}")
    return tuple(Iteration(*record) for record in zip(*columns, strict=True))

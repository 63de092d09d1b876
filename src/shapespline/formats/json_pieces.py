"""Pieces of a fit, and what they keep, as JSON; `shapespline.formats.json` says how they look."""

from __future__ import annotations

from typing import Any

from shapespline.errors import FormatError, InvalidInputError
from shapespline.formats.json_values import (
    checked_indices,
    checked_integer,
    checked_list,
    checked_number,
    checked_numbers,
    checked_object,
    checked_points,
    checked_string,
)
from shapespline.values import Arc, Piece, Regularity

KINDS = ("line", "arc", "bezier", "spline")
PIECE_FIELDS = ("kind", "degree", "knots", "control_points")
ARC_FIELDS = ("centre", "radius", "start_angle", "sweep")
# The twin of an arc is a cubic this near to it, of the radius: one that was joined to neighbours of
# few digits is, another curve is not.
SAME_ENDS = 1e-3


def piece_document(piece: Piece) -> dict[str, Any]:
    """The fields of a piece."""
    document = {
        "kind": piece.kind,
        "degree": piece.degree,
        "knots": piece.knots.tolist(),
        "control_points": piece.control_points.tolist(),
    }
    if piece.arc is not None:
        values = {name: getattr(piece.arc, name) for name in ARC_FIELDS}
        document["arc"] = values | {"centre": list(piece.arc.centre)}
    return document


def regularities_document(found: tuple[Regularity, ...]) -> dict[str, Any]:
    """The field of a fit; none if there are no regularities."""
    listed = [one._asdict() | {"pieces": list(one.pieces)} for one in found]
    return {"regularities": listed} if listed else {}


def checked_regularities(value: object, where: str, n_pieces: int) -> tuple[Regularity, ...]:
    """Regularities of a list of such fields."""
    found = []
    for index, item in enumerate(checked_list(value, where)):
        place = f"{where}[{index}]"
        fields = checked_object(item, place, Regularity._fields)
        pieces = checked_indices(fields["pieces"], f"{place}.pieces", 0, n_pieces)
        found.append(
            Regularity(
                checked_string(fields["name"], f"{place}.name"),
                tuple(pieces),
                checked_number(fields["off"], f"{place}.off"),
                checked_integer(fields["order"], f"{place}.order"),
            )
        )
    return tuple(found)


def checked_pieces(value: object, where: str) -> tuple[Piece, ...]:
    """Pieces of a list of such fields."""
    return tuple(
        _piece(item, f"{where}[{index}]") for index, item in enumerate(checked_list(value, where))
    )


def _piece(item: object, place: str) -> Piece:
    with_arc = isinstance(item, dict) and "arc" in item
    fields = checked_object(item, place, PIECE_FIELDS + (("arc",) if with_arc else ()))
    kind = checked_string(fields["kind"], f"{place}.kind")
    if kind not in KINDS:
        raise FormatError(f"{place}.kind must be one of {', '.join(KINDS)}, found {kind!r}")
    if with_arc != (kind == "arc"):
        raise FormatError(f"{place} must have the field 'arc' if its kind is 'arc', and only then")
    degree = checked_integer(fields["degree"], f"{place}.degree")
    knots = checked_numbers(fields["knots"], f"{place}.knots")
    points = checked_points(fields["control_points"], f"{place}.control_points")
    if len(knots) != len(points) + degree + 1:
        raise FormatError(f"{place} must have degree + 1 knots more than control points")
    if not with_arc:
        return Piece(kind, degree, knots, points)
    arc = _arc(fields["arc"], f"{place}.arc")
    piece = Piece(kind, degree, knots, points, arc)
    if degree != 3 or len(points) % 2 or not piece.twin_error <= SAME_ENDS * arc.radius:
        raise FormatError(f"{place}.control_points must be a cubic beside its arc")
    return piece


def _arc(value: object, where: str) -> Arc:
    fields = checked_object(value, where, ARC_FIELDS)
    x, y = checked_points([fields["centre"]], f"{where}.centre")[0].tolist()
    radius, start_angle, sweep = (
        checked_number(fields[name], f"{where}.{name}") for name in ARC_FIELDS[1:]
    )
    try:
        return Arc((x, y), radius, start_angle, sweep)
    except InvalidInputError as error:
        raise FormatError(f"{where}: {error}") from error

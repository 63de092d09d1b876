"""Uncertainty as a JSON object, both ways."""

from __future__ import annotations

from typing import Any

import numpy as np

from shapespline.errors import FormatError
from shapespline.formats.json_values import (
    checked_list,
    checked_number,
    checked_numbers,
    checked_object,
)
from shapespline.values import Uncertainty

FIELDS = ("covariance", "chi_squared", "degrees_of_freedom", "precisions")


def uncertainty_document(known: Uncertainty | None) -> dict[str, Any] | None:
    """The object, null where nothing is known."""
    if known is None:
        return None
    return {
        "covariance": known.covariance.tolist(),
        "chi_squared": known.chi_squared,
        "degrees_of_freedom": known.degrees_of_freedom,
        "precisions": known.precisions.tolist(),
    }


def checked_uncertainty(value: object, where: str) -> Uncertainty | None:
    """The value of such an object."""
    if value is None:
        return None
    fields = checked_object(value, where, FIELDS)
    rows = checked_list(fields["covariance"], f"{where}.covariance")
    covariance = [checked_numbers(row, f"{where}.covariance[{i}]") for i, row in enumerate(rows)]
    if not all(len(row) == len(rows) for row in covariance):
        raise FormatError(f"{where}.covariance must be as wide as high, {len(rows)}")
    return Uncertainty(
        covariance=np.array(covariance),
        chi_squared=checked_number(fields["chi_squared"], f"{where}.chi_squared"),
        degrees_of_freedom=checked_number(
            fields["degrees_of_freedom"], f"{where}.degrees_of_freedom"
        ),
        precisions=checked_numbers(fields["precisions"], f"{where}.precisions"),
    )

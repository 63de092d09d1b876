"""NumPy's array file: one (n, 2) array of numbers, never pickled objects."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.errors import FormatError
from shapespline.formats.csv import in_order, turned_over
from shapespline.values import Contour, Shape

if TYPE_CHECKING:
    from pathlib import Path


def read(
    path: Path, *, closed: bool | None = None, y_down: bool = False, unordered: bool = False
) -> Shape:
    """Read one outline from a ``.npy`` file.

    Parameters
    ----------
    path : Path
        A file of :func:`numpy.save` with a real (n, 2) array of any precision.
    closed : bool, optional
        Whether the outline is closed; found from the gap between its ends if not given.
    y_down : bool
        Turn y over within the bounding box: y -> y_min + y_max - y.
    unordered : bool
        Find the outlines that the points were taken from, whatever their order in the file; see
        `order_points`.

    Returns
    -------
    Shape
        One contour, no frame.

    Raises
    ------
    FormatError
        If the file holds anything but a real (n, 2) array.
    InvalidInputError
        If the points make no contour.
    """
    with path.open("rb") as file:
        try:
            array = np.lib.format.read_array(file, allow_pickle=False)
        except OSError:  # the caller's affair
            raise
        except Exception as error:  # a damaged header makes numpy's parsers raise anything
            reason = str(error).split("\n")[0] or type(error).__name__
            raise FormatError(f"no array in NumPy's format: {reason}") from error
    if array.dtype.kind not in "fiu":
        raise FormatError(f"expected an array of real numbers, got dtype {array.dtype}")
    if array.ndim != 2 or array.shape[1] != 2:
        hint = "; transpose it?" if array.ndim == 2 and array.shape[0] == 2 else ""
        raise FormatError(f"expected an array of shape (n, 2), got {array.shape}{hint}")
    points = array.astype(np.float64)
    if unordered:
        points = turned_over(points) if y_down else points
        return in_order(points, closed)
    contour = Contour(points, closed)
    return Shape([Contour(turned_over(points), closed) if y_down else contour])

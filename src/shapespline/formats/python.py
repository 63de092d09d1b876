"""Python: a file that makes the curves as scipy BSplines, (t, c, k), to the last bit."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from shapespline.typing import FloatArray
    from shapespline.values import Drawing, Fit

HEAD = '''"""Curves as B-splines: curves[i](u) are points, u from 0 to 1.

{says}
"""

import numpy as np
from scipy.interpolate import BSpline

curves = []
'''
BESIDE = 4  # numbers of a line


def encode(drawing: Drawing) -> bytes:
    """Source text that imports numpy and scipy and defines ``curves``, a list of BSpline.

    Numbers are written with the shortest digits that read back to the same double.
    """
    count = len(drawing)
    says = f"{count} curve{'s' * (count > 1)}"
    if drawing.unit is not None:
        says += f", in {drawing.unit}"
    if count > 1:
        says += f"; the one around each, -1 for none: {list(drawing.parents)}"
    text = HEAD.format(says=f"{says}.") + "".join(_curve(fit) for fit in drawing)
    return text.encode("utf-8")


def _curve(fit: Fit) -> str:
    spline = fit.spline
    mode = '"periodic"' if spline.periodic else "True"
    return (
        f"\nt = np.array([\n{_rows(spline.knots)}])\n"
        f"c = np.array([\n{_rows(spline.coefficients.ravel())}]).reshape(-1, 2)\n"
        f"curves.append(BSpline(t, c, {spline.degree}, extrapolate={mode}))\n"
    )


def _rows(values: FloatArray) -> str:
    numbers = [repr(value) for value in values.tolist()]
    rows = [numbers[k : k + BESIDE] for k in range(0, len(numbers), BESIDE)]
    return "".join(f"    {', '.join(row)},\n" for row in rows)

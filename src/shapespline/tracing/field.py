"""Field: how much of each pixel is ink, read off a picture where it is asked for."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from shapespline.tracing.layer import Layer
    from shapespline.typing import BoolArray, FloatArray, IntArray


@dataclass(frozen=True, eq=False)
class Field:
    """One value for each pixel, and what its values mean.

    A picture is kept in its own type: what is computed of it is computed at the borders of the
    ink alone, so that a large one takes little more memory than itself.

    Attributes
    ----------
    values : Layer
    cut : float
        Where ink and ground part; no pixel lies on it.
    light : bool
        Whether the ink has the greater values.
    contrast : float
        Difference of the values of ink and ground, positive.
    noise : float
        Standard deviation of the values where the picture is even, as a part of the contrast.
    middle : float
        Half-way between the values of ink and ground: the cut lies beside it, where no pixel does.
    scale : int
        How wide a pixel is in those of the picture, which was enlarged (TRC-38).
    interpolated : bool
        Whether that was done by more than copies of pixels.
    step : float
        How coarse the parts of pixels that are ink are known at least, of the contrast (TRC-42).
    """

    values: Layer
    cut: float
    light: bool
    contrast: float
    noise: float
    middle: float
    scale: int = 1
    interpolated: bool = False
    step: float = 0.0

    @property
    def shape(self) -> tuple[int, int]:
        """Height and width of the picture."""
        return self.values.shape

    def is_ink(self, values: NDArray[Any]) -> BoolArray:
        """Which values are those of ink by more than half."""
        above = values >= self.cut
        return np.asarray(above if self.light else ~above)

    def coverage(self, row: IntArray, column: IntArray) -> FloatArray:
        """Part of pixels that is ink, 1/2 at the cut; outside the picture that of its rim."""
        return self._over(row, column, self.cut)

    def ink(self, row: IntArray, column: IntArray) -> FloatArray:
        """The same, 0 on even ground and 1 on even ink."""
        return self._over(row, column, self.middle)

    def _over(self, row: IntArray, column: IntArray, half: float) -> FloatArray:
        height, width = self.shape
        row, column = np.clip(row, 0, height - 1), np.clip(column, 0, width - 1)
        excess = (self.values[row, column] - half) / self.contrast
        return 0.5 + (excess if self.light else -excess)

"""Types used in signatures: arrays, and the words that options are said in."""

from __future__ import annotations

from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray: TypeAlias = NDArray[np.float64]
IntArray: TypeAlias = NDArray[np.int64]
BoolArray: TypeAlias = NDArray[np.bool_]

# How a curve within a tolerance is made, and how long it is searched for.
Form: TypeAlias = Literal["pieces", "spline", "arcs"]
Effort: TypeAlias = Literal["fast", "balanced", "smallest"]
# Lines, arcs and corners as they were drawn first, or the fewest points whatever was drawn.
Character: TypeAlias = Literal["drawn", "fewest"]
# Of an open curve, as a caller says it: its ends are free, or the first and last point exactly.
Ends: TypeAlias = Literal["free", "fixed"]
# Which corners a curve has, where they are not named by their indices.
CornerChoice: TypeAlias = Literal["auto", "free"]
# Of measured points: what an error counts where not its square.
Loss: TypeAlias = Literal["huber", "tukey"]
# Where the knots of a curve of a given size begin.
Knots: TypeAlias = Literal[
    "balanced",
    "cpda-filled",
    "cpda-halved",
    "cpda-maxima",
    "curvature",
    "arc-length",
    "every-nth",
    "park-lee",
    "dominant",
    "uniform",
]

__all__ = [
    "ArrayLike",
    "BoolArray",
    "Character",
    "CornerChoice",
    "Effort",
    "Ends",
    "FloatArray",
    "Form",
    "IntArray",
    "Knots",
    "Loss",
]

"""The film of a run: its curves one after another, as an SVG that moves by itself.

Every frame is the path of a curve, exact up to degree 3; a browser shows them in turn, without any
script.
"""

from __future__ import annotations

from typing import TYPE_CHECKING
from xml.sax.saxutils import escape

import numpy as np

from shapespline.errors import InvalidInputError

if TYPE_CHECKING:
    from shapespline.paper.run import PaperRun
    from shapespline.typing import FloatArray
    from shapespline.values import Snapshot

# Frames at most, seconds a frame, and frames that the last curve stays.
MOST_FRAMES, FRAME_SECONDS, LAST_FRAMES = 40, 0.25, 8
# Of the longer side of the shape: border and stroke.
MARGIN, STROKE = 0.05, 0.004


def film(run: PaperRun) -> bytes:
    """Text of an animated SVG of the curves that a run kept.

    The first iterations come one by one, later ones in growing steps, because they move less.

    Raises
    ------
    InvalidInputError
        If the run kept no curves.
    """
    snapshots = run.fit.snapshots
    if not snapshots:
        raise InvalidInputError("run must hold snapshots: make it with run_paper(snapshots=1)")
    shown = [snapshots[i] for i in chosen_frames(len(snapshots))]
    points = np.concatenate([run.contour.points, *(s.spline.control_points for s in shown[-1:])])
    low, high = points.min(axis=0), points.max(axis=0)
    side = float((high - low).max())
    border = MARGIN * side
    width, height = (high - low + 2 * border).tolist()
    x, y = float(low[0]) - border, float(high[1]) + border

    def placed(at: FloatArray) -> FloatArray:
        return np.stack([at[..., 0] - x, y - at[..., 1]], axis=-1)

    frames = [*shown, *shown[-1:] * LAST_FRAMES]
    seconds = FRAME_SECONDS * len(frames)
    paths = [_path(placed(_cubics(snapshot))) for snapshot in frames]
    stroke = STROKE * side
    dots = "".join(f"M{px:.6g} {py:.6g}h0" for px, py in placed(run.contour.points).tolist())
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.6g} {height:.6g}"'
        ' width="800">',
        f"<title>{escape(run.fit.method)}: {len(shown)} of {len(snapshots)} curves, iterations"
        f" {shown[0].iteration} to {shown[-1].iteration}</title>",
        '<rect width="100%" height="100%" fill="white"/>',
        f'<path d="{dots}" fill="none" stroke="#999" stroke-width="{2 * stroke:.3g}"'
        ' stroke-linecap="round"/>',
        f'<path d="{paths[-1]}" fill="none"'
        f' stroke="#c0392b" stroke-width="{stroke:.3g}" stroke-linejoin="round">',
        f'<animate attributeName="d" calcMode="discrete" dur="{seconds:g}s"'
        f' repeatCount="indefinite" values="{";".join(paths)}"/>',
        "</path>",
        "</svg>",
    ]
    return ("\n".join(lines) + "\n").encode()


def chosen_frames(count: int) -> list[int]:
    """Indices of the curves to show: all of a few, else ever fewer towards the end."""
    if count <= MOST_FRAMES:
        return list(range(count))
    steps = np.geomspace(1.0, count, MOST_FRAMES)
    chosen = np.maximum.accumulate(np.rint(steps).astype(int) - 1)
    first = np.maximum(chosen, np.arange(MOST_FRAMES))  # one by one, as long as steps are below 1
    return sorted({*first.tolist(), count - 1})


def _cubics(snapshot: Snapshot) -> FloatArray:
    """Cubics with the ends and end derivatives of each Bezier piece, shape (s, 4, 2)."""
    points = snapshot.spline.beziers().points
    third = (points.shape[1] - 1) / 3.0
    first, last = points[:, 0], points[:, -1]
    leaving, arriving = points[:, 1] - first, points[:, -2] - last
    return np.stack([first, first + third * leaving, last + third * arriving, last], axis=1)


def _path(cubics: FloatArray) -> str:
    """Commands of one curve."""
    x, y = cubics[0, 0]
    rest = " ".join(f"{value:.6g}" for value in cubics[:, 1:].ravel().tolist())
    return f"M{x:.6g} {y:.6g}C{rest}"

"""The figures of the paper, each from plain values; see DOI 10.1140/epjp/s13360-022-02604-y.

Figure 1: the points, the accumulated chord-to-point distance, the frames at its maxima, the
initial curve. Figure 2: initial curves for several lengths. Figures 3 to 6: final curves. The
convergence of the error, which the paper only tabulates, is added. All are written as SVG, or as
PNG of 1600 pixels width, and need the extra ``plot``. Every function raises MissingExtraError
without matplotlib, UnknownFormatError for another ending, and FormatError if it cannot be written.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shapespline.errors import InvalidInputError
from shapespline.plotting import (
    BLUE,
    FONT_SIZE,
    GREEN,
    GREY,
    INK,
    ORANGE,
    PALE,
    RED,
    check_picture,
    draw_curves,
    draw_points,
    equal_axes,
    legend_below,
    new_figure,
    plane_height,
    quiet_axes,
    save,
)

if TYPE_CHECKING:
    import os
    from collections.abc import Mapping, Sequence

    from matplotlib.axes import Axes

    from shapespline.monitor import Iteration
    from shapespline.typing import ArrayLike, FloatArray, IntArray
    from shapespline.values import BSplineCurve, Contour

# Length of an arrow, of the box diagonal of the shape.
ARROW = 0.06
# Methods are told apart by colour and by dashes; 25 pairs before one comes again.
COLORS = (BLUE, RED, GREEN, ORANGE, INK)
DASHES = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)))


def plot_points(contour: Contour, path: str | os.PathLike[str], *, title: str = "") -> None:
    """Draw the data points (Figure 1a).

    Examples
    --------
    >>> import pathlib, tempfile
    >>> from shapespline.values import Contour
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = pathlib.Path(folder) / "points.png"
    ...     plot_points(Contour([(0, 0), (4, 0), (2, 3)], closed=True), file, title="A triangle")
    ...     file.exists()
    True
    """
    check_picture(path)
    figure = new_figure(10.0, plane_height([contour]))
    axes = figure.subplots()
    draw_points(axes, [contour])
    equal_axes(axes, title=title)
    legend_below(figure, axes)
    save(figure, path)


def plot_cpda(
    values: ArrayLike,
    maxima: ArrayLike,
    path: str | os.PathLike[str],
    *,
    raw: ArrayLike | None = None,
    threshold: float | None = None,
    title: str = "",
) -> None:
    """Draw the accumulated chord-to-point distance over the point index (Figure 1b).

    Parameters
    ----------
    values : array_like, shape (n,)
        H_j, the curve in which the maxima were sought.
    maxima : array_like of int, shape (k,)
        Indices of its local maxima, marked.
    path : path-like
    raw : array_like, shape (n,), optional
        H_j before smoothing, drawn behind.
    threshold : float, optional
        The height below which no maximum counts, drawn as a line.
    title : str
    """
    heights, peaks = np.asarray(values, dtype=np.float64), _indices(maxima, len(np.asarray(values)))
    behind = None if raw is None else np.asarray(raw, dtype=np.float64)
    if behind is not None and behind.shape != heights.shape:
        raise InvalidInputError(
            f"raw must have the shape of values, {heights.shape}, got {behind.shape}"
        )
    check_picture(path)
    figure = new_figure(10.0, 4.5)
    axes = figure.subplots()
    if behind is not None:
        axes.plot(behind, color=GREY, lw=0.8, label="as accumulated", zorder=1)
    axes.plot(heights, color=BLUE, lw=1.3, label="H" if behind is None else "H, smoothed", zorder=2)
    label = f"local maxima, {len(peaks)}"
    axes.plot(peaks, heights[peaks], "o", ms=4.5, color=RED, mew=0, label=label, zorder=3)
    if threshold is not None:
        axes.axhline(threshold, color=GREEN, lw=0.9, ls="--", label=f"threshold {threshold:.3g}")
    axes.set_xlim(0, max(len(heights) - 1, 1))
    axes.set_ylim(bottom=0.0 if heights.min(initial=0.0) >= 0.0 else None)
    axes.grid(axis="y", color=PALE, linewidth=0.5)
    quiet_axes(axes, x="point index j", y="accumulated distance $H_j$", title=title)
    legend_below(figure, axes)
    save(figure, path)


def plot_frames(
    contour: Contour,
    indices: ArrayLike,
    tangents: ArrayLike,
    normals: ArrayLike,
    path: str | os.PathLike[str],
    *,
    title: str = "",
) -> None:
    """Draw tangents and normals at the local maxima, over the points (Figure 1c).

    All arrows are of one length, a small part of the shape's; a vector that is zero (no normal
    where the contour runs straight) has none.

    Parameters
    ----------
    contour : Contour
    indices : array_like of int, shape (k,)
        Of the points that are local maxima.
    tangents, normals : array_like, shape (k, 2)
        Directions there; their lengths do not matter.
    path : path-like
    title : str
    """
    at = contour.points[_indices(indices, len(contour))]
    arrows = {"tangents": _directions(tangents, len(at), "tangents")}
    arrows["normals"] = _directions(normals, len(at), "normals")
    check_picture(path)
    figure = new_figure(10.0, plane_height([contour]))
    axes = figure.subplots()
    draw_points(axes, [contour])
    axes.plot(*at.T, "o", ms=4.5, color=INK, mew=0, label=f"local maxima, {len(at)}", zorder=4)
    for color, (label, directions) in zip((BLUE, RED), arrows.items(), strict=True):
        _draw_arrows(axes, at, ARROW * contour.box_diagonal * directions, color, label)
    equal_axes(axes, title=title)
    legend_below(figure, axes)
    save(figure, path)


def plot_initial_curve(
    contour: Contour, curve: BSplineCurve, path: str | os.PathLike[str], *, title: str
) -> None:
    """Draw points, control polygon and initial curve (Figures 1d, 4a, 5a, 6a)."""
    _plot_curve(contour, curve, path, title, polygon=True)


def plot_final_curve(
    contour: Contour, curve: BSplineCurve, path: str | os.PathLike[str], *, title: str
) -> None:
    """Draw points and final curve (Figures 3, 4b, 5b, 6b); no polygon hides how well it fits."""
    _plot_curve(contour, curve, path, title, polygon=False)


def _plot_curve(
    contour: Contour,
    curve: BSplineCurve,
    path: str | os.PathLike[str],
    title: str,
    *,
    polygon: bool,
) -> None:
    check_picture(path)
    figure = new_figure(10.0, plane_height([contour]))
    axes = figure.subplots()
    draw_points(axes, [contour])
    draw_curves(axes, [curve], polygon=polygon)
    equal_axes(axes, title=title)
    legend_below(figure, axes)
    save(figure, path)


def plot_panels(
    contour: Contour,
    curves: Mapping[str, BSplineCurve],
    path: str | os.PathLike[str],
    *,
    columns: int = 2,
    title: str = "",
) -> None:
    """Draw several curves to the same points, a panel each (Figure 2: L = 5, 4, 3, 2).

    Parameters
    ----------
    contour : Contour
    curves : mapping of str to BSplineCurve
        Curves by the titles of their panels, to which the number of control points is added.
    path : path-like
    columns : int
        Panels beside each other.
    title : str
    """
    if not curves or columns < 1:
        raise InvalidInputError(
            f"curves must hold one curve and columns be 1 at least, got {len(curves)}, {columns}"
        )
    check_picture(path)
    columns = min(columns, len(curves))
    rows = -(-len(curves) // columns)
    panel = plane_height([contour], width=10.0 / columns)
    figure = new_figure(10.0, 0.8 + rows * panel)
    grid = figure.subplots(rows, columns, squeeze=False).ravel()
    for axes, (name, curve) in zip(grid, curves.items(), strict=False):
        draw_points(axes, [contour])
        draw_curves(axes, [curve], counted=False, dot=3.0)
        equal_axes(axes, title=f"{name}: {curve.n_control_points} control points")
    corners = np.concatenate([axes.dataLim.corners() for axes in grid[: len(curves)]])
    for axes in grid[: len(curves)]:  # one scale for all panels
        axes.update_datalim(corners)
        axes.autoscale_view()
    for axes in grid[len(curves) :]:
        axes.set_axis_off()
    if title:
        figure.suptitle(title, fontsize=FONT_SIZE + 1, color=INK)
    legend_below(figure, grid[0])
    save(figure, path)


def plot_convergence(
    histories: Mapping[str, Sequence[Iteration]], path: str | os.PathLike[str], *, title: str = ""
) -> None:
    """Draw the paper's error E_i over iterations and over function evaluations.

    Parameters
    ----------
    histories : mapping of str to sequence of Iteration
        Histories by the names of their methods.
    path : path-like
    title : str
    """
    if not histories or not all(histories.values()):
        raise InvalidInputError("histories must hold one record or more for each method")
    check_picture(path)
    figure = new_figure(10.0, 5.0)
    left, right = figure.subplots(1, 2, sharey=True)
    for index, (name, history) in enumerate(histories.items()):
        color = COLORS[index % len(COLORS)]
        dashes = DASHES[(index + index // len(COLORS)) % len(DASHES)]
        error = [record.paper_error for record in history]
        for axes, x in (
            (left, [record.iteration for record in history]),
            (right, [record.evaluations for record in history]),
        ):
            axes.plot(x, error, color=color, ls=dashes, lw=1.4, label=name)
            axes.plot(x[-1], error[-1], "o", ms=4.0, color=color, mew=0)
    # An error that is zero has no place on a logarithmic axis; without any other it stays linear.
    if any(record.paper_error > 0 for history in histories.values() for record in history):
        left.set_yscale("log")
    quiet_axes(left, x="iterations", y="error $E_i$, data units")
    quiet_axes(right, x="function evaluations")
    for axes in (left, right):
        axes.grid(color=PALE, linewidth=0.5)
    if title:
        figure.suptitle(title, fontsize=FONT_SIZE + 1, color=INK)
    legend_below(figure, left)
    save(figure, path)


def _draw_arrows(axes: Axes, at: FloatArray, arrows: FloatArray, color: str, label: str) -> None:
    """Draw arrows in data units, and make room for their tips."""
    some = np.hypot(*arrows.T) > 0
    axes.quiver(
        *at[some].T,
        *arrows[some].T,
        angles="xy",
        scale_units="xy",
        scale=1.0,
        units="inches",
        width=0.014,
        color=color,
        zorder=3,
    )
    axes.plot([], [], color=color, lw=1.5, label=label)  # a quiver has no place in a legend
    axes.update_datalim(at + arrows)
    axes.autoscale_view()


def _directions(vectors: ArrayLike, count: int, name: str) -> FloatArray:
    """Return vectors of length 1, zero where they were zero, shape (count, 2)."""
    array = np.asarray(vectors, dtype=np.float64)
    if array.shape != (count, 2):
        raise InvalidInputError(
            f"{name} must have shape ({count}, 2), one for each index, got {array.shape}"
        )
    length = np.hypot(array[:, 0], array[:, 1])[:, None]
    return np.divide(array, length, out=np.zeros_like(array), where=length > 0)


def _indices(indices: ArrayLike, count: int) -> IntArray:
    """Return indices of an array of ``count`` values."""
    array = np.asarray(indices, dtype=np.int64).reshape(-1)
    if len(array) and not (array.min() >= 0 and array.max() < count):
        raise InvalidInputError(
            f"indices must be from 0 to {count - 1}, got {array.min()} to {array.max()}"
        )
    return array

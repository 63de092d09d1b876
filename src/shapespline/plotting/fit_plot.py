"""Pictures of fits: the data, the control polygon, the curve and its error.

The figures of the paper are in :mod:`shapespline.paper_figures`; both draw with the helpers here,
so that colours, sizes and the way to save are in one place. Needs the extra ``plot``. Figures are
made without pyplot: no global state, safe in threads. The same input gives the same bytes with
the same version of matplotlib.
"""

from __future__ import annotations

import io
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from PIL import Image

from shapespline.errors import InvalidInputError, UnknownFormatError, require
from shapespline.formats import check_target, write_atomically
from shapespline.geometry import signed_area

if TYPE_CHECKING:
    import os
    from collections.abc import Sequence

    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from shapespline.typing import FloatArray
    from shapespline.values import BSplineCurve, Contour, Drawing, Fit

# Okabe and Ito's palette: told apart by the colour-blind too.
BLUE, ORANGE, GREEN, RED = "#0072B2", "#E69F00", "#009E73", "#D55E00"
GREY, PALE, INK = "#8A8A8A", "#E4E4E4", "#333333"
DPI = 160
PALETTE = 128
FONT_SIZE = 10.0
# Samples of a curve for each polynomial span; a picture of 1600 pixels shows no more.
SAMPLES = 40

# Level of the band that is drawn around a fit to points with errors.
BAND_LEVEL = 0.95


def plot_fit(drawing: Drawing, path: str | os.PathLike[str]) -> None:
    """Draw data, control polygons and curves, and below them the error of each data point.

    The error is the distance of the curve from the data point at its foot parameter, over the arc
    length of the data: positive where the curve passes outside a closed contour, or to the left
    of an open one. Several contours stand side by side, in the order of the drawing. Points that
    were left out as outliers are crossed and have no error.

    Parameters
    ----------
    drawing : Drawing
    path : path-like
        A ``.png`` file; 1600 pixels wide, as high as the shape asks for.

    Raises
    ------
    MissingExtraError
        If matplotlib is not installed.
    UnknownFormatError
        If the path ends neither in ``.png`` nor in ``.svg``.
    FormatError
        If the file cannot be written.

    Examples
    --------
    >>> import tempfile
    >>> from shapespline.values import Contour
    >>> from shapespline.values import BSplineCurve
    >>> from shapespline.values import Drawing, Fit, Status
    >>> from shapespline.values import clamped_knots
    >>> fit = Fit(
    ...     spline=BSplineCurve(clamped_knots(2, 1), [(0, 0), (8, 0)], degree=1),
    ...     contour=Contour([(0, 0), (4, 1), (8, 0)]), parameters=np.array([0.0, 0.5, 1.0]),
    ...     max_distance=1.0, rms_distance=0.577, hausdorff_distance=1.0, tolerance=1.0,
    ...     status=Status.KEPT, history=(), method="by hand",
    ... )
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     plot_fit(Drawing([fit]), Path(folder) / "fit.png")
    ...     (Path(folder) / "fit.png").read_bytes()[1:4]
    b'PNG'
    """
    check_picture(path)
    contours = [fit.contour for fit in drawing]
    height = plane_height(contours)
    figure = new_figure(10.0, height + 2.4)
    shape_axes, error_axes = figure.subplots(2, 1, height_ratios=[height, 2.0])
    draw_points(shape_axes, contours)
    draw_curves(shape_axes, [fit.spline for fit in drawing])
    _draw_outliers(shape_axes, drawing)
    _draw_bands(shape_axes, drawing)
    equal_axes(shape_axes)
    _draw_errors(error_axes, [_errors(fit) for fit in drawing])
    figure.suptitle(_caption(drawing), fontsize=FONT_SIZE, color=INK)
    legend_below(figure, shape_axes)
    save(figure, path)


def plot_on_axes(fits: Sequence[Fit], axes: Axes | None = None) -> Axes:
    """Draw data, control polygons and curves of fits into axes, new ones of pyplot's if none.

    Raises
    ------
    MissingExtraError
        If matplotlib is not installed.
    InvalidInputError
        If the axes are none.
    """
    check_matplotlib()
    from matplotlib.axes import Axes

    if axes is None:
        from matplotlib import pyplot

        _, axes = pyplot.subplots()
    elif not isinstance(axes, Axes):
        raise InvalidInputError(
            f"ax must be an Axes of matplotlib, got {type(axes).__name__}; a figure gives one with"
            " figure.add_subplot()"
        )
    draw_points(axes, [fit.contour for fit in fits])
    draw_curves(axes, [fit.spline for fit in fits])
    equal_axes(axes)
    return axes


# What every picture shares


def check_picture(path: str | os.PathLike[str]) -> None:
    """Raise before any work if no such picture can be drawn, or written there."""
    check_matplotlib()
    if Path(path).suffix.lower() not in (".png", ".svg"):
        raise UnknownFormatError(f"{Path(path).name}: pictures are written as .png or .svg only")
    check_target(path)


def check_matplotlib() -> None:
    """Raise if matplotlib is not installed."""
    require("matplotlib", "plot", "pictures need")


def new_figure(width: float, height: float) -> Figure:
    """Return an empty figure; its sizes in inches of 160 pixels."""
    check_matplotlib()
    from matplotlib.figure import Figure
    from matplotlib.layout_engine import ConstrainedLayoutEngine

    layout = ConstrainedLayoutEngine(w_pad=0.08, h_pad=0.08)
    return Figure(figsize=(width, height), dpi=DPI, layout=layout, facecolor="white")


def plane_height(contours: Sequence[Contour], *, width: float = 10.0) -> float:
    """Height for axes of a width in which contours leave little unused; in inches."""
    points = np.concatenate([contour.points for contour in contours])
    extent = points.max(axis=0) - points.min(axis=0)
    # Equal neighbours are dropped, so one of the two is positive.
    return float(width * np.clip(extent[1] / max(extent[0], extent[1]), 0.35, 0.85) + 0.8)


def save(figure: Figure, path: str | os.PathLike[str]) -> None:
    """Write a figure without a date or the name of a program, whole or not at all."""
    drawn, packed = io.BytesIO(), io.BytesIO()
    if Path(path).suffix.lower() == ".svg":
        from matplotlib import rc_context

        # A fixed salt names the same parts the same way every time; letters stay letters.
        with rc_context({"svg.hashsalt": "shapespline", "svg.fonttype": "none"}):
            figure.savefig(drawn, format="svg", metadata={"Date": None, "Creator": None})
        write_atomically(path, drawn.getvalue())
        return
    figure.savefig(drawn, format="png", dpi=DPI, metadata={"Software": None})
    # A palette holds the few colours of a drawing and their mixtures in a third of the bytes.
    picture = Image.open(drawn).convert("RGB")
    picture.quantize(PALETTE, dither=Image.Dither.NONE).save(packed, "png", optimize=True)
    write_atomically(path, packed.getvalue())


def quiet_axes(axes: Axes, *, x: str = "", y: str = "", title: str = "") -> None:
    """Give axes thin pale lines, small ticks and labels."""
    axes.set_xlabel(x, fontsize=FONT_SIZE, color=INK)
    axes.set_ylabel(y, fontsize=FONT_SIZE, color=INK)
    if title:
        axes.set_title(title, fontsize=FONT_SIZE + 1, color=INK)
    axes.tick_params(labelsize=FONT_SIZE - 1, labelcolor=INK, color=GREY, width=0.6)
    axes.tick_params(which="minor", color=GREY, width=0.4)
    axes.spines[["top", "right"]].set_visible(False)
    axes.spines[["left", "bottom"]].set(color=GREY, linewidth=0.6)
    axes.set_axisbelow(True)


def equal_axes(axes: Axes, *, title: str = "") -> None:
    """Finish axes that show the plane: one unit in x as long as one in y, y up."""
    quiet_axes(axes, title=title)
    axes.set_aspect("equal", adjustable="datalim")
    axes.grid(color=PALE, linewidth=0.5)


def legend_below(figure: Figure, *axes: Axes) -> None:
    """One legend under the figure, where it covers nothing; the same label once."""
    entries: dict[str, Artist] = {}
    for one in axes:
        handles, labels = one.get_legend_handles_labels()
        for handle, label in zip(handles, labels, strict=True):
            entries.setdefault(label, handle)
    figure.legend(
        list(entries.values()),
        list(entries),
        loc="outside lower center",
        ncols=min(len(entries), 5),
        fontsize=FONT_SIZE,
        labelcolor=INK,
        frameon=False,
    )


def draw_points(axes: Axes, contours: Sequence[Contour]) -> None:
    """Draw data points as dots, smaller the more there are."""
    n_points = sum(len(contour) for contour in contours)
    size = float(np.clip(80.0 / np.sqrt(n_points), 2.0, 5.0))
    points = np.concatenate([contour.points for contour in contours])
    label = f"data, {n_points} points"
    axes.plot(*points.T, ".", ms=size, color=GREY, mew=0, label=label, zorder=1)


def draw_curves(
    axes: Axes,
    curves: Sequence[BSplineCurve],
    *,
    polygon: bool = True,
    counted: bool = True,
    dot: float = 4.0,
) -> None:
    """Draw curves, and with ``polygon`` their control points, ``counted`` in the legend."""
    if polygon:
        count = f", {sum(curve.n_control_points for curve in curves)} points" if counted else ""
        axes.plot(
            *_joined([_control_polygon(curve) for curve in curves]).T,
            "o-",
            ms=dot,
            lw=0.8,
            color=ORANGE,
            mfc="white",
            mew=1.0,
            label=f"control polygon{count}",
            zorder=2,
        )
    label = "B-spline curve" if len(curves) == 1 else f"{len(curves)} B-spline curves"
    lines = _joined([_sampled(curve) for curve in curves])
    axes.plot(*lines.T, color=BLUE, lw=1.5, label=label, zorder=3)


def _control_polygon(curve: BSplineCurve) -> FloatArray:
    points = curve.control_points
    return np.concatenate([points, points[:1]]) if curve.periodic else points


def _sampled(curve: BSplineCurve) -> FloatArray:
    """Points of a curve, ``SAMPLES`` for each span and all breakpoints, shape (k, 2)."""
    u = curve.breakpoints
    share = np.arange(SAMPLES) / SAMPLES
    inside = u[:-1, None] + np.diff(u)[:, None] * share
    points = curve(inside.ravel())
    # A periodic curve reads the end of its domain as its start: the same point.
    return np.concatenate([points, curve(u[-1:])])


def _joined(lines: Sequence[FloatArray]) -> FloatArray:
    """Polylines in one array, parted by NaN: one artist, one legend entry."""
    gap = np.full((1, 2), np.nan)
    return np.concatenate([part for line in lines for part in (line, gap)][:-1])


# The error panel


class _Errors(NamedTuple):
    """Signed distances of the data points of one fit over their arc length."""

    arc_length: FloatArray
    distance: FloatArray
    total: float


def _errors(fit: Fit) -> _Errors:
    """Error of each given point that is no outlier, in the order of the data."""
    contour, used = fit.contour, np.ones(fit.contour.n_given, dtype=bool)
    used[fit.outliers] = False
    source, u = contour.source[used], fit.parameters[used]
    offset = fit.spline(u) - contour.points[source]
    tangent = fit.spline(u, derivative=1)
    left = tangent[:, 0] * offset[:, 1] - tangent[:, 1] * offset[:, 0]
    sign = np.where(left < 0, -1.0, 1.0)
    if fit.closed and signed_area(_sampled(fit.spline)) > 0:
        sign = -sign  # anticlockwise: the inside is on the left
    return _Errors(
        contour.arc_length[source], sign * np.hypot(offset[:, 0], offset[:, 1]), contour.length
    )


def _draw_errors(axes: Axes, errors: Sequence[_Errors]) -> None:
    """Draw signed errors end to end, with lines at the rms and the maximum."""
    starts = np.concatenate([[0.0], np.cumsum([error.total for error in errors])])
    for index in range(1, len(errors), 2):  # a pale ground under every second contour
        axes.axvspan(starts[index], starts[index + 1], color=PALE, alpha=0.6, lw=0, zorder=0)
    lines = [
        np.column_stack([start + error.arc_length, error.distance])
        for start, error in zip(starts[:-1], errors, strict=True)
    ]
    axes.plot(*_joined(lines).T, ".-", ms=2.0, lw=0.6, color=BLUE, zorder=2)
    every = np.concatenate([error.distance for error in errors])
    quiet_axes(axes, x="arc length of the data" + (", end to end" if len(errors) > 1 else ""))
    axes.set_ylabel("error\n(outside / left: +)", fontsize=FONT_SIZE, color=INK)
    axes.set_xlim(0.0, starts[-1])
    axes.axhline(0.0, color=GREY, lw=0.6, zorder=1)
    if len(every):
        rms, largest = float(np.sqrt(np.mean(every**2))), float(np.abs(every).max())
        _draw_level(axes, rms, GREEN, "--", f"rms {rms:.3g}")
        _draw_level(axes, largest, RED, "-", f"max {largest:.3g}")


def _draw_level(axes: Axes, value: float, color: str, style: str, text: str) -> None:
    """Draw lines at plus and minus a value, and write it at the right end of the upper one."""
    for side in (value, -value):
        axes.axhline(side, color=color, lw=0.9, ls=style, zorder=3)
    axes.annotate(
        text,
        (1.0, value),
        xytext=(4, 0),
        xycoords=("axes fraction", "data"),
        textcoords="offset points",
        va="center",
        color=color,
        fontsize=FONT_SIZE - 1,
    )


def _draw_outliers(axes: Axes, drawing: Drawing) -> None:
    points = np.concatenate(
        [fit.contour.points[fit.contour.source[fit.outliers]] for fit in drawing]
    )
    if len(points):
        label = f"left out, {len(points)} points"
        axes.plot(*points.T, "x", ms=5.0, mew=1.0, color=RED, label=label, zorder=4)


def _draw_bands(axes: Axes, drawing: Drawing) -> None:
    """The bands of fits to points with errors, a strip each."""
    label = f"{BAND_LEVEL:.0%} band"
    for fit in drawing:
        if fit.uncertainty is not None:
            band = fit.band(BAND_LEVEL)
            strip = np.concatenate([band.left, band.right[::-1]])
            axes.fill(*strip.T, color=RED, alpha=0.3, lw=0, label=label, zorder=2)
            label = "_nolegend_"


def _caption(drawing: Drawing) -> str:
    """Counts and distances of a drawing, in two lines."""
    fits = drawing.fits
    n_points = np.array([fit.contour.n_given - len(fit.outliers) for fit in fits])
    n_left_out = sum(len(fit.outliers) for fit in fits)
    of_all = f" of {n_points.sum() + n_left_out}" if n_left_out else ""
    rms = np.sqrt(np.average([fit.rms_distance**2 for fit in fits], weights=n_points))
    degrees = "/".join(map(str, sorted({fit.degree for fit in fits})))
    contours = "" if len(fits) == 1 else f"{len(fits)} contours, "
    count = sum(fit.n_control_points for fit in fits)
    # Where none was asked for, the tolerance is the distance itself and says nothing more.
    asked = [fit for fit in fits if fit.tolerance != fit.hausdorff_distance]
    n_kept = sum(fit.kept for fit in asked)
    kept = ""
    if len(asked) == 1:
        kept = f", tolerance {asked[0].tolerance:.4g} {'kept' if n_kept else 'not kept'}"
    elif asked:
        kept = f", tolerance kept by {n_kept} of {len(asked)}"
    return (
        f"{contours}{n_points.sum()}{of_all} points, {count} control points of degree {degrees}\n"
        f"rms {rms:.4g}, maximum {max(fit.max_distance for fit in fits):.4g}, two-sided"
        f" {max(fit.hausdorff_distance for fit in fits):.4g}{kept}"
    )

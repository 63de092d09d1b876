"""What the pictures hold, read from their artists and from the files."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest
from PIL import Image
from tests.support.make_fit import blob, fit_of, history, nested, wave

from shapespline.errors import FormatError, InvalidInputError, MissingExtraError, UnknownFormatError
from shapespline.paper import figures as paper_figures
from shapespline.plotting import fit_plot as plot
from shapespline.values.contour import Contour
from shapespline.values.curve import BSplineCurve
from shapespline.values.drawing import Drawing
from shapespline.values.knots import clamped_knots

pytest.importorskip("matplotlib")

CONTOUR = fit_of(blob()).contour
AT = np.array([0, 7, 20, 31])
TURNED = np.array([(0.0, 2.0), (-3.0, 0.0), (0.0, -4.0), (0.0, 0.0)])
CALLS = {
    "fit": lambda path: plot.plot_fit(Drawing([fit_of(blob())]), path),
    "nested": lambda path: plot.plot_fit(nested(), path),
    "points": lambda path: paper_figures.plot_points(CONTOUR, path, title="Blob"),
    "cpda": lambda path: paper_figures.plot_cpda(
        np.sin(np.arange(60)) ** 2, [8, 30], path, raw=np.ones(60), threshold=0.2
    ),
    "frames": lambda path: paper_figures.plot_frames(CONTOUR, AT, TURNED[::-1], TURNED, path),
    "initial": lambda path: paper_figures.plot_initial_curve(CONTOUR, blob(), path, title="a"),
    "final": lambda path: paper_figures.plot_final_curve(CONTOUR, blob(), path, title="b"),
    "panels": lambda path: paper_figures.plot_panels(
        CONTOUR, {f"L = {k}": blob(18 - 2 * k) for k in (5, 4, 3, 2)}, path
    ),
    "convergence": lambda path: paper_figures.plot_convergence(
        {"d-bfgs": history(), "levenberg-marquardt": history(4, 0.1)}, path
    ),
}


@pytest.fixture
def drawn(monkeypatch, tmp_path):
    """Run a call of ``CALLS`` or a function of a path, and return its figure."""
    caught = []
    for module in (plot, paper_figures):
        monkeypatch.setattr(module, "save", lambda figure, path: caught.append(figure))

    def run(call):
        (CALLS[call] if isinstance(call, str) else call)(tmp_path / "figure.png")
        return caught.pop()

    return run


def line(axes, label):
    """Points of the one line whose label begins like this."""
    (found,) = [one for one in axes.lines if one.get_label().startswith(label)]
    return found.get_xydata()


def labels(figure):
    return [text.get_text() for legend in figure.legends for text in legend.get_texts()]


@pytest.mark.parametrize("name", CALLS)
@pytest.mark.slow
def test_files_are_readable_pngs_of_1600_pixels_without_a_date(tmp_path, name):
    path = tmp_path / f"{name}.png"
    CALLS[name](path)
    with Image.open(path) as picture:
        assert picture.format == "PNG"
        assert picture.width == 1600
        assert 600 <= picture.height <= 2000
        assert not set(picture.info) & {"Software", "Creation Time", "date"}
        assert len(np.unique(np.asarray(picture.convert("L")))) > 20  # not an empty sheet
    assert [file.name for file in tmp_path.iterdir()] == [path.name]


@pytest.mark.parametrize("name", ["fit", "frames", "convergence"])
@pytest.mark.slow
def test_same_input_same_bytes(tmp_path, name):
    CALLS[name](tmp_path / "a.png")
    CALLS[name](tmp_path / "b.png")
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


@pytest.mark.parametrize("name", CALLS)
@pytest.mark.slow
def test_no_legend_covers_axes(drawn, name):
    figure = drawn(name)
    figure.draw_without_rendering()
    (legend,) = figure.legends
    box = legend.get_window_extent()
    assert all(axes.get_legend() is None for axes in figure.axes)
    assert not any(box.overlaps(axes.get_tightbbox()) for axes in figure.axes)
    assert figure.bbox.x0 <= box.x0
    assert box.x1 <= figure.bbox.x1
    assert len(labels(figure)) == len(set(labels(figure)))


@pytest.mark.parametrize("name", ["fit", "nested", "points", "frames", "initial", "panels"])
@pytest.mark.slow
def test_the_plane_has_equal_axes_and_y_up(drawn, name):
    figure = drawn(name)
    figure.draw_without_rendering()
    axes = figure.axes[0]
    (x0, y0), (x1, y1) = axes.transData.transform([(0, 0), (1, 1)])
    # Matplotlib leaves limits alone that are less than 0.5 % off, after the layout has moved axes.
    assert y1 - y0 == pytest.approx(x1 - x0, rel=0.006)
    assert y1 > y0


def test_fit_shows_data_polygon_and_curve(drawn):
    fit = fit_of(blob())
    shape, _ = drawn(lambda path: plot.plot_fit(Drawing([fit]), path)).axes
    np.testing.assert_array_equal(line(shape, "data, 60 points"), fit.contour.points)
    polygon = line(shape, "control polygon, 12 points")
    np.testing.assert_array_equal(polygon[:-1], fit.control_points)
    np.testing.assert_array_equal(polygon[-1], polygon[0])  # closed, like the curve
    curve = line(shape, "B-spline curve")
    u = np.arange(len(curve)) / (len(curve) - 1)
    np.testing.assert_allclose(curve, fit.spline(u), rtol=0, atol=1e-12 * 20)


def test_the_polygon_of_an_open_curve_is_open(drawn):
    fit = fit_of(wave())
    shape, _ = drawn(lambda path: plot.plot_fit(Drawing([fit]), path)).axes
    np.testing.assert_array_equal(line(shape, "control polygon, 9"), fit.control_points)
    np.testing.assert_array_equal(line(shape, "B-spline curve")[-1], fit.control_points[-1])


def test_error_panel_holds_the_distances(drawn):
    fit = fit_of(blob())
    _, panel = drawn(lambda path: plot.plot_fit(Drawing([fit]), path)).axes
    arc_length, error = panel.lines[0].get_xydata().T
    np.testing.assert_array_equal(arc_length, fit.contour.arc_length[:-1])
    expected = np.hypot(*(fit.spline(fit.parameters) - fit.contour.points).T)
    np.testing.assert_allclose(np.abs(error), expected, rtol=1e-12)
    assert {text.get_text() for text in panel.texts} == {
        f"rms {fit.rms_distance:.3g}",
        f"max {fit.max_distance:.3g}",
    }
    heights = sorted(one.get_ydata()[0] for one in panel.lines[1:])
    rms, largest = fit.rms_distance, fit.max_distance
    np.testing.assert_allclose(heights, [-largest, -rms, 0, rms, largest], rtol=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("clockwise", [False, True])
@pytest.mark.parametrize("outside", [False, True])
def test_error_is_positive_outside_a_closed_contour(drawn, clockwise, outside):
    curve = blob()
    u = np.arange(50) / 50
    points = curve(u) * (0.9 if outside else 1.1)  # the centre is the origin
    if clockwise:
        # The same knots backwards, since these are equally spaced.
        curve = BSplineCurve(curve.knots, curve.control_points[::-1], curve.degree, periodic=True)
        points = points[::-1]
        u = np.array([_nearest(curve, point) for point in points])
    else:
        u = np.array([_nearest(curve, point) for point in points])
    fit = fit_of(curve, contour=Contour(points, closed=True), parameters=u)
    _, panel = drawn(lambda path: plot.plot_fit(Drawing([fit]), path)).axes
    error = panel.lines[0].get_ydata()
    assert (error > 0).all() if outside else (error < 0).all()


def _nearest(curve, point):
    u = np.arange(4000) / 4000
    return u[np.argmin(np.hypot(*(curve(u) - point).T))]


def test_error_is_positive_left_of_an_open_contour(drawn):
    curve = BSplineCurve(clamped_knots(2, 1), [(0, 0), (8, 0)], 1)
    contour = Contour([(0, -1), (4, 1), (8, -2)], closed=False)
    fit = fit_of(curve, contour=contour, parameters=np.array([0.0, 0.5, 1.0]))
    _, panel = drawn(lambda path: plot.plot_fit(Drawing([fit]), path)).axes
    assert panel.lines[0].get_ydata().tolist() == [1.0, -1.0, 2.0]


def test_outliers_are_crossed_and_have_no_error(drawn):
    fit = fit_of(blob(), outliers=np.array([3, 40]))
    figure = drawn(lambda path: plot.plot_fit(Drawing([fit]), path))
    shape, panel = figure.axes
    np.testing.assert_array_equal(line(shape, "left out, 2"), fit.contour.points[[3, 40]])
    assert fit.contour.arc_length[3] not in panel.lines[0].get_xdata()
    assert len(panel.lines[0].get_xdata()) == 58
    assert "58 of 60 points" in figure.get_suptitle()


def test_several_contours_stand_end_to_end(drawn):
    drawing = nested()
    _, panel = drawn("nested").axes
    x = panel.lines[0].get_xdata()
    assert np.isnan(x).sum() == len(drawing) - 1
    starts = x[np.flatnonzero(np.isnan(x)) + 1]
    lengths = [fit.contour.length for fit in drawing]
    np.testing.assert_allclose(starts, np.cumsum(lengths)[:-1], rtol=1e-14)
    assert panel.get_xlim() == pytest.approx((0, sum(lengths)))


def test_caption_tells_counts_and_distances(drawn):
    fit = fit_of(wave(degree=5))
    caption = drawn(lambda path: plot.plot_fit(Drawing([fit]), path)).get_suptitle()
    assert "60 points, 9 control points of degree 5" in caption
    for value in (fit.rms_distance, fit.max_distance, fit.hausdorff_distance):
        assert f"{value:.4g}" in caption
    assert f"tolerance {fit.tolerance:.4g} kept" in caption
    missed = fit_of(wave(), tolerance=1e-6)
    caption = drawn(lambda path: plot.plot_fit(Drawing([missed]), path)).get_suptitle()
    assert "tolerance 1e-06 not kept" in caption
    assert "tolerance kept by 4 of 4" in drawn("nested").get_suptitle()


def test_cpda_marks_the_maxima(drawn):
    figure = drawn("cpda")
    (axes,) = figure.axes
    values = np.sin(np.arange(60)) ** 2
    np.testing.assert_array_equal(line(axes, "H, smoothed")[:, 1], values)
    expected = np.column_stack([[8, 30], values[[8, 30]]])
    np.testing.assert_array_equal(line(axes, "local maxima, 2"), expected)
    np.testing.assert_array_equal(line(axes, "as accumulated")[:, 1], np.ones(60))
    assert set(line(axes, "threshold 0.2")[:, 1]) == {0.2}
    plain = drawn(lambda path: paper_figures.plot_cpda(values, [], path))
    assert labels(plain) == ["H", "local maxima, 0"]


def test_arrows_start_at_the_maxima_with_one_length(drawn):
    (axes,) = drawn("frames").axes
    tangents, normals = axes.collections
    length = paper_figures.ARROW * CONTOUR.box_diagonal
    np.testing.assert_array_equal(normals.XY, CONTOUR.points[AT[:3]])  # the last one is zero
    found = np.column_stack([normals.U, normals.V])
    np.testing.assert_allclose(found, length * np.array([(0, 1), (-1, 0), (0, -1)]), atol=1e-12)
    np.testing.assert_array_equal(tangents.XY, CONTOUR.points[AT[1:]])
    assert (normals.angles, normals.scale_units, normals.scale) == ("xy", "xy", 1.0)
    tips = normals.XY + found
    low, high = axes.viewLim.get_points()
    assert (low <= tips).all()
    assert (tips <= high).all()


def test_final_curve_hides_the_polygon(drawn):
    assert labels(drawn("initial")) == [
        "data, 60 points",
        "control polygon, 12 points",
        "B-spline curve",
    ]
    assert labels(drawn("final")) == ["data, 60 points", "B-spline curve"]


@pytest.mark.slow
def test_panels_have_one_scale_and_counted_titles(drawn):
    figure = drawn("panels")
    figure.draw_without_rendering()
    assert [axes.get_title() for axes in figure.axes] == [
        f"L = {k}: {18 - 2 * k} control points" for k in (5, 4, 3, 2)
    ]
    limits = np.array([(axes.get_xlim(), axes.get_ylim()) for axes in figure.axes])
    np.testing.assert_allclose(limits, np.broadcast_to(limits[:1], limits.shape), rtol=1e-9)
    three = {name: blob() for name in "abc"}
    figure = drawn(lambda path: paper_figures.plot_panels(CONTOUR, three, path))
    assert [axes.axison for axes in figure.axes] == [True, True, True, False]


def test_convergence_over_iterations_and_evaluations(drawn):
    left, right = drawn("convergence").axes
    records = history()
    error = [record.paper_error for record in records]
    over = line(left, "d-bfgs")
    np.testing.assert_array_equal(over, np.column_stack([range(8), error]))
    over = line(right, "d-bfgs")
    np.testing.assert_array_equal(over[:, 0], [record.evaluations for record in records])
    assert left.get_yscale() == right.get_yscale() == "log"


def test_twelve_methods_look_different(drawn):
    names = [f"method {index}" for index in range(12)]
    left, _ = drawn(
        lambda path: paper_figures.plot_convergence(dict.fromkeys(names, history()), path)
    ).axes
    named = [one for one in left.lines if one.get_label() in names]
    assert len({(one.get_color(), str(one._dash_pattern)) for one in named}) == 12


@pytest.mark.slow
def test_convergence_to_zero_does_not_warn(tmp_path):
    zero = [record._replace(paper_error=0.0) for record in history()]
    paper_figures.plot_convergence({"a": zero}, tmp_path / "zero.png")
    paper_figures.plot_convergence({"a": zero, "b": history()}, tmp_path / "part.png")
    assert (tmp_path / "zero.png").exists()
    assert (tmp_path / "part.png").exists()


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda path: paper_figures.plot_cpda([1, 2], [2], path), "from 0 to 1, got 2 to 2"),
        (lambda path: paper_figures.plot_cpda([1, 2], [-1], path), "from 0 to 1, got -1 to -1"),
        (
            lambda path: paper_figures.plot_cpda([1, 2], [], path, raw=[1]),
            "raw must have the shape",
        ),
        (
            lambda path: paper_figures.plot_frames(CONTOUR, AT, TURNED, TURNED[:2], path),
            r"normals must have shape \(4, 2\)",
        ),
        (lambda path: paper_figures.plot_convergence({}, path), "histories must hold"),
        (lambda path: paper_figures.plot_convergence({"a": ()}, path), "histories must hold"),
        (lambda path: paper_figures.plot_panels(CONTOUR, {}, path), "curves must hold"),
    ],
)
def test_input_that_makes_no_sense(tmp_path, call, message):
    with pytest.raises(InvalidInputError, match=message):
        call(tmp_path / "figure.png")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", CALLS)
def test_targets_that_cannot_be(tmp_path, name):
    with pytest.raises(UnknownFormatError, match=r"figure\.pdf: pictures are written as \.png"):
        CALLS[name](tmp_path / "figure.pdf")
    with pytest.raises(FormatError, match="does not exist"):
        CALLS[name](tmp_path / "nowhere" / "figure.png")


def test_without_matplotlib_the_extra_is_named(monkeypatch, tmp_path):
    for name in ("matplotlib", "matplotlib.figure", "matplotlib.layout_engine"):
        monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(MissingExtraError, match=r'pip install "shapespline\[plot\]"'):
        CALLS["points"](tmp_path / "figure.png")


@pytest.mark.slow
def test_no_global_state_of_pyplot(tmp_path):
    program = (
        "import sys; from shapespline.paper import figures as paper_figures\n"
        "assert 'matplotlib' not in sys.modules\n"
        "from shapespline import Contour\n"
        "triangle = Contour([(0, 0), (1, 0), (1, 1)])\n"
        f"paper_figures.plot_points(triangle, {str(tmp_path / 'a.png')!r})\n"
        "assert 'matplotlib' in sys.modules and 'matplotlib.pyplot' not in sys.modules\n"
    )
    subprocess.run([sys.executable, "-c", program], check=True)


def test_fits_and_drawings_draw_themselves_on_axes():
    from matplotlib.figure import Figure

    axes = Figure().subplots(1, 2)
    drawing = nested()
    assert drawing.plot(axes[0]) is axes[0]
    assert drawing.fits[0].plot(ax=axes[1]) is axes[1]
    for ax, fits in zip(axes, (drawing.fits, drawing.fits[:1]), strict=True):
        data, polygon, curve = ax.lines
        assert len(data.get_xdata()) == sum(len(fit.contour) for fit in fits)
        for fit in fits:
            drawn = polygon.get_xydata()
            assert all((drawn == point).all(axis=1).any() for point in fit.control_points)
            # Forty samples for each span: breakpoints are among them.
            on = fit.spline(fit.spline.breakpoints[:-1])
            assert all((curve.get_xydata() == point).all(axis=1).any() for point in on)
        assert ax.get_aspect() == 1.0
    with pytest.raises(InvalidInputError, match=r"ax must be an Axes .* got Figure"):
        drawing.plot(axes[0].figure)


def test_new_axes_are_those_of_pyplot():
    import matplotlib

    matplotlib.use("agg")
    from matplotlib import pyplot

    axes = nested().plot()
    assert pyplot.gca() is axes
    pyplot.close(axes.figure)

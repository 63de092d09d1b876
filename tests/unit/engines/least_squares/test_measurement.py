"""Measured points: errors, robust losses, covariance and bands, by theory and simulation."""

from __future__ import annotations

import time

import numpy as np
import pytest
from tests.support import reference
from tests.support.shapes import Start, flower

from shapespline import BSplineCurve, Contour, Drawing, Shape, optimize, read, write
from shapespline.errors import InvalidInputError
from shapespline.geometry import nearest, unit_normals
from shapespline.geometry.band_draws import SlidingCurve, second_order_stretch
from shapespline.solvers import Limits
from shapespline.values import clamped_knots, periodic_knots

LIMITS = Limits(max_iterations=50, relative_decrease=1e-8)
LM = "levenberg-marquardt"


def truth(closed, m=10):
    angle = 2 * np.pi * np.arange(m) / m
    r = 10 + 1.5 * np.cos(3 * angle)
    points = np.column_stack([r * np.cos(angle), r * np.sin(angle)])
    knots = (periodic_knots if closed else clamped_knots)(m, 3)
    return BSplineCurve(knots, points, 3, closed)


def noisy(curve, n, covariance, seed):
    u = np.linspace(0, 1, n, endpoint=not curve.periodic)
    noise = np.random.default_rng(seed).normal(size=(n, 2)) @ np.linalg.cholesky(covariance).T
    return Contour(curve(u) + noise, curve.periodic), Start(curve, u)


ISOTROPIC = np.eye(2) * 0.01**2
TILTED = np.array([[4.0, 1.5], [1.5, 1.0]]) * 0.01**2


# --- what is the same and what differs ---------------------------------------------------------


@pytest.mark.parametrize("closed", [True, False])
def test_equal_errors_give_the_plain_curve(closed):
    contour, start = noisy(truth(closed), 120, ISOTROPIC, 0)
    plain = optimize(contour, start, LM, ends=None if closed else "fitted")
    for sigma in (0.01, np.full(120, 0.3), np.full((120, 2), 2.0)):
        fit = optimize(contour, start, LM, sigma=sigma)
        # Weights of equal size divided by their mean: one, but for a rounding.
        np.testing.assert_allclose(fit.control_points, plain.control_points, rtol=1e-9, atol=1e-9)
    assert plain.uncertainty is None


@pytest.mark.parametrize("closed", [True, False])
def test_the_shapes_of_sigma_mean_the_same(closed):
    contour, start = noisy(truth(closed), 120, ISOTROPIC, 0)
    lengths = np.linspace(0.01, 0.05, 120)
    per_axis = np.repeat(lengths[:, None], 2, axis=1)
    matrices = per_axis[:, :, None] ** 2 * np.eye(2)
    one, two, three = (optimize(contour, start, LM, sigma=s) for s in (lengths, per_axis, matrices))
    assert one.covariance.tobytes() == two.covariance.tobytes()
    np.testing.assert_allclose(three.covariance, one.covariance, rtol=1e-9)


def test_repeated_points_add_their_precisions():
    contour, start = noisy(truth(True), 120, ISOTROPIC, 0)
    sigma = np.full(120, 0.02)
    sigma[7] = 0.02 / np.sqrt(2)
    expected = optimize(contour, start, LM, sigma=sigma)
    doubled = Contour.silently(np.insert(contour.points, 7, contour.points[7], axis=0), True)
    found = optimize(doubled, start, LM, sigma=0.02)
    np.testing.assert_allclose(found.covariance, expected.covariance, rtol=1e-6)


def test_the_unit_of_length_scales_everything():
    contour, start = noisy(truth(True), 120, TILTED, 0)
    fit = optimize(contour, start, LM, sigma=np.tile(TILTED, (120, 1, 1)))
    spline = start.spline
    scaled = Start(BSplineCurve(spline.knots, 8 * spline.control_points, 3, True), start.parameters)
    other = optimize(
        Contour(8 * contour.points, True), scaled, LM, sigma=np.tile(64 * TILTED, (120, 1, 1))
    )
    np.testing.assert_allclose(other.covariance, 64 * fit.covariance, rtol=1e-6)
    assert other.uncertainty.chi_squared == pytest.approx(fit.uncertainty.chi_squared, rel=1e-6)


# --- the covariance ----------------------------------------------------------------------------


def test_covariance_is_the_dense_inverse_of_the_normal_information():
    """sum_j (N_j (x) n_j) (N_j (x) n_j)' / n'Sn, inverted by numpy."""
    closed = True
    contour, start = noisy(truth(closed), 120, TILTED, 3)
    sigma = np.tile(TILTED, (120, 1, 1))
    fit = optimize(contour, start, LM, sigma=sigma, limits=LIMITS)
    # The parameters of the run are foot parameters to the accuracy of its end.
    u = fit.parameters
    rows = reference.folded(reference.basis_matrix(fit.knots, 3, u, closed), 10).astype(float)
    tangents = fit.spline(u, derivative=1)
    normals = np.column_stack([-tangents[:, 1], tangents[:, 0]])
    normals /= np.hypot(*normals.T)[:, None]
    design = (rows[:, :, None] * normals[:, None, :]).reshape(120, 20)
    variance = np.einsum("ki,ij,kj->k", normals, TILTED, normals)
    information = (design / variance[:, None]).T @ design
    # A control point stays between its neighbours: the nearer one is a standard deviation away.
    ring = fit.control_points
    nearer = np.minimum(
        np.hypot(*(ring - np.roll(ring, 1, axis=0)).T),
        np.hypot(*(ring - np.roll(ring, -1, axis=0)).T),
    )
    information += np.diag(np.repeat(nearer, 2) ** -2.0)
    band = fit.band(parameters=np.linspace(0.05, 0.9, 40))
    rows = reference.folded(
        reference.basis_matrix(fit.knots, 3, band.parameters, closed), 10
    ).astype(float)
    motion = (rows[:, :, None] * band.normals[:, None, :]).reshape(40, 20)
    expected = np.sqrt(np.einsum("ki,ij,kj->k", motion, np.linalg.inv(information), motion))
    # Parameters of the run and true feet differ by its stopping rule, 1e-8 in the cost.
    stretch = second_order_stretch(fit.spline, fit.uncertainty, 0.95, False)
    np.testing.assert_allclose(band.half_width, 1.959964 * stretch * expected, rtol=1e-3)


def test_the_second_order_of_a_motion_leaves_the_third():
    """Against the crossings of the moved curve with the normals: half the motion, an eighth off."""
    curve = truth(True)
    at = (np.arange(40) + 0.5) / 40  # none in a knot
    sliding = SlidingCurve(curve, at, np.full(40, 1e-4))
    moves = np.random.default_rng(0).normal(0, 0.02, 20)
    normals, points = unit_normals(curve, at), curve(at)

    def left_over(part):
        moved = BSplineCurve(
            curve.knots, curve.control_points + part * moves.reshape(10, 2), 3, True
        )
        u = at.copy()
        for _ in range(20):  # Newton's iteration for the place that lies on the normal
            tangents = np.column_stack([normals[:, 1], -normals[:, 0]])
            along = ((moved(u) - points) * tangents).sum(axis=1)
            u -= along / (moved(u, derivative=1) * tangents).sum(axis=1)
        exact = ((moved(u) - points) * normals).sum(axis=1)
        step = (part * moves)[:, None]
        return exact - (sliding.across @ step + sliding.second(step))[:, 0]

    whole, half = np.abs(left_over(1.0)).max(), np.abs(left_over(0.5)).max()
    assert half < whole / 7  # an eighth, but for a part of the fourth order


def test_small_errors_do_not_stretch_the_band_and_large_ones_do():
    stretches = []
    for sigma in (1e-4, 0.05):
        contour, start = noisy(truth(True), 150, np.eye(2) * sigma**2, 0)
        fit = optimize(contour, start, LM, sigma=sigma, limits=LIMITS)
        stretches.append(second_order_stretch(fit.spline, fit.uncertainty, 0.95, True))
    # Of a coordinate of 1e-4 slides are some 1e-2, a thousandth of the radius: so much is left.
    assert abs(stretches[0] - 1.0) < 1e-3
    assert stretches[1] > 1.1


def test_degrees_of_freedom_count_what_acts():
    """On a straight line control points slide along it: only one coordinate of each acts."""
    x = np.linspace(0, 10, 101)
    contour = Contour(np.column_stack([x, np.zeros(101)]), False)
    line = BSplineCurve(
        clamped_knots(6, 3), np.column_stack([np.linspace(0, 10, 6), np.zeros(6)]), 3
    )
    fit = optimize(contour, Start(line, x / 10), LM, sigma=0.01, ends="fitted")
    # 101 normal distances and two along the line at the held ends; six heights and two ends. That
    # a control point stays within 2 of its place is worth (0.01 / 2)^2 of a point, for 8 of them;
    # the least that the points tell of a combination of heights is half a point.
    assert fit.uncertainty.degrees_of_freedom == pytest.approx(103 - 8, abs=2 * 8 * 0.005**2)


def test_interpolated_ends_are_taken_as_exact():
    contour, start = noisy(truth(False), 120, ISOTROPIC, 0)
    fit = optimize(contour, start, LM, sigma=0.01, ends="fixed")
    band = fit.band(parameters=[0.0, 0.5, 1.0])
    assert band.half_width[0] == band.half_width[2] == 0.0 < band.half_width[1]
    assert (fit.covariance[:2] == 0.0).all()


# --- simulation --------------------------------------------------------------------------------


def coverage(closed, covariance, repetitions, **options):
    """How often the bands hold the truth: at one random place, and everywhere at once."""
    curve = truth(closed)
    places = np.linspace(0, 1, 300) if closed else np.linspace(0.01, 0.99, 300)
    one = whole = 0
    chi = []
    for seed in range(repetitions):
        contour, start = noisy(curve, 150, covariance, seed)
        fit = optimize(
            contour, start, LM, sigma=np.tile(covariance, (150, 1, 1)), limits=LIMITS, **options
        )
        band = fit.band(0.95, simultaneous=True, parameters=places)
        off = np.sqrt(nearest(curve, band.points).distances_sq)
        whole += bool((off <= band.half_width).all())
        place = seed % len(places)
        narrow = fit.band(0.95, parameters=places[place : place + 1])
        one += bool(off[place] <= narrow.half_width[0])
        chi.append((fit.uncertainty.chi_squared, fit.uncertainty.degrees_of_freedom))
    return one / repetitions, whole / repetitions, np.array(chi)


@pytest.mark.slow
@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("covariance", [ISOTROPIC / 25, TILTED / 25], ids=["isotropic", "tilted"])
def test_bands_hold_the_truth_as_often_as_they_say(closed, covariance):
    """400 repetitions, fixed size, truth in the space, errors small beside the curvature.

    `python -m benchmarks.uncertainty` prints 1000, and errors of other sizes.
    """
    one, whole, chi = coverage(closed, covariance, 400)
    # Binomial: three standard deviations of 0.0109.
    assert abs(one - 0.95) <= 3 * np.sqrt(0.95 * 0.05 / 400)
    assert abs(whole - 0.95) <= 3 * np.sqrt(0.95 * 0.05 / 400)
    # The mean of a chi-squared variable over its degrees of freedom, 130: three of its deviations.
    ratio = chi[:, 0].mean() / chi[:, 1].mean()
    assert abs(ratio - 1.0) <= 3 * np.sqrt(2 / chi[:, 1].mean() / 400) + 0.005


@pytest.mark.slow
@pytest.mark.parametrize("loss", ["huber", "tukey"])
def test_bands_of_robust_losses_hold_the_truth(loss):
    one, _, _ = coverage(True, ISOTROPIC / 25, 400, loss=loss)
    assert abs(one - 0.95) <= 3 * np.sqrt(0.95 * 0.05 / 400)


@pytest.mark.parametrize("loss", ["huber", "tukey"])
@pytest.mark.parametrize("known", [True, False])
def test_robust_losses_shrug_off_outliers(loss, known):
    curve = truth(True)
    contour, start = noisy(curve, 150, ISOTROPIC, 1)
    points = contour.points.copy()
    points[::15] *= 1.1
    spoilt = Contour(points, True)
    sigma = 0.01 if known else None

    def off(fit):
        at = np.linspace(0, 1, 200)
        return np.sqrt(nearest(curve, fit.spline(at)).distances_sq.mean())

    square = off(optimize(spoilt, start, LM))
    robust = off(optimize(spoilt, start, LM, sigma=sigma, loss=loss))
    assert robust < 0.2 * square


# --- beside orthogonal distance regression -----------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("ratio", [1.0, 0.6], ids=["arc", "ellipse"])
@pytest.mark.filterwarnings("ignore")
def test_odrpack_finds_its_ellipse_inside_our_band(ratio):
    """Implicit orthogonal distance regression of three or five parameters, scipy's ODRPACK.

    Its curve is the better estimate, with fewer parameters and the truth among them; ours has it
    within the simultaneous band, and its chi squared differs by the parameters in between.
    """
    odr = pytest.importorskip("scipy.odr")
    rng = np.random.default_rng(2)
    turn = 1.5 * np.pi if ratio == 1.0 else 2 * np.pi
    angle = np.linspace(0, turn, 200, endpoint=ratio == 1.0)
    clean = np.column_stack([10 * np.cos(angle), 10 * ratio * np.sin(angle)])
    points = clean + rng.normal(0, 0.01, clean.shape)
    model = odr.Model(
        lambda b, x: ((x[0] - b[0]) / b[2]) ** 2 + ((x[1] - b[1]) / b[3]) ** 2 - 1, implicit=True
    )
    data = odr.RealData(points.T, 1, sx=0.01)
    found = odr.ODR(data, model, beta0=[0, 0, 10, 10 * ratio]).run()
    x0, y0, a, b = found.beta
    at = np.linspace(0, turn, 20_001)
    theirs = np.column_stack([x0 + a * np.cos(at), y0 + b * np.sin(at)])
    contour = Contour(points, closed=ratio != 1.0)
    start = _start(contour, 14)
    fit = optimize(contour, start, LM, sigma=0.01, limits=LIMITS)
    places = np.linspace(0.01, 0.99, 200)
    band = fit.band(0.99, simultaneous=True, parameters=places)
    off = np.sqrt(((band.points[:, None] - theirs[None]) ** 2).sum(axis=2).min(axis=1))
    assert (off <= band.half_width + 0.002).all()  # the spline is no ellipse: bias below 1e-3
    # chi squared: ODRPACK's is the sum of squared distances over sigma squared.
    more = 200 - 4 - fit.uncertainty.degrees_of_freedom
    gained = found.sum_square - fit.uncertainty.chi_squared
    assert abs(gained - more) <= 5 * np.sqrt(2 * more)


def _start(contour, count):
    from shapespline.engines.least_squares import STARTS

    return STARTS["arc-length"](contour, count, 3, None)


# --- speed, files, errors ----------------------------------------------------------------------


@pytest.mark.slow  # a time means nothing under sanitizers
def test_bands_of_ten_thousand_points_take_less_than_50_ms():
    contour = Contour(flower(10_000).points, True)
    start = _start(contour, 100)
    fit = optimize(contour, start, LM, sigma=0.01, limits=Limits(max_iterations=2))
    seconds = []  # of the processor: others may work on the machine
    for _ in range(5):
        began = time.process_time()
        fit.band(0.95, simultaneous=True, parameters=10_000)
        seconds.append(time.process_time() - began)
    assert min(seconds) < 0.05


def test_the_band_goes_into_files_and_pictures(tmp_path):
    contour, start = noisy(truth(True), 120, ISOTROPIC, 0)
    fit = optimize(contour, start, LM, sigma=0.01)
    drawing = Drawing([fit])
    write(tmp_path / "a.json", drawing)
    again = read(tmp_path / "a.json").fits[0]
    assert again.covariance.tobytes() == fit.covariance.tobytes()
    assert again.uncertainty.chi_squared == fit.uncertainty.chi_squared
    assert again.band(0.9).half_width.tobytes() == fit.band(0.9).half_width.tobytes()
    write(tmp_path / "plain.svg", drawing)
    write(tmp_path / "band.svg", drawing, band=0.95)
    assert (tmp_path / "plain.svg").read_text().count("<path") == 1
    assert (tmp_path / "band.svg").read_text().count("<path") == 2
    assert isinstance(read(tmp_path / "plain.svg"), Shape | Drawing)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"sigma": 0.0}, "sigma must be positive and finite, got 0.0 at index 0"),
        (
            {"sigma": [0.1, -1.0, *[0.1] * 118]},
            "sigma must be positive and finite, got -1.0",
        ),
        ({"sigma": np.ones(7)}, r"sigma must be a length, or have shape \(n,\), \(n, 2\) or"),
        ({"sigma": np.ones((120, 2, 2))}, "sigma must hold covariances that are symmetric"),
        ({"sigma": "much"}, "sigma must be an array of numbers"),
        ({"loss": "cauchy"}, "loss must be one of huber, tukey or None, got 'cauchy'"),
        ({"sigma": 0.1, "weights": np.ones(120)}, "weights and sigma or loss say the same thing"),
        ({"snapshots": -1}, "snapshots must be a whole number of iterations"),
    ],
)
def test_bad_input_is_one_sentence(arguments, sentence):
    contour, start = noisy(truth(True), 120, ISOTROPIC, 0)
    with pytest.raises(InvalidInputError, match=sentence) as raised:
        optimize(contour, start, LM, **arguments)
    assert "\n" not in str(raised.value)


def test_too_few_points_for_the_degrees_of_freedom():
    contour, start = noisy(truth(True), 20, ISOTROPIC, 0)
    with pytest.raises(InvalidInputError, match="20 points for 10 control points with 20 free"):
        optimize(contour, start, LM, sigma=0.01)


def test_bands_want_errors_and_a_level():
    contour, start = noisy(truth(True), 120, ISOTROPIC, 0)
    with pytest.raises(InvalidInputError, match="fit knows no errors of its points"):
        optimize(contour, start, LM).band()
    fit = optimize(contour, start, LM, sigma=0.01)
    for level in (0.0, 1.0, 95, "much"):
        with pytest.raises(InvalidInputError, match="level must be between 0 and 1"):
            fit.band(level)
    for places in (1, [np.nan], [[0.5]]):
        with pytest.raises(InvalidInputError, match="parameters must be"):
            fit.band(parameters=places)

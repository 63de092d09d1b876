"""fit_curve with symmetric=True: mirrored where the data are, and otherwise as ever."""

import numpy as np
import pytest
from tests.support.shapes import flower, moved, wave

from shapespline import Contour, InvalidInputError, Shape, fit_curve, fit_shape
from shapespline.analysis.mirror import find_mirror
from shapespline.analysis.normalization import THINNING


def keyhole(n=240):
    """A closed outline with corners, curves and lines, symmetric about x = 0."""
    t = np.linspace(-0.35 * np.pi, 1.35 * np.pi, n)
    arc = np.column_stack([3 * np.cos(t), 6 + 3 * np.sin(t)])
    down = np.linspace(0, 1, n // 4)[1:, None]
    left = arc[-1] + down * (np.array([-4.0, 0.0]) - arc[-1])
    base = np.array([-4.0, 0.0]) + down * np.array([8.0, 0.0])
    right = base[-1] + down[:-1] * (arc[0] - base[-1])
    return np.concatenate([arc, left, base, right])


def image_error(fit, mirror):
    """Largest distance from the image of a control point to the nearest control point."""
    points = np.concatenate([piece.control_points[:-1] for piece in fit.pieces])
    image = mirror.reflected(points)
    return np.sqrt(((image[:, None] - points) ** 2).sum(axis=-1)).min(axis=1).max()


@pytest.mark.parametrize("angle", [0.0, 0.3, 1.2, 2.5])
@pytest.mark.parametrize("shift", [0, 77])
@pytest.mark.parametrize("backwards", [False, True])
def test_a_symmetric_outline_gets_a_symmetric_curve(angle, shift, backwards):
    points = np.roll(moved(keyhole(), angle, 1.5, (4, -2)), shift, axis=0)
    contour = Contour(points[::-1] if backwards else points, closed=True)
    fit = fit_curve(contour, tolerance=0.02, symmetric=True)
    assert fit.kept
    mirror = find_mirror(contour)
    axis = moved([(0, 1)], angle)[0]
    # The axis is found to a part of the sampling step; what is left shows in the mirror's error.
    assert abs(mirror.direction @ axis) == pytest.approx(1.0, abs=1e-6)
    # This axis is that of all points, the fit's that of the thinned ones.
    assert image_error(fit, mirror) <= THINNING * 0.02
    plain = fit_curve(contour, tolerance=0.02)
    # A node and a curve on either side where the axis crosses.
    assert fit.n_stored_points <= plain.n_stored_points + 6


@pytest.mark.parametrize("angle", [0.0, 0.3])
@pytest.mark.parametrize("options", [{}, {"character": "drawn"}])
def test_lines_and_arcs_keep_the_mirror_too(angle, options):
    contour = Contour(moved(keyhole(), angle), closed=True)
    fit = fit_curve(contour, tolerance=0.02, symmetric=True, **options)
    assert sorted(piece.kind for piece in fit.pieces) == ["arc", "line", "line", "line"]
    assert "mirror" in {one.name for one in fit.regularities}


def test_a_circle_is_its_own_mirror_image():
    t = np.linspace(0, 2 * np.pi, 100, endpoint=False)
    circle = Contour(np.column_stack([np.cos(t), np.sin(t)]), closed=True)
    (piece,) = fit_curve(circle, tolerance=0.01, symmetric=True).pieces
    assert piece.arc is not None


def test_lines_and_arcs_without_a_mirror_give_way_to_one_that_is_asked_for():
    points = keyhole() + np.random.default_rng(4).normal(0, 5e-3, keyhole().shape)
    contour = Contour(points, closed=True)
    fit = fit_curve(contour, tolerance=0.2, symmetric=True, regularities="axis-parallel")
    mirror = find_mirror(contour)
    assert image_error(fit, mirror) <= 0.2 * THINNING


def test_what_is_not_symmetric_has_no_axis():
    hook = np.concatenate([keyhole(), [[9.0, 1.0], [8.0, -2.0]]])
    assert find_mirror(Contour(hook, closed=True)) is None
    lopsided = Contour(keyhole() * (1, 1) + 0.3 * (keyhole()[:, :1] > 2), closed=True)
    plain = fit_curve(lopsided, tolerance=0.02)
    asked = fit_curve(lopsided, tolerance=0.02, symmetric=True)
    assert asked.kept
    assert asked.n_stored_points == plain.n_stored_points


def test_open_outlines_are_refused_alone_and_fitted_as_ever_among_others():
    with pytest.raises(InvalidInputError, match="symmetric acts on closed outlines only"):
        fit_curve(wave(), tolerance=0.02, symmetric=True)
    plain, asked = (
        fit_shape(Shape([wave()]), tolerance=0.02, symmetric=on).fits[0] for on in (False, True)
    )
    assert (plain.spline.control_points == asked.spline.control_points).all()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"symmetric": 1}, "symmetric must be True or False"),
        ({"symmetric": True, "form": "spline"}, "form='pieces'"),
        ({"symmetric": True, "tolerance": None}, "within a tolerance"),
    ],
)
def test_bad_arguments(arguments, message):
    with pytest.raises(InvalidInputError, match=message):
        fit_curve(flower(), **{"tolerance": 0.05, **arguments})

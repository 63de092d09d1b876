"""Motions that map an outline onto another, by its line alone."""

import numpy as np
import pytest
from tests.support.shapes import moved

import shapespline as ss
from shapespline.fitting.motions import Placed, motion_between

MIRROR = np.diag([-1.0, 1.0])


def blot(n=300):
    """Of no symmetry."""
    t = 2 * np.pi * np.arange(n) / n
    radius = 10 + 2 * np.cos(3 * t) + np.sin(2 * t + 1) + 0.5 * np.cos(5 * t)
    return radius[:, None] * np.column_stack([np.cos(t), np.sin(t)])


def placed(points):
    contour = ss.Contour(points, closed=True)
    return Placed(ss.fit_curve(contour, tolerance=0.2), contour)


@pytest.mark.parametrize("mirrored", [False, True])
@pytest.mark.parametrize("angle", [0.0, np.pi / 2, np.pi, 0.7, -2.0])
def test_a_copy_is_where_it_is(angle, mirrored):
    points = blot()
    image = moved(points @ MIRROR if mirrored else points, angle, shift=(31.0, -7.0))
    image = np.roll(image[::-1] if mirrored else image, 77, axis=0)
    head, other = placed(points), placed(image)
    motion = motion_between(head, other, 0.1, 0.01)
    assert motion is not None
    assert motion.is_mirror == mirrored
    assert motion.keeps_axes == (angle in (0.0, np.pi / 2, np.pi))
    found = head.images(head.line.points, motion.nearer(head, other), other)
    there = np.roll(image, -77, axis=0)[::-1] if mirrored else np.roll(image, -77, axis=0)
    # The sagitta of a step, by which chords of places miss the outline, is 0.006.
    assert np.abs(found - there).max() < 0.01


def test_what_is_no_copy_has_no_motion():
    other = blot() * [1.03, 1.0]
    assert motion_between(placed(blot()), placed(other), 0.05, 0.05) is None


def test_outlines_of_other_lengths_are_not_compared():
    assert motion_between(placed(blot()), placed(1.02 * blot()), 10.0, 0.01) is None


def test_a_motion_and_its_way_back_leave_all_where_it_is():
    rng = np.random.default_rng(5)
    image = moved(blot(), 0.4) + rng.normal(0, 0.02, (300, 2))
    head, other = placed(blot()), placed(image)
    motion = motion_between(head, other, 0.2, 0.05).nearer(head, other)
    both = motion.back().after(motion)
    assert np.allclose(both.linear, np.eye(2), atol=1e-15)
    assert np.allclose(both.shift, 0.0, atol=1e-15)
    assert not both.is_mirror
    # As many points as these tell a shift to their error over the root of their number.
    off = head.images(head.line.points, motion, other) - moved(blot(), 0.4)
    assert np.abs(off.mean(axis=0)).max() < 4 * 0.02 / 300**0.5


def test_a_curve_is_moved_with_all_that_it_keeps():
    square = ss.Contour([(0, 0), (9, 0), (9, 6), (0, 6)], closed=True).resampled(90).points
    turned = square @ np.array([[0.0, 1.0], [-1.0, 0.0]]) + [40.0, 3.0]
    head = Placed(ss.fit_curve(ss.Contour(square, closed=True)), ss.Contour(square, closed=True))
    other = placed(turned)
    fit = head.as_fit_of(other, motion_between(head, other, 0.1, 0.01), None)
    assert [piece.kind for piece in fit.pieces] == ["line"] * 4
    assert {one.name for one in fit.regularities} == {one.name for one in head.fit.regularities}
    assert "axis-parallel" in {one.name for one in fit.regularities}
    assert fit.hausdorff_distance < 1e-9
    slanted = placed(moved(square, 0.3))
    motion = motion_between(head, slanted, 0.1, 0.01)
    assert "axis-parallel" not in {
        one.name for one in head.as_fit_of(slanted, motion, None).regularities
    }


def test_what_a_mirror_image_keeps_is_told_of_its_own_pieces():
    corners = np.array([(0, 0), (9, 0), (9, 6), (4, 8), (0, 3)], dtype=float)
    points = ss.Contour(corners, closed=True).resampled(150).points
    head = placed(points)
    other = placed((points @ MIRROR + [30.0, 2.0])[::-1])
    fit = head.as_fit_of(other, motion_between(head, other, 0.1, 0.01), None)
    level = [k for one in fit.regularities if one.name == "axis-parallel" for k in one.pieces]
    assert len(level) == 3
    assert all((np.ptp(fit.pieces[k].control_points, axis=0) == 0.0).any() for k in level)

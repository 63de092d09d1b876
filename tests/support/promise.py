"""The promise of a fit, by the outside checker."""

import numpy as np

from checks import data_turn, splines, turns, two_sided
from shapespline import Status

# What a certified distance may fall short of a sampled one by, of the box diagonal: rounding.
ROUNDING = 1e-9
# A joint that turns by less is smooth: the degree that fits promise, and rounding.
SMOOTH = np.radians(1.01)
# Where a joint turns by more the data turn by so much within six tolerances on both sides: a round
# of 34 tolerances would turn by as much, and asks for no corner.
DATA_BEND, DATA_REACH = np.radians(20), 12


def checked(fit, tolerance):
    """Assert that a fit keeps a tolerance, and is no farther from its data than it says."""
    contour = fit.contour
    found = two_sided(fit.curve, contour.points, closed=contour.closed, step=tolerance / 10)
    assert found.larger <= fit.hausdorff_distance + ROUNDING * contour.box_diagonal
    assert fit.status == Status.KEPT
    assert fit.kept
    assert fit.hausdorff_distance <= tolerance == fit.tolerance
    return fit


def assert_turns_with_the_data(pieces, contour, tolerance):
    """Assert that joints are smooth but where the data have a bend; how many are not."""
    turn = np.abs(turns(pieces, closed=contour.closed))
    nodes = np.array([spline.c[0] for spline in splines(pieces)])[0 if contour.closed else 1 :]
    sharp = nodes[turn > SMOOTH]
    reach = DATA_REACH * tolerance
    bends = data_turn(contour.points, sharp, closed=contour.closed, reach=reach)
    assert (bends > DATA_BEND).all(), np.degrees(bends)
    return len(sharp)

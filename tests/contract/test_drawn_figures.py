"""What `python -m benchmarks.drawn` says of curves whose faults are known."""

from itertools import pairwise

import numpy as np
from benchmarks.drawn.found import Found
from benchmarks.drawn.icons import outlines_of
from benchmarks.drawn.measure import Figures
from benchmarks.drawn.shapes import box
from benchmarks.drawn.truth import Arc

from shapespline.values import Piece

CORNERS = [(-50.0, -30.0), (50.0, -30.0), (50.0, 30.0), (-50.0, 30.0)]


def row_of(corners):
    """The figures of a polygon that should be a box of 100 by 60."""
    knots = np.array([0.0, 0.0, 1.0, 1.0])
    loop = pairwise(np.array([*corners, corners[0]]))
    lines = [Piece("line", 1, knots, np.stack(pair)) for pair in loop]
    figures = Figures()
    figures.add("box", [box(100, 60)], Found.of_pieces([lines]))
    return figures.row()


def test_every_fault_shows_in_its_column_and_in_no_other():
    right = row_of(CORNERS)
    assert right["straight"] == right["level"] == right["corners"] == right["same"] == "100"
    assert right["lost"] == right["chamfered"] == "0"
    assert right["false"] == right["hooks"] == "0.0"
    assert right["points"] == "1.00"
    assert right["spread"] == "0.000"

    chamfered = row_of([(-50.0, -30.0), (49.0, -30.0), (50.0, -29.0), *CORNERS[2:]])
    assert chamfered["chamfered"] == "25"
    assert chamfered["corners"] == "75"  # breaks a pixel away: found, but not within half of one
    assert chamfered["lost"] == "0"

    hooked = row_of([CORNERS[0], (0.0, -30.0), (0.0, -30.5), (0.5, -30.0), *CORNERS[1:]])
    assert hooked["hooks"] == "1.0"
    assert hooked["false"] == "3.0"

    # Two pairs of equal sides; one of the long ones lies 0.1 off, so do the ends of the short ones.
    shifted = row_of([(x, y + 0.1 if y > 0 else y) for x, y in CORNERS])
    assert shifted["spread"] == "0.050"  # the median of 0.1 and 0
    leaning = row_of([CORNERS[0], (50.0, -29.9), *CORNERS[2:]])
    assert leaning["level"] == "75"
    assert float(leaning["direction"]) < 0.06  # one side of four leans by 0.1 / 100


def test_arcs_of_one_circle_and_lines_in_a_row_are_one_element():
    ring = "M12,2A10,10 0 0,0 2,12A10,10 0 0,0 12,22A10,10 0 0,0 22,12A10,10 0 0,0 12,2Z"
    ((circle,),) = outlines_of(ring)
    assert isinstance(circle, Arc)
    assert abs(circle.sweep - 2 * np.pi) < 1e-12  # y up it runs counter-clockwise
    np.testing.assert_allclose([*circle.centre, circle.radius], [0.5, 0.5, 10 / 24])
    ((*lines,),) = outlines_of("M0,0H6H12V12H0Z")
    assert len(lines) == 4

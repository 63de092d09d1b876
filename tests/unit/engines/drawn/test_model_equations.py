"""Each equation of the kernel: it is met, and what it leaves free is least squares."""

import numpy as np
import pytest

from shapespline import _kernels

# Two lines, seven circles, and two unknowns of a motion, which no data tell.
LINES = {0: (0.0, 0.0), 2: (np.pi / 2, 1.0)}
CIRCLES = {
    4: (3.0, 2.1, 2.0),
    7: (6.5, 3.0, 1.6),
    10: (3.4, 2.3, 1.5),
    13: (8.0, 0.5, 1.0),
    16: (-1.3, 7.23, 1.0),
    19: (-1.3, 8.18, 1.0),
    22: (-1.3, 9.14, 1.0),
}
AXIS = np.arctan2(0.9, 3.5) + np.pi / 2
MOTIONS = {"turn": (1.0, 2.0), "mirror": (AXIS, 2.55 * np.cos(AXIS) - 4.75 * np.sin(AXIS))}


def edges(circle, side):
    """One along the first line up to a circle, one along the second up to another."""
    begin = [_kernels.End(at, is_line=True) for at in (2, 0)]
    ends = [
        _kernels.End(13, is_line=False, side=-1.0),
        _kernels.End(circle, is_line=False, side=side),
    ]
    return [_kernels.Edge(at, a, b, 1e-4) for at, a, b in zip((0, 2), begin, ends, strict=True)]


EQUATIONS = {
    "difference": _kernels.Difference((0, 6), (2, 9), turn=-1.5),
    "alone": _kernels.Difference((0,), (), turn=0.01),
    "line touches": _kernels.LineTouches(0, 4, 1.0),
    "circles touch": _kernels.CirclesTouch(4, 7, alike=False),
    "circle within": _kernels.CirclesTouch(4, 10, alike=True),
    "line through": _kernels.PassesThrough(0, is_line=True, x=1.0, y=0.1),
    "circle through": _kernels.PassesThrough(4, is_line=False, x=5.1, y=2.1),
    "lines, turn": _kernels.Images((0,), (2,), 25, is_line=True, angle=np.pi / 2),
    "circles, turn": _kernels.Images((4,), (7,), 25, is_line=False, angle=0.4),
    "lines, mirror": _kernels.Images((0,), (2,), 25, is_line=True),
    "circles, mirror": _kernels.Images((4,), (7,), 25, is_line=False),
    "lengths, after": _kernels.EqualLengths(*edges(16, 1.0)),
    "lengths, before": _kernels.EqualLengths(*edges(22, -1.0)),
    "lengths, at the foot": _kernels.EqualLengths(*edges(19, 0.0)),
}


def elements(random):
    """Their points, twenty each, shaken."""
    along, angle = np.linspace(-1.0, 8.0, 20), np.linspace(0.3, 5.0, 20)
    parts = [np.column_stack([along, 0 * along]), np.column_stack([0 * along - 1.0, along])]
    for x, y, r in CIRCLES.values():
        parts.append(np.column_stack([x + r * np.cos(angle), y + r * np.sin(angle)]))
    points = np.concatenate(parts)
    points += random.normal(0, 0.01, points.shape)
    at = [*LINES, *CIRCLES]
    begins = list(range(0, len(points), 20))
    is_line = [k in LINES for k in at]
    alike = np.ones(len(points))
    return _kernels.Elements(is_line, at, begins, points, alike, alike, 0.01)


def slopes(function, x):
    """Central differences, one row for each value."""
    h = 1e-5
    steps = h * np.eye(len(x))
    rows = [(np.array(function(x + s)) - np.array(function(x - s))) / (2 * h) for s in steps]
    return np.array(rows).T


@pytest.mark.parametrize("name", EQUATIONS)
def test_it_is_met_and_the_rest_is_least_squares(name):
    own, equation = elements(np.random.default_rng(1)), EQUATIONS[name]
    motion = MOTIONS["mirror" if name.endswith("mirror") else "turn"]
    if name == "lines, mirror":
        motion = (np.pi / 4, 1.0 / np.sqrt(2.0))
    x = np.concatenate([*LINES.values(), *CIRCLES.values(), motion]).astype(float)
    limits = _kernels.EstimateLimits(
        rounds=40, extent=10.0, least_step=1e-13, longest_step=0.3, implied=1e-6
    )
    _kernels.estimate(own, [equation], x, limits)
    assert np.abs(_kernels.equation_values([equation], x)).max() < 1e-12
    (down,) = slopes(lambda at: [0.5 * sum(one[0] for one in own.misfits(at))], x)
    rows = slopes(lambda at: _kernels.equation_values([equation], at), x)
    held = np.linalg.lstsq(rows.T, down, rcond=None)[0]
    # Chi squared falls nowhere but against the equation: differences are off by h^2 = 1e-10 times a
    # third derivative, 20 points over 0.01^2 and a radius of one, and some.
    assert np.abs(down - rows.T @ held).max() < 1e-3
    # An axis of two lines is always there.
    assert (np.abs(down).max() > 1.0) == (name != "lines, mirror")

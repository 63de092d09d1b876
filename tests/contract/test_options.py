"""Every option with every goal: it acts, it holds anyway, or it is refused with a sentence."""

from __future__ import annotations

import dataclasses
import inspect
from functools import cache

import numpy as np
import pytest
from checks.distance import distance_to_curve

import shapespline as ss
from shapespline.fitting import Settings

# An open arch with corners, clean and shaken; a closed one with a mirror symmetry.
T = np.linspace(0.0, np.pi, 200)
ARCH = np.concatenate(
    [[(-6.0, 0.0)], np.column_stack([-4 * np.cos(T), 3 * np.sin(T)]), [(6.0, 0.0)]]
)
NOISE = np.random.default_rng(3).normal(0.0, 0.05, ARCH.shape)
SHAKEN = ARCH + NOISE
DATA = {
    "within": (ARCH, {"tolerance": 0.002}),
    "within, one spline": (ARCH, {"tolerance": 0.05, "form": "spline"}),
    "of size": (ARCH, {"n_control_points": 20}),
    "estimate, clean": (ARCH, {}),
    "estimate, noisy": (SHAKEN, {}),
    "estimate, noisy, one spline": (SHAKEN, {"form": "spline"}),
    "estimate, weighted": (SHAKEN, {"weights": np.ones(len(ARCH))}),
    "estimate, measured": (SHAKEN, {"sigma": 0.05}),
}
STRUCTURE = ("regularities", "simplify")
LEAST_SQUARES = ("estimate, weighted", "estimate, measured")
WEIGHTS = np.where(np.arange(len(ARCH)) % 40 == 7, 50.0, 1.0)
# Option -> a value that is not its default.
OPTIONS = {
    "degree": 2,
    "corners": [30, 60, 150],
    "form": "spline",
    "ends": "fixed",
    "end_tangents": ((1.0, 0.0), None),
    "through": [60],
    "symmetric": True,
    "effort": "fast",
    "character": "fewest",
    "regularities": None,
    "simplify": True,
    "smoothness": 2,
    "weights": WEIGHTS,
    "sigma": 0.05 / np.sqrt(WEIGHTS),
    "loss": "tukey",
    "knots": "uniform",
    "outliers": True,
    "method": "d-bfgs",
    "time_limit": 1e-9,
    "callback": lambda record: True,
}
ACTS, HOLDS, REFUSED = "acts", "holds anyway", "is refused"
# What each option does beside each goal; everything else acts.
EXPECTED = {
    # Its form and its ends are said already, or always so.
    ("form", "within, one spline"): HOLDS,
    ("ends", "within, one spline"): HOLDS,
    ("ends", "of size"): HOLDS,
    ("form", "estimate, noisy, one spline"): HOLDS,
    ("form", "estimate, weighted"): HOLDS,
    ("form", "estimate, measured"): HOLDS,
    **dict.fromkeys(
        [
            *(("corners", goal) for goal in ("of size", *LEAST_SQUARES)),
            *(("corners", goal) for goal in DATA if goal.endswith("one spline")),
            ("form", "of size"),
            *(("effort", goal) for goal in ("of size", *LEAST_SQUARES)),
            *(
                (name, goal)
                for name in ("sigma", "loss")
                for goal in ("within", "within, one spline", "estimate, weighted")
            ),
            ("weights", "estimate, measured"),
            *(
                (name, goal)
                for name in ("end_tangents", "through", "symmetric")
                for goal in DATA
                if goal != "within"
            ),
            ("symmetric", "within"),  # of an open outline
            *(("smoothness", goal) for goal in DATA if goal != "within"),
            *(("knots", goal) for goal in DATA if goal != "of size"),
            *(("method", goal) for goal in ("within", "within, one spline")),
            *(("method", goal) for goal in ("estimate, clean", "estimate, noisy")),
        ],
        REFUSED,
    ),
    # What least squares make has no lines and arcs; noise between those is smoothed with the rest.
    **dict.fromkeys(
        [
            *((name, goal) for name in STRUCTURE for goal in ("of size", *LEAST_SQUARES)),
            *((name, goal) for name in STRUCTURE for goal in DATA if goal.endswith("one spline")),
            *(("simplify", goal) for goal in DATA if goal.startswith("estimate")),
        ],
        REFUSED,
    ),
    # Noise hides that its two edges were drawn, level and on one line.
    ("regularities", "estimate, noisy"): HOLDS,
    **{("character", goal): HOLDS for goal in DATA if goal not in ("within", "estimate, clean")},
    ("simplify", "within"): HOLDS,
    # Nothing is left to search for: least squares of a size that a criterion chose.
    ("effort", "estimate, noisy, one spline"): HOLDS,
}


@cache
def plain(goal):
    points, options = DATA[goal]
    return ss.fit_curve(points, closed=False, **options)


def same(a, b):
    return a.spline.knots.tobytes() == b.spline.knots.tobytes() and (
        a.spline.control_points.tobytes() == b.spline.control_points.tobytes()
    )


@pytest.mark.parametrize(
    "goal",
    [
        pytest.param(one, marks=pytest.mark.slow if one.startswith("estimate") else ())
        for one in DATA
    ],
)
@pytest.mark.parametrize("option", OPTIONS)
def test_an_option_acts_or_is_refused(option, goal):
    points, options = DATA[goal]
    if option == "outliers":
        points = points.copy()
        points[90] += 2.0
    given = {**options, option: OPTIONS[option]}
    expected = EXPECTED.get((option, goal), ACTS)
    if expected == REFUSED:
        with pytest.raises(ss.InvalidInputError, match=option):
            ss.fit_curve(points, closed=False, **given)
        return
    fit = ss.fit_curve(points, closed=False, **given)
    if expected == HOLDS:
        assert same(fit, plain(goal))
    else:
        assert ACT[option](fit, points, goal), f"{option} was dropped beside {goal}"


def ends_are_kept(fit, points, goal):
    return (fit.control_points[[0, -1]] == points[[0, -1]]).all()


def heavy_points_are_nearer(fit, points, goal):
    heavy = points[WEIGHTS > 1]
    after, before = (distance_to_curve(heavy, one.curve, 1e-3).max() for one in (fit, plain(goal)))
    return after < before


def was_ended(status):
    def check(fit, points, goal):
        return fit.status == status

    return check


ACT = {
    "degree": lambda fit, points, goal: fit.degree == 2,
    "corners": lambda fit, points, goal: not same(fit, plain(goal)),
    "form": lambda fit, points, goal: len(fit.pieces) == 1,
    "ends": ends_are_kept,
    "end_tangents": lambda fit, points, goal: (
        abs(np.arctan2(*fit.spline([0.0], derivative=1)[0][::-1])) < 1e-9
    ),
    "through": lambda fit, points, goal: (
        distance_to_curve(points[60:61], fit.curve, 1e-3)[0] < 1e-12
    ),
    "effort": lambda fit, points, goal: not same(fit, plain(goal)),
    "character": lambda fit, points, goal: bool(plain(goal).regularities and not fit.regularities),
    "regularities": lambda fit, points, goal: bool(
        plain(goal).regularities and not fit.regularities
    ),
    "smoothness": lambda fit, points, goal: not same(fit, plain(goal)),
    "weights": heavy_points_are_nearer,
    "sigma": heavy_points_are_nearer,
    "loss": lambda fit, points, goal: not same(fit, plain(goal)),
    "knots": lambda fit, points, goal: not same(fit, plain(goal)),
    "outliers": lambda fit, points, goal: fit.outliers.tolist() == [90],
    "method": lambda fit, points, goal: fit.method == "d-bfgs",
    "time_limit": was_ended(ss.Status.BUDGET),
    "callback": was_ended(ss.Status.CANCELLED),
}


def test_every_option_is_tried():
    options = set(inspect.signature(ss.fit_curve).parameters)
    assert set(OPTIONS) == options - {"points", "closed", "tolerance", "n_control_points"}
    assert {field.name for field in dataclasses.fields(Settings)} == options - {
        "points",
        "closed",
        "callback",
    }


@pytest.mark.parametrize("method", ["nonsense", "d-bfgs"])
def test_a_method_is_checked_within_a_tolerance_too(method):
    with pytest.raises(ss.InvalidInputError, match="method"):
        ss.fit_curve(ARCH, closed=False, tolerance=0.01, method=method)


@pytest.mark.parametrize(
    ("options", "named"),
    [
        ({"outliers": True, "effort": "much"}, "effort"),
        ({"outliers": True, "form": "spline", "through": [3], "tolerance": 0.1}, "through"),
        ({"outliers": True, "weights": np.ones(3)}, "weights"),
    ],
)
def test_arguments_are_checked_before_any_work(monkeypatch, options, named):
    def never(contour):
        raise AssertionError("work had begun")

    monkeypatch.setattr("shapespline.fitting.request.find_outliers", never)
    with pytest.raises(ss.InvalidInputError, match=named):
        ss.fit_curve(ARCH, closed=False, **options)


def test_settings_come_back_from_a_dictionary():
    settings = Settings(tolerance="0.1%", corners=[4, 2], through=[1], weights=[1, 2.5])
    said = settings.to_dict()
    assert said == {
        "tolerance": "0.1%",
        "corners": [2, 4],
        "through": [1],
        "weights": [1.0, 2.5],
    }
    assert Settings.from_dict(said).to_dict() == said
    assert Settings.from_dict({"corners": None}).to_dict() == {"corners": None}
    with pytest.raises(ss.InvalidInputError, match="tolerence is not an option of a fit"):
        Settings.from_dict({"tolerence": 1})

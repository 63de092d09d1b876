"""One fit on its way through the rooms: every room is below the one that calls it."""

from __future__ import annotations

import numpy as np
import pytest
from benchmarks.flow import outline, room_of, way_of

import shapespline as ss


@pytest.fixture(scope="module")
def way():
    points = outline()
    ss.fit_curve(points, closed=True, tolerance=0.01, character="fewest")  # everything is loaded
    return way_of(lambda: ss.fit_curve(points, closed=True, tolerance=0.01, character="fewest"))


def test_control_never_climbs_to_a_higher_rank(way):
    assert not way.climbs


def test_one_fit_passes_few_modules(way):
    # docs/architecture.md states the figure; a module more is a decision (the last three PIE-30).
    assert len(way.modules) <= 47
    rooms = {room_of(module) for module in way.modules}
    assert rooms == {"ground", "values", "geometry", "analysis", "engines", "fitting"}


def test_points_become_a_contour_a_request_and_a_fit_once(monkeypatch):
    made = []

    def counted(cls, name):
        original = getattr(cls, name)

        def call(*arguments, **options):
            made.append(name)
            return original(*arguments, **options)

        return call

    from shapespline.fitting import curve, settings
    from shapespline.values import Contour

    monkeypatch.setattr(Contour, "__init__", counted(Contour, "__init__"))
    monkeypatch.setattr(
        settings.Settings, "__post_init__", counted(settings.Settings, "__post_init__")
    )
    monkeypatch.setattr(curve, "solve", counted(curve, "solve"))
    ss.fit_curve(outline(), closed=True, tolerance=0.01, character="fewest")
    assert made == ["__post_init__", "__init__", "solve"]


def test_a_climb_would_be_seen():
    from shapespline.values import Contour

    def rank(module):
        return {"shapespline.values.contour": 1}.get(module, 2 if "validation" in module else 0)

    climbs = way_of(lambda: Contour(np.eye(3)[:, :2]), rank).climbs
    assert climbs["shapespline.values.contour", "shapespline.validation"] == 1

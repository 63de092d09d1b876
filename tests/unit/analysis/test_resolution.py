"""What points show: the band that their noise or their accuracy leaves."""

from __future__ import annotations

from tests.support.shapes import flower, shaken

from shapespline import Contour
from shapespline.analysis.resolution import NOISE_BAND, resolution


def test_noise_beyond_the_accuracy_counts():
    noisy = shaken(flower(400), 1.0, 4)
    shown = resolution(Contour(noisy.points, closed=True, accuracy=1e-6))
    assert not shown.clean
    assert shown.band == NOISE_BAND * shown.noise

"""Aeroplanes of pictures: fillets of a few pixels, tellings that hold in part."""

from itertools import pairwise

import numpy as np
import pytest
from benchmarks.drawn import renderers
from benchmarks.drawn.icons import outlines_of
from benchmarks.drawn.truth import Line, placed
from tests.support.places import DATA

import shapespline as ss

# From above: a nose of two curves, wings and a tail with fillets of 1.25 and 0.62.
AEROPLANE = (
    "M9.8,4.8C9.8,3.2 10.6,2 12,2C13.4,2 14.2,3.2 14.2,4.8V10L20.9,15.9A1.25,1.25 0 0,1"
    " 21.3,16.8V18.3A0.62,0.62 0 0,1 20.5,18.9L14.2,17.2V20.2L16.6,22A0.62,0.62 0 0,1"
    " 16.85,22.5V23.1A0.62,0.62 0 0,1 16.05,23.7L12,22.6L7.95,23.7A0.62,0.62 0 0,1 7.15,23.1V22.5"
    "A0.62,0.62 0 0,1 7.4,22L9.8,20.2V17.2L3.5,18.9A0.62,0.62 0 0,1 2.7,18.3V16.8"
    "A1.25,1.25 0 0,1 3.1,15.9L9.8,10Z"
)


@pytest.mark.parametrize(("size", "seed"), [(220, 2), (240, 2), (280, 2)])
def test_fillets_beside_a_free_form_nose_are_neither_chamfers_nor_notches(size, seed):
    picture = renderers.exact(placed(outlines_of(AEROPLANE), size, 0.0, seed=seed), size)
    (fit,) = ss.fit_shape(ss.trace(picture))
    assert fit.method == "drawn"
    # What three deviations, taken three times as large, leave of a corner that does not turn.
    assert fit.hausdorff_distance < 0.18
    radii = np.array([piece.arc.radius for piece in fit.pieces if piece.arc])
    small, large = radii[radii < 7.4 * size / 256], radii[radii > 7.4 * size / 256]
    assert len(small) >= 4
    assert np.ptp(small) < 1e-9 * size
    assert abs(large.mean() / small[0] / (1.25 / 0.62) - 1) < 0.02


def aeroplane_of_the_paper(size, place):
    """Its picture of 256 pixels, traced and fitted."""
    line = ss.read(DATA / "paper" / "airplane1100.csv", closed=True).longest.polyline
    corners = (line - line.min(axis=0)) / np.ptp(line, axis=0).max() * size + place
    picture = renderers.exact([[Line(*pair) for pair in pairwise(corners)]], 256)
    (fit,) = ss.fit_shape(ss.trace(picture))
    assert fit.method == "drawn"
    return fit


@pytest.mark.parametrize(
    ("size", "place"), [(198, (21.64, 22.4)), (216, (18.3, 23.2)), (217, (18.3, 23.2))]
)
def test_what_is_told_shorter_in_part_gives_way_to_what_is_exact(size, place):
    # At 212 and 213 it has a false corner on a wing tip, which the tip's true arc passes by 0.18.
    fit = aeroplane_of_the_paper(size, place)
    assert fit.hausdorff_distance < 0.18  # 0.28 and 0.25 told shorter (DRA-29), the latter two


def test_what_is_told_shorter_in_part_does_not_hold_because_it_is_read_alike():
    # Seven where the mirrored halves of the shorter telling had one free-form run more (DRA-30); it
    # has nine.
    fit = aeroplane_of_the_paper(220, (15.5, 16.2))
    assert sum(piece.kind == "arc" for piece in fit.pieces) == 9

"""Rows read alike where their outline is its own image."""

from io import BytesIO
from itertools import pairwise

import numpy as np
import pytest
from PIL import Image

import shapespline as ss
from shapespline.engines.drawn import DrawnArc, DrawnLine, as_drawn
from shapespline.engines.drawn.observed import Observed
from shapespline.engines.drawn.repeats import rows_repeated
from shapespline.engines.drawn.segments import ARC, FREE, LINE, Segment, segmented
from shapespline.studio.examples import example_bytes
from shapespline.values import Contour


def cog(teeth=8, n=20):
    """Teeth with straight sides on a circle: three lines and an arc each."""
    part = 2 * np.pi / teeth
    corners = [(10, -0.25), (13, -0.15), (13, 0.15), (10, 0.25)]
    sides = []
    for k in range(teeth):
        ends = [r * np.exp(1j * part * (k + at)) for r, at in corners]
        for a, b in pairwise(ends):
            sides.append(a + (b - a) * np.arange(n) / n)
        sides.append(10 * np.exp(1j * part * (k + 0.25 + 0.5 * np.arange(n) / n)))
    z = np.concatenate(sides)
    return Contour(np.column_stack([z.real, z.imag]), closed=True)


def house(n=25):
    """A polygon of seven sides that is its own mirror image."""
    corners = np.array([(0, 9), (-6, 5), (-4, 0), (-7, -4), (7, -4), (4, 0), (6, 5)], dtype=float)
    t = np.arange(n)[:, None] / n
    after = np.roll(corners, -1, axis=0)
    points = np.concatenate([a + t * (b - a) for a, b in zip(corners, after, strict=True)])
    return Contour(points, closed=True)


def read(contour):
    seen = Observed.of(contour, None)
    return seen, segmented(seen)


def kinds(row):
    return [segment.kind for segment in row.found]


def with_free(row, places):
    return row._replace(
        found=tuple(s._replace(kind=FREE) if k in places else s for k, s in enumerate(row.found))
    )


def arcs_of(row):
    return [k for k, segment in enumerate(row.found) if segment.kind == ARC]


def test_what_is_read_alike_stays():
    seen, row = read(cog())
    assert sorted(kinds(row)) == [LINE] * 24 + [ARC] * 8
    assert not list(rows_repeated(seen, row))
    seen, row = read(house())
    assert kinds(row) == [LINE] * 7
    assert not list(rows_repeated(seen, row))


@pytest.mark.parametrize("which", range(8))
def test_one_part_in_eight_is_read_as_the_others_are(which):
    seen, row = read(cog())
    odd = with_free(row, {arcs_of(row)[which]})
    first, *_ = rows_repeated(seen, odd)
    assert sorted(kinds(first)) == [LINE] * 24 + [ARC] * 8
    # Nodes that were found stay.
    at = {(s.begin + row.first) % len(seen.points) for s in row.found}
    assert {(s.begin + first.first) % len(seen.points) for s in first.found} == at


def test_what_most_are_comes_after_what_has_no_free_form_runs():
    seen, row = read(cog())
    most = with_free(row, set(arcs_of(row)[1:]))
    found = [sorted(kinds(one)) for one in rows_repeated(seen, most)]
    assert found == [[LINE] * 24 + [ARC] * 8, [LINE] * 24 + [FREE] * 8]
    few = with_free(row, set(arcs_of(row)[4:]))
    assert [sorted(kinds(one)) for one in rows_repeated(seen, few)] == found[:1]


def test_halves_are_read_alike_with_the_fewer_nodes_first():
    seen, row = read(house())
    k = 2
    i, j, _ = row.found[k]
    middle = (i + j) // 2
    cut = (Segment(i, middle, LINE), Segment(middle, j, LINE))
    odd = row._replace(found=(*row.found[:k], *cut, *row.found[k + 1 :]))
    sizes = [len(one.found) for one in rows_repeated(seen, odd)]
    assert sizes == sorted(sizes)
    assert set(sizes) == {7, 9}


def test_nodes_stay_or_are_images_where_the_median_of_all_is():
    seen, row = read(cog())
    arcs = arcs_of(row)
    moved = {arcs[1]: 2, arcs[4]: -3}  # points by which the nodes before two arcs are off
    begins = [s.begin + moved.get(k, 0) for k, s in enumerate(row.found)]
    ends = [*begins[1:], row.found[-1].end]
    parts = zip(row.found, begins, ends, strict=True)
    found = tuple(Segment(i, j, s.kind) for s, i, j in parts)
    own, exact = list(rows_repeated(seen, with_free(row._replace(found=found), {arcs[6]})))[:2]
    n = len(seen.points)
    places = [{(s.begin + one.first) % n for s in one.found} for one in (own, exact, row)]
    assert places[1] == places[2]
    assert len(places[0] - places[2]) == 2


@pytest.mark.slow
def test_the_teeth_of_the_studios_gear_are_alike():
    pixels = np.array(Image.open(BytesIO(example_bytes("gear"))).convert("L"))
    outer, *_ = ss.trace(pixels)
    fit = ss.fit_curve(outer)
    kinds = "".join(piece.kind[0] for piece in fit.pieces)
    # Three chords a flank, an arc for the head, one of the root.
    assert kinds in 2 * ("lllallla" * 12)


def test_what_has_no_images_is_left():
    seen, row = read(cog())
    bent = seen.points * [1.0, 1.1]
    contour = Contour(bent + 0.3 * np.sin(bent[:, ::-1]), closed=True)
    seen, row = read(contour)
    assert not list(rows_repeated(seen, with_free(row, {0})))
    seen, row = read(Contour(house().points, closed=False))
    assert not list(rows_repeated(seen, with_free(row, {0})))


def test_the_teeth_of_a_saw_blade_are_alike(outline):
    found = as_drawn(outline("mdi_saw-blade_c0"))
    letters = {DrawnLine: "L", DrawnArc: "A"}
    seen = "".join(letters.get(type(part), "C") for part in found.parts)
    assert seen in 2 * ("LLC" * 8)

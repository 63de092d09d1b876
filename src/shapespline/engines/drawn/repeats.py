"""Rows whose segments repeat as their outline does: after a part of a turn, or across an axis.

Where an outline is its own image within what its points may be off, one of its parts may be read as
other elements than the rest: a chamfer for a fillet, a free-form run for an arc. Here the reading
of one part stands for all of them (DRA-30).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shapespline.engines.drawn.segments import FREE, Segment
from shapespline.engines.drawn.symmetry import way_round

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from shapespline.engines.drawn.observed import Observed
    from shapespline.engines.drawn.segments import Segments
    from shapespline.typing import FloatArray, IntArray

    ComplexArray = NDArray[np.complex128]

# Places of an outline that are compared with their images, and the highest order of a rotation;
# every so many-th of the places is looked at first.
PLACES, FIRST_EVERY, HIGHEST = 1024, 32, 72
# How far an image may be off, in parts of the extent and in deviations, and the nodes of an image,
# in steps (DRA-30).
OFF_PART, OFF_DEVIATIONS, NEAR_STEPS = 0.01, 6.0, 4.0
# So many readings are tried (DRA-30).
MOST_READINGS = 3


def free_runs(row: Segments) -> int:
    """How many free-form runs a row has: segments side by side are one."""
    return _kinds(_joined(row)).count(str(FREE))


class _Part(NamedTuple):
    """A part of an outline whose images are all of it: ``order`` of them by turns, two by a mirror.

    It goes from station ``begin`` on for ``length``; a mirror's images lie on both sides of that.
    """

    begin: float
    length: float
    order: int
    is_mirrored: bool

    def folded(self, station: float) -> float:
        """The station in this part of which a station is an image."""
        away = (station - self.begin) % (self.order * self.length)
        if self.is_mirrored:
            return self.begin + min(away, self.order * self.length - away)
        return self.begin + away % self.length

    def images(self, station: float) -> list[float]:
        """All stations that are folded to this one."""
        if self.is_mirrored:
            return [station, 2.0 * self.begin - station]
        return [station + k * self.length for k in range(self.order)]


def rows_repeated(seen: Observed, row: Segments) -> Iterator[Segments]:
    """Other rows, in which every part is read as one of them is; the simplest first."""
    row = _joined(row)
    kinds = _kinds(row)
    if not seen.closed or len(kinds) < 3 or len(kinds) == kinds.count(str(FREE)):
        return
    rows: dict[str, tuple[_Part, Segments]] = {}
    near = NEAR_STEPS * seen.step
    for part in _parts(seen, row):
        other = _read_alike(row, part, near)
        if other is None:
            continue
        own = _kinds(other)
        if len(own) == len(kinds) and own in 2 * kinds:
            continue
        # What most of many parts are stands for all, if the elements of fewer do not.
        n_free, was = own.count(str(FREE)), kinds.count(str(FREE))
        if n_free <= was or (part.order > 2 and n_free < 2 * was):
            rows.setdefault(own, (part, other))
    simplest = sorted(rows, key=lambda own: (own.count(str(FREE)), len(own)))
    for part, other in (rows[own] for own in simplest[:MOST_READINGS]):
        yield other
        exact = _read_alike(row, part, near, exactly=True)
        if exact is not None and exact.found != other.found:
            yield exact


def _parts(seen: Observed, row: Segments) -> list[_Part]:
    """Parts that repeat: by turns of the highest order, from a node to its image; else halves."""
    total = float(row.stations[-1])
    at = np.linspace(0.0, total, PLACES, endpoint=False)
    places = _at(row, at)
    middle = places.mean()
    places -= middle
    reach = max(OFF_PART * float(np.ptp(row.points, axis=0).max()), OFF_DEVIATIONS * seen.deviation)
    way = way_round(row.points)

    def turning(orders: IntArray, every: int) -> IntArray:
        images = _at(row, at[::every] + total / orders[:, None]) - middle
        turned = np.exp(2j * np.pi * way / orders[:, None]) * places[::every]
        return orders[abs(turned - images).max(axis=1) <= reach]

    for order in turning(np.arange(min(HIGHEST, len(row.found)), 1, -1), FIRST_EVERY).tolist():
        if len(turning(np.array([order]), 1)):
            begins = _begins(row)
            return [
                _Part(begin, total / order, order, False)
                for begin in begins.tolist()
                if _between(begins, begin + total / order, total) <= NEAR_STEPS * seen.step
            ]
    # A mirror's image of place k is place s - k: the s for which their products agree most.
    products = np.fft.ifft(np.fft.fft(places) ** 2)
    s = int(abs(products).argmax())
    less, most, more = abs(products[[s - 1, s, (s + 1) % PLACES]]).tolist()
    s_finer = s + 0.5 * (less - more) / min(less - 2.0 * most + more, -1e-300)
    turn = products[s] / abs(products[s])
    for every in (FIRST_EVERY, 1):
        images = _at(row, s_finer * total / PLACES - at[::every]) - middle
        if abs(turn * places[::every].conj() - images).max() > reach:
            return []
    begin = 0.5 * s_finer * total / PLACES
    return [_Part(begin + side, 0.5 * total, 2, True) for side in (0.0, 0.5 * total)]


def _read_alike(
    row: Segments, part: _Part, near: float, *, exactly: bool = False
) -> Segments | None:
    """The row with all images of a part read as this one; None where these do not make an outline.

    Nodes stay where they are if they are near enough to such an image, or ``exactly`` are images,
    where the median of them is.
    """
    total, begins = float(row.stations[-1]), _begins(row)
    stations: list[float] = []
    for begin in begins.tolist():
        away = (begin - part.begin) % total
        if part.is_mirrored:  # those on the axis are of both halves
            away = 0.0 if away > total - near else away
            away = min(away, part.length) if away <= part.length + near else away
        elif away > part.length - near:
            continue
        if away > part.length:
            continue
        images = part.images(part.begin + away)
        if exactly:
            images = part.images(part.begin + away + _median_miss(begins, part, images, near))
        stations += images
    wanted = np.array(stations)
    off = np.abs(_apart(begins, wanted[:, None], total))
    stays = off.min(axis=1, initial=np.inf) <= (-1.0 if exactly else near)
    nodes = {row.found[k].begin for k in off[stays].argmin(axis=1).tolist()}
    for station in (wanted[~stays] % total).tolist():
        nodes.add(int(np.abs(row.stations[:-1] - station).argmin()))
    ordered = sorted(nodes)
    if len(ordered) < 2:
        return None
    ends = [*row.stations[ordered[1:]].tolist(), float(row.stations[ordered[0]]) + total]
    own = zip(row.stations[ordered].tolist(), ends, strict=True)
    inside = [part.folded(0.5 * (begin + end)) % total for begin, end in own]
    read = np.searchsorted(begins, inside, side="right") - 1
    kinds = [row.found[k].kind for k in read.tolist()]
    whole = next((k for k, kind in enumerate(kinds) if kind != FREE), 0)
    ordered, kinds = ordered[whole:] + ordered[:whole], kinds[whole:] + kinds[:whole]
    named = row._replace(found=tuple(Segment(0, 0, kind) for kind in kinds))
    return _joined(named.cut_at(ordered))


def _median_miss(begins: FloatArray, part: _Part, images: list[float], near: float) -> float:
    """How far nodes are from images of one, along the part; the median of those that are near."""
    off = _apart(begins, np.array(images)[:, None], part.order * part.length)
    nearest = off[np.arange(len(images)), np.abs(off).argmin(axis=1)]
    if part.is_mirrored:
        nearest[1:] = -nearest[1:]
    missed = nearest[np.abs(nearest) <= near]
    return float(np.median(missed)) if len(missed) else 0.0


def _begins(row: Segments) -> FloatArray:
    """Stations where segments begin."""
    return row.stations[[segment.begin for segment in row.found]]


def _kinds(row: Segments) -> str:
    """What segments are, a digit each."""
    return "".join(str(segment.kind) for segment in row.found)


def _joined(row: Segments) -> Segments:
    """The row with free-form segments side by side as one."""
    found: list[Segment] = []
    for segment in row.found:
        if found and found[-1].kind == segment.kind == FREE:
            found[-1] = found[-1]._replace(end=segment.end)
        else:
            found.append(segment)
    return row._replace(found=tuple(found))


def _apart(stations: FloatArray, other: float | FloatArray, total: float) -> FloatArray:
    """From a station to others, the shorter way round; a row for each of some in a column."""
    return (stations - other + 0.5 * total) % total - 0.5 * total


def _between(stations: FloatArray, other: float, total: float) -> float:
    """How far the nearest of some stations is."""
    return float(np.abs(_apart(stations, other, total)).min())


def _at(row: Segments, stations: FloatArray) -> ComplexArray:
    """Places of a closed outline."""
    total = float(row.stations[-1])
    x, y = (np.interp(stations % total, row.stations, c) for c in row.points.T)
    return x + 1j * y

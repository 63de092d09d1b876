"""Centre lines of drawn strokes: where they run, where they meet, what is no stroke."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageDraw

import shapespline as ss

# Drawn four times as large and reduced: anti-aliased, edges known to a quarter of a pixel.
FINE = 4


def drawn(tmp_path, draw, size=(300, 220)):
    image = Image.new("L", (FINE * size[0], FINE * size[1]), 255)
    draw(ImageDraw.Draw(image))
    path = tmp_path / "strokes.png"
    image.reduce(FINE).save(path)
    return ss.read(path, centerline=True)


def line(pen, ends, width):
    pen.line([tuple(FINE * x for x in end) for end in ends], fill=0, width=FINE * width)


def distance_to_line(points, a, b):
    along = np.subtract(b, a) / np.hypot(*np.subtract(b, a))
    off = np.asarray(points) - a
    return np.abs(off[:, 0] * along[1] - off[:, 1] * along[0])


def test_a_stroke_is_one_open_line(tmp_path):
    (found,) = drawn(tmp_path, lambda pen: line(pen, [(40, 60), (250, 160)], 12))
    assert not found.closed
    # y turned over: the picture is 220 high. Edges and the middle are within half a pixel.
    assert distance_to_line(found.points, (40, 160), (250, 60)).max() < 0.5
    # From end to end, both drawn square.
    assert found.length == pytest.approx(np.hypot(210, 100), abs=1.0)


def test_crossing_strokes_share_their_junction(tmp_path):
    def cross(pen):
        line(pen, [(50, 110), (250, 110)], 10)
        line(pen, [(150, 20), (150, 200)], 10)

    shape = drawn(tmp_path, cross)
    assert len(shape) == 4
    ends = np.concatenate([contour.points[[0, -1]] for contour in shape])
    shared = [tuple(end) for end in ends if (ends == end).all(axis=1).sum() == 4]
    assert len(set(shared)) == 1
    assert np.hypot(*np.subtract(shared[0], (150, 110))) < 0.5
    for contour in shape:
        vertical = np.ptp(contour.points[:, 1]) > np.ptp(contour.points[:, 0])
        a, b = ((150, 0), (150, 9)) if vertical else ((0, 110), (9, 110))
        off = distance_to_line(contour.points, a, b)
        # The last pixel of a loose end leans to the corner that is nearer.
        assert off[1:-1].max() < 0.5
        assert off.max() < 1.0


def test_a_ring_is_closed(tmp_path):
    def ring(pen):
        pen.ellipse([FINE * 60, FINE * 30, FINE * 220, FINE * 190], outline=0, width=FINE * 14)

    (found,) = drawn(tmp_path, ring)
    assert found.closed
    radius = np.hypot(*(found.points - (140, 110)).T)
    assert np.abs(radius - 73).max() < 0.5


def test_t_junction_and_separate_strokes(tmp_path):
    def letters(pen):
        line(pen, [(20, 30), (120, 30)], 10)
        line(pen, [(70, 30), (70, 180)], 10)
        line(pen, [(180, 40), (260, 190)], 14)

    shape = drawn(tmp_path, letters)
    assert len(shape) == 4
    assert all(not contour.closed for contour in shape)
    assert sum(contour.length for contour in shape) > 0.85 * (100 + 150 + 170)


def pen_strokes(height=120, width=200, fine=8):
    """Strokes with round ends and corners: a T, a V and a frame, edges known to 1/16 pixel."""
    image = Image.new("L", (width * fine, height * fine), 255)
    pen = ImageDraw.Draw(image)
    truth = {
        4: [[(20, 20), (80, 20)], [(50, 20), (50, 90)], [(100, 20), (120, 65), (140, 20)]],
        2: [[(155, 20), (190, 20), (190, 90), (155, 90), (155, 20)]],
    }
    for wide, lines in truth.items():
        for points in lines:
            own = [(fine * x, fine * y) for x, y in points]
            pen.line(own, fill=0, width=fine * wide)
            for x, y in own:
                r = fine * wide / 2
                pen.ellipse([x - r, y - r, x + r, y + r], fill=0)
    return np.asarray(image.reduce(fine))


@pytest.mark.slow
def test_junctions_corners_and_ends_lie_where_the_pen_was():
    shape = ss.trace(pen_strokes(), centerline=True)
    assert len(shape) == 5
    # y turned over; Pillow draws half a pixel of its own beside, a sixteenth here.
    ends = {(20, 100), (80, 100), (50, 30), (50, 100), (100, 100), (140, 100)}
    found = np.concatenate([line.points[[0, -1]] for line in shape if not line.closed])
    assert max(np.hypot(*(found - end).T).min() for end in ends) < 0.25
    assert max(np.hypot(*(np.array(list(ends)) - end).T).min() for end in found) < 0.25
    points = np.concatenate([line.points for line in shape])
    corners = [(120, 55), (155, 100), (190, 100), (190, 30), (155, 30)]
    assert max(np.hypot(*(points - corner).T).min() for corner in corners) < 0.25
    for line, width in zip(shape, shape.widths, strict=True):
        assert width == pytest.approx(2 if line.closed else 4, abs=0.2)


def test_a_disc_is_no_stroke(tmp_path):
    with pytest.raises(ss.DegenerateContourError, match="no stroke in the picture"):
        drawn(tmp_path, lambda pen: pen.ellipse([400, 300, 700, 600], fill=0))


def test_centre_lines_can_be_fitted(tmp_path):
    shape = drawn(tmp_path, lambda pen: line(pen, [(40, 60), (250, 160)], 12))
    (fit,) = ss.fit_shape(shape, tolerance=0.5)
    assert [piece.kind for piece in fit.pieces] == ["line"]


def test_places_narrower_than_the_steps_along_an_outline_have_a_width():
    """Discs of no size divided by nothing there."""
    picture = Path(__file__).parents[4] / "examples/data/images/opencv_HappyFish.png"
    with pytest.warns(ss.PictureWarning):  # specks of its compression
        shape = ss.trace(picture, centerline=True)
    assert len(shape) > 10
    assert min(shape.widths) > 0

"""trace: arrays, Pillow's images and files give the same shape."""

from __future__ import annotations

import numpy as np
import pytest
from PIL import Image

import shapespline as ss


def picture():
    y, x = np.mgrid[:60, :80]
    ink = 100 * (22 - np.hypot(x - 38.3, y - 29.6))
    return np.clip(127 - ink, 0, 255).astype(np.uint8)


@pytest.mark.slow
@pytest.mark.parametrize("mode", ["L", "RGB", "RGBA", "LA", "1", "P", "I;16"])
def test_arrays_images_and_files_agree(tmp_path, mode):
    grey = Image.fromarray(picture())
    image = Image.fromarray(picture().astype(np.uint16) * 257) if mode == "I;16" else grey
    image = image.convert(mode, dither=Image.Dither.NONE) if mode != "I;16" else image
    path = tmp_path / "disc.png"
    image.save(path)
    shape = ss.trace(image)
    assert shape == ss.trace(path) == ss.trace(str(path)) == ss.read(path)
    if mode in ("L", "RGB", "RGBA"):
        assert shape == ss.trace(np.asarray(image))
    (contour,) = shape
    # The ramp from black to white is 2.55 pixels wide about a radius of 22: any level lies in it.
    radius = np.hypot(*(contour.points - [38.8, 60 - 30.1]).T)
    assert np.abs(radius - 22).max() < 1.275 + 0.5


def test_options_reach_the_tracer():
    assert ss.trace(picture(), level=40) != ss.trace(picture())
    strokes = np.full((60, 80), 255, dtype=np.uint8)
    strokes[28:32, 10:70] = 0
    line = ss.trace(strokes, centerline=True)
    assert not any(contour.closed for contour in line)


def test_what_is_refused(tmp_path):
    with pytest.raises(ss.FormatError, match=r"cannot trace .*none\.png: there is no such file"):
        ss.trace(tmp_path / "none.png")
    (tmp_path / "text.png").write_text("no picture")
    with pytest.raises(ss.FormatError, match=r"^text\.png: not a PNG"):
        ss.trace(tmp_path / "text.png")
    broken = picture().astype(float)
    broken[3, 4] = np.inf
    for image in (broken, np.zeros(3), "abc", [["a"]]):
        with pytest.raises(ss.ShapesplineError, match=r".{20}"):
            ss.trace(image)

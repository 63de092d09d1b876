"""Units of files: read, named, converted, written."""

from __future__ import annotations

import numpy as np
import pytest
from PIL import Image

from shapespline import read, write
from shapespline.errors import InvalidInputError


def test_reading_and_writing_know_units(tmp_path):
    pixels = np.full((40, 40), 255, dtype=np.uint8)
    pixels[10:30, 10:30] = 0
    Image.fromarray(pixels).save(tmp_path / "square.png")
    assert read(tmp_path / "square.png").unit == "px"
    shape = read(tmp_path / "square.png", dpi=254)
    assert (shape.unit, shape.frame) == ("mm", pytest.approx((0, 0, 4, 4)))
    shape = read(tmp_path / "square.png", unit="mm", scale=0.1)
    assert (shape.unit, shape.frame) == ("mm", (0, 0, 4, 4))
    with pytest.raises(InvalidInputError, match=r"square\.png: unit='mm' needs the size"):
        read(tmp_path / "square.png", unit="mm")
    (tmp_path / "square.csv").write_text("0,0\n1,0\n1,1\n0,1\n0,0\n")
    assert read(tmp_path / "square.csv").unit is None
    inches = read(tmp_path / "square.csv", unit="in")
    write(tmp_path / "square.json", inches, unit="mm")
    back = read(tmp_path / "square.json")
    assert (back.unit, back.fits[0].contour.length) == ("mm", pytest.approx(4 * 25.4))
    write(tmp_path / "square.svg", shape)
    assert 'width="4mm" height="4mm" viewBox="0 0 4 4"' in (tmp_path / "square.svg").read_text()

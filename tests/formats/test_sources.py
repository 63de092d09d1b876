"""Reading from bytes and open files gives what reading the file gives."""

from __future__ import annotations

import io

import numpy as np
import pytest
from PIL import Image

import shapespline as ss

SQUARE = ss.Contour([(0, 0), (4, 0), (4, 2), (0, 2)], closed=True)


@pytest.fixture
def files(tmp_path):
    drawing = ss.Drawing([ss.fit_curve(SQUARE.resampled(60), tolerance=0.01)])
    for suffix in ("svg", "dxf", "json", "csv", "geojson"):
        ss.write(tmp_path / f"square.{suffix}", drawing)
    np.save(tmp_path / "square.npy", SQUARE.points)
    pixels = np.full((40, 60), 255, dtype=np.uint8)
    pixels[10:30, 15:45] = 0
    Image.fromarray(pixels).save(tmp_path / "square.png")
    return {path.suffix: path for path in tmp_path.iterdir()}


@pytest.mark.slow
@pytest.mark.parametrize("suffix", [".svg", ".dxf", ".json", ".csv", ".geojson", ".npy", ".png"])
def test_bytes_and_open_files(files, suffix):
    path = files[suffix]
    wanted = ss.read(path)
    assert ss.read(path.read_bytes(), format=suffix) == wanted
    assert ss.read(io.BytesIO(path.read_bytes()), format=suffix[1:].upper()) == wanted
    with path.open("rb") as file:
        assert ss.read(file) == wanted
    if suffix in (".svg", ".csv"):
        with path.open(encoding="utf-8") as file:
            assert ss.read(file) == wanted
    if suffix in (".svg", ".npy", ".png"):
        assert ss.read(path.read_bytes()) == wanted


def test_what_is_refused(files):
    with pytest.raises(ss.UnknownFormatError, match=r"say it, such as format='\.csv'"):
        ss.read(b"0,0\n1,1\n")
    with pytest.raises(ss.UnknownFormatError, match=r"no reader for '\.abc'"):
        ss.read(b"0,0\n1,1\n", format="abc")
    with pytest.raises(ss.FormatError, match="is empty"):
        ss.read(b"", format=".csv")
    with pytest.raises(ss.FormatError, match=r"^data\.png: "):
        ss.read(b"\x89PNG and nothing else")
    with pytest.raises(ss.InvalidInputError, match="a geometry or a glyph, got ndarray"):
        ss.read(np.zeros((4, 2)))
    with pytest.raises(ss.InvalidInputError, match="format is for bytes"):
        ss.read(files[".csv"], format=".svg")
    with pytest.raises(ss.InvalidInputError, match="ending like"):
        ss.read(b"", format=3)

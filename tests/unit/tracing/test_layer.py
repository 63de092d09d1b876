"""A picture looked at strip by strip is the picture looked at whole, and says how far it is."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from tests.support.rendering import word

import shapespline as ss
from shapespline.tracing import layer


def outlines(shape):
    return [contour.points.tolist() for contour in shape], shape.parents, len(shape.left_out)


def pictures():
    """Grey, in three colours under a lamp, 16 bits, on a transparent ground, and floats."""
    letters = word("ä 8", 24, margin=8)
    yield letters
    lamp = np.linspace(1.0, 0.4, letters.shape[1]) * (30 + 0.88 * letters)
    grain = np.random.default_rng(0).normal(0, 2.0, letters.shape)
    lit = np.clip(lamp + grain, 0, 255).astype(np.uint8)
    yield lit
    yield np.stack([np.maximum(letters, 200), letters, letters], axis=2)
    yield letters.astype(np.uint16) * 257
    yield np.stack([np.zeros_like(letters), 255 - letters], axis=2)
    yield letters / 255.0


@pytest.mark.slow
def test_strips_change_nothing(monkeypatch):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ss.PictureWarning)
        whole = [outlines(ss.trace(picture)) for picture in pictures()]
        monkeypatch.setattr(layer, "STRIP", 900)  # a few rows each
        assert [outlines(ss.trace(picture)) for picture in pictures()] == whole


def test_a_mapped_file_is_traced(tmp_path):
    np.save(tmp_path / "word.npy", word("ä", 40))
    mapped = np.load(tmp_path / "word.npy", mmap_mode="r")
    assert outlines(ss.trace(mapped)) == outlines(ss.trace(word("ä", 40)))


def test_what_comes_next_is_told_and_can_be_ended(monkeypatch, tmp_path):
    monkeypatch.setattr(layer, "STRIP", 700)
    said = []
    shape = ss.trace(word("gä 8", 40), progress=said.append)
    assert any(sentence.startswith("looking for edges, row") for sentence in said)
    assert said[-1] == f"looking for the corners of {len(shape)} outlines"

    def end(sentence):
        if sentence.startswith("placing"):
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        ss.trace(word("gä 8", 40), progress=end)
    # A table has nothing to tell.
    (tmp_path / "square.csv").write_text("0,0\n1,0\n1,1\n0,1\n")
    assert len(ss.read(tmp_path / "square.csv", progress=said.append, closed=True)) == 1

"""The shapes that come with the project: complete, permitted, and readable."""

from __future__ import annotations

import csv
import re

import numpy as np
import pytest
from scipy.spatial import cKDTree
from tests.support.places import DATA

from shapespline.formats.registry import read

PERMISSIVE = {
    "MIT", "Apache-2.0", "Apache-2.0 OR BSD-3-Clause", "OFL-1.1", "CC-BY-3.0", "CC-BY-4.0"
}  # fmt: skip

with (DATA / "manifest.csv").open(encoding="utf-8", newline="") as manifest:
    ROWS = list(csv.DictReader(manifest))
OUTLINES = [row for row in ROWS if row["kind"] in ("outline", "paper outline")]
IMAGES = [row for row in ROWS if row["kind"] == "image"]


def by_file(rows):
    return pytest.mark.parametrize("row", rows, ids=[row["file"] for row in rows])


def test_the_manifest_names_every_file_once_and_no_other():
    named = [row["file"] for row in ROWS]
    assert len(named) == len(set(named))
    there = {
        path.relative_to(DATA).as_posix()
        for folder in ("outlines", "images", "paper")
        for path in (DATA / folder).iterdir()
    }
    assert set(named) == there
    assert len(OUTLINES) + len(IMAGES) == len(ROWS)


def test_it_is_small():
    size = sum(path.stat().st_size for path in DATA.rglob("*") if path.is_file())
    assert size < 2_500_000


@by_file(ROWS)
def test_it_may_be_passed_on(row):
    assert row["licence"] in PERMISSIVE
    assert re.match(r"(PyPI|npm|Debian) \S|made for this project$", row["source"])
    assert "github" not in row["source"].lower()
    assert row["author"]
    assert row["changes"]


def test_the_credits_name_every_author_and_licence():
    readme = (DATA / "README.md").read_text(encoding="utf-8")
    for row in ROWS:
        for name in re.split(r", | & | OR | \(", row["author"] + ", " + row["licence"]):
            assert name.removeprefix("the ").rstrip(")") in readme


@by_file(OUTLINES)
def test_outlines(row):
    (contour,) = read(DATA / row["file"], closed=row["closed"] == "yes")
    assert len(contour) == contour.n_given == int(row["n_points"])
    if row["kind"] == "paper outline":
        assert contour.box_diagonal == pytest.approx(10, abs=1e-7)
        assert str(len(contour)) in row["file"]


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::shapespline.PictureWarning")  # photographs have grain
@by_file(IMAGES)
def test_images(row):
    shape = read(DATA / row["file"])
    assert shape.frame.width * shape.frame.height == int(row["pixels"])
    assert all(contour.closed for contour in shape)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("image", "n_contours"),
    [
        ("fa_leaf_256", 1),
        ("fa_gear_256", 2),
        ("mdi_leaf-maple_256", 1),
        ("EBGaramond12-Regular_U0026_256", 3),
    ],
)
def test_traced_renderings_lie_on_the_outlines_they_were_drawn_from(image, n_contours):
    shape = read(DATA / "images" / f"{image}.png")
    truth = [
        read(DATA / "outlines" / file, closed=True).longest.resampled(40_000).points / 2
        for file in (image.replace("_256", f"_c{k}.csv") for k in range(n_contours))
    ]
    assert len(shape) == len(truth)
    found = np.vstack([contour.points for contour in shape])
    off, _ = cKDTree(np.vstack(truth)).query(found)
    # 0.086 px: linear interpolation across a straight edge of area coverage, at worst; 1/32 px:
    # coverage counted in sixteenths by the renderer. Corners, which are cut, are few.
    assert np.sqrt(np.mean(off**2)) <= 0.086 + 1 / 32
    assert np.percentile(off, 90) <= 0.086 + 1 / 32

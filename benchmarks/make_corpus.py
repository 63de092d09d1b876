"""Build examples/data from the large collection of shapes kept next to the repository.

Takes only what came from package archives under a permissive licence, and writes outlines
(y up), pictures and examples/data/manifest.csv. Same input, same bytes.

Run it from anywhere: ``python benchmarks/make_corpus.py [collection]``.
"""

from __future__ import annotations

import csv
import io
import sys
from dataclasses import astuple, dataclass, fields
from pathlib import Path

import numpy as np
from PIL import Image

REPOSITORY = Path(__file__).resolve().parents[1]
COLLECTION = REPOSITORY.parent / "shared" / "data"
TARGET = REPOSITORY / "examples" / "data"

# Icons and glyphs were sampled in a square of this side, y down.
SIDE = 512.0
PAPER_DIAGONAL = 10.0

ICONS = [
    "fa_dove_c0",
    "fa_gear_c0",
    "fa_gear_c1",
    "fa_guitar_c0",
    "fa_hand-spock_c0",
    "fa_horse_c0",
    "fa_leaf_c0",
    "gameicons_airplane-arrival_c0",
    "gameicons_bat-leth_c0",
    "gameicons_big-gear_c0",
    "gameicons_commercial-airplane_c0",
    "gameicons_jet-fighter_c0",
    "gameicons_tribal-gear_c0",
    "gameicons_turbine_c0",
    "gameicons_wind-turbine_c0",
    "mdi_airplane_c0",
    "mdi_fan_c0",
    "mdi_feather_c0",
    "mdi_fish_c0",
    "mdi_leaf-maple_c0",
    "mdi_saw-blade_c0",
    "mdi_saw-blade_c1",
]
GLYPHS = [
    "EBGaramond12-Regular_U0026_c0",
    "EBGaramond12-Regular_U0026_c1",
    "EBGaramond12-Regular_U0026_c2",
    "EBGaramond12-Regular_U0066_c0",
    "NotoNaskhArabic-Regular_U0647_c0",
    "NotoNaskhArabic-Regular_U0647_c1",
    "NotoSans-Regular_U0065_c0",
    "NotoSans-Regular_U0065_c1",
    "NotoSansSymbols2-Regular_U2766_c0",
    "NotoSansSymbols2-Regular_U2766_c1",
    "NotoSerif-Regular_U0035_c0",
    "NotoSerif-Regular_U0067_c0",
    "NotoSerif-Regular_U0067_c1",
]
AIRFOILS = ["naca2412", "naca4412"]
PEERS = [
    "hand620_closed",
    "leaf840_closed",
    "leaf840_n0.2_closed",
    "loop500_n0.2_open",
    "loop500_n1_open",
    "loop500_open",
    "plane1100_closed",
]
PAPER = {
    "leaf840": "leaf_840_gameicons_oak-leaf",
    "palm620": "palm_620_gameicons_palm-tree",
    "airplane1100": "airplane_1100_fa_plane-up",
}
RENDERINGS = {
    "icons": [
        "fa_gear_256",
        "fa_horse_256",
        "fa_leaf_256",
        "gameicons_jet-fighter_256",
        "gameicons_oak-leaf_256",
        "mdi_leaf-maple_256",
    ],
    "glyphs": [
        "EBGaramond12-Regular_U0026_256",
        "NotoSansSymbols2-Regular_U2766_256",
        "NotoSerif-Regular_U0067_512",
    ],
}
PICTURES = ["opencv_HappyFish", "opencv_detect_blob", "opencv_pic1"]
PHOTOGRAPHS = ["opencv_apple", "opencv_butterfly"]
JPEG_QUALITY = 88

# Licence as the collection states it -> licence, author.
LICENCES = {
    "CC-BY-3.0 (game-icons.net)": ("CC-BY-3.0", "Lorc, Delapouite & contributors, game-icons.net"),
    "CC-BY-4.0 (Fonticons, Inc.)": ("CC-BY-4.0", "Fonticons, Inc. (Font Awesome Free)"),
    "Apache-2.0 (Pictogrammers)": ("Apache-2.0", "Pictogrammers (Material Design Icons)"),
    "Apache-2.0 / BSD-3-Clause (OpenCV; in Debian main)": (
        "Apache-2.0 OR BSD-3-Clause",
        "the OpenCV contributors",
    ),
    "MIT": ("MIT", "the shapespline authors"),
}
FONT_AUTHORS = {
    "fonts-ebgaramond": "Georg Duffner (EB Garamond)",
    "fonts-noto-core": "the Noto Project Authors",
}
ARCHIVES = ("PyPI ", "npm ", "Debian ")


@dataclass(frozen=True)
class Row:
    """A line of examples/data/manifest.csv; n_points for outlines, pixels for images."""

    file: str
    kind: str
    n_points: int | str
    pixels: int | str
    closed: str
    licence: str
    author: str
    source: str
    changes: str


class Collection:
    """The large collection: its files and what its manifest says of them."""

    def __init__(self, folder: Path) -> None:
        manifest = folder / "manifest.csv"
        if not manifest.is_file():
            raise SystemExit(
                f"make_corpus: no collection at {folder} (manifest.csv is missing);"
                " name its folder as the argument"
            )
        self.folder = folder
        with manifest.open(encoding="utf-8", newline="") as file:
            self.rows = {f"{row['category']}/{row['file']}": row for row in csv.DictReader(file)}

    def origin(self, name: str) -> tuple[str, str, str]:
        """Licence, author and source of a file, or SystemExit if it must not be published."""
        row = self.rows[name]
        source, licence = row["source"], row["licence"]
        if source.startswith("own:"):
            return (*LICENCES[licence], "made for this project")
        if not source.startswith(ARCHIVES):
            raise SystemExit(f"make_corpus: {name} is from {source}, no package archive")
        if licence == "OFL-1.1":
            package, _, font = source.removeprefix("Debian ").partition(": ")
            return licence, FONT_AUTHORS[package], f"Debian {package} {font.rsplit('/', 1)[-1]}"
        if source.startswith("PyPI aerosandbox"):
            return "MIT", "Peter Sharpe (AeroSandbox)", source
        if licence not in LICENCES:
            raise SystemExit(f"make_corpus: {name} has the licence {licence}, not a permitted one")
        return (*LICENCES[licence], source)

    def points(self, name: str) -> np.ndarray:
        """Points of an outline, as they are in the collection."""
        return np.loadtxt(self.folder / name, delimiter=",", ndmin=2)


def main(arguments: list[str]) -> None:
    collection = Collection(Path(arguments[0]) if arguments else COLLECTION)
    contents: dict[str, bytes] = {}
    rows: list[Row] = []

    def add_outline(
        source: str, target: str, points: np.ndarray, closed: bool, changes: str
    ) -> None:
        contents[target] = "".join(f"{x:.9g},{y:.9g}\n" for x, y in points).encode()
        kind = "paper outline" if target.startswith("paper/") else "outline"
        shut = "yes" if closed else "no"
        rows.append(Row(target, kind, len(points), "", shut, *collection.origin(source), changes))

    for category, names in (("icons", ICONS), ("glyphs", GLYPHS)):
        for name in names:
            source = f"{category}/{name}.csv"
            changes = "one contour, sampled at equal arc length in a square of side 512, y up"
            points = turned_up(collection.points(source))
            add_outline(source, f"outlines/{name}.csv", points, True, changes)
    for name in AIRFOILS:
        source = f"airfoils/{name}.csv"
        points = collection.points(source)
        add_outline(source, f"outlines/{name}.csv", points, False, "header dropped")
    for name in PEERS:
        source = f"peers/{name}.csv"
        points = collection.points(source)
        closed = name.endswith("_closed")
        add_outline(source, f"outlines/{name}.csv", points, closed, "none (synthetic)")
    for name, original in PAPER.items():
        source = f"paper_like/{original}.csv"
        points = scaled_to_diagonal(turned_up(collection.points(source)), PAPER_DIAGONAL)
        changes = (
            "longest contour, sampled at equal arc length, scaled to a box diagonal of 10, y up"
        )
        add_outline(source, f"paper/{name}.csv", points, True, changes)

    images = [
        (f"{category}/{name}.png", ".png", "rendered by area coverage, white on black")
        for category, names in RENDERINGS.items()
        for name in names
    ]
    images += [(f"photos/{name}.png", ".png", "re-encoded as PNG") for name in PICTURES]
    images += [
        (f"photos/{name}.png", ".jpg", f"re-encoded as JPEG, quality {JPEG_QUALITY}")
        for name in PHOTOGRAPHS
    ]
    for source, suffix, changes in images:
        target = f"images/{Path(source).stem}{suffix}"
        with Image.open(collection.folder / source) as picture:
            contents[target] = encoded(picture, suffix)
            pixels = picture.width * picture.height
        rows.append(Row(target, "image", "", pixels, "", *collection.origin(source), changes))

    rows.sort(key=lambda row: row.file)
    contents["manifest.csv"] = table(rows)
    publish(contents)
    size = sum(map(len, contents.values()))
    print(f"{len(rows)} files, {size / 1e6:.2f} MB in {TARGET.relative_to(REPOSITORY)}")


def turned_up(points: np.ndarray) -> np.ndarray:
    """Turn the square over, y up; rounded, for the source has no more than five decimals."""
    return np.column_stack([points[:, 0], np.round(SIDE - points[:, 1], 5)])


def scaled_to_diagonal(points: np.ndarray, diagonal: float) -> np.ndarray:
    """Points with their bounding box at the origin and its diagonal as long as asked."""
    low = points.min(axis=0)
    return (points - low) * (diagonal / np.hypot(*(points.max(axis=0) - low)))


def encoded(picture: Image.Image, suffix: str) -> bytes:
    """Bytes of a picture without metadata; PNG pixel for pixel, in as few bits as they need."""
    file = io.BytesIO()
    if suffix == ".jpg":
        picture.convert("RGB").save(file, "JPEG", quality=JPEG_QUALITY, optimize=True)
    else:
        picture.save(file, "PNG", optimize=True)
    return file.getvalue()


def table(rows: list[Row]) -> bytes:
    """Return the manifest as CSV."""
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(field.name for field in fields(Row))
    writer.writerows(astuple(row) for row in rows)
    return file.getvalue().encode()


def publish(contents: dict[str, bytes]) -> None:
    """Write the files, and remove those of an earlier run that are no longer among them."""
    for folder in ("outlines", "images", "paper"):
        (TARGET / folder).mkdir(parents=True, exist_ok=True)
        for old in (TARGET / folder).iterdir():
            if f"{folder}/{old.name}" not in contents:
                old.unlink()
    for name, data in contents.items():
        (TARGET / name).write_bytes(data)


if __name__ == "__main__":
    main(sys.argv[1:])

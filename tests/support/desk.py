"""A folder as the documentation supposes it: the clone's examples, and files of a user's own."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from benchmarks.howto_figures import boat, bracket, plate
from PIL import Image, ImageDraw, ImageFilter
from tests.support.places import DATA, ROOT

if TYPE_CHECKING:
    from pathlib import Path

IMAGES = {
    "logo.png": "gameicons_jet-fighter_256.png",
    "leaf.png": "gameicons_oak-leaf_256.png",
}
OUTLINES = {
    "scan.csv": "hand620_closed",
    "profile.csv": "loop500_open",
    "noisy.csv": "loop500_n1_open",
}


def laid_out(folder: Path) -> Path:
    """The folder, with everything in it that a command of the documentation reads."""
    (folder / "examples").symlink_to(ROOT / "examples")
    for name, source in IMAGES.items():
        (folder / name).write_bytes((DATA / "images" / source).read_bytes())
    for name, source in OUTLINES.items():
        (folder / name).write_bytes((DATA / "outlines" / f"{source}.csv").read_bytes())
    points = np.loadtxt(folder / "scan.csv", delimiter=",")
    np.savetxt(folder / "cloud.csv", np.random.default_rng(0).permutation(points), delimiter=",")
    rows = [f"{index},{x!r},{y!r},0.5" for index, (x, y) in enumerate(points[::4].tolist())]
    (folder / "table.csv").write_text("\n".join(["id,east,north,error", *rows]), "utf-8")
    ground = Image.new("RGB", (96, 96), "white")
    ground.paste("#145aa0", (12, 12, 60, 80))
    ground.paste("#c81e1e", (60, 12, 84, 80))
    ground.paste("#e0a010", (12, 80, 84, 90))
    ground.save(folder / "colours.png")
    y, x = np.mgrid[-1:1:192j, -1:1:192j]
    seen = ground.resize((192, 192)).filter(ImageFilter.GaussianBlur(1.0))
    lit = np.asarray(seen) * (1 - 0.1 * (x**2 + y**2))[..., None]
    Image.fromarray(np.rint(lit).astype(np.uint8)).save(folder / "sign.jpg", quality=88)
    circuit = Image.new("L", (96, 96), 255)
    ImageDraw.Draw(circuit).line([(10, 48), (48, 48), (48, 12), (86, 12)], fill=0, width=4)
    circuit.save(folder / "circuit.png")
    (folder / "boat.svg").write_text(boat(), "utf-8")
    plate(folder / "plate.dxf")
    np.savetxt(folder / "part.csv", bracket("1 % strays"), delimiter=",")
    (folder / "scans").mkdir()
    (folder / "scans" / "a.csv").write_bytes((folder / "scan.csv").read_bytes())
    with Image.open(folder / "leaf.png") as leaf:
        leaf.resize((96, 96)).save(folder / "scans" / "b.png")
    return folder

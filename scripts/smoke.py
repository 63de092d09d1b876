"""Whether an installed package works: a logo, a profile, every core format, the size on disk.

    python scripts/smoke.py examples/data
    python scripts/smoke.py --weight         # what the installation weighs, package by package

Needs nothing but the package, so that it runs where only a wheel was installed.
"""

from __future__ import annotations

import contextlib
import subprocess
import sys
from importlib import metadata
from pathlib import Path

import numpy as np

import shapespline as ss

# Megabytes on disk of all that `pip install shapespline` brings, but numpy and scipy (PKG-05).
MOST_MEGABYTES = 40
APART = {"numpy", "scipy", "pip", "setuptools", "wheel"}
WRITTEN = ("svg", "json", "geojson", "pdf", "csv", "py", "png")


def main(examples: Path) -> int:
    """Run everything; the exit code."""
    failed = [name for name, passes in checks(examples).items() if not passes]
    for name in failed:
        print(f"failed: {name}")
    return 1 if failed else 0


def checks(examples: Path) -> dict[str, bool]:
    """Name of a check -> whether it passed."""
    logo = examples / "images" / "fa_gear_256.png"
    Path("logo.png").write_bytes(logo.read_bytes())
    Path("logo.svg").unlink(missing_ok=True)
    drawing = ss.fit_shape(ss.read("logo.png"), tolerance=0.5)
    outline = np.loadtxt(examples / "outlines" / "hand620_closed.csv", delimiter=",")
    fit = ss.fit_curve(outline, closed=True, tolerance="0.5%")
    for ending in WRITTEN:
        ss.write(f"logo_again.{ending}", drawing)
    back = ss.read("logo_again.svg")
    size = sum(weights().values())
    return {
        "the package is an installed one": "site-packages" in str(ss.__file__),
        "the command line": called("fit", "logo.png") and Path("logo.svg").exists(),
        "the doctor": called("doctor"),
        "the studio's page": (Path(ss.__file__).parent / "studio/page/index.html").exists(),
        "a shape": all(one.kept for one in drawing) and len(drawing) == 2,
        "a curve": fit.kept and fit.n_stored_points < 60,
        "formats": all(Path(f"logo_again.{ending}").stat().st_size > 0 for ending in WRITTEN),
        "a missing extra is named": refused("logo_again.dxf", drawing),
        "there and back": ss.compare(drawing, back).hausdorff_distance < 1e-3,
        f"at most {MOST_MEGABYTES} MB": size <= MOST_MEGABYTES,
    }


def called(*arguments: str) -> bool:
    """Whether a command of the command line ends well."""
    command = [sys.executable, "-m", "shapespline", *arguments]
    return subprocess.run(command, check=False).returncode == 0


def refused(name: str, drawing: ss.Drawing) -> bool:
    """Whether DXF, an extra that is not installed here, is refused with its remedy."""
    try:
        ss.write(name, drawing)
    except ss.MissingExtraError as error:
        return 'pip install "shapespline[dxf]"' in str(error)
    return False


def weights() -> dict[str, float]:
    """Megabytes of every package but some, those of compiled modules (bytecode) included.

    pip compiles modules as it installs them; without that they are compiled when first imported.
    """
    found, compiled = {}, 0.0
    for package in metadata.distributions():
        name = package.metadata["Name"].lower()
        if name in APART:
            continue
        found[name] = 0.0
        for file in package.files or ():
            with contextlib.suppress(OSError):
                size = Path(str(package.locate_file(file))).stat().st_size / 1e6
                found[name] += size
                compiled += size if str(file).endswith(".pyc") else 0.0
    for name, size in sorted(found.items(), key=lambda row: -row[1]):
        print(f"{name:20}{size:7.1f} MB")
    total = sum(found.values())
    print(f"beside numpy and scipy{total:5.1f} MB, {total - compiled:.1f} MB without bytecode")
    return found


if __name__ == "__main__":
    if sys.argv[1:] == ["--weight"]:
        weights()
    else:
        sys.exit(main(Path(sys.argv[1])))

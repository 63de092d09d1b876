"""Pictures of glyphs and icons traced and fitted, against the outlines that they were drawn from.

    python -m benchmarks.traced                     anti-aliased, 256 pixels
    python -m benchmarks.traced --one-bit           the same cut to black and white first
    python -m benchmarks.traced --tolerance 0.3     in pixels; none means no parameter at all
    python -m benchmarks.traced --pixels 64         another size: from larger pictures, by means
    python -m benchmarks.traced --every 4           each fourth picture

Distances in pixels, over samples a twentieth of a pixel apart, both ways. Left out is what a
picture cannot show: a corner within ``CORNER`` pixels, and tips and slits narrower than ``FINE``
pixels. A true turn is kept where the curve has a break within ``KEPT`` pixels. potrace, where it is
installed, gets the same picture at its usual threshold.
"""

from __future__ import annotations

import argparse
import io
import json
import shutil
import subprocess
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from PIL import Image, ImageOps
from scipy.spatial import cKDTree

import shapespline as ss
from shapespline.tracing.coverage import border_coverage

if TYPE_CHECKING:
    from collections.abc import Sequence

    from checks.curves import Array
    from numpy.typing import NDArray

ROOT = Path(__file__).parent.parent
LARGE = ROOT.parent / "shared" / "data"
OWN = ROOT / "examples" / "data" / "images"
PIXELS, FRAME = 256, 512
SIZES = (64, 128, 256, 512, 1024, 2048)
STEP = 0.05
# Pixels around a corner of the true outline that do not count, and the turn that makes a corner.
CORNER, TURN = 1.0, 20.0
# Pixels between two sides of ink or ground that are too near to be told apart.
FINE = 1.0
TOLERANCE = 0.35
# True turns that a curve has to keep, the breaks that keep them (degrees), and how near (pixels).
SHARP, BREAK, KEPT = 30.0, 10.0, 1.5


class Truth(NamedTuple):
    """Samples of the visible outline, pixels, y up; what is too fine to show; points stored."""

    samples: Array
    too_fine: cKDTree
    n_points: int
    corners: Array


class Result(NamedTuple):
    """Points stored, distances to the truth away from corners, both ways; corners kept."""

    n_points: int
    rms: float
    worst: float
    seconds: float
    kept: NDArray[np.bool_]

    @classmethod
    def of(
        cls, loops: Sequence[Sequence[Array]], n_points: int, seconds: float, outline: Truth
    ) -> Result:
        """Closed rows of Beziers against the true outline."""
        samples = np.concatenate([bezier(piece, STEP) for loop in loops for piece in loop])
        breaks = np.concatenate([_turns(loop, BREAK) for loop in loops])
        near = cKDTree(np.vstack([breaks, (1e9, 1e9)]))
        kept = near.query(outline.corners)[0] <= KEPT
        return cls(n_points, *distances(samples, outline), seconds, kept)


def bezier(points: Array, step: float) -> Array:
    """Samples of a Bezier from its start on, its end left out."""
    length = np.hypot(*np.diff(points, axis=0).T).sum()
    t = np.linspace(0, 1, max(2, int(np.ceil(length / step))), endpoint=False)[:, None]
    work = [np.broadcast_to(p, (len(t), 2)) for p in points]
    while len(work) > 1:
        work = [(1 - t) * a + t * b for a, b in zip(work, work[1:])]  # noqa: B905, RUF007
    return work[0]


def truth(path: Path, pixels: int = PIXELS) -> Truth:
    """The outline of a .truth.json, scaled to a picture of so many pixels."""
    held = json.loads(path.read_text())
    scale = pixels / FRAME
    loops, corners, sharp, n_points = [], [], [], 0
    for contour in held["contours"]:
        segments = [
            np.array([(scale * x, pixels - scale * y) for x, y in segment]) for segment in contour
        ]
        segments = [s for s in segments if np.hypot(*np.diff(s, axis=0).T).sum() > 1e-9]
        n_points += sum(len(segment) - 1 for segment in segments)
        loops.append(np.concatenate([bezier(segment, STEP) for segment in segments]))
        corners.append(_turns(segments, TURN))
        sharp.append(_turns(segments, SHARP))
    samples, normals = np.concatenate(loops), np.concatenate([_normals(loop) for loop in loops])
    if len(loops) > 1:  # glyphs are drawn of parts that overlap: ink is on one side only
        aside = 0.05 * normals
        seen = _ink(samples + aside, loops) != _ink(samples - aside, loops)
        samples, normals = samples[seen], normals[seen]
    fine = _facing(samples, normals)
    turns = np.concatenate(sharp)
    seen_turns = turns[cKDTree(samples).query(turns)[0] < 2 * STEP]
    return Truth(samples, cKDTree(np.vstack([*corners, *fine, (1e9, 1e9)])), n_points, seen_turns)


def _turns(loop: Sequence[Array], least: float) -> Array:
    """Where a closed row of Beziers turns by more than so many degrees, shape (k, 2)."""
    found = []
    for before, after in zip(loop, [*loop[1:], loop[0]], strict=True):
        u, v = _tangent(before[::-1]) * -1, _tangent(after)
        if abs(np.degrees(np.arctan2(u[0] * v[1] - u[1] * v[0], u @ v))) > least:
            found.append(after[0])
    return np.array(found).reshape(-1, 2)


def _normals(loop: Array) -> Array:
    along = np.roll(loop, -1, axis=0) - np.roll(loop, 1, axis=0)
    normal = np.column_stack([-along[:, 1], along[:, 0]])
    return normal / np.maximum(np.hypot(*normal.T), 1e-12)[:, None]


def _facing(samples: Array, normals: Array) -> Array:
    """Samples that have the other side of a tip or a slit within FINE pixels."""
    points, across = samples[::4], normals[::4]
    pairs = cKDTree(points).query_pairs(FINE, output_type="ndarray")
    opposite = (across[pairs[:, 0]] * across[pairs[:, 1]]).sum(axis=1) < -0.5
    return points[np.unique(pairs[opposite])]


def _tangent(points: Array) -> Array:
    ahead = points[1:] - points[0]
    return ahead[np.hypot(*ahead.T) > 1e-9][0]


def _ink(points: Array, loops: Sequence[Array]) -> Array:
    """Whether points are inside by the nonzero rule."""
    winding = np.zeros(len(points), dtype=int)
    for loop in loops:
        coarse = loop[::10]
        a, b = coarse, np.roll(coarse, -1, axis=0)
        for chunk in np.array_split(np.arange(len(points)), max(1, len(points) * len(a) // 10**7)):
            x, y = points[chunk, 0, None], points[chunk, 1, None]
            up, down = (a[:, 1] <= y) & (b[:, 1] > y), (a[:, 1] > y) & (b[:, 1] <= y)
            side = (b[:, 0] - a[:, 0]) * (y - a[:, 1]) - (x - a[:, 0]) * (b[:, 1] - a[:, 1])
            winding[chunk] += (up & (side > 0)).sum(axis=1) - (down & (side < 0)).sum(axis=1)
    return winding != 0


def distances(curve: Array, outline: Truth) -> tuple[float, float]:
    """Root mean square and largest distance, both ways, away from corners."""
    there = np.concatenate(
        [
            _away(outline.samples, outline, cKDTree(curve)),
            _away(curve, outline, cKDTree(outline.samples)),
        ]
    )
    return float(np.sqrt((there**2).mean())), float(there.max())


def _away(points: Array, outline: Truth, other: cKDTree) -> Array:
    return other.query(points[outline.too_fine.query(points)[0] > CORNER])[0]


def ours(
    picture: Image.Image, outline: Truth, tolerance: float | None
) -> tuple[Result, ss.Drawing]:
    """Trace and fit."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "picture.png"
        picture.save(path)
        began = time.perf_counter()
        drawing = ss.fit_shape(ss.read(path), tolerance=tolerance)
        seconds = time.perf_counter() - began
    loops = [list(fit.spline.beziers().points) for fit in drawing]
    n_points = sum(fit.n_stored_points for fit in drawing)
    return Result.of(loops, n_points, seconds, outline), drawing


def rendered_back(drawing: ss.Drawing, picture: Image.Image) -> float:
    """Mean difference of the drawing, drawn by area coverage, to its picture, of 255."""
    width, height = picture.size
    outlines = [
        np.clip(np.concatenate([bezier(piece, 4 * STEP) for piece in fit.spline.beziers().points]),
                0, (width, height))
        for fit in drawing
    ]  # fmt: skip
    keys, part, _ = border_coverage(outlines, height, width)
    seen = 1.0 - np.asarray(black_on_white(picture), dtype=float) / 255.0
    ours = np.rint(seen).ravel()
    ours[keys] = part
    return 255.0 * float(np.abs(ours - seen.ravel()).mean())


def black_on_white(picture: Image.Image) -> Image.Image:
    """Grey, on white ground, the shape dark."""
    ground = Image.new("L", picture.size, 255)
    flat = picture.convert("RGBA")
    ground.paste(flat.convert("L"), mask=flat.getchannel("A"))
    return ImageOps.invert(ground) if ground.getpixel((0, 0)) < 128 else ground


def potrace(picture: Image.Image, outline: Truth) -> Result | None:
    """The same picture through potrace with its own options; None where it is not installed."""
    program = shutil.which("potrace")
    if program is None:
        return None
    import svgelements

    bitmap = io.BytesIO()
    black_on_white(picture).save(bitmap, format="PPM")
    began = time.perf_counter()
    done = subprocess.run(
        [program, "-b", "svg", "--flat", "-r", "72", "-o", "-", "-"],
        input=bitmap.getvalue(),
        capture_output=True,
        check=True,
    )
    seconds = time.perf_counter() - began
    loops, n_points = [], 0
    drawing = svgelements.SVG.parse(io.StringIO(done.stdout.decode()), reify=True, ppi=72)
    scale = picture.width / float(drawing.width)
    paths = drawing.elements(lambda element: isinstance(element, svgelements.Path))
    for path in (part for whole in paths for part in whole.as_subpaths()):
        loop = []
        for segment in path:
            if isinstance(segment, svgelements.Line | svgelements.Close):
                control = [segment.start, segment.end]
            elif isinstance(segment, svgelements.CubicBezier):
                control = [segment.start, segment.control1, segment.control2, segment.end]
            else:
                continue
            points = np.array([(scale * p.x, picture.height - scale * p.y) for p in control])
            if np.ptp(points, axis=0).any():
                loop.append(points)
        n_points += sum(len(points) - 1 for points in loop)
        if loop:
            loops.append(loop)
    return Result.of(loops, n_points, seconds, outline)


def pictures(pixels: int = PIXELS) -> list[tuple[Path, Image.Image]]:
    """Truths, and pictures of so many pixels: the smallest that are at least as large, reduced.

    The mean over whole pixels is what a drawing covers of the larger one: nothing is resampled.
    """
    folders = [LARGE / "glyphs", LARGE / "icons"] if LARGE.exists() else [OWN]
    found = []
    for folder in folders:
        for path in sorted(folder.glob("*.truth.json")):
            for size in SIZES[SIZES.index(pixels) :]:
                name = path.with_name(path.name.replace(".truth.json", f"_{size}.png"))
                if name.exists():
                    with Image.open(name) as picture:
                        picture.load()
                    reduced = picture.resize((pixels, pixels), Image.Resampling.BOX)
                    found.append((path, picture if size == pixels else reduced))
                    break
    return found


def table(
    tolerance: float | None, every: int = 1, *, pixels: int = PIXELS, one_bit: bool = False
) -> None:
    """One line a picture, geometric means, and what misses."""
    pairs = pictures(pixels)[::every]
    print(
        f"## {len(pairs)} pictures of {pixels} pixels, tolerance {tolerance} px,"
        f" one bit: {one_bit}\n"
    )
    print("| picture | truth | ours: points | rms | worst | s | potrace: points | rms | worst |")
    print("|---|---|---|---|---|---|---|---|---|")
    ratios, misses, back = [], [], []
    kept, lost = np.zeros(3, dtype=int), []
    for path, picture in pairs:
        image = picture
        if one_bit:
            image = black_on_white(image).point(lambda value: 255 * (value >= 128)).convert("1")
        outline = truth(path, pixels)
        found, drawing = ours(image, outline, tolerance)
        back.append(rendered_back(drawing, image))
        other = potrace(image, outline)
        name = path.name.removesuffix(".truth.json")
        theirs = (
            "| | |" if other is None else f"{other.n_points} | {other.rms:.3f} | {other.worst:.2f}"
        )
        print(
            f"| {name} | {outline.n_points} | {found.n_points} | {found.rms:.3f}"
            f" | {found.worst:.2f} | {found.seconds:.2f} | {theirs} |",
            flush=True,
        )
        kept += [len(found.kept), found.kept.sum(), 0 if other is None else other.kept.sum()]
        if other is not None:
            ratios.append([a / b for a, b in zip(found[:3], other[:3], strict=True)])
            n_lost = int((other.kept & ~found.kept).sum())
            lost += [f"{name} {n_lost}"] if n_lost else []
        reasons = [
            reason
            for reason, missed in (
                ("rms", found.rms > 0.25),
                ("worst", found.worst > 0.75),
                ("points", found.n_points > 1.2 * outline.n_points),
            )
            if missed
        ]
        if reasons:
            misses.append(f"{name}: {', '.join(reasons)}")
    if ratios:
        mean = np.exp(np.log(ratios).mean(axis=0))
        print(
            f"\nGeometric mean against potrace: points {mean[0]:.2f}, rms {mean[1]:.2f},"
            f" worst {mean[2]:.2f}"
        )
        print(
            f"\nTrue turns over {SHARP:g} degrees that potrace keeps: {kept[2]} of {kept[0]};"
            f" ours does not keep: {', '.join(lost) or 'none'}"
        )
    print(f"\nTrue turns over {SHARP:g} degrees that are kept: {kept[1]} of {kept[0]}")
    print(
        f"\nRendered back: mean difference to the picture {np.mean(back):.2f} of 255,"
        f" largest {max(back):.2f}"
    )
    print(
        f"\nTo reach: rms 0.25, worst 0.75, points 1.2 times the truth's;"
        f" {len(pairs) - len(misses)} of {len(pairs)} do."
    )
    for miss in misses:
        print(f"  misses {miss}")


def main() -> None:
    """Read the arguments and print."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--tolerance", default=str(TOLERANCE), help="pixels, or none")
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--one-bit", action="store_true")
    parser.add_argument("--pixels", type=int, default=PIXELS, choices=SIZES)
    chosen = parser.parse_args()
    tolerance = None if chosen.tolerance == "none" else float(chosen.tolerance)
    table(tolerance, chosen.every, pixels=chosen.pixels, one_bit=chosen.one_bit)


if __name__ == "__main__":
    main()

"""Large pictures traced: seconds of one core, and memory.

    python -m benchmarks.large_pictures                     8000 x 8000 pixels, grey
    python -m benchmarks.large_pictures --side 20000        a mapped file that is never read whole
    python -m benchmarks.large_pictures --colour            red ink on white, three channels
    python -m benchmarks.large_pictures --areas             the same as areas of colours
    python -m benchmarks.large_pictures --noise             all noise: ends in a sentence

A sheet of words in letters of 30 to 400 pixels, anti-aliased. The picture lies in a file of its own
as an array; a process of its own traces it (``numpy.load(mmap_mode="r")``) on one core.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from benchmarks.small_letters import FONTS, WORDS, drawn

TRACER = """
import sys, time, warnings
import numpy as np
import shapespline as ss
warnings.simplefilter("ignore")
pixels = np.load(sys.argv[1], mmap_mode="r")
ss.trace(np.kron(np.array([[0, 1], [1, 0]], dtype=np.uint8), np.full((20, 20), 255, np.uint8)))
began = time.process_time()
try:
    shape = ss.trace(pixels, colors="auto" if "areas" in sys.argv else None)
    found = f"{len(shape)} outlines, {sum(map(len, shape))} points"
except ss.ShapesplineError as error:
    found = str(error)
seconds = time.process_time() - began
own = [line for line in open("/proc/self/status") if line.startswith("VmHWM")][0].split()[1]
print(f"{seconds:.1f} s of processor, at most {int(own) / 1e6:.2f} GB, mapped file included;"
      f" {found}")
"""


def sheet(side: int) -> np.ndarray:
    """Words in rows, one font and height after the other."""
    image = np.full((side, side), 255, dtype=np.uint8)
    top, index = 50, 0
    heights = (400, 200, 120, 60, 30)
    while index < 60:
        height = heights[index % len(heights)]
        left, lowest = 50, top
        while True:
            word = drawn(WORDS[index % len(WORDS)], FONTS[index % len(FONTS)], height)
            index += 1
            if left + word.shape[1] > side or top + word.shape[0] > side:
                break
            image[top : top + word.shape[0], left : left + word.shape[1]] = word
            left, lowest = left + word.shape[1] + 100, max(lowest, top + word.shape[0])
        top = lowest + 60
    return image


def main() -> None:
    """Read the arguments and print."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--side", type=int, default=8000)
    parser.add_argument("--colour", action="store_true")
    parser.add_argument("--areas", action="store_true")
    parser.add_argument("--noise", action="store_true")
    chosen = parser.parse_args()
    side = chosen.side
    if chosen.noise:
        image = np.random.default_rng(0).integers(0, 256, (side, side), dtype=np.uint8)
    else:
        image = sheet(side)
    if chosen.areas:
        image = np.stack([255 - (255 - image) // part for part in (4, 1, 1)], axis=2)
    elif chosen.colour:
        image = np.stack([np.maximum(image, 200), image, image], axis=2)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "picture.npy"
        np.save(path, image)
        size = path.stat().st_size
        del image
        done = subprocess.run(
            [sys.executable, "-c", TRACER, str(path), *(["areas"] if chosen.areas else [])],
            check=True, capture_output=True, text=True,
            env={**os.environ, "OMP_NUM_THREADS": "1"},
        )  # fmt: skip
    print(f"{side} x {side} pixels, {size / 1e9:.2f} GB: {done.stdout.strip()}")


if __name__ == "__main__":
    main()

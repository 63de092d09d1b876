"""Pictures of known shapes: what part of each pixel is ink, counted by samples."""

from __future__ import annotations

import numpy as np
from PIL import Image, ImageDraw, ImageFont

SAMPLES = 32


def coverage(inside, height, width):
    """Ink in each pixel of a picture whose ink is where ``inside(x, y)``, y up."""
    rows, columns = np.mgrid[: height * SAMPLES, : width * SAMPLES]
    x, y = (columns + 0.5) / SAMPLES, height - (rows + 0.5) / SAMPLES
    ink = np.asarray(inside(x, y), dtype=float)
    return ink.reshape(height, SAMPLES, width, SAMPLES).mean(axis=(1, 3))


def dark(cover):
    """A picture of 8 bits, the ink black on white."""
    return np.rint(255 * (1 - cover)).astype(np.uint8)


def polygon(points):
    """For :func:`coverage`: the inside of a convex polygon, counter-clockwise."""
    points = np.asarray(points, dtype=float)

    def inside(x, y):
        ink = np.ones(x.shape, dtype=bool)
        for (ax, ay), (bx, by) in zip(points, np.roll(points, -1, axis=0), strict=True):
            ink &= (bx - ax) * (y - ay) - (by - ay) * (x - ax) >= 0
        return ink

    return inside


def tile(side, radius):
    """For :func:`coverage`: a square with round corners that fills a picture so large."""

    def inside(x, y):
        dx, dy = (np.maximum(np.abs(c - side / 2) - (side / 2 - radius), 0) for c in (x, y))
        return np.hypot(dx, dy) <= radius

    return inside


def strip(angle, width, middle):
    """For :func:`coverage`: a straight stroke through a point, its normal at an angle."""
    normal = np.cos(np.radians(angle)), np.sin(np.radians(angle))

    def inside(x, y):
        off = (x - middle[0]) * normal[0] + (y - middle[1]) * normal[1]
        return np.abs(off) <= 0.5 * width

    return inside


def word(text, height, margin=4):
    """A word black on white, in DejaVu Sans, which comes with matplotlib."""
    from pathlib import Path

    import matplotlib

    path = Path(matplotlib.get_data_path()) / "fonts" / "ttf" / "DejaVuSans.ttf"
    face = ImageFont.truetype(str(path), round(height / 0.73), layout_engine=0)
    left, top, right, bottom = face.getbbox(text)
    image = Image.new("L", (int(right - left) + 2 * margin, int(bottom - top) + 2 * margin), 255)
    ImageDraw.Draw(image).text((margin - left, margin - top), text, font=face, fill=0)
    return np.asarray(image)

"""Who traces a picture: this package, and potrace and vtracer where they are installed."""

from __future__ import annotations

import io
import re
import shutil
import subprocess
import tempfile
import time
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from PIL import Image, ImageColor

import shapespline as ss
from benchmarks.drawn.found import Found
from benchmarks.drawn.renderers import MissingError, is_ink
from shapespline.values import Piece

if TYPE_CHECKING:
    from collections.abc import Callable

    from benchmarks.drawn.renderers import Picture

CHARACTERS = ("fewest", "drawn")


def ours(
    picture: Picture, tolerance: float | None, character: str, colors: int | None = None
) -> tuple[Found, float]:
    """Outlines of this package, of the drawing alone, and the seconds that fitting took."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ss.PictureWarning)  # of the light on photographs
        shape = ss.trace(picture, colors=colors)
    begin = time.process_time()
    fits = ss.fit_shape(shape, tolerance=tolerance, character=character).fits
    seconds = time.process_time() - begin
    own = [fit for k, fit in enumerate(fits) if _is_drawn(shape, k, len(picture))]
    return Found.of_fits(own), seconds


def _is_drawn(shape: ss.Shape, index: int, size: int) -> bool:
    """Whether an outline is no disc beside the drawing and, of areas, one of ink."""
    if shape.contours[index].points[:, 0].max() > size:
        return False
    area = index if shape.parents[index] < 0 else shape.parents[index]
    color = shape.colors[area] if shape.colors else None
    return color is None or is_ink(ImageColor.getrgb(color))


def potrace(picture: Picture) -> Found:
    """With its own threshold and options."""
    if shutil.which("potrace") is None:
        raise MissingError("potrace was left out: it is not installed")
    bitmap = io.BytesIO()
    Image.fromarray(picture).save(bitmap, format="PPM")
    command = ["potrace", "-b", "svg", "--flat", "-r", "72", "-o", "-", "-"]
    done = subprocess.run(command, input=bitmap.getvalue(), capture_output=True, check=True)
    return _found(done.stdout.decode(), len(picture))


def vtracer(picture: Picture) -> Found:
    """Black and white, splines."""
    try:
        import vtracer as program
    except ImportError as error:
        raise MissingError("vtracer was left out: it is not installed") from error
    with tempfile.TemporaryDirectory() as folder:
        source, target = Path(folder, "picture.png"), Path(folder, "picture.svg")
        Image.fromarray(picture).convert("RGB").save(source)
        program.convert_image_to_svg_py(str(source), str(target), colormode="binary")
        return _found(target.read_text("utf-8"), len(picture))


PEERS: dict[str, Callable[[Picture], Found]] = {"potrace": potrace, "vtracer": vtracer}


def _found(text: str, size: int) -> Found:
    """The outlines of an SVG file, in pixels, y up."""
    import svgelements

    text = re.sub(r"<\?xml.*?\?>|<!DOCTYPE.*?>", "", text, flags=re.DOTALL)
    drawing = svgelements.SVG.parse(io.StringIO(text), reify=True, ppi=72)
    scale = size / float(drawing.width)
    outlines = []
    for element in drawing.elements(lambda item: isinstance(item, svgelements.Path)):
        for part in element.as_subpaths():
            pieces = [
                piece
                for segment in svgelements.Path(part)
                if (piece := _piece(segment, scale, size)) is not None
            ]
            if pieces:
                outlines.append(pieces)
    return Found.of_pieces(outlines)


def _piece(segment: Any, scale: float, size: int) -> Piece | None:
    """A line or a cubic; None for one of no length."""
    import svgelements

    if isinstance(segment, svgelements.Move):
        return None
    given = [segment.start, segment.end]
    if isinstance(segment, svgelements.CubicBezier):
        given = [segment.start, segment.control1, segment.control2, segment.end]
    points = np.array([[scale * p.x, size - scale * p.y] for p in given])
    if not np.ptp(points, axis=0).any():
        return None
    degree = len(points) - 1
    knots = np.repeat([0.0, 1.0], degree + 1)
    return Piece("line" if degree == 1 else "bezier", degree, knots, points)

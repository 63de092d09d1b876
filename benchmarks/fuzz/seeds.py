"""Sound files of every format that is read, and what hostile ones are made of."""

from __future__ import annotations

import io
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from PIL import Image

import shapespline as ss

# Written by hand: what our own writers do not write, but others do.
SVG = b"""<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"
 width="40mm" height="30mm" viewBox="0 0 40 30"><style>.a{fill:none;stroke:red}</style>
<defs><g id="one"><rect x="1" y="1" width="5" height="4" rx="1"/><circle cx="9" cy="9" r="3"/></g>
<symbol id="two" viewBox="0 0 9 9"><use href="#one"/></symbol></defs>
<g transform="rotate(20) translate(3 4) scale(1.5)" class="a"><use xlink:href="#one" x="2"/>
<use href="#two" width="7" height="7"/></g><polygon points="1,1 9,2 6,8"/><ellipse rx="4" ry="2"/>
<path d="M3 3h4v5H3zM10 10C12 8 14 12 16 10S20 8 22 12Q24 6 26 12T30 12A5 3 30 1 0 20 20z"/>
<text>no</text></svg>"""
DXF = """
0 SECTION 2 HEADER 9 $ACADVER 1 AC1015 9 $INSUNITS 70 4 0 ENDSEC 0 SECTION 2 BLOCKS 0 BLOCK 8 0
2 A 70 0 10 0 20 0 3 A 0 LINE 8 0 10 0 20 0 11 5 21 5 0 INSERT 8 0 2 B 10 1 20 1 0 ENDBLK 8 0 0
BLOCK 8 0 2 B 70 0 10 0 20 0 3 B 0 CIRCLE 8 0 10 0 20 0 40 3 0 ENDBLK 8 0 0 ENDSEC 0 SECTION 2
ENTITIES 0 INSERT 8 0 2 A 10 3 20 4 41 2 50 30 70 2 71 2 44 9 45 9 0 ARC 8 0 10 1 20 2 40 3 50
10 51 200 0 ELLIPSE 8 0 10 0 20 0 11 4 21 1 40 0.5 41 0 42 6 0 LWPOLYLINE 100 AcDbEntity 8 0 100
AcDbPolyline 90 3 70 1 10 0 20 0 42 0.5 10 5 20 0 10 5 20 5 0 POLYLINE 8 0 66 1 70 1 0 VERTEX 8
0 10 0 20 0 0 VERTEX 8 0 10 4 20 0 42 -1 0 VERTEX 8 0 10 4 20 4 0 SEQEND 8 0 0 SPLINE 100
AcDbEntity 8 0 100 AcDbSpline 70 8 71 3 72 8 73 4 40 0 40 0 40 0 40 0 40 1 40 1 40 1 40 1 10 0
20 0 10 1 20 3 10 4 20 3 10 5 20 0 0 TEXT 8 0 10 0 20 0 40 1 1 no 0 ENDSEC 0 EOF"""
GEOJSON = b"""{"type":"FeatureCollection","features":[{"type":"Feature","properties":{},
"geometry":{"type":"GeometryCollection","geometries":[{"type":"Point","coordinates":[1,2]},
{"type":"MultiPolygon","coordinates":[[[[0,0],[4,0],[4,4],[0,0]],[[1,1],[2,1],[2,2],[1,1]]]]},{"type":"MultiLineString",
"coordinates":[[[0,0,5],[1,2,5],[3,1,5]]]}]}}]}"""
CSV = b"# x;y\n0;0\n1,5;2\n3;1\n\n5;5\n7;5\n7;7\n5;5\n"
ENDINGS = ("csv", "npy", "json", "geojson", "svg", "dxf", "png", "jpg", "tif", "bmp", "webp", "gif")
# Read by libraries in C++ that are extras.
EXTRAS = {"step": "OCP", "iges": "OCP", "3dm": "rhino3dm"}


def endings() -> tuple[str, ...]:
    """Formats that can be read here."""
    return (*ENDINGS, *(name for name, module in EXTRAS.items() if find_spec(module) is not None))


def sound(ending: str) -> list[bytes]:
    """Files of a format without a fault, most of a few hundred bytes."""
    if ending == "npy":
        return [_saved(np.arange(12.0).reshape(6, 2)), _saved(np.eye(9, 2).astype("<f4"))]
    if ending in ("png", "jpg", "tif", "bmp", "webp", "gif"):
        return _pictures(ending)
    if ending == "csv":
        return [CSV, b"x,y\n0,0\n4,0\n4,4\n0,4\n0,0\n"]
    by_hand = {"svg": [SVG], "dxf": [_tagged(DXF)], "geojson": [GEOJSON]}.get(ending, [])
    return [*by_hand, _written(ending)]


def _saved(array: np.ndarray) -> bytes:
    out = io.BytesIO()
    np.save(out, array)
    return out.getvalue()


def _tagged(text: str) -> bytes:
    """A DXF file of its tags: code and value each on a line."""
    return "\n".join(text.split()).encode()


def _pictures(ending: str) -> list[bytes]:
    pixels = np.full((20, 24), 255, dtype=np.uint8)
    pixels[6:15, 5:18] = 0
    kind = {"jpg": "jpeg", "tif": "tiff"}.get(ending, ending)
    files = []
    for mode in ("L",) if ending == "gif" else ("L", "RGB"):
        out = io.BytesIO()
        Image.fromarray(pixels).convert(mode).save(out, format=kind)
        files.append(out.getvalue())
    return files


def _written(ending: str) -> bytes:
    """A drawing of two curves, as this package writes it."""
    turn = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    ring = np.column_stack([5 * np.cos(turn), 3 * np.sin(turn)])
    shape = ss.Shape([ss.Contour(ring, True), ss.Contour(0.4 * ring, True)], [-1, 0])
    with TemporaryDirectory() as folder:
        path = Path(folder, f"sound.{ending}")
        ss.write(path, ss.fit_shape(shape, tolerance=0.05))
        return path.read_bytes()

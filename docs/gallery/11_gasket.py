"""
A gasket for a laser: lines and arcs
====================================

Controllers that read no splines get tangent-continuous arcs. Written as DXF, read back as entities.
"""

import tempfile
from collections import Counter
from pathlib import Path

from canvas import curves, image, panels

import shapespline as ss

drawing = ss.fit_shape(ss.read(image("fa_gear_256.png"), dpi=96), tolerance=0.1)
with tempfile.TemporaryDirectory() as folder:
    path = Path(folder) / "gasket.dxf"
    ss.write(path, drawing, arcs=True)
    kinds = Counter(line for line in path.read_text().splitlines() if line.isupper())
    back = ss.read(path)

(axes,) = panels()
curves(axes, back, filled=True, points=False)
axes.set_title(f"{kinds['LWPOLYLINE']} closed polylines of lines and arcs, {back.unit}")

"""
A profile to STEP, and back
===========================

The section is written for CAD and read again by OpenCASCADE: the same curve.
"""

import tempfile
from pathlib import Path

from canvas import curves, dots, outline, panels

import shapespline as ss

points = outline("naca4412")
fit = ss.fit_curve(points, closed=False, tolerance="0.05%", ends="fixed")
with tempfile.TemporaryDirectory() as folder:
    path = Path(folder) / "profile.step"
    ss.write(path, ss.Drawing([fit], unit="mm"))
    (back,) = ss.read(path)
    size = path.stat().st_size
found = ss.compare(ss.Drawing([fit]), ss.Drawing([back]))

(axes,) = panels()
dots(axes, points, 5)
curves(axes, [back])
axes.set_title(f"{size} bytes; off by {found.hausdorff_distance:.1g} of a chord of 1")

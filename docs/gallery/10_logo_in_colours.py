"""
A logo in colours
=================

A logo of two flat colours, painted from two icons; one reading for each colour.
"""

import tempfile
from pathlib import Path

from canvas import BLUE, ORANGE, curves, image, panels, stored
from PIL import Image

import shapespline as ss

logo = Image.new("RGB", (256, 256), "white")
leaf = Image.open(image("mdi_leaf-maple_256.png")).convert("L").resize((110, 110))
gear = Image.open(image("fa_gear_256.png")).convert("L")
logo.paste(BLUE, (0, 0), gear)
logo.paste("white", (63, 63, 193, 193))
logo.paste(ORANGE, (73, 73), leaf)

seen, traced = panels(2)
seen.imshow(logo)
total = 0
with tempfile.TemporaryDirectory() as folder:
    path = Path(folder) / "logo.png"
    logo.save(path)
    for color in (BLUE, ORANGE):
        drawing = ss.fit_shape(ss.read(path, color=color), tolerance=0.5)
        curves(traced, drawing, filled=True, points=False, color=color)
        total += stored(drawing)
traced.set_title(f"two colours, {total} points")

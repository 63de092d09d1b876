"""Pages of SVG written by hand, and what is read of them."""

from __future__ import annotations

HEAD = '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
PAGE = 'viewBox="0 0 40 30"'


def points(outlines, index=0):
    return [piece.control_points.tolist() for piece in outlines.curves[index]]


def path(d, **attributes):
    more = " ".join(f'{name}="{value}"' for name, value in attributes.items())
    return f'<path d="{d}" {more}/>'

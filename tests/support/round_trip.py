"""Helpers for every format that holds curves: what was written, read again; ezdxf's own points."""

from __future__ import annotations

import numpy as np

import shapespline as ss

# The issue's: of the size of the drawing. Doubles written with all digits keep far more.
SAME = 1e-9


def sizes(drawing):
    return max(fit.contour.box_diagonal for fit in drawing)


def round_trip(drawing, path, **options):
    """Write, read, and assert that the curves, their number, closure and nesting are the same."""
    ss.write(path, drawing, **options)
    again = ss.read(path)
    assert isinstance(again, ss.Drawing)
    assert len(again) == len(drawing)
    matched = _matched(drawing, again)
    for mine, theirs in enumerate(matched):
        before, after = drawing.fits[mine], again.fits[theirs]
        assert after.closed == before.closed
        found = ss.compare(before.spline, after.spline)
        assert found.hausdorff_distance <= SAME * sizes(drawing)
        parent = drawing.parents[mine]
        assert again.parents[theirs] == (-1 if parent < 0 else matched[parent])
    return again


def _matched(drawing, again):
    """For each fit the one at the same place in the drawing read again: order may differ."""

    def box(fit):
        pieces = fit.spline.beziers().points.reshape(-1, 2)
        ends = fit.spline(fit.spline.breakpoints)
        return np.concatenate([ends.min(axis=0), ends.max(axis=0), pieces.mean(axis=0)])[:4]

    theirs = [box(fit) for fit in again]
    order = [
        int(np.argmin([np.abs(box(fit) - other).max() for other in theirs])) for fit in drawing
    ]
    assert sorted(order) == list(range(len(drawing)))
    return order


def flattened(entity, n=400):
    """Points of an entity by ezdxf's construction tools."""
    if entity.dxftype() == "LINE":
        return np.array([entity.dxf.start.xyz, entity.dxf.end.xyz])[:, :2]
    if entity.dxftype() in ("ARC", "CIRCLE"):
        angles = np.linspace(0, 360, n) if entity.dxftype() == "CIRCLE" else entity.angles(n)
        return np.array([p.xyz for p in entity.vertices(list(angles))])[:, :2]
    tool = entity.construction_tool()
    if entity.dxftype() == "ELLIPSE":
        return np.array([p.xyz for p in tool.vertices(tool.params(n))])[:, :2]
    return np.array([p.xyz for p in tool.approximate(n)])[:, :2]

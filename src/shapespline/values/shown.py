"""Shown: what a notebook asks of a value."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

if TYPE_CHECKING:
    from shapespline.values.contour import Contour


class Shown:
    """A value with a small picture: Contour, Shape, Fit and Drawing."""

    def _repr_svg_(self) -> str:
        """A small picture as an SVG element."""
        from shapespline.formats import svg_preview

        return svg_preview(cast("Contour", self))

    def _repr_html_(self) -> str:
        """The same picture with the line that ``repr`` gives."""
        from shapespline.formats import html_preview

        return html_preview(cast("Contour", self))

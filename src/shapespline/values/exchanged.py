"""Exchanged: what libraries of geometry and of fonts ask of a value."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

if TYPE_CHECKING:
    from shapespline.values.drawing import Drawing


class Exchanged:
    """A value that maps and fonts take: Contour, Shape, Fit and Drawing."""

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        """A GeoJSON geometry, points of the curves at a chordal tolerance: see `to_shapely`."""
        from shapespline.formats import geometry_of

        return geometry_of(cast("Drawing", self))

    def to_shapely(self, chord: float | None = None) -> Any:
        """The same as a shapely geometry: polygons with their holes, lines, or both.

        Parameters
        ----------
        chord : float, optional
            Largest distance between a curve and its points, data units; 1e-4 of the box diagonal
            if not given. Straight pieces are two points whatever it is.

        Raises
        ------
        MissingExtraError
            Without shapely.
        InvalidInputError
            If ``chord`` is not positive, or absurdly small.

        Examples
        --------
        >>> import shapespline as ss
        >>> square = ss.Contour([(0, 0), (2, 0), (2, 2), (0, 2)], closed=True)
        >>> square.to_shapely().area
        4.0
        """
        from shapespline.formats import shapely_geometry

        return shapely_geometry(cast("Drawing", self), chord)

    def to_geopandas(self, chord: float | None = None) -> Any:
        """A geopandas GeoSeries, an entry for each outline with its holes.

        Its coordinate reference is the ``reference`` of the value.

        Parameters
        ----------
        chord : float, optional
            As in `to_shapely`.

        Raises
        ------
        MissingExtraError
            Without geopandas.

        Examples
        --------
        >>> import shapespline as ss
        >>> square = ss.Contour([(0, 0), (2, 0), (2, 2), (0, 2)], closed=True)
        >>> shape = ss.Shape([square], reference="EPSG:25832")
        >>> shape.to_geopandas().crs.to_epsg()
        25832
        """
        from shapespline.formats import geopandas_series

        return geopandas_series(cast("Drawing", self), chord)

    def draw(self, pen: Any, *, clockwise: bool = False) -> None:
        """Draw the curves with a pen of fontTools, so that they are a glyph to its tools.

        Lines, quadratics and cubics are drawn as they are; curves of higher degree as cubics
        within 1e-6 of the size. fontTools' ``Cu2QuPen`` around the pen makes all of them
        quadratic.

        Parameters
        ----------
        pen : object
            With ``moveTo``, ``lineTo``, ``curveTo``, ``qCurveTo``, ``closePath`` and ``endPath``.
        clockwise : bool
            Whether outer outlines run clockwise and holes the other way, as in TrueType; the other
            way round, as in PostScript, if not.

        Examples
        --------
        >>> from fontTools.pens.recordingPen import RecordingPen
        >>> import shapespline as ss
        >>> pen = RecordingPen()
        >>> ss.Contour([(0, 0), (500, 0), (500, 700)], closed=True).draw(pen)
        >>> pen.value[:2]
        [('moveTo', ((0.0, 0.0),)), ('lineTo', ((500.0, 0.0),))]
        """
        from shapespline.formats import draw_with_pen

        draw_with_pen(cast("Drawing", self), pen, clockwise=clockwise)

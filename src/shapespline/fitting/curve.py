"""fit_curve: points in, verified Fit out."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapespline.fitting.request import Request
from shapespline.fitting.settings import Settings
from shapespline.fitting.solve import solve
from shapespline.monitor import Monitor

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.monitor import Callback
    from shapespline.typing import (
        ArrayLike,
        Character,
        CornerChoice,
        Effort,
        Ends,
        Form,
        Knots,
        Loss,
    )
    from shapespline.values import Contour, Fit


def fit_curve(
    points: ArrayLike | Contour,
    *,
    closed: bool | None = None,
    tolerance: float | str | None = None,
    n_control_points: int | None = None,
    degree: int = 3,
    corners: CornerChoice | ArrayLike | None = "auto",
    form: Form = "pieces",
    ends: Ends = "free",
    end_tangents: tuple[ArrayLike | None, ArrayLike | None] | None = None,
    through: ArrayLike | None = None,
    symmetric: bool = False,
    character: Character | None = None,
    regularities: str | Sequence[str] | None = "auto",
    simplify: bool = False,
    smoothness: int = 1,
    effort: Effort = "balanced",
    weights: ArrayLike | None = None,
    sigma: ArrayLike | None = None,
    loss: Loss | None = None,
    knots: Knots = "balanced",
    outliers: bool = False,
    method: str = "levenberg-marquardt",
    callback: Callback | None = None,
    time_limit: float | None = None,
) -> Fit:
    """Fit a B-spline curve to ordered points.

    With a ``tolerance``: the fewest stored points that keep it, in both directions, as lines,
    Beziers and small splines or as one spline. With ``n_control_points``: one spline by least
    squares, control points and parameters together. With neither the curve is estimated: clean
    points give the smallest curve within what they tell of each other, a hundredth to a tenth of a
    per cent of the box diagonal, or within the accuracy of their source, and vertices that were
    drawn themselves; noisy ones a least-squares curve whose size a criterion chooses, in pieces
    with corners and straight runs where the points tell of them.

    Parameters
    ----------
    points : array_like, shape (n, 2), or Contour
        In order along the outline, data units.
    closed : bool, optional
        Whether the last point joins the first; found from the data when not given.
    tolerance : float or str, optional
        Largest distance from data to curve and from curve to data polyline, data units; or a
        part of the box diagonal, such as ``"0.1%"``.
    n_control_points : int, optional
        Number of control points, ``degree + 1`` to n.
    degree : int
        1 to 9.
    corners : "auto", "free", None or array_like of indices
        Keep corners sharp and everything else tangent-continuous; round or make
        them where that is smaller; know none; or these points are the corners.
    form : {"pieces", "spline", "arcs"}
        Pieces between nodes; one spline, smooth everywhere; or, within a tolerance, lines and arcs
        alone, tangent where the curve is smooth (``fit.pieces``; ``fit.curve`` holds splines in
        their place that are a hundredth of the tolerance from them, which the distances count).
    ends : {"free", "fixed"}
        Of an open curve: "fixed" begins and ends in the first and last point, exactly. Pieces
        whose ends are free, within the tolerance of these points, may take fewer; one spline always
        has fixed ends, but where it is estimated from noisy points and they are free.
    end_tangents : pair of array_like, shape (2,), or None, optional
        Directions (x, y) in which an open curve begins and ends, exactly; None where that is free.
        Its ends are fixed then. Within a tolerance, in pieces.
    through : array_like of indices, optional
        Points, counted as they were given, that the curve goes through, up to rounding; each is a
        node of it, smooth where it is no corner. Within a tolerance, in pieces.
    symmetric : bool
        Whether a mirror symmetry that a closed outline has within a part of the tolerance is kept
        exactly: one half is fitted and reflected, which may take some points more. Without, that
        is done where it takes none, unless the search is to be fast.
    character : {"drawn", "fewest"}, optional
        The shape as it was drawn: lines, circular arcs and whole circles where the data show them,
        corners where they meet, and the tolerance spent on the rest; what cannot be told that way,
        or would not keep the tolerance, is as with "fewest", the fewest points whatever was drawn.
        "drawn" where it acts if nothing is said: in pieces of degree 3 or more with corners "auto",
        nothing kept exactly by other options.
    regularities : "auto", None or sequence of str
        As it was drawn, what lines and arcs may keep exactly where the data allow it: "tangent",
        "rotation", "mirror", "axis-parallel", "parallel", "perpendicular", "concentric",
        "equal-radius", "collinear", "equal-length"; among the outlines of a shape also
        "equal-copies" and "equal-spacing"; all of these, none, or some. ``fit.regularities`` lists
        them.
    simplify : bool
        With "drawn", leave out features that the tolerance does not need: a fillet becomes a
        corner, an arc a line; equal features stay equal.
    smoothness : {1, 2}
        Tangents have no jump but in corners; or curvature has none either (G2), for surfaces that
        are built on the curve. Within a tolerance, in pieces of degree 3 or more: a line or one
        spline from corner to corner, at the price of points. Where the data are too rough for that
        the status says so.
    effort : {"fast", "balanced", "smallest"}
        How long to search.
    weights : array_like, shape (n,), optional
        One positive weight per point. In least squares they multiply the squared distances; within
        a tolerance a point of weight w > 1 is kept within tolerance / w, and a lower weight loosens
        nothing. Few points are held exactly by ``through``, and cheaper. Without a tolerance the
        result is one spline.
    sigma : float or array_like, optional
        Standard deviations of the measured points: one length, one for each point (n,), one for
        each axis (n, 2), or covariances (n, 2, 2). In least squares: with a number of control
        points, or without, and then the errors choose the size of one spline. ``fit.covariance``
        and ``fit.band`` tell how sure the curve is; open ends are fitted unless they are fixed.
    loss : {"huber", "tukey"}, optional
        Where ``sigma`` acts, instead of the square: errors beyond 1.345 standard deviations count
        linearly, those beyond 4.685 no more. Without ``sigma`` the deviation is that of most
        points.
    knots : str
        With a number of control points, what least squares starts from: ``"balanced"``, knots
        spread until every span errs as much; or for comparison ``"cpda-filled"``,
        ``"cpda-halved"``, ``"cpda-maxima"``, ``"curvature"``, ``"arc-length"``, ``"every-nth"``,
        ``"park-lee"``, ``"dominant"``, ``"uniform"`` (docs/paper.md compares them).
    outliers : bool
        Whether to leave out points that jump off the path and back, up to three in a row (see
        `find_outliers`); ``fit.outliers`` lists them and every promise is about the rest, which
        is ``fit.contour``, as are ``fit.parameters``.
    method : str
        For least squares: with a number of control points, weights or ``form="spline"`` and no
        tolerance; see `optimize`.
    callback : callable, optional
        Called with every Iteration of a least-squares run, or with the progress of a search
        within a tolerance (an Iteration whose ``cost`` is the number of points), some times a
        second; a true answer cancels it. The best curve so far is returned.
    time_limit : float, optional
        Seconds after which the search ends with the best curve so far. It is looked at between
        iterations and between moves; finding a start and verifying the result come on top.

    Returns
    -------
    Fit
        Its distances are verified both ways; ``fit.kept`` and ``fit.status`` say whether the
        tolerance holds.

    Raises
    ------
    InvalidInputError, DegenerateContourError
        If the points or an argument is not usable; the message says which and why.

    Examples
    --------
    >>> import numpy as np
    >>> t = np.linspace(0, 2 * np.pi, 200, endpoint=False)
    >>> ellipse = np.column_stack([3 * np.cos(t), np.sin(t)])
    >>> fit = fit_curve(ellipse, closed=True, tolerance=0.01)
    >>> fit.kept, fit.closed, fit.n_stored_points <= 8
    (True, True, True)
    >>> fit_curve(ellipse, closed=True, n_control_points=12).n_control_points
    12
    """
    settings = Settings(
        tolerance=tolerance,
        n_control_points=n_control_points,
        degree=degree,
        corners=corners,
        form=form,
        ends=ends,
        end_tangents=end_tangents,
        through=through,
        symmetric=symmetric,
        character=character,
        regularities=regularities,
        simplify=simplify,
        smoothness=smoothness,
        effort=effort,
        weights=weights,
        sigma=sigma,
        loss=loss,
        knots=knots,
        outliers=outliers,
        method=method,
        time_limit=time_limit,
    )
    request = Request.of(points, closed, settings)
    return solve(request, Monitor(callback, settings.time_limit))

"""Fits: a whole document, one outline while a slider moves, and scipy's splprep to compare with."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import TYPE_CHECKING, Any, get_args

import numpy as np

from shapespline import typing as words
from shapespline.errors import InvalidInputError, ShapesplineError
from shapespline.fitting import Settings, Within, fit_curve, fit_shape, verified_fit
from shapespline.values import BSplineCurve, Contour, Drawing

if TYPE_CHECKING:
    from shapespline.studio.asked import Asked
    from shapespline.studio.jobs import Ticket
    from shapespline.values import Fit

# While a slider moves a search ends after so many seconds with its best curve, which is verified
# (STU-01).
DRAFT_SECONDS = 0.08
# Of one outline, where nobody said a limit: a page is no place to wait longer.
MOST_SECONDS = 60.0
# splprep's smoothing factor is halved down to this difference of its decimal logarithm.
SMALLEST_STEP = 1e-3


def choices() -> dict[str, list[str]]:
    """Options of a fit that take one of some words, and the words.

    Examples
    --------
    >>> choices()["effort"]
    ['fast', 'balanced', 'smallest']
    """
    known = {
        item.name: getattr(words, str(item.type).removesuffix(" | None"), None)
        for item in fields(Settings)
    }
    return {
        name: list(get_args(one))
        for name, one in known.items()
        if get_args(one) and all(isinstance(word, str) for word in get_args(one))
    }


def defaults() -> dict[str, str]:
    """What these options are where nothing is said; nothing where that depends on the others.

    Examples
    --------
    >>> defaults()["effort"]
    'balanced'
    """
    return {
        item.name: "" if item.default is None else str(item.default)
        for item in fields(Settings)
        if item.name in choices()
    }


def fitted(asked: Asked, index: int, ticket: Ticket, *, draft: bool = False) -> Fit:
    """The fit of one outline; a draft is one within a few hundredths of a second."""
    settings = asked.settings(index)
    if draft:
        within = settings.tolerance is not None
        settings = replace(
            settings,
            effort="fast" if within else settings.effort,
            # What was drawn is looked for without an eye on the time (STU-06).
            character="fewest",
            regularities="auto",
            simplify=False,
            time_limit=DRAFT_SECONDS,
        )
    elif settings.time_limit is None:
        settings = replace(settings, time_limit=MOST_SECONDS)
    options: dict[str, Any] = {item.name: getattr(settings, item.name) for item in fields(settings)}
    try:
        return fit_curve(asked.contour(index), callback=ticket.check, **options)
    except ShapesplineError as error:
        if len(asked.document.shape) == 1:
            raise
        raise type(error)(f"outline {index + 1}: {error}") from error


def whole(asked: Asked, ticket: Ticket) -> Drawing:
    """The fits of a document: those of the command line, unless outlines have own settings."""
    shape = asked.document.shape
    if asked.is_plain:
        options = {"time_limit": MOST_SECONDS, **asked.common}
        shared = asked.shared_boundaries
        return fit_shape(shape, callback=ticket.check, shared_boundaries=shared, **options)
    fits = [fitted(asked, index, ticket) for index in range(len(shape))]
    return Drawing.of(shape, fits)


def remarks(asked: Asked, drawing: Drawing) -> list[str]:
    """What the command line says of these fits: sentences, each once."""
    said: dict[str, None] = {}
    for index, fit in enumerate(drawing):
        settings = asked.settings(index)
        if settings.tolerance is not None and isinstance(settings.corners, str):
            found = Within(fit.tolerance).remarks(asked.contour(index))
            said |= dict.fromkeys(map(str, found))
    return list(said)


def splprep_fit(contour: Contour, tolerance: float, degree: int, ticket: Ticket) -> Fit:
    """What splprep makes of an outline: the largest smoothing whose points keep a tolerance.

    The factor is found by halving; splprep itself promises a sum of squares, not a distance.
    """
    from scipy.interpolate import BSpline, splprep

    points = contour.points
    if contour.closed:
        points = np.vstack([points, points[:1]])
    if len(points) <= degree:
        raise InvalidInputError(f"splprep needs more than {degree} points, got {len(points)}")
    best: Fit | None = None
    least, most = -12.0, 2.0
    while best is None or most - least > SMALLEST_STEP:
        ticket.check()
        middle = 0.5 * (least + most)
        smoothing = len(points) * tolerance**2 * 10.0**middle
        (knots, columns, _), *_ = splprep(
            points.T, s=smoothing, k=degree, per=contour.closed, quiet=2
        )
        curve = BSpline(
            knots, np.column_stack(columns), degree,
            extrapolate="periodic" if contour.closed else True,
        )  # fmt: skip
        fit = verified_fit(
            contour, BSplineCurve.from_scipy(curve), tolerance=tolerance, method="splprep"
        )
        if fit.max_distance <= tolerance:
            best, least = fit, middle
        else:
            best, most = best or fit, middle
    return best

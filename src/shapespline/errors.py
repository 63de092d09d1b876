"""The exceptions that shapespline raises: bad input raises, not converging is a status.

Every message names the argument, what was expected, what came and what to do about it.
"""

from __future__ import annotations

import sys
from importlib import import_module
from importlib.util import find_spec


class ShapesplineError(Exception):
    """Root of every error raised on purpose by this package."""


class InvalidInputError(ShapesplineError, ValueError):
    """An argument has the wrong shape, type or value."""


class DegenerateContourError(InvalidInputError):
    """The points do not span a curve: too few distinct ones, or too few for the degree."""


class OrderError(InvalidInputError):
    """The points, parameters or knots are not in the order that the call needs."""


class FormatError(ShapesplineError):
    """A file cannot be read, or a value cannot be held by the format asked for."""


class UnknownFormatError(FormatError):
    """No reader or writer is registered for a file name's ending."""


class MissingExtraError(ShapesplineError, ImportError):
    """An optional dependency is not installed."""


class DroppedPointsWarning(UserWarning):
    """Points that add nothing to the shape (repeated ones) were left out."""


class SkippedContentWarning(UserWarning):
    """Parts of a file were left out: no outlines, or how areas lie partly over each other."""


class OpenOutlinesWarning(UserWarning):
    """Ends of outlines in a drawing almost meet, and were not joined."""


class PictureWarning(UserWarning):
    """What a picture was taken for, where it could be otherwise, and the option that says so."""


class ShuffledPointsWarning(UserWarning):
    """Points are hardly in the order of an outline."""


class SparsePointsWarning(UserWarning):
    """Points are so sparse that a smooth curve through them leaves the tolerance between them."""


class ArcsAsCurvesWarning(UserWarning):
    """A format that knows no arcs was written: curves stand for them."""


class MissingReferenceWarning(UserWarning):
    """A format for maps was written without a coordinate reference."""


def require(module: str, extra: str, said: str) -> None:
    """Raise unless a module of an extra can be imported.

    Parameters
    ----------
    module : str
        What is imported.
    extra : str
        What brings it.
    said : str
        Who needs it, such as "DXF files need".

    Raises
    ------
    MissingExtraError

    Examples
    --------
    >>> require("no_such_module", "dxf", "DXF files need")
    Traceback (most recent call last):
    ...
    shapespline.errors.MissingExtraError: DXF files need the extra dxf: \
pip install "shapespline[dxf]"
    """
    try:
        import_module(module)
    except ModuleNotFoundError as error:
        raise _missing(extra, said) from error
    except ImportError as error:  # there, but a library of the system is not
        raise MissingExtraError(
            f"{said} {module}, which is installed and cannot be loaded: {error}"
        ) from error


def require_installed(module: str, extra: str, said: str) -> None:
    """Raise unless the package of a module is there, which is not imported.

    Parameters
    ----------
    module, extra, said : str
        As for `require`.

    Raises
    ------
    MissingExtraError
    """
    if find_spec(module.partition(".")[0]) is None:
        raise _missing(extra, said)


def _missing(extra: str, said: str) -> MissingExtraError:
    return MissingExtraError(f'{said} the extra {extra}: pip install "shapespline[{extra}]"')


def caller_level() -> int:
    """The ``stacklevel`` at which a warning points at the caller's own line, not into the package.

    To be called where ``warnings.warn`` is called.
    """
    level, frame = 1, sys._getframe(1)
    while frame.f_back is not None and frame.f_globals.get("__name__", "").startswith(__package__):
        level, frame = level + 1, frame.f_back
    return level

"""Options of a format: the keyword-only parameters of its function, and no others."""

from __future__ import annotations

import inspect
from typing import TYPE_CHECKING

from shapespline.errors import InvalidInputError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping


def option_names(function: Callable[..., object]) -> tuple[str, ...]:
    """Names of the keyword-only parameters of a function."""
    return tuple(
        name
        for name, parameter in inspect.signature(function).parameters.items()
        if parameter.kind is inspect.Parameter.KEYWORD_ONLY
    )


def known_options(
    name: str, kind: str, function: Callable[..., object], options: Mapping[str, object]
) -> dict[str, object]:
    """Options that were given, all of them known to a function.

    Parameters
    ----------
    name, kind : str
        What is read or written, such as "a.svg", and of which kind it is, for the sentence.
    function : callable
    options : mapping
        One that is None counts as not given.

    Raises
    ------
    InvalidInputError
        If the function does not take one of them.
    """
    known = option_names(function)
    given = {option: value for option, value in options.items() if value is not None}
    for option in given:
        if option not in known:
            takes = f"take {', '.join(known)}" if known else "take no options"
            raise InvalidInputError(f"{option} is not an option for {name}: {kind} {takes}")
    return given

"""One test for many files: a thousand cases of a millisecond cost seconds before the first runs."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from tests.support.places import ROOT

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable


def each(values: Iterable[Any]) -> Callable[[Callable[..., None]], Callable[[], None]]:
    """Run a test's body for every value; a failure names the value.

    A value that is a tuple is given as several arguments. No value at all is a failure.
    """
    values = list(values)

    def decorate(body: Callable[..., None]) -> Callable[[], None]:
        def test() -> None:
            assert values, "nothing to test"
            for value in values:
                try:
                    body(*value) if isinstance(value, tuple) else body(value)
                except Exception as error:
                    error.add_note(f"of {_label(value)}")
                    raise

        test.__name__, test.__doc__, test.__module__ = body.__name__, body.__doc__, body.__module__
        return test

    return decorate


def _label(value: object) -> str:
    if isinstance(value, Path) and value.is_relative_to(ROOT):
        return value.relative_to(ROOT).as_posix()
    return repr(value)

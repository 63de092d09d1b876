"""Options that belong together, gathered in one argument of a command."""

from __future__ import annotations

import functools
import inspect
from dataclasses import fields
from typing import TYPE_CHECKING, Any, get_type_hints

if TYPE_CHECKING:
    from collections.abc import Callable

    Command = Callable[..., Any]


def gathers(**groups: type[Any]) -> Callable[[Command], Command]:
    """Give a command the options of groups, each gathered in the argument that it is named for.

    Options are built from a signature; the command's gets the fields of the groups in place of
    the arguments that take them.
    """

    def decorate(command: Command) -> Command:
        own = inspect.signature(command, eval_str=True)
        options = {name: _parameters(group) for name, group in groups.items()}  # type: ignore[arg-type]

        @functools.wraps(command)
        def gathered(**given: Any) -> Any:
            for name, group in groups.items():
                taken = {option.name: given.pop(option.name) for option in options[name]}
                given[name] = group(**taken)
            return command(**given)

        parameters = [
            parameter.replace(kind=inspect.Parameter.KEYWORD_ONLY)
            for parameter in own.parameters.values()
            if parameter.name not in groups
        ]
        parameters += [option for found in options.values() for option in found]
        gathered.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
        return gathered

    return decorate


@functools.cache
def _parameters(group: type[Any]) -> list[inspect.Parameter]:
    hints = get_type_hints(group, include_extras=True)
    return [
        inspect.Parameter(
            field.name,
            inspect.Parameter.KEYWORD_ONLY,
            default=field.default,
            annotation=hints[field.name],
        )
        for field in fields(group)
    ]

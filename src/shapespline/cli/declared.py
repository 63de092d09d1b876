"""Commands from functions: every parameter says in its annotation what option it is.

def fit(sources: Annotated[list[str], Argument("INPUT...")], *,
degree: Annotated[int, Option(help="Degree of the curve.")] = 3) -> None: ...
"""

from __future__ import annotations

import inspect
from dataclasses import dataclass
from pathlib import Path
from types import NoneType, UnionType
from typing import TYPE_CHECKING, Any, Literal, Union, get_args, get_origin

import click

from shapespline.cli.panels import OTHERS, PanelCommand, closing

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence


class Option:
    """An option; without names it is called like its parameter.

    Parameters
    ----------
    *names : str
        Such as "--jobs", "-j", or "--closed/--open".
    help : str
    panel : str
        The part of the help that it stands in.
    metavar : str, optional
        What stands for its value.
    least, most : int, optional
        Bounds of a number, themselves allowed.
    """

    def __init__(
        self,
        *names: str,
        help: str,
        panel: str = OTHERS,
        metavar: str | None = None,
        least: int | None = None,
        most: int | None = None,
    ) -> None:
        self.names, self.help, self.panel, self.metavar = names, help, panel, metavar
        self.bounds = (least, most)


@dataclass(frozen=True)
class Argument:
    """What is told by its place; with dots there may be several."""

    metavar: str
    help: str
    panel: str = OTHERS


def command(function: Callable[..., Any], examples: Sequence[str]) -> click.Command:
    """The command that calls a function, with its first sentence and examples as help."""
    parameters, rows = [], {}
    for parameter in inspect.signature(function, eval_str=True).parameters.values():
        hint, declared = get_args(parameter.annotation)
        rows[parameter.name] = declared
        make = _option if isinstance(declared, Option) else _argument
        parameters.append(make(parameter, hint, declared))
    return PanelCommand(
        function.__name__,
        callback=function,
        params=parameters,
        help=inspect.getdoc(function),
        short_help=inspect.getdoc(function),
        epilog=closing(examples),
        panels={name: declared.panel for name, declared in rows.items()},
        arguments={
            name: (declared.metavar, declared.help)
            for name, declared in rows.items()
            if isinstance(declared, Argument)
        },
    )


def _argument(parameter: inspect.Parameter, hint: Any, declared: Argument) -> click.Argument:
    several = get_origin(hint) is list
    required = parameter.default is inspect.Parameter.empty
    return click.Argument(
        [parameter.name],
        metavar=declared.metavar,
        nargs=-1 if several else 1,
        required=required,
        type=str if several else _type_of(hint, (None, None)),
        **({} if required else {"default": parameter.default}),
    )


def _option(parameter: inspect.Parameter, hint: Any, declared: Option) -> click.Option:
    """An option whose kind and values are those of the annotation."""
    names = declared.names or (f"--{parameter.name.replace('_', '-')}",)
    plain = _without_none(hint)
    kind: dict[str, Any] = {"type": _type_of(plain, declared.bounds), "metavar": declared.metavar}
    if plain is bool:
        kind = {"is_flag": True}
    elif get_origin(plain) is list:
        kind |= {"type": str, "multiple": True}
    return click.Option(
        [parameter.name, *names],
        help=declared.help,
        show_default=True,
        **(
            {"required": True}
            if parameter.default is inspect.Parameter.empty
            else {"default": parameter.default}
        ),
        **kind,
    )


def _without_none(hint: Any) -> Any:
    if get_origin(hint) not in (Union, UnionType):
        return hint
    (plain,) = (part for part in get_args(hint) if part is not NoneType)
    return plain


def _type_of(hint: Any, bounds: tuple[int | None, int | None]) -> Any:
    """How click reads a value."""
    plain = _without_none(hint)
    if get_origin(plain) is Literal:
        return click.Choice(get_args(plain))
    if plain is Path:
        return click.Path(path_type=Path)
    return plain if bounds == (None, None) else click.IntRange(*bounds)

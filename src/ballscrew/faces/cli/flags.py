"""Flags of the command line from options that are declared once."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Mapping
from typing import Annotated, Any, TypeVar

import typer

from ballscrew.questions.shared.options import OptionField, options_of

C = TypeVar("C", bound=Callable[..., None])
#: The parameter in whose place the flags stand, and which gets their values.
WRITTEN = "written"
#: The attribute of a command with the classes of its options.
_CLASSES = "options"
_TYPES: Mapping[str, Any] = {"switch": bool, "whole": int, "number": float}
_TABLES = ("names", "quantities", "texts", "ranges")


def flags_of(*classes: type) -> Callable[[C], C]:
    """Decorator of a command that takes the options of some dataclasses, by its parameter ``written``.

    The command gets a mapping of what was written, by the names of the options. Of an option that several classes have,
    the first one says what the help says. The flags are made by :func:`with_flags`, of the command that is asked for.
    """

    def decorated(command: C) -> C:
        setattr(command, _CLASSES, classes)
        return command

    return decorated


def with_flags(command: Callable[..., None]) -> Callable[..., None]:
    """A command with a flag for each of its options in place of its parameter ``written``; others as they are."""
    classes: tuple[type, ...] = getattr(command, _CLASSES, ())
    if not classes:
        return command
    options = {name: option for cls in reversed(classes) for name, option in options_of(cls).items()}
    names = dict.fromkeys(name for cls in classes for name in options_of(cls))

    @functools.wraps(command)
    def called(**given: Any) -> None:
        written = {name: given.pop(name) for name in names}
        command(**given, written=written)

    signature = inspect.signature(command, eval_str=True)
    parameters: list[inspect.Parameter] = []
    for parameter in signature.parameters.values():
        flags = [_flag(options[name]) for name in names] if parameter.name == WRITTEN else [parameter]
        parameters += [one.replace(kind=inspect.Parameter.KEYWORD_ONLY) for one in flags]
    # typer makes the parameters of a command from its signature
    setattr(called, "__signature__", signature.replace(parameters=parameters))  # noqa: B010  (functions have none)
    return called


def _flag(option: OptionField) -> inspect.Parameter:
    """The parameter of a command for an option, as typer reads it."""
    said, default = option.option, option.written_default
    names = [option.flag, *([said.short] if said.short else [])]
    kind: Any = list[str] if option.kind in _TABLES else _TYPES.get(option.kind, str)
    if default in (None, "") or option.kind in _TABLES:
        kind, default = kind | None, None
    least = None if option.kind == "quantity" else said.at_least
    annotation = Annotated[kind, typer.Option(*names, metavar=said.metavar or None, help=said.meaning, min=least)]
    return inspect.Parameter(option.name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=annotation)

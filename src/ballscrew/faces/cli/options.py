"""Parameters of commands: flags of options that are declared once, and parameters that several commands share."""

from __future__ import annotations

import dataclasses
import functools
import inspect
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, get_args, get_origin

import typer

from ballscrew.questions.shared.options import Option, OptionField, options_of
from ballscrew.questions.shared.question import CASE, SELF_HEATING

if TYPE_CHECKING:
    from ballscrew.basis.output.sheet import Sheet
    from ballscrew.questions.shared.question import Answer

_TYPES: Mapping[str, Any] = {"switch": bool, "whole": int, "number": float}
_TABLES = ("names", "quantities", "texts", "ranges")
#: Parameters that stand last in every help, in this order.
_LAST = ("allow_code", "verbose")
_JSON = Option("One JSON object, SI units.", flag="json")

CaseArgument = Annotated[Path, typer.Argument(help=CASE.meaning)]
AsJson = Annotated[bool, typer.Option("--json", help=_JSON.meaning)]
SelfHeating = Annotated[bool, typer.Option("--self-heating", help=SELF_HEATING.meaning)]
Verbose = Annotated[bool, typer.Option("--verbose", help="Say on the error stream what evaluates the model, and why.")]
#: Options of tables of screws.
Rows = Annotated[
    Path | None,
    typer.Option(
        "--rows",
        metavar="FILE",
        help="A table of screws of your own, .csv or .xlsx: each in place of that of the case.",
    ),
]
Row = Annotated[str | None, typer.Option("--row", metavar="NAME", help="Only this row of --rows.")]
KeepGoing = Annotated[bool, typer.Option("--keep-going", help="Leave faulty rows out, and say how many.")]


@dataclasses.dataclass(frozen=True, kw_only=True)
class Output:
    """The form in which an answer is printed: text, or JSON of its document or of its sheet."""

    as_json: Annotated[bool, _JSON] = False
    as_sheet: Annotated[bool, Option("What people see as one JSON object.", flag="sheet")] = False

    @property
    def is_data(self) -> bool:
        """True where the standard output is for programs: lines for people go to the error stream."""
        return self.as_json or self.as_sheet

    def print(self, sheet: Sheet, document: Callable[[], Any]) -> None:
        """Print a sheet, or the ``document`` of the answer, which is made only then."""
        from ballscrew.basis.output import json_text
        from ballscrew.basis.output import sheet as sheets
        from ballscrew.faces.sheets import terminal

        if self.as_sheet:
            typer.echo(json_text.as_json(sheets.document(sheet)))
        elif self.as_json:
            typer.echo(json_text.as_json(document()))
        else:
            typer.echo(terminal.text(sheet, getattr(sys.stdout, "encoding", None) or ""))

    def note(self, line: str) -> None:
        """Print a line for people, such as that on a file that was written."""
        typer.echo(line, err=self.is_data)

    def print_and_write(
        self, answer: Answer, files: Mapping[Path, str], option: str = "--to", own_kinds: Sequence[str] = ()
    ) -> None:
        """Print an answer and write its files: of each the name of the table that a .csv has.

        Those of its ``own_kinds`` come last, as there may be nothing to write into them.
        """
        from ballscrew.faces.sheets.files import write

        self.print(answer.sheet, answer.document)
        for path in sorted(files, key=lambda path: path.suffix.lower() in own_kinds):
            size = answer.size
            if answer.write is not None and path.suffix.lower() in own_kinds:
                size = answer.write(path)
            else:
                write(path, answer.sheet, files[path], option)
            self.note(f"{path}: {size}" if size else f"{path}")


def print_answer(text: Callable[[], str], document: Callable[[], Any], *, as_json: bool) -> None:
    """Print an answer that has no sheet."""
    from ballscrew.basis.output import json_text

    typer.echo(json_text.as_json(document()) if as_json else text())


def file_option(meaning: str, flag: str = "to", short: str = "-o", metavar: str = "FILE") -> Any:
    """The option that names a file to write, or several."""
    return typer.Option(f"--{flag}", *([short] if short else []), metavar=metavar, help=meaning)


def with_flags(command: Callable[..., None]) -> Callable[..., None]:
    """A command with flags in place of the parameters that stand for several options; others as they are.

    A parameter whose type is a dataclass of options gets an instance of it. One that is annotated with such classes,
    ``written: Annotated[Mapping[str, Any], FitOptions]``, gets what was written, by the names of the options; of an
    option that several classes have, the first one says what the help says. A mapping in the annotation has texts in
    place of those of options, by name; None leaves an option out.
    """
    groups: dict[str, _Group] = {}
    parameters: list[inspect.Parameter] = []
    for parameter in inspect.signature(command, eval_str=True).parameters.values():
        group = _group(parameter.annotation)
        if group is None:
            parameters.append(parameter.replace(kind=inspect.Parameter.KEYWORD_ONLY))
        else:
            groups[parameter.name] = group
            parameters += [_flag(option) for option in group.options.values()]
    if not groups:
        return command

    @functools.wraps(command)
    def with_groups(**given: Any) -> None:
        for name, group in groups.items():
            written = {option: given.pop(option) for option in group.options}
            given[name] = written if group.cls is None else _read(group.cls, written)
        command(**given)

    parameters.sort(key=lambda parameter: _LAST.index(parameter.name) + 1 if parameter.name in _LAST else 0)
    # typer makes the parameters of a command from its signature
    setattr(with_groups, "__signature__", inspect.Signature(parameters))  # noqa: B010  (functions have none)
    return with_groups


@dataclasses.dataclass(frozen=True)
class _Group:
    """Options that one parameter of a command stands for."""

    options: Mapping[str, OptionField]
    #: The class of which the command gets an instance; None for the mapping of what was written.
    cls: type | None


def _group(annotation: Any) -> _Group | None:
    kind, *metadata = get_args(annotation) if get_origin(annotation) is Annotated else (annotation,)
    is_instance = dataclasses.is_dataclass(kind)
    classes = [kind] if is_instance else [each for each in metadata if dataclasses.is_dataclass(each)]
    classes = [each for each in classes if isinstance(each, type)]
    if not classes:
        return None
    texts = {name: text for each in metadata if isinstance(each, Mapping) for name, text in each.items()}
    options: dict[str, OptionField] = {}
    for name, field in (item for cls in classes for item in options_of(cls).items()):
        text = texts.get(name, field.option.meaning)
        if name not in options and text is not None:
            options[name] = dataclasses.replace(field, option=dataclasses.replace(field.option, meaning=text))
    return _Group(options, classes[0] if is_instance else None)


def _read(cls: type, written: Mapping[str, Any]) -> Any:
    from ballscrew.questions.shared.option_values import read

    return read(cls, written)


def _flag(field: OptionField) -> inspect.Parameter:
    """The parameter of a command for an option, as typer reads it."""
    option, default = field.option, field.written_default
    names = [field.flag, *([option.short] if option.short else [])]
    kind: Any = list[str] if field.kind in _TABLES else _TYPES.get(field.kind, str)
    if default in (None, "") or field.kind in _TABLES:
        kind, default = kind | None, None
    least = None if field.kind == "quantity" else option.at_least
    annotation = Annotated[kind, typer.Option(*names, metavar=option.metavar or None, help=option.meaning, min=least)]
    return inspect.Parameter(field.name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=annotation)

"""Options and messages that several commands share."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Generator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ballscrew.faces.cli import INTERRUPTED

if TYPE_CHECKING:
    from ballscrew.basis.output.sheet import Sheet
    from ballscrew.questions.shared.every_row import OfRows, RowCase

#: Stand for the names of the models and of the calibrations in help texts; replaced when the help is shown.
MODEL_NAMES, CALIBRATION_NAMES = "{models}", "{calibrations}"
CaseFile = Annotated[Path, typer.Argument(help="Case file (TOML); ballscrew catalogue show NAME --case makes one.")]
ModelName = Annotated[
    str | None,
    typer.Option("--model", metavar="NAME", help=f"Model, in place of that of the file: {MODEL_NAMES}."),
]
CalibrationName = Annotated[
    str | None,
    typer.Option(
        "--calibration",
        metavar="NAME",
        help=f"Calibration, in place of that of the file: {CALIBRATION_NAMES}, by-make or none.",
    ),
]
Settings = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="SECTION.FIELD=VALUE", help='Change a value: --set operation.axial_load="4 kN".'),
]
AsJson = Annotated[bool, typer.Option("--json", help="One JSON object, SI units.")]
AsSheet = Annotated[bool, typer.Option("--sheet", help="What people see as one JSON object.")]
AllowCode = Annotated[
    bool, typer.Option("--allow-code", help='Let the case name laws of your own, "module:name", and run their code.')
]
SelfHeatingOption = Annotated[
    bool,
    typer.Option("--self-heating", help="Take the oil as warm as friction makes it in the [surroundings] of the case."),
]
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


def print_answer(sheet: Sheet, document: Callable[[], Any], *, as_json: bool, as_sheet: bool) -> None:
    """Print a sheet as text, or as JSON; or the ``document`` of the answer, which is made only then."""
    from ballscrew.basis.output import json_text
    from ballscrew.basis.output import sheet as sheets
    from ballscrew.faces.sheets import terminal

    if as_sheet:
        typer.echo(json_text.as_json(sheets.document(sheet)))
    elif as_json:
        typer.echo(json_text.as_json(document()))
    else:
        typer.echo(terminal.text(sheet, getattr(sys.stdout, "encoding", None) or ""))


def check_rows(rows: Path | None, row: str | None) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` for a row without a table."""
    if row is not None and rows is None:
        from ballscrew.basis.errors import Fault, InputError

        raise InputError(Fault("--row", "needs a table of screws", row, "add --rows FILE"))


def cases_of_rows(
    case: Path,
    rows: Path,
    row: str | None,
    settings: Sequence[str] | None,
    model: str | None,
    *,
    calibration: str | None,
    allow_code: bool,
    keep_going: bool,
) -> OfRows[RowCase]:
    """The case with each screw of a table, or that of one row, in place of its own."""
    from ballscrew.faces.cli.progress import progress
    from ballscrew.questions.shared import every_row

    with progress("rows read") as done:
        return every_row.cases(
            case,
            rows,
            row,
            settings=settings or [],
            model=model,
            calibration=calibration,
            allow_code=allow_code,
            keep_going=keep_going,
            done=done,
        )


def say_of_rows(notes: Sequence[str], interrupted: bool) -> None:
    """Print what is to be said of rows on the error stream; after Ctrl-C the command ends with its exit code."""
    for note in notes:
        typer.echo(note, err=True)
    if interrupted:
        raise typer.Exit(INTERRUPTED)


def say_engine(attributes: Mapping[str, Any]) -> None:
    """The engine that evaluated, and why it was that one, on the error stream."""
    reason = attributes.get("engine_reason")
    typer.echo(f"evaluated by {attributes['engine']}" + (f": {reason}" if reason else ""), err=True)


#: What logs that something is compiled.
_COMPILER = "ballscrew.compiler.kernels"


@contextlib.contextmanager
def log_on_stderr() -> Generator[None]:
    """Show on the error stream what the package logs; compiling is for :func:`compiling_on_terminal`."""
    with _echo("ballscrew", but=_COMPILER):
        yield


@contextlib.contextmanager
def compiling_on_terminal() -> Generator[None]:
    """Say on a terminal what is compiled, where that takes more than a second; silent where nobody looks."""
    if not sys.stderr.isatty():
        yield
        return
    with _echo(_COMPILER):
        yield


@contextlib.contextmanager
def _echo(of: str, but: str | None = None) -> Generator[None]:
    """Show on the error stream what a logger and those below it say, but for one of these."""
    import logging  # not for those who ask for help only

    class Echo(logging.Handler):
        def emit(self, record: logging.LogRecord) -> None:
            if but is None or not record.name.startswith(but):
                sys.stderr.write(f"{record.getMessage()}\n")  # that of a bar, where there is one: above it

    logger, handler = logging.getLogger(of), Echo()
    before = logger.level
    logger.addHandler(handler)
    logger.setLevel(logging.INFO)
    try:
        yield
    finally:
        logger.setLevel(before)
        logger.removeHandler(handler)

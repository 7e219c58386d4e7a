"""``ballscrew check``: friction, stiffness, life and limits of a screw."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import typer

from ballscrew.faces.cli.common_options import (
    AllowCode,
    AsSheet,
    CalibrationName,
    ModelName,
    Row,
    SelfHeatingOption,
    check_rows,
    print_answer,
    say_of_rows,
)
from ballscrew.faces.cli.flags import flags_of
from ballscrew.questions.check.options import CheckOptions, given

if TYPE_CHECKING:
    from ballscrew.questions.check.compute import Options


@flags_of(CheckOptions)
def check(
    name: Annotated[
        str | None, typer.Argument(metavar="[CASE_OR_ROW]", help="Case file (TOML), or name of a catalogue row.")
    ] = None,
    rows: Annotated[
        Path | None,
        typer.Option(
            "--rows",
            metavar="FILE",
            help="A table of your own, .csv or .xlsx; without a name, all its rows; with a case, each in its place.",
        ),
    ] = None,
    row: Row = None,
    every: Annotated[bool, typer.Option("--all", help="All rows, one line each.")] = False,
    *,
    written: Mapping[str, Any],
    model: ModelName = None,
    calibration: CalibrationName = None,
    settings: Annotated[
        list[str] | None,
        typer.Option(
            "--set", metavar="SECTION.FIELD=VALUE", help='Any other value: --set losses.seals.seal_torque="0.4 N m".'
        ),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object, of many rows a list; SI units.")] = False,
    as_sheet: AsSheet = False,
    to: Annotated[
        Path | None, typer.Option("--to", "-o", metavar="FILE", help="Of many rows: also write them, .csv or .xlsx.")
    ] = None,
    self_heating: SelfHeatingOption = False,
    allow_code: AllowCode = False,
) -> None:
    """Torque, stiffness, life and all checks of one screw. The screw is a row of the catalogue or that of a case file.

    What is not given is assumed, and the output says what was. The exit code is 0 where a check fails, too: the
    verdict says so; it is 2 only for bad input.
    """
    from ballscrew.questions.check.compute import Options, one
    from ballscrew.questions.check.document import document
    from ballscrew.questions.check.sheet import sheet

    options = Options(given(written), settings or [], model, calibration, allow_code, self_heating)
    keep_going: bool = written["keep_going"]
    check_rows(rows, row)
    screws = _asked(name, rows, row, every=every, to=to)
    if screws.name is None or screws.case is not None or screws.are_listed:
        _check_rows(screws, rows, options, keep_going=keep_going, as_json=as_json, as_sheet=as_sheet, to=to)
        return
    screw, notes = one(screws.name, rows, options, keep_going)
    say_of_rows(notes, interrupted=False)
    print_answer(sheet(screw), lambda: document(screw), as_json=as_json, as_sheet=as_sheet)


class _Screws(NamedTuple):
    """The screws that are asked for: one by its name, or rows of a table, perhaps each in a case."""

    #: A case file, or the name of a row; None for all rows.
    name: str | None
    #: The case that the rows stand in.
    case: str | None
    #: The only row of a table that is asked for.
    row: str | None
    #: Whether the answer is a list, also of one.
    are_listed: bool


def _asked(name: str | None, rows: Path | None, row: str | None, *, every: bool, to: Path | None) -> _Screws:
    """The screws by the names on the command line."""
    from ballscrew.basis.errors import Fault, InputError
    from ballscrew.questions.check.compute import is_case

    case = name if name is not None and rows is not None and is_case(name) else None
    if row is not None and case is None:
        if name is not None:
            raise InputError(Fault("--row", "is given beside another name", name, "give one of the two"))
        name = row
    if to is not None and case is None and not every:
        row = name
    of_rows = case is not None and row is None
    return _Screws(name, case, row, every or name is None or to is not None or of_rows)


def _check_rows(
    asked: _Screws,
    rows: Path | None,
    options: Options,
    *,
    keep_going: bool,
    as_json: bool,
    as_sheet: bool,
    to: Path | None,
) -> None:
    """Check rows of a table, print a list of them, or the only one in a case, and write the table asked for."""
    from ballscrew.faces.cli.progress import progress
    from ballscrew.faces.sheets import files
    from ballscrew.questions.check.compute import every_row
    from ballscrew.questions.check.document import document, list_document
    from ballscrew.questions.check.sheet import of_rows, sheet
    from ballscrew.questions.shared import row_tables

    if to is not None:
        row_tables.check_path(to)
    with progress("rows") as done:
        name = asked.case if asked.row else asked.name
        checks = every_row(name, rows, options, keep_going, row=asked.row, done=done)
    screws = list(checks.found.values())
    if asked.are_listed:
        print_answer(of_rows(screws), lambda: list_document(screws), as_json=as_json, as_sheet=as_sheet)
    else:
        print_answer(sheet(screws[0]), lambda: document(screws[0]), as_json=as_json, as_sheet=as_sheet)
    if to is not None:
        files.write(to, of_rows(screws))
        typer.echo(f"{to}: {len(screws)} screws", err=True)
    say_of_rows(checks.notes, checks.interrupted)

"""``ballscrew check``: friction, stiffness, life and limits of a screw."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ballscrew.command_options.common_options import (
    AllowCode,
    CalibrationName,
    ModelName,
    Row,
    SelfHeatingOption,
    check_rows,
    say_of_rows,
)


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
    axial_load: Annotated[
        str | None, typer.Option("--axial-load", metavar="FORCE", help='"5 kN"; a tenth of C_a if left out.')
    ] = None,
    speed: Annotated[
        str | None, typer.Option("--speed", metavar="SPEED", help='"1500 rpm"; 600 rpm if left out.')
    ] = None,
    nut: Annotated[
        str | None, typer.Option("--nut", metavar="TYPE", help="single, oversize-balls, double, offset-lead.")
    ] = None,
    preload: Annotated[
        str | None,
        typer.Option(
            "--preload",
            metavar="FORCE",
            help='"3 kN", or "7 %" of C_a; if left out, that of the row, or 7 % (oversize balls 5 %).',
        ),
    ] = None,
    length: Annotated[
        str | None, typer.Option("--length", metavar="LENGTH", help='Longest stretch without support, "1.2 m".')
    ] = None,
    ends: Annotated[
        str | None,
        typer.Option("--ends", metavar="ENDS", help="fixed-fixed, fixed-supported, supported-supported, fixed-free."),
    ] = None,
    grade: Annotated[
        str | None, typer.Option("--grade", metavar="GRADE", help='Of the oil: "ISO VG 68"; ISO VG 100 if left out.')
    ] = None,
    temperature: Annotated[
        str | None, typer.Option("--temperature", metavar="T", help='Of the oil: "50 degC"; 40 degC if left out.')
    ] = None,
    model: ModelName = None,
    calibration: CalibrationName = None,
    settings: Annotated[
        list[str] | None,
        typer.Option(
            "--set", metavar="SECTION.FIELD=VALUE", help='Any other value: --set losses.seals.seal_torque="0.4 N m".'
        ),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object, of many rows a list; SI units.")] = False,
    keep_going: Annotated[
        bool, typer.Option("--keep-going", help="Leave faulty rows out, and say which; fails if none is good.")
    ] = False,
    to: Annotated[
        Path | None, typer.Option("--to", "-o", metavar="FILE", help="Of many rows: also write them, .csv or .xlsx.")
    ] = None,
    self_heating: SelfHeatingOption = False,
    allow_code: AllowCode = False,
) -> None:
    """From a catalogue row or a case to torque, efficiency, stiffness, life, and all checks.

    What is not given is assumed, and the output says what was. The exit code is 0 where a check fails, too: the
    verdict says so; it is 2 only for bad input.
    """
    from ballscrew.documents.check import document, list_document
    from ballscrew.errors import Fault, InputError
    from ballscrew.output.json_text import as_json as json_of
    from ballscrew.studies.check import Options, every_row, is_case, one
    from ballscrew.text.check import list_text, text

    given = {
        "operation.axial_load": axial_load,
        "operation.screw_speed": speed,
        "nut.type": nut,
        "nut.preload": preload,
        "installation.unsupported_length": length,
        "installation.ends": ends,
        "lubricant.grade": grade,
        "lubricant.temperature": temperature,
    }
    options = Options(
        {key: value for key, value in given.items() if value is not None},
        settings or [],
        model,
        calibration,
        allow_code,
        self_heating,
    )
    check_rows(rows, row)
    case = name if name is not None and rows is not None and is_case(name) else None
    if row is not None and case is None:
        if name is not None:
            raise InputError(Fault("--row", "is given beside another name", name, "give one of the two"))
        name = row
    if to is not None and case is None and not every:
        row = name
    many = every or name is None or to is not None or (case is not None and row is None)
    if not many and name is not None and case is None:
        screw, notes = one(name, rows, options, keep_going)
        say_of_rows(notes, interrupted=False)
        typer.echo(json_of(document(screw)) if as_json else text(screw))
        return
    from ballscrew.command_options.progress import progress
    from ballscrew.table_files import row_tables

    if to is not None:
        row_tables.check_path(to)
    with progress("rows") as done:
        found = every_row(case if row else name, rows, options, keep_going, row=row, done=done)
    screws = list(found.found.values())
    if many:
        typer.echo(json_of(list_document(screws)) if as_json else list_text(screws))
    else:
        typer.echo(json_of(document(screws[0])) if as_json else text(screws[0]))
    if to is not None:
        row_tables.write(to, row_tables.of_checks(screws))
        typer.echo(f"{to}: {len(screws)} screws", err=True)
    say_of_rows(found.notes, found.interrupted)

"""``ballscrew run``: friction at one operating point, with ``--band`` its uncertainty."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ballscrew.faces.cli.common_options import (
    AllowCode,
    AsJson,
    AsSheet,
    CalibrationName,
    CaseFile,
    KeepGoing,
    ModelName,
    Row,
    Rows,
    SelfHeatingOption,
    Settings,
    cases_of_rows,
    check_rows,
    print_answer,
    say_of_rows,
)
from ballscrew.faces.cli.flags import flags_of
from ballscrew.questions.band.options import BandOptions
from ballscrew.questions.shared.options import is_any_given

if TYPE_CHECKING:
    from ballscrew.cases.case_files.case import Case
    from ballscrew.questions.shared.every_row import OfRows, RowCase


@flags_of(BandOptions)
def run(
    case: CaseFile,
    model: ModelName = None,
    calibration: CalibrationName = None,
    settings: Settings = None,
    as_json: AsJson = False,
    as_sheet: AsSheet = False,
    band: Annotated[
        bool,
        typer.Option("--band", help="Band of the results by uncertain inputs and other laws, 95 % of the samples."),
    ] = False,
    *,
    written: Mapping[str, Any],
    to: Annotated[
        Path | None,
        typer.Option(
            "--to", "-o", metavar="FILE", help="With --rows: .csv, .xlsx; with --band: also draw .png, .svg or .pdf."
        ),
    ] = None,
    rows: Rows = None,
    row: Row = None,
    keep_going: KeepGoing = False,
    self_heating: SelfHeatingOption = False,
    allow_code: AllowCode = False,
) -> None:
    """Friction at the operating point of a case file. With --band its uncertainty.

    With --rows the same for each screw of a table, one line each; oil, operating point and model are those of the case.
    """
    check_rows(rows, row)
    _check_self_heating(self_heating, rows)
    has_band = band or is_any_given(BandOptions, written) or (to is not None and rows is None)
    if rows is not None:
        cases = cases_of_rows(
            case, rows, row, settings, model, calibration=calibration, allow_code=allow_code, keep_going=keep_going
        )
        if not has_band:
            _of_rows(cases, as_json=as_json, as_sheet=as_sheet, to=to, keep_going=keep_going)
            return
        loaded = _only(cases)
        say_of_rows(cases.notes, cases.interrupted)
    else:
        from ballscrew.cases.case_files import case_file

        loaded = case_file.load(case, settings or [], model, calibration=calibration, allow_code=allow_code)
    if has_band:
        from ballscrew.faces.cli import band as band_command
        from ballscrew.faces.cli.progress import progress
        from ballscrew.questions.shared.option_values import read

        options = read(BandOptions, written)
        band_command.check(band, options, to, self_heating)
        with progress("band") as done:
            if self_heating:
                band_command.run_warm(loaded, options, done, as_json=as_json, as_sheet=as_sheet)
            else:
                band_command.run(loaded, options, to, done, as_json=as_json, as_sheet=as_sheet)
        return
    from ballscrew.questions.run.answer import document
    from ballscrew.questions.run.compute import run as run_case
    from ballscrew.questions.run.sheet import sheet
    from ballscrew.questions.warm_up.self_heating_document import with_self_heating

    heating = None
    if self_heating:
        from ballscrew.questions.warm_up import self_heating as studies

        heating = studies.self_heating(loaded)
    result = run_case(loaded if heating is None else heating.warm)
    seen = sheet(result, heating=() if heating is None else heating.records)
    print_answer(seen, lambda: with_self_heating(document(result), heating), as_json=as_json, as_sheet=as_sheet)


def _check_self_heating(asked: bool, rows: Path | None) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` where self-heating is asked for beside what does not know
    it.
    """
    from ballscrew.basis.errors import Fault, InputError

    if asked and rows is not None:
        raise InputError(Fault("--self-heating", "is given beside --rows", "", "leave one of them out"))


def _of_rows(cases: OfRows[RowCase], *, as_json: bool, as_sheet: bool, to: Path | None, keep_going: bool) -> None:
    """Results of each row: one line each, and a table in a file."""
    from ballscrew.faces.cli.progress import progress
    from ballscrew.faces.sheets import files
    from ballscrew.questions.run.answer import list_document
    from ballscrew.questions.run.compute import run as run_case
    from ballscrew.questions.run.sheet import of_rows
    from ballscrew.questions.shared import every_row, row_tables

    if to is not None:
        row_tables.check_path(to)
    with progress("rows") as done:
        work = {each.place: each for each in cases.found.values()}
        ran = every_row.each(work, lambda each: run_case(each.case), keep_going=keep_going, done=done)
    runs = {work[place].row.name: run for place, run in ran.found.items()}
    seen = of_rows(runs)
    print_answer(seen, lambda: list_document(runs), as_json=as_json, as_sheet=as_sheet)
    if to is not None:
        files.write(to, seen)
        typer.echo(f"{to}: {len(runs)} screws", err=True)
    say_of_rows([*cases.notes, *ran.notes], ran.interrupted)


def _only(cases: OfRows[RowCase]) -> Case:
    """The case of the one row there is."""
    from ballscrew.basis.errors import Fault, InputError

    if len(cases.found) > 1:
        raise InputError(Fault("--band", "is of one screw", f"{len(cases.found)} rows", "choose one: --row NAME"))
    return next(iter(cases.found.values())).case

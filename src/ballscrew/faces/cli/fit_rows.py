"""``ballscrew fit --rows``: the screws of a table, each fitted to its own log."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from ballscrew.command_options.common_options import cases_of_rows, say_of_rows
from ballscrew.errors import Fault, InputError
from ballscrew.files import check_writable

if TYPE_CHECKING:
    from ballscrew.cases.case import Case
    from ballscrew.studies.every_row import RowCase
    from ballscrew.studies.fit import FitReport
    from ballscrew.studies.fit_log import Options


def fit_rows(
    case: Path,
    rows: Path,
    row: str | None,
    options: Callable[[Case], Options],
    *,
    settings: Sequence[str],
    model: str | None,
    calibration: str | None,
    allow_code: bool,
    keep_going: bool,
    as_json: bool,
    to: Path | None,
) -> None:
    """Fit each row to its log; a folder ``to`` gets the calibrated case of each as soon as it is done."""
    from ballscrew.cases import fitted_case
    from ballscrew.command_options.progress import progress
    from ballscrew.documents import fit as documents
    from ballscrew.output import json_text
    from ballscrew.studies import fit_rows
    from ballscrew.table_files import row_tables
    from ballscrew.text import fit_rows as text

    cases = cases_of_rows(
        case, rows, row, settings, model, calibration=calibration, allow_code=allow_code, keep_going=keep_going
    )
    is_table = to is not None and to.suffix.lower() in row_tables.KINDS and not to.is_dir()
    if to is not None and not is_table and to.suffix and not to.is_dir():
        remedy = "end it in .csv or .xlsx, or give a folder for a calibrated case of each"
        raise InputError(Fault("--to", "unknown kind of file", str(to), remedy))
    if to is not None and is_table:
        row_tables.check_path(to)
    paths = {} if to is None or is_table else fit_rows.files(cases.found, to)
    for path in paths.values():
        if path.resolve() == case.resolve():
            raise InputError(Fault("--to", "would overwrite the case itself", str(path), "choose another folder"))
    for path in list(paths.values())[:1]:
        check_writable("--to", path)
    with progress("logs") as done:
        read = fit_rows.logs(cases.found, rows, options, keep_going=keep_going, done=done)

    def save(of_row: RowCase, report: FitReport) -> None:
        if paths:
            path = paths[of_row.row.name]
            fitted_case.save(path, of_row.tables, case.parent, of_row.case, report.model)

    with progress("fits") as done:
        fitted = fit_rows.fits(cases.found, read.found, options, keep_going=keep_going, each=save, done=done)
    by_place = {each.place: each for each in cases.found.values()}
    reports = {by_place[place].row.name: report for place, report in fitted.found.items()}
    if as_json:
        listed = [
            {"name": name, **documents.document(cases.found[name].case, report)} for name, report in reports.items()
        ]
        typer.echo(json_text.as_json(listed))
    else:
        typer.echo(text.list_text(reports))
    if to is not None and is_table:
        row_tables.write(to, row_tables.of_fits(reports))
    if to is not None:
        typer.echo(f"{to}: {len(reports)} screws", err=True)
    say_of_rows([*cases.notes, *read.notes, *fitted.notes], fitted.interrupted)

"""``ballscrew fit --rows``: the screws of a table, each fitted to its own log."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from ballscrew.basis.atomic_files import check_writable
from ballscrew.basis.errors import Fault, InputError, raise_if_any
from ballscrew.faces.cli.common_options import cases_of_rows, print_answer, say_of_rows
from ballscrew.faces.cli.fit_torques import not_written

if TYPE_CHECKING:
    from ballscrew.cases.case_files.case import Case
    from ballscrew.questions.fit.compute import FitReport
    from ballscrew.questions.fit.options import FitOptions
    from ballscrew.questions.shared.every_row import RowCase


def fit_rows(
    case: Path,
    rows: Path,
    row: str | None,
    written: Mapping[str, Any],
    *,
    settings: Sequence[str],
    model: str | None,
    calibration: str | None,
    allow_code: bool,
    as_json: bool,
    as_sheet: bool,
    to: Path | None,
) -> None:
    """Fit each row to its log; a folder ``to`` gets the calibrated case of each as soon as it is done."""
    from ballscrew.cases.case_files import fitted_case
    from ballscrew.faces.cli.progress import progress
    from ballscrew.faces.sheets import files
    from ballscrew.questions.fit import answer as documents
    from ballscrew.questions.fit import rows as fit_rows
    from ballscrew.questions.fit.log import read_options
    from ballscrew.questions.fit.sheet import of_rows

    keep_going: bool = written["keep_going"]

    def options(of_row: Case) -> FitOptions:
        return read_options(of_row, written)

    cases = cases_of_rows(
        case, rows, row, settings, model, calibration=calibration, allow_code=allow_code, keep_going=keep_going
    )
    table = to if to is not None and _is_table(to) else None
    paths = {} if to is None or table is not None else _paths(to, cases.found, case)
    with progress("logs") as done:
        read = fit_rows.logs(cases.found, rows, options, keep_going=keep_going, done=done)

    left_out: list[Fault] = []

    def save(of_row: RowCase, report: FitReport) -> None:
        if not paths:
            return
        path = paths[of_row.row.name]
        if report.objection and not keep_going:
            left_out.append(not_written(str(path), report))
        else:
            fitted_case.save(path, of_row.tables, case.parent, of_row.case, report.model)

    with progress("fits") as done:
        fitted = fit_rows.fits(cases.found, read.found, options, keep_going=keep_going, each=save, done=done)
    by_place = {each.place: each for each in cases.found.values()}
    reports = {by_place[place].row.name: report for place, report in fitted.found.items()}
    seen = of_rows(reports)

    def listed() -> list[dict[str, Any]]:
        return [
            {"name": name, **documents.document(cases.found[name].case, report)} for name, report in reports.items()
        ]

    print_answer(seen, listed, as_json=as_json, as_sheet=as_sheet)
    if table is not None:
        files.write(table, seen)
    if to is not None:
        typer.echo(f"{to}: {len(reports) - len(left_out)} screws", err=True)
    raise_if_any(left_out)
    say_of_rows([*cases.notes, *read.notes, *fitted.notes], fitted.interrupted)


def _is_table(to: Path) -> bool:
    """Test whether the rows go to a table, or else to a folder. Raises ``InputError`` for a file of another kind."""
    from ballscrew.questions.shared import row_tables

    if to.is_dir() or not to.suffix:
        return False
    if to.suffix.lower() not in row_tables.KINDS:
        remedy = "end it in .csv or .xlsx, or give a folder for a calibrated case of each"
        raise InputError(Fault("--to", "unknown kind of file", str(to), remedy))
    row_tables.check_path(to)
    return True


def _paths(folder: Path, cases: Mapping[str, RowCase], case: Path) -> dict[str, Path]:
    """The calibrated case of each row in a folder, which has to be writable and not to be the case itself."""
    from ballscrew.questions.fit.rows import files

    paths = files(cases, folder)
    for path in paths.values():
        if path.resolve() == case.resolve():
            raise InputError(Fault("--to", "would overwrite the case itself", str(path), "choose another folder"))
    for path in list(paths.values())[:1]:
        check_writable("--to", path)
    return paths

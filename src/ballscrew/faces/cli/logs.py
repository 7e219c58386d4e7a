"""Commands that hold the model against measurements: fit and validate."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ballscrew.faces.cli.cases import cases_of_rows, check_rows
from ballscrew.faces.cli.options import Output, Row, Rows, Verbose, file_option
from ballscrew.faces.cli.progress import print_engine, print_notes_of_rows, progress
from ballscrew.questions.fit import FitMotionOptions, FitOptions
from ballscrew.questions.shared.options import options_of
from ballscrew.questions.shared.question import MODEL_NAMES, CaseOptions

if TYPE_CHECKING:
    from ballscrew.basis.errors import Fault
    from ballscrew.basis.output.sheet import Sheet
    from ballscrew.cases.case_files.case import Case
    from ballscrew.evidence.validation.entries import Entry
    from ballscrew.questions.fit.compute import FitReport
    from ballscrew.questions.shared.every_row import RowCase
    from ballscrew.questions.validate.compute import Request
    from ballscrew.questions.validate.sheet import SummaryRow


def fit(
    case: Annotated[Path, typer.Option("--case", metavar="FILE", help="Case file (TOML) of screw, oil and model.")],
    log: Annotated[
        Path | None,
        typer.Argument(help="Log of load, speed and torque, perhaps temperature and time: .csv, .xlsx, .mat."),
    ] = None,
    *,
    written: Annotated[Mapping[str, Any], FitOptions, FitMotionOptions],
    moving: Annotated[
        bool,
        typer.Option(
            "--moving",
            help="The log is of a moving axis: time, position, force (recognised by its columns if left out).",
        ),
    ] = False,
    test: Annotated[
        Path | None,
        typer.Option("--test", metavar="FILE", help="Another log of the same axis, predicted and not fitted."),
    ] = None,
    case_options: Annotated[
        CaseOptions,
        {
            "settings": "Change a value, or give a prior: --set "
            'model.friction.boundary_friction_coefficient="0.12 ± 0.03".'
        },
    ],
    output: Output,
    to: Annotated[
        Path | None,
        file_option("Write the calibrated model, a case file (.toml); with --rows a table (.csv, .xlsx), or a folder."),
    ] = None,
    picture: Annotated[
        Path | None,
        typer.Option("--picture", metavar="FILE", help="Draw log and model: .png, .svg or .pdf."),
    ] = None,
    rows: Rows = None,
    row: Row = None,
    verbose: Verbose = False,
) -> None:
    """Fit numbers of a model to a log. The output says which of them the log does not determine.

    A log of a moving axis (time, position, and a force, torque, current or control voltage) determines its mass, the
    gravity force, the dead time and the friction, by three models side by side.

    With --rows each screw of a table is fitted by itself, to the file in its column log.

    A distribution that the case gives a number is its prior. Part of the operating points is held out
    to see how well the model predicts, beside two descriptions without physics. The last lines say where to
    measure next. With --self-heating each row of a log of friction torque without temperatures is as warm as its
    own torque makes it in the steady state.
    """
    check_rows(rows, row)
    _check_log(log, rows, picture, self_heating=written["self_heating"])
    if rows is not None:
        _fit_rows(case, rows, row, written, case_options, output, to)
        return
    assert log is not None
    tables = case_options.tables(case)
    loaded = case_options.build(tables, case.parent)

    # pandas is slow to import: only for a good case
    from ballscrew.questions.fit.log import is_moving_log
    from ballscrew.questions.shared.charts import check_picture

    if picture is not None:
        check_picture(picture, "--picture")
    if moving or test is not None or is_moving_log(log, written["columns"] or []):
        _check_unused(written, to)
        sheet, size = _fit_motion(loaded, log, test, written, output)
    else:
        sheet, size = _fit_torques(case, tables, loaded, log, written, output, to, verbose=verbose)
    if picture is not None:
        from ballscrew.faces.sheets import files

        files.write(picture, sheet, option="--picture")
        output.note(f"{picture}: {size} rows")


def _check_log(log: Path | None, rows: Path | None, picture: Path | None, *, self_heating: bool) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` unless there is one log, or a table that names them."""
    from ballscrew.basis.errors import Fault, InputError, raise_if_any

    if log is None and rows is None:
        raise InputError(Fault("fit", "needs a log", "", "give a file, or --rows FILE with a column log"))
    if rows is None:
        return
    others = {"LOG": log, "--picture": picture}
    raise_if_any(
        [
            Fault(name, "does not go with --rows", str(path), "leave it out; the column log names the logs")
            for name, path in others.items()
            if path is not None
        ]
    )
    if self_heating:
        raise InputError(Fault("--self-heating", "is given beside --rows", "", "leave one of them out"))


# -- fit to a log of torques ----------------------------------------------------------------------


def _fit_torques(
    path: Path,
    tables: Mapping[str, Any],
    case: Case,
    log: Path,
    written: Mapping[str, Any],
    output: Output,
    to: Path | None,
    *,
    verbose: bool,
) -> tuple[Sheet, int]:
    """Fit a case to a log of torques, print the fit, and write the calibrated case.

    ``tables`` are those of the case file at ``path``, with the settings of the command line. Returns the sheet, and
    the number of rows of the log.
    """
    from ballscrew.basis.errors import InputError
    from ballscrew.questions.fit.log import read_options, steady_log

    if to is not None:
        _check_case_file(to, path)
    options = read_options(case, written)
    with progress("fit") as done:
        steady = steady_log(case, log, options, done)
        # solvers are slow to import: only for a log that can be fitted to
        from ballscrew.questions.fit import compute
        from ballscrew.questions.fit.answer import document
        from ballscrew.questions.fit.sheet import sheet

        assumed: Sequence[str] = ()
        if options.self_heating:
            from ballscrew.questions.fit.compute import warm_log

            steady, assumed = warm_log(case, steady, options.kind)
        report = dataclasses.replace(compute.fit(case, steady, options), assumed=assumed)
    is_refused = to is not None and report.objection != "" and not options.keep_going
    if to is not None and not is_refused:
        from ballscrew.cases.case_files import fitted_case

        # before anything is printed: whoever reads the output may stop after its first lines
        fitted_case.save(to, tables, path.parent, case, report.model)
    fit_sheet = sheet(case, report)
    if verbose:
        print_engine(report.model.response.evaluation.attributes)
    output.print(fit_sheet, lambda: document(case, report))
    if is_refused:
        raise InputError(_not_written(str(to), report))
    if to is not None:
        output.note(f"{to}: the calibrated model")
    return fit_sheet, len(report.model.rows.log)


def _not_written(to: str, report: FitReport) -> Fault:
    """The fault of a fit that should not be written as a calibrated case."""
    from ballscrew.basis.errors import Fault

    problem = f"is not written: {report.objection}"
    return Fault("--to", problem, to, "see the warnings of the fit, or write it all the same by --keep-going")


def _check_case_file(to: Path, case: Path) -> None:
    """Raise ``InputError`` if no case file can be written there, or if it is the case itself."""
    from ballscrew.basis.atomic_files import check_writable
    from ballscrew.basis.errors import Fault, InputError

    if to.resolve() == case.resolve():
        raise InputError(
            Fault("--to", "is the case itself", str(to), "choose another name: its comments would be lost")
        )
    if to.suffix.lower() != ".toml":
        raise InputError(Fault("--to", "is no case file", str(to), "end it in .toml; a picture is --picture"))
    check_writable("--to", to)


# -- fit to a log of a moving axis ----------------------------------------------------------------


def _fit_motion(
    case: Case, log: Path, test: Path | None, written: Mapping[str, Any], output: Output
) -> tuple[Sheet, int]:
    """Fit a case to a moving log, and print the fit. Returns its sheet, and the number of rows of the log."""
    from ballscrew.questions.fit.log import moving_log
    from ballscrew.questions.shared.option_values import read

    options = read(FitMotionOptions, written)
    read_log = moving_log(case, log, options)
    test_log = None if test is None else moving_log(case, test, options, usual_gain=read_log.gain)
    # solvers are slow to import: only for logs that can be read
    from ballscrew.questions.fit import moving

    if options.steady:
        friction = moving.friction_over_speed(read_log, test_log)
        steady = moving.sheet_over_speed(friction, read_log)
        output.print(steady, lambda: moving.document_over_speed(friction, read_log))
        return steady, sum(one.rows for one in friction.speeds)
    motion = moving.fit(case, read_log, test_log, options)
    fit_sheet = moving.sheet(case, motion)
    output.print(fit_sheet, lambda: moving.document(case, motion))
    return fit_sheet, motion.equation.used.size


def _check_unused(written: Mapping[str, Any], to: Path | None) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` for options of logs of torques alone."""
    from ballscrew.basis.errors import Fault, raise_if_any

    of_motion = options_of(FitMotionOptions)
    others = [option for name, option in options_of(FitOptions).items() if name not in of_motion]
    unused = [option.flag for option in others if option.is_given(written)]
    remedy = "leave it out: the log is of a motion, not of torques at steady speed"
    raise_if_any(
        [
            Fault(flag, "does not go with a moving log", "", remedy)
            for flag in [*unused, *([] if to is None else ["--to"])]
        ]
    )


# -- fit of the screws of a table -----------------------------------------------------------------


def _fit_rows(
    case: Path,
    rows: Path,
    row: str | None,
    written: Mapping[str, Any],
    case_options: CaseOptions,
    output: Output,
    to: Path | None,
) -> None:
    """Fit each row to its log; a folder ``to`` gets the calibrated case of each as soon as it is done."""
    from ballscrew.basis.errors import raise_if_any
    from ballscrew.cases.case_files import fitted_case
    from ballscrew.faces.sheets import files
    from ballscrew.questions.fit import compute
    from ballscrew.questions.fit.answer import document
    from ballscrew.questions.fit.log import logs_of_rows, read_options
    from ballscrew.questions.fit.sheet import of_rows

    keep_going: bool = written["keep_going"]

    def options(row_case: Case) -> FitOptions:
        return read_options(row_case, written)

    cases = cases_of_rows(case, rows, row, case_options, keep_going)
    table = to if to is not None and _is_table(to) else None
    paths = {} if to is None or table is not None else _paths(to, cases.found, case)
    with progress("logs") as done:
        logs = logs_of_rows(cases.found, rows, options, keep_going=keep_going, done=done)

    left_out: list[Fault] = []

    def save(row_case: RowCase, report: FitReport) -> None:
        if not paths:
            return
        path = paths[row_case.row.name]
        if report.objection and not keep_going:
            left_out.append(_not_written(str(path), report))
        else:
            fitted_case.save(path, row_case.tables, case.parent, row_case.case, report.model)

    with progress("fits") as done:
        fitted = compute.fits_of_rows(cases.found, logs.found, options, keep_going=keep_going, each=save, done=done)
    by_place = {each.place: each for each in cases.found.values()}
    reports = {by_place[place].row.name: report for place, report in fitted.found.items()}

    def documents() -> list[dict[str, Any]]:
        return [{"name": name, **document(cases.found[name].case, report)} for name, report in reports.items()]

    rows_sheet = of_rows(reports)
    output.print(rows_sheet, documents)
    if table is not None:
        files.write_tables(table, rows_sheet)
    if to is not None:
        typer.echo(f"{to}: {len(reports) - len(left_out)} screws", err=True)
    raise_if_any(left_out)
    print_notes_of_rows([*cases.notes, *logs.notes, *fitted.notes], fitted.interrupted)


def _is_table(to: Path) -> bool:
    """Test whether the rows go to a table, or else to a folder. Raises ``InputError`` for a file of another kind."""
    from ballscrew.basis.errors import Fault, InputError
    from ballscrew.questions.shared import every_row

    if to.is_dir() or not to.suffix:
        return False
    if to.suffix.lower() not in every_row.KINDS:
        remedy = "end it in .csv or .xlsx, or give a folder for a calibrated case of each"
        raise InputError(Fault("--to", "unknown kind of file", str(to), remedy))
    every_row.check_path(to)
    return True


def _paths(folder: Path, cases: Mapping[str, RowCase], case: Path) -> dict[str, Path]:
    """The calibrated case of each row in a folder, which has to be writable and not to be the case itself."""
    from ballscrew.basis.atomic_files import check_writable
    from ballscrew.basis.errors import Fault, InputError
    from ballscrew.questions.fit.compute import files_of_rows

    paths = files_of_rows(cases, folder)
    for path in paths.values():
        if path.resolve() == case.resolve():
            raise InputError(Fault("--to", "would overwrite the case itself", str(path), "choose another folder"))
    for path in list(paths.values())[:1]:
        check_writable("--to", path)
    return paths


# -- validate -------------------------------------------------------------------------------------


def validate(
    sets: Annotated[
        list[str] | None, typer.Argument(metavar="SET", help="Sets of data: rexroth-double-nut; without one, all.")
    ] = None,
    rows: Annotated[
        Path | None,
        typer.Option("--rows", metavar="FILE", help="A table of your own with the columns of the set, .csv or .xlsx."),
    ] = None,
    card: Annotated[
        list[Path] | None,
        typer.Option("--card", metavar="PATH", help="A torque card, or a folder of them, in place of the sets."),
    ] = None,
    summary: Annotated[
        bool, typer.Option("--summary", help="Drag torques by maker and kind of nut in one table, without their rows.")
    ] = False,
    *,
    output: Annotated[
        Output,
        {
            "as_json": "One JSON list, SI units; of --summary one object.",
            "as_sheet": "What people see as one JSON list, a sheet for each set.",
        },
    ],
    to: Annotated[Path | None, file_option("Also draw the ratios: .png, .svg or .pdf.")] = None,
    report: Annotated[
        Path | None,
        typer.Option("--report", metavar="FILE", help="Also write all of it as one paper: .pdf or .html."),
    ] = None,
    keep_going: Annotated[
        bool, typer.Option("--keep-going", help="Leave faulty rows out, and say which; fails if none is good.")
    ] = False,
    model: Annotated[str, typer.Option("--model", metavar="NAME", help=f"{MODEL_NAMES}.")] = "reference",
    calibration: Annotated[
        str | None,
        typer.Option(
            "--calibration", metavar="NAME", help="Calibration to show beside the model as it is: rexroth-2006."
        ),
    ] = None,
    temperature: Annotated[
        str | None,
        typer.Option("--temperature", metavar="VALUE", help='Temperature of the oil where a row has none: "25 degC".'),
    ] = None,
    grade: Annotated[
        str | None, typer.Option("--grade", metavar="NAME", help='Grade of the oil where a row has none: "ISO VG 100".')
    ] = None,
    speed: Annotated[
        str | None, typer.Option("--speed", metavar="VALUE", help='Screw speed where a row has none: "100 rpm".')
    ] = None,
) -> None:
    """The model against what vendors and laboratories state.

    For each set the ratio model / stated (the middle of the vendor's band), its scatter, the share of rows inside the
    band, and every row; first the model as it is, then with a named calibration. Beside them rules of one line that
    people use in place of a model.
    """
    from ballscrew.basis.output import json_text
    from ballscrew.basis.output.sheet import document
    from ballscrew.faces.sheets import terminal
    from ballscrew.questions.shared import charts
    from ballscrew.questions.validate import compute
    from ballscrew.questions.validate import sheet as sheets
    from ballscrew.questions.validate.answer import documents

    request = compute.request(
        sets or [],
        model=model,
        calibration_name=calibration,
        rows=rows,
        keep_going=keep_going,
        grade=grade,
        temperature=temperature,
        speed=speed,
        cards=card or [],
        summary=summary,
        to=to,
        report=report,
    )
    if to is not None:
        charts.check_picture(to)
    if report is not None:
        from ballscrew.faces.report.pdf import check_kind

        check_kind("--report", report)
    print_notes_of_rows(request.notes)
    sets_of_entries: list[Sequence[Entry]] = []
    shown: list[Sheet] = []

    def show(sheet: Sheet) -> None:
        if not output.is_data:
            typer.echo(("\n" if shown else "") + terminal.text(sheet))
        shown.append(sheet)

    for entries, notes in compute.evaluate(request) if not summary else ():
        sets_of_entries.append(entries)
        print_notes_of_rows(notes)
        show(sheets.sheet(entries, request))
    makers: list[SummaryRow] = []
    if summary or (request.everything and not output.as_json):
        makers, notes = sheets.summary(request, sets_of_entries)
        print_notes_of_rows(notes)
        show(sheets.of_makers(makers))
    if output.as_sheet:
        typer.echo(json_text.as_json([document(sheet) for sheet in shown]))
    elif output.as_json and summary:
        typer.echo(json_text.as_json(sheets.document(makers)))
    elif output.as_json:
        typer.echo(json_text.as_json(documents([entry for entries in sets_of_entries for entry in entries])))
    if report is not None:
        output.note(f"{report}: report, {_write_paper(request, sets_of_entries, report) // 1000} kB")
    if to is not None:
        from ballscrew.faces.sheets import pictures  # matplotlib is slow to import

        charts.draw(lambda: pictures.picture(sheets.picture(sets_of_entries, request)), to)
        output.note(f"{to}: {len(sets_of_entries)} sets")


def _write_paper(request: Request, entries: Sequence[Sequence[Entry]], path: Path) -> int:
    """Write all of a validation as one paper, and return its size in bytes."""
    from ballscrew.faces.report.pdf import written
    from ballscrew.faces.report.validation import report
    from ballscrew.questions.validate.sheet import summary

    return written("--report", path, report(request, entries, summary(request, entries)[0]))

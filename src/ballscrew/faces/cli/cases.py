"""Commands on a case and on the rows of a table in its place: run, check and sweep."""

from __future__ import annotations

import contextlib
import functools
import sys
from collections.abc import Generator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NamedTuple

import typer

from ballscrew.faces.cli.options import CaseArgument, KeepGoing, Output, Row, Rows, SelfHeating, Verbose, file_option
from ballscrew.faces.cli.progress import log_on_stderr, print_engine, print_notes_of_rows, progress
from ballscrew.questions.band import BandOptions
from ballscrew.questions.check import CheckOptions, given
from ballscrew.questions.shared.question import Answer, CaseOptions, Done
from ballscrew.questions.sweep import SweepOptions

if TYPE_CHECKING:
    from ballscrew.cases.case_files.case import Case
    from ballscrew.questions.shared.every_row import OfRows, RowCase


def check_rows(rows: Path | None, row: str | None) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` for a row without a table."""
    if row is not None and rows is None:
        from ballscrew.basis.errors import Fault, InputError

        raise InputError(Fault("--row", "needs a table of screws", row, "add --rows FILE"))


def cases_of_rows(
    case: Path, rows: Path, row: str | None, case_options: CaseOptions, keep_going: bool
) -> OfRows[RowCase]:
    """The case with each screw of a table, or that of one row, in place of its own."""
    from ballscrew.questions.shared import every_row

    with progress("rows read") as done:
        return every_row.cases(case, rows, row, **vars(case_options), keep_going=keep_going, done=done)


def _print_rows(answer: Answer, output: Output, to: Path | None) -> None:
    """Print the answer for rows and write its table; the line on it is on the error stream, whatever is printed."""
    from ballscrew.faces.sheets import files

    output.print(answer.sheet, answer.document)
    if to is not None:
        files.write_tables(to, answer.sheet)
        typer.echo(f"{to}: {answer.size}", err=True)


# -- run ------------------------------------------------------------------------------------------


def run(
    case: CaseArgument,
    case_options: CaseOptions,
    output: Output,
    band: Annotated[
        bool,
        typer.Option("--band", help="Band of the results by uncertain inputs and other laws, 95 % of the samples."),
    ] = False,
    *,
    options: BandOptions,
    to: Annotated[
        Path | None, file_option("With --rows: .csv, .xlsx; with --band: also draw .png, .svg or .pdf.")
    ] = None,
    rows: Rows = None,
    row: Row = None,
    keep_going: KeepGoing = False,
    self_heating: SelfHeating = False,
) -> None:
    """Friction at the operating point of a case file. With --band its uncertainty.

    With --rows the same for each screw of a table, one line each; oil, operating point and model are those of the case.
    """
    from ballscrew.basis.errors import Fault, InputError

    check_rows(rows, row)
    if self_heating and rows is not None:
        raise InputError(Fault("--self-heating", "is given beside --rows", "", "leave one of them out"))
    has_band = band or options != BandOptions() or (to is not None and rows is None)
    if rows is None:
        loaded = case_options.load(case)
    else:
        cases = cases_of_rows(case, rows, row, case_options, keep_going)
        if not has_band:
            _run_rows(cases, output, to, keep_going=keep_going)
            return
        if len(cases.found) > 1:
            raise InputError(Fault("--band", "is of one screw", f"{len(cases.found)} rows", "choose one: --row NAME"))
        (loaded,) = (each.case for each in cases.found.values())
        print_notes_of_rows(cases.notes, cases.interrupted)
    if has_band:
        _check_band(band, options, to, self_heating)
        with progress("band") as done:
            if self_heating:
                answer = _warm_band(loaded, options, done)
            else:
                answer = _band(loaded, options, done, has_picture=to is not None)
    else:
        answer = _operating_point(loaded, self_heating)
    output.print_and_write(answer, {} if to is None else {to: ""})


def _operating_point(case: Case, self_heating: bool) -> Answer:
    from ballscrew.questions.run.answer import document
    from ballscrew.questions.run.compute import run
    from ballscrew.questions.run.sheet import sheet

    if not self_heating:
        result = run(case)
        return Answer(sheet(result), lambda: document(result))
    from ballscrew.questions.warm_up import self_heating as studies

    heating = studies.self_heating(case)
    warm = run(heating.warm)
    return Answer(sheet(warm, heating=heating.records), lambda: heating.within(document(warm)))


def _run_rows(cases: OfRows[RowCase], output: Output, to: Path | None, *, keep_going: bool) -> None:
    """Run each row: one line each, and a table in a file."""
    from ballscrew.questions.run.answer import list_document
    from ballscrew.questions.run.compute import run
    from ballscrew.questions.run.sheet import of_rows
    from ballscrew.questions.shared import every_row

    if to is not None:
        every_row.check_path(to)
    work = {each.place: each for each in cases.found.values()}
    with progress("rows") as done:
        results = every_row.each(work, lambda each: run(each.case), keep_going=keep_going, done=done)
    runs = {work[place].row.name: result for place, result in results.found.items()}
    _print_rows(Answer(of_rows(runs), lambda: list_document(runs), f"{len(runs)} screws"), output, to)
    print_notes_of_rows([*cases.notes, *results.notes], results.interrupted)


def _check_band(is_named: bool, options: BandOptions, to: Path | None, self_heating: bool) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` for options without a band, and a picture that cannot be."""
    from ballscrew.basis.errors import Fault, InputError, raise_if_any
    from ballscrew.questions.shared.charts import check_picture
    from ballscrew.questions.shared.option_values import without_band

    values = {
        "--samples": options.samples,
        "--level": options.level,
        "--only-given": options.only_given or None,
        "--to": to,
    }
    if not is_named:
        raise_if_any(without_band(values))
    if to is not None and self_heating:
        problem = "draws a curve over the speed, at each of which the oil has another temperature"
        raise InputError(Fault("--to", problem, str(to), "leave it out, or see ballscrew sweep --self-heating"))
    if to is not None:
        check_picture(to)


def _band(case: Case, options: BandOptions, done: Done, *, has_picture: bool) -> Answer:
    """The band of a case."""
    from ballscrew.questions.band import compute
    from ballscrew.questions.band.answer import document
    from ballscrew.questions.band.sheet import sheet, tornado
    from ballscrew.questions.run.compute import run

    report = compute.band(case, options, done)
    curve, swings = None, None
    if has_picture:
        curve, swings = compute.curve(case, report, options, done), tornado(case, report)
    size = f"{report.band.count} samples of {len(report.inputs)} uncertain inputs"
    return Answer(sheet(case, report, curve, swings), lambda: document(run(case), report), size)


def _warm_band(case: Case, options: BandOptions, done: Done) -> Answer:
    """The band of a case as warm as it makes itself: temperature and preload by samples of its surroundings."""
    from ballscrew.questions.band import compute
    from ballscrew.questions.band.answer import document
    from ballscrew.questions.band.compute import heat_samples
    from ballscrew.questions.band.sheet import sheet
    from ballscrew.questions.run.compute import run
    from ballscrew.questions.warm_up.self_heating import self_heating

    heating = self_heating(case)
    report = compute.band(heating.warm, options, done, heat_samples(heating, only_given=options.only_given))
    return Answer(
        sheet(heating.warm, report, heating=heating.records),
        lambda: heating.within(document(run(heating.warm), report)),
    )


# -- check ----------------------------------------------------------------------------------------


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
    options: CheckOptions,
    case_options: Annotated[CaseOptions, {"settings": 'Any other value: --set losses.seals.seal_torque="0.4 N m".'}],
    output: Annotated[Output, {"as_json": "One JSON object, of many rows a list; SI units."}],
    to: Annotated[Path | None, file_option("Of many rows: also write them, .csv or .xlsx.")] = None,
    self_heating: SelfHeating = False,
) -> None:
    """Torque, stiffness, life and all checks of one screw. The screw is a row of the catalogue or that of a case file.

    What is not given is assumed, and the output says what was. The exit code is 0 where a check fails, too: the
    verdict says so; it is 2 only for bad input.
    """
    from ballscrew.questions.check.answer import Options, document, every_row, list_document, one
    from ballscrew.questions.check.sheet import of_rows, sheet
    from ballscrew.questions.shared.every_row import check_path

    values = Options(given(vars(options)), **vars(case_options), self_heating=self_heating)
    check_rows(rows, row)
    screws = _screws(name, rows, row, every=every, to=to)
    if screws.name is not None and screws.case is None and not screws.are_listed:
        screw, notes = one(screws.name, rows, values, options.keep_going)
        print_notes_of_rows(notes, interrupted=False)
        output.print(sheet(screw), lambda: document(screw))
        return
    if to is not None:
        check_path(to)
    with progress("rows") as done:
        chosen = screws.case if screws.row else screws.name
        results = every_row(chosen, rows, values, options.keep_going, row=screws.row, done=done)
    checks = list(results.found.values())
    if screws.are_listed:
        answer = Answer(of_rows(checks), lambda: list_document(checks), f"{len(checks)} screws")
    else:
        answer = Answer(sheet(checks[0]), lambda: document(checks[0]))
    _print_rows(answer, output, to)
    print_notes_of_rows(results.notes, results.interrupted)


class _Screws(NamedTuple):
    """The screws to check: one by its name, or rows of a table, perhaps each in a case."""

    #: A case file, or the name of a row; None for all rows.
    name: str | None
    #: The case that the rows stand in.
    case: str | None
    #: The only row of a table to check.
    row: str | None
    #: Whether the answer is a list, also of one.
    are_listed: bool


def _screws(name: str | None, rows: Path | None, row: str | None, *, every: bool, to: Path | None) -> _Screws:
    """The screws by the names on the command line."""
    from ballscrew.basis.errors import Fault, InputError
    from ballscrew.questions.check.answer import is_case

    case = name if name is not None and rows is not None and is_case(name) else None
    if row is not None and case is None:
        if name is not None:
            raise InputError(Fault("--row", "is given beside another name", name, "give one of the two"))
        name = row
    if to is not None and case is None and not every:
        row = name
    has_all_rows = case is not None and row is None
    return _Screws(name, case, row, every or name is None or to is not None or has_all_rows)


# -- sweep ----------------------------------------------------------------------------------------


def sweep(
    case: CaseArgument,
    *,
    options: SweepOptions,
    to: Annotated[
        Path | None,
        file_option("Write .csv, .xlsx or .nc, or a folder .zarr of any size; without it, CSV on the terminal."),
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option(
            "--scheduler",
            metavar="ADDRESS",
            help="Fill a .zarr by the workers of a Dask scheduler that you trust: it runs code.",
        ),
    ] = None,
    verify: Annotated[
        bool,
        typer.Option("--verify", help="Compare all checksums of a .zarr that is there; compute damaged blocks again."),
    ] = False,
    trust: Annotated[
        bool, typer.Option("--trust", help="Write into a .zarr that belongs to another user, who can change it.")
    ] = False,
    output: Output,
    case_options: CaseOptions,
    rows: Rows = None,
    row: Row = None,
    keep_going: KeepGoing = False,
    self_heating: SelfHeating = False,
    verbose: Verbose = False,
) -> None:
    """Friction over ranges of load, speed or anything else.

    With --rows for each screw of a table: one dataset with a dimension screw, in CSV and XLSX a first column.

    Without --vary, the axes come from the [sweep] table of the case file, or else are ten loads and
    ten speeds up to those of the case. One output over two axes comes as a table, load down and
    speed across, ready to paste; otherwise one row a point. A .zarr is filled block by block: after an
    interruption the same command continues where it was; blocks whose files are damaged are computed again.
    With --self-heating each point has the temperature and the preload of its own steady state.
    With --band each output has the ends of its band beside it: at each point those of ballscrew run --band there.
    """
    from ballscrew.faces.sheets.terminal import line_text
    from ballscrew.questions.sweep import answer, compute, sheet, table

    check_rows(rows, row)
    _check_combination(options, output, rows, row, scheduler, self_heating=self_heating)
    if rows is None:
        loaded = case_options.load(case)
    else:
        cases = cases_of_rows(case, rows, row, case_options, keep_going)
        if row is None:
            compute.check_store_options(to, verify=verify, trust=trust)
            with compute.workers(scheduler, to):
                _sweep_rows(cases, options, to, keep_going=keep_going, verbose=verbose)
            return
        print_notes_of_rows(cases.notes, cases.interrupted)
        (loaded,) = (each.case for each in cases.found.values())
    plan = compute.plan(loaded, options.vary, options.outputs, to, heats=self_heating, banded=options.is_banded)
    is_text = to.suffix.lower() == ".csv" if to is not None else not (output.as_json or output.as_sheet)
    plan = compute.with_flooded_torque(loaded, plan, as_table=is_text)
    compute.check_store_options(to, verify=verify, trust=trust)
    with _report_stop(), compute.workers(scheduler, to) as cluster, progress("sweep") as done, log_on_stderr():
        dataset = compute.sweep(loaded, plan, done, to, cluster, verify=verify, trust=trust)
        if options.is_banded:
            from ballscrew.questions.sweep.band import INNER, with_band  # only where there is a band

            inner = INNER if output.as_json and to is None else ()  # files have the ends of one interval
            dataset = with_band(loaded, plan, dataset, options.of_bands, done, recorded=to is not None, inner=inner)
    if verbose:
        print_engine(dataset.attrs)
    if output.is_data:
        document = functools.partial(answer.document, loaded, plan, dataset)
        output.print(sheet.sheet(loaded, plan, dataset, to), document)
    elif to is None:
        table.write_csv(sys.stdout, dataset, plan)
    if to is not None:
        if not compute.is_store(to):
            table.write(dataset, plan, to)
        output.note(f"{to}: {sheet.size(dataset, plan)}, model {loaded.model.label}")
    for line in [*sheet.assumed(dataset), *sheet.warnings(loaded, plan, dataset, to)]:
        typer.echo(line_text(line), err=True)


def _check_combination(
    options: SweepOptions,
    output: Output,
    rows: Path | None,
    row: str | None,
    scheduler: str | None,
    *,
    self_heating: bool,
) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` for options that do not go together."""
    from ballscrew.basis.errors import Fault, raise_if_any

    others = {"--rows": rows, "--scheduler": scheduler}
    raise_if_any(
        [
            Fault("--self-heating", f"is given beside {name}", str(value), "leave one of them out")
            for name, value in others.items()
            if self_heating and value is not None
        ]
    )
    faults: list[Fault] = []
    for option, is_given in {"--band": options.is_banded, "--json": output.as_json, "--sheet": output.as_sheet}.items():
        if is_given and rows is not None and row is None:
            faults.append(Fault(option, "is of one screw", str(rows), "choose one: --row NAME"))
    if options.is_banded and self_heating:
        remedy = "leave one of them out, or see ballscrew run --band --self-heating"
        faults.append(Fault("--band", "is given beside --self-heating", "", remedy))
    raise_if_any(faults)


def _sweep_rows(
    cases: OfRows[RowCase], options: SweepOptions, to: Path | None, *, keep_going: bool, verbose: bool
) -> None:
    """Sweep all rows into one dataset."""
    from ballscrew.faces.sheets.terminal import line_text
    from ballscrew.questions.sweep import table
    from ballscrew.questions.sweep.sheet import size, warnings

    planned = table.plans(cases.found, options.vary, options.outputs, to, keep_going)
    with progress("sweep") as done:
        dataset, swept = table.sweep(planned.found, to, keep_going=keep_going, done=done)
    plan = table.plan_of(planned.found)
    if to is None:
        table.write_csv(sys.stdout, dataset, plan)
    else:
        table.write(dataset, plan, to)
        typer.echo(f"{to}: {size(dataset, plan)}, {dataset.sizes[table.SCREW]} screws")
    for place, swept_row in swept.found.items():
        if verbose:
            print_engine(swept_row.attrs)
        row_case, row_plan = planned.found[place]
        for line in warnings(row_case.case, row_plan, swept_row, to):
            typer.echo(f"{row_case.row.name}: {line_text(line)}", err=True)
    print_notes_of_rows([*cases.notes, *planned.notes, *swept.notes], swept.interrupted)


@contextlib.contextmanager
def _report_stop() -> Generator[None]:
    """Print how far a sweep into a store came that stopped, and that it resumes from there."""
    try:
        yield
    except OSError as error:
        from ballscrew.engine.sweeps.store import UnfinishedSweepError

        if not isinstance(error, UnfinishedSweepError):
            raise
        typer.echo(str(error), err=True)
        raise typer.Exit(1) from None

"""``ballscrew sweep``: friction over ranges of inputs."""

from __future__ import annotations

import contextlib
import functools
import sys
from collections.abc import Generator, Mapping, Sequence
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
    Verbose,
    cases_of_rows,
    check_rows,
    log_on_stderr,
    print_answer,
    say_engine,
    say_of_rows,
)
from ballscrew.faces.cli.flags import flags_of
from ballscrew.questions.sweep.options import SweepOptions

if TYPE_CHECKING:
    from ballscrew.questions.shared.every_row import OfRows, RowCase


@flags_of(SweepOptions)
def sweep(
    case: CaseFile,
    *,
    written: Mapping[str, Any],
    to: Annotated[
        Path | None,
        typer.Option(
            "--to",
            "-o",
            metavar="FILE",
            help="Write .csv, .xlsx or .nc, or a folder .zarr of any size; without it, CSV on the terminal.",
        ),
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
    as_json: AsJson = False,
    as_sheet: AsSheet = False,
    model: ModelName = None,
    calibration: CalibrationName = None,
    settings: Settings = None,
    rows: Rows = None,
    row: Row = None,
    keep_going: KeepGoing = False,
    self_heating: SelfHeatingOption = False,
    allow_code: AllowCode = False,
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
    from ballscrew.cases.case_files import case_file
    from ballscrew.faces.cli.progress import progress
    from ballscrew.faces.sheets.terminal import line_text
    from ballscrew.questions.shared.option_values import read
    from ballscrew.questions.sweep import compute as studies
    from ballscrew.questions.sweep import sheet as sheets
    from ballscrew.questions.sweep import table as sweep_files

    check_rows(rows, row)
    options = read(SweepOptions, written)
    banded = options.is_banded
    _check_self_heating(self_heating, rows, scheduler)
    options_of_one = {"--band": banded, "--json": as_json, "--sheet": as_sheet}
    _check_beside(options_of_one, rows if row is None else None, self_heating)
    if rows is None:
        loaded = case_file.load(case, settings or [], model, calibration=calibration, allow_code=allow_code)
    else:
        cases = cases_of_rows(
            case, rows, row, settings, model, calibration=calibration, allow_code=allow_code, keep_going=keep_going
        )
        if row is None:
            studies.check_store_options(to, verify=verify, trust=trust)
            with studies.workers(scheduler, to):
                _of_rows(cases, options.vary, options.outputs, to, keep_going=keep_going, verbose=verbose)
            return
        say_of_rows(cases.notes, cases.interrupted)
        (loaded,) = (each.case for each in cases.found.values())
    plan = studies.plan(loaded, options.vary, options.outputs, to, heats=self_heating, banded=banded)
    is_text = to.suffix.lower() == ".csv" if to is not None else not (as_json or as_sheet)
    plan = studies.with_flooded_torque(loaded, plan, as_table=is_text)
    studies.check_store_options(to, verify=verify, trust=trust)
    with _report_stop(), studies.workers(scheduler, to) as cluster, progress("sweep") as done, log_on_stderr():
        dataset = studies.sweep(loaded, plan, done, to, cluster, verify=verify, trust=trust)
        if banded:
            from ballscrew.questions.sweep.band import INNER, with_band  # for those only who ask

            inner = INNER if as_json and to is None else ()  # files have the ends of one interval
            dataset = with_band(loaded, plan, dataset, options.of_bands, done, recorded=to is not None, inner=inner)
    if verbose:
        say_engine(dataset.attrs)
    if as_json or as_sheet:
        from ballscrew.questions.sweep import answer as documents

        seen = sheets.sheet(loaded, plan, dataset, to)
        document = functools.partial(documents.document, loaded, plan, dataset)
        print_answer(seen, document, as_json=as_json, as_sheet=as_sheet)
    elif to is None:
        sweep_files.write_csv(sys.stdout, dataset, plan)
    if to is not None:
        if not studies.is_store(to):
            sweep_files.write(dataset, plan, to)
        typer.echo(f"{to}: {sheets.size(dataset, plan)}, model {loaded.model.label}", err=as_json or as_sheet)
    for line in [*sheets.assumed(dataset), *sheets.warnings(loaded, plan, dataset, to)]:
        typer.echo(line_text(line), err=True)


def _check_self_heating(asked: bool, rows: Path | None, scheduler: str | None) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` where self-heating is asked for beside what does not know
    it.
    """
    from ballscrew.basis.errors import Fault, raise_if_any
    from ballscrew.basis.records import Message

    beside = {"--rows": rows, "--scheduler": scheduler}
    raise_if_any(
        [
            Fault(
                "--self-heating", Message("is given beside {name}", {"name": name}), str(value), "leave one of them out"
            )
            for name, value in beside.items()
            if asked and value is not None
        ]
    )


def _check_beside(asked: Mapping[str, bool], rows: Path | None, self_heating: bool) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` for a band and a document beside what does not know them."""
    from ballscrew.basis.errors import Fault, raise_if_any

    faults: list[Fault] = []
    for option, is_asked in asked.items():
        if is_asked and rows is not None:
            faults.append(Fault(option, "is of one screw", str(rows), "choose one: --row NAME"))
    if asked["--band"] and self_heating:
        remedy = "leave one of them out, or see ballscrew run --band --self-heating"
        faults.append(Fault("--band", "is given beside --self-heating", "", remedy))
    raise_if_any(faults)


def _of_rows(
    cases: OfRows[RowCase],
    vary: Sequence[str],
    wanted: Sequence[str],
    to: Path | None,
    *,
    keep_going: bool,
    verbose: bool,
) -> None:
    """The sweeps of all rows as one dataset."""
    from ballscrew.faces.cli.progress import progress
    from ballscrew.faces.sheets.terminal import line_text
    from ballscrew.questions.sweep import rows as sweep_rows
    from ballscrew.questions.sweep import table as sweep_files
    from ballscrew.questions.sweep.sheet import size, warnings

    planned = sweep_rows.plans(cases.found, vary, wanted, to, keep_going)
    with progress("sweep") as done:
        dataset, swept = sweep_rows.sweep(planned.found, to, keep_going=keep_going, done=done)
    plan = sweep_rows.plan_of(planned.found)
    if to is None:
        sweep_files.write_csv(sys.stdout, dataset, plan)
    else:
        sweep_files.write(dataset, plan, to)
        typer.echo(f"{to}: {size(dataset, plan)}, {dataset.sizes[sweep_rows.SCREW]} screws")
    for place, own in swept.found.items():
        if verbose:
            say_engine(own.attrs)
        row_case, of_row = planned.found[place]
        for line in warnings(row_case.case, of_row, own, to):
            typer.echo(f"{row_case.row.name}: {line_text(line)}", err=True)
    say_of_rows([*cases.notes, *planned.notes, *swept.notes], swept.interrupted)


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

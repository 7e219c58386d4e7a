"""``ballscrew fit`` on a log of torques."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from ballscrew.basis.atomic_files import check_writable
from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.records import Message
from ballscrew.cases.case_files.case import Case
from ballscrew.faces.cli.common_options import print_answer, say_engine
from ballscrew.faces.cli.progress import progress
from ballscrew.questions.fit.log import read_options, steady_log

if TYPE_CHECKING:
    from ballscrew.questions.fit.compute import FitReport


@dataclasses.dataclass(frozen=True)
class Shown:
    """How a fit is shown, and the files that are written of it."""

    as_json: bool
    as_sheet: bool
    to: Path | None
    picture: Path | None
    verbose: bool


def fit_torques(
    path: Path, tables: Mapping[str, Any], case: Case, log: Path, written: Mapping[str, Any], shown: Shown
) -> None:
    """Fit a case to a log of torques, print what is found, and write the files asked for.

    ``tables`` are those of the case file at ``path``, with the settings of the command line.
    """
    if shown.to is not None:
        _check_to(shown.to, path)
    options = read_options(case, written)
    with progress("fit") as done:
        steady = steady_log(case, log, options, done)
        # solvers are slow to import: only for a log that can be fitted to
        from ballscrew.faces.sheets import to_file
        from ballscrew.questions.fit import answer as documents
        from ballscrew.questions.fit import compute
        from ballscrew.questions.fit.sheet import sheet

        assumed: Sequence[str] = ()
        if options.self_heating:
            from ballscrew.questions.fit.warm_log import warm_log

            steady, assumed = warm_log(case, steady, options.kind)
        report = dataclasses.replace(compute.fit(case, steady, options), assumed=assumed)
    if shown.to is not None and (report.objection == "" or options.keep_going):
        from ballscrew.cases.case_files import fitted_case

        # before anything is printed: whoever reads the output may stop after its first lines
        fitted_case.save(shown.to, tables, path.parent, case, report.model)
    seen = sheet(case, report)
    if shown.verbose:
        say_engine(report.model.response.evaluation.attributes)
    document = functools.partial(documents.document, case, report)
    print_answer(seen, document, as_json=shown.as_json, as_sheet=shown.as_sheet)
    if shown.to is not None and report.objection and not options.keep_going:
        raise InputError(not_written(str(shown.to), report))
    is_data = shown.as_json or shown.as_sheet
    if shown.to is not None:
        typer.echo(f"{shown.to}: the calibrated model", err=is_data)
    if shown.picture is not None:
        to_file.write(shown.picture, seen, option="--picture")
        typer.echo(f"{shown.picture}: {len(report.model.rows.log)} rows", err=is_data)


def not_written(to: str, report: FitReport) -> Fault:
    """The fault of a fit that should not be written as a calibrated case."""
    problem = Message("is not written: {reason}", {"reason": report.objection})
    return Fault("--to", problem, to, "see the warnings of the fit, or write it all the same by --keep-going")


def _check_to(to: Path, case: Path) -> None:
    """Raise ``InputError`` if no case file can be written there, or if it is the case itself."""
    if to.resolve() == case.resolve():
        raise InputError(
            Fault("--to", "is the case itself", str(to), "choose another name: its comments would be lost")
        )
    if to.suffix.lower() != ".toml":
        raise InputError(Fault("--to", "is no case file", str(to), "end it in .toml; a picture is --picture"))
    check_writable("--to", to)

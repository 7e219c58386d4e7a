"""``ballscrew duty``: what a cycle of an axis asks of the motor."""

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
    ModelName,
    print_answer,
)
from ballscrew.faces.cli.flags import flags_of
from ballscrew.questions.duty.options import DutyOptions

if TYPE_CHECKING:
    from ballscrew.questions.duty.band import DutyBandReport
    from ballscrew.questions.duty.compute import DutyReport


@flags_of(DutyOptions)
def duty(
    case: CaseFile,
    model: ModelName = None,
    calibration: CalibrationName = None,
    settings: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="SECTION.FIELD=VALUE", help='Change a value: --set axis.mass="500 kg".'),
    ] = None,
    as_json: AsJson = False,
    as_sheet: AsSheet = False,
    to: Annotated[
        list[Path] | None,
        typer.Option(
            "--to",
            "-o",
            metavar="FILE",
            help="Also write tables (.xlsx, .csv) or a picture (.pdf, .png, .svg); may be repeated.",
        ),
    ] = None,
    trace: Annotated[
        Path | None,
        typer.Option(
            "--trace", metavar="FILE", help="A recorded motion in place of [motion]: time, position or speed, force."
        ),
    ] = None,
    *,
    written: Mapping[str, Any],
    allow_code: AllowCode = False,
) -> None:
    """Motor torque, energy, brake and life over a cycle.

    The case has an [axis] and a [motion], and perhaps a [motor]; it needs no [operation]. The rule of catalogues
    stands beside the numbers; [model] name = "constant-efficiency" asks for it.
    """
    from ballscrew.cases.case_files import case_file
    from ballscrew.faces.sheets import to_file
    from ballscrew.questions.duty import answer as documents
    from ballscrew.questions.duty import compute
    from ballscrew.questions.duty.sheet import sheet
    from ballscrew.questions.shared.option_values import read

    tables = case_file.override(case_file.read(case), settings or [])
    if trace is not None:
        tables["motion"] = {"kind": "trajectory", "file": str(trace.absolute())}
    loaded = case_file.build(tables, model, case.parent, calibration=calibration, allow_code=allow_code, moves=True)
    to_file.check(to or [])
    report = compute.duty(loaded)
    options = read(DutyOptions, written)
    bands = _banded(report, options) if options.is_banded else None
    seen = sheet(report, bands)
    print_answer(
        seen,
        lambda: documents.document(report) if bands is None else documents.with_band(bands),
        as_json=as_json,
        as_sheet=as_sheet,
    )
    for path in to or []:
        to_file.write(path, seen)
        typer.echo(f"{path}: {len(report.duty.states.time)} states", err=as_json or as_sheet)


def _banded(report: DutyReport, options: DutyOptions) -> DutyBandReport:
    from ballscrew.faces.cli.progress import progress
    from ballscrew.questions.duty import band as duty_band  # loads xarray

    with progress("band") as done:
        return duty_band.band(report, options.samples, only_given=options.only_given, done=done)

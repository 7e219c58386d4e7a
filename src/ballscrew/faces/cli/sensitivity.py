"""``ballscrew sensitivity``: which input to find out next."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

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
from ballscrew.questions.sensitivity.options import SensitivityOptions


@flags_of(SensitivityOptions)
def sensitivity(
    case: CaseFile,
    *,
    written: Mapping[str, Any],
    model: ModelName = None,
    calibration: CalibrationName = None,
    settings: Annotated[
        list[str] | None,
        typer.Option(
            "--set", metavar="SECTION.FIELD=VALUE", help='Change a value: --set screw.lead="10 mm ± 0.02 mm".'
        ),
    ] = None,
    as_json: AsJson = False,
    as_sheet: AsSheet = False,
    to: Annotated[
        Path | None,
        typer.Option(
            "--to", "-o", metavar="FILE", help="Also write tables (.xlsx, .csv) or a picture (.pdf, .png, .svg)."
        ),
    ] = None,
    allow_code: AllowCode = False,
) -> None:
    """Share of each uncertain input in a band. The output also says what to measure to halve the band.

    Uncertain inputs are those that the case file gives a distribution, such as "0.54 ± 0.01", and those that are
    rarely known, with a usual one. Laws are not varied here.
    """
    from ballscrew.cases.case_files import case_file
    from ballscrew.faces.cli import progress
    from ballscrew.faces.sheets import to_file
    from ballscrew.questions.sensitivity import compute
    from ballscrew.questions.sensitivity.answer import document
    from ballscrew.questions.sensitivity.sheet import sheet
    from ballscrew.questions.shared.option_values import read

    loaded = case_file.load(case, settings or [], model, calibration=calibration, allow_code=allow_code)
    options = read(SensitivityOptions, written)
    to_file.check([] if to is None else [to])
    with progress.progress("sensitivity") as done:
        report = compute.sensitivity(loaded, options, done)
    seen = sheet(loaded, report)
    print_answer(seen, lambda: document(loaded, report), as_json=as_json, as_sheet=as_sheet)
    if to is not None:
        to_file.write(to, seen)
        typer.echo(f"{to}: {len(report.result.inputs)} inputs", err=as_json or as_sheet)

"""``ballscrew sensitivity``: which input to find out next."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import typer

from ballscrew.faces.cli.common_options import AllowCode, CalibrationName, CaseFile, ModelName
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
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object, SI units.")] = False,
    to: Annotated[
        Path | None, typer.Option("--to", "-o", metavar="FILE", help="Also draw a picture: .png, .svg or .pdf.")
    ] = None,
    allow_code: AllowCode = False,
) -> None:
    """Share of each uncertain input in a band. The output also says what to measure to halve the band.

    Uncertain inputs are those that the case file gives a distribution, such as "0.54 ± 0.01", and those that are
    rarely known, with a usual one. Laws are not varied here.
    """
    from ballscrew.basis.output.json_text import as_json as json_text
    from ballscrew.cases.case_files import case_file
    from ballscrew.faces.cli import progress
    from ballscrew.questions.sensitivity import compute, text
    from ballscrew.questions.sensitivity import document as documents
    from ballscrew.questions.shared import chart_files as files
    from ballscrew.questions.shared.option_values import read

    loaded = case_file.load(case, settings or [], model, calibration=calibration, allow_code=allow_code)
    options = read(SensitivityOptions, written)
    if to is not None:
        files.check_picture(to)
    with progress.progress("sensitivity") as done:
        report = compute.sensitivity(loaded, options, done)
    if as_json:
        typer.echo(json_text(documents.document(loaded, report)))
    else:
        text.print_sensitivity(loaded, report)
    if to is not None:
        from ballscrew.questions.sensitivity import figure as figures  # matplotlib is slow to import

        files.draw(lambda: figures.picture(loaded, report), to)
        typer.echo(f"{to}: {len(report.result.inputs)} inputs", err=as_json)

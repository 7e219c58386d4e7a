"""``ballscrew reversal``: friction after a reversal, and the models of control engineering fitted to it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import typer

from ballscrew.faces.cli.common_options import AllowCode, AsJson, CalibrationName, CaseFile, ModelName, Settings
from ballscrew.faces.cli.flags import flags_of
from ballscrew.questions.reversal.options import ReversalOptions


@flags_of(ReversalOptions)
def reversal(
    case: CaseFile,
    *,
    written: Mapping[str, Any],
    model: ModelName = None,
    calibration: CalibrationName = None,
    settings: Settings = None,
    as_json: AsJson = False,
    to: Annotated[
        Path | None, typer.Option("--to", "-o", metavar="FILE", help="Also draw a picture: .png, .svg or .pdf.")
    ] = None,
    allow_code: AllowCode = False,
) -> None:
    """Friction after a reversal, and models for controllers. Over the angle of the screw, by mechanism.

    Dahl, LuGre and Maxwell-slip elements (GMS) are fitted, each with its error. That helix slip comes back over degrees
    of the screw is a hypothesis.
    """
    from ballscrew.basis.output.json_text import as_json as json_text
    from ballscrew.cases.case_files import case_file
    from ballscrew.faces.cli.progress import progress
    from ballscrew.questions.reversal import compute, text
    from ballscrew.questions.reversal import document as documents
    from ballscrew.questions.shared import chart_files as files
    from ballscrew.questions.shared.option_values import read

    options = read(ReversalOptions, written)
    if to is not None:
        files.check_picture(to)
    loaded = case_file.load(case, settings or [], model, calibration=calibration, allow_code=allow_code)
    with progress("reversal"):
        report = compute.reversal(loaded, options)
    typer.echo(json_text(documents.document(report)) if as_json else text.text(report))
    if to is not None:
        from ballscrew.questions.reversal import figure as figures  # matplotlib is slow to import

        files.draw(lambda: figures.picture(report), to)
        typer.echo(f"{to}: {len(report.reversal.screw_angle)} angles", err=as_json)

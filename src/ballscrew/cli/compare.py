"""``ballscrew compare``: all models and laws side by side."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ballscrew.command_options.common_options import (
    AllowCode,
    CalibrationName,
    CaseFile,
    ModelName,
    SelfHeatingOption,
    Settings,
)


def compare(
    case: CaseFile,
    model: ModelName = None,
    calibration: CalibrationName = None,
    settings: Settings = None,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object, SI units.")] = False,
    to: Annotated[
        Path | None,
        typer.Option("--to", "-o", metavar="FILE", help="Also draw a picture of the spread: .png, .svg or .pdf."),
    ] = None,
    self_heating: SelfHeatingOption = False,
    allow_code: AllowCode = False,
) -> None:
    """All models and all laws side by side at the operating point of a case file.

    First the models as they are, then the model of the case with one law at a time in place of its
    own: torque, its parts, efficiency in both directions, and what lies outside its validity. With
    --self-heating all at the oil and preload in which the model of the case ends.
    """
    from ballscrew.cases import case_file
    from ballscrew.documents import comparison as documents
    from ballscrew.documents.self_heating import with_self_heating
    from ballscrew.figures import files
    from ballscrew.output import json_text
    from ballscrew.output.wrapping import wrapped
    from ballscrew.studies.comparison import comparison
    from ballscrew.text import comparison as text

    loaded = case_file.load(case, settings or [], model, calibration=calibration, allow_code=allow_code)
    if to is not None:
        files.check_picture(to)
    heating = None
    if self_heating:
        from ballscrew.axis_studies import self_heating as studies

        heating = studies.self_heating(loaded)
        loaded = heating.warm
    compared = comparison(loaded)
    if as_json:
        typer.echo(json_text.as_json(with_self_heating(documents.document(loaded, compared), heating)))
    else:
        if heating is not None:
            typer.echo(wrapped(heating.record.text))
        text.print_comparison(loaded, compared)
    if to is not None:
        from ballscrew.figures import comparison as figures  # matplotlib is slow to import

        files.draw(lambda: figures.picture(loaded, compared), to)
        typer.echo(f"{to}: {len(compared.rows)} models and laws", err=as_json)

"""``ballscrew hand-over``: the model as files for another program."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ballscrew.faces.cli.common_options import AllowCode, CalibrationName, CaseFile, ModelName, Settings


def hand_over(
    case: CaseFile,
    to: Annotated[str, typer.Option("--to", metavar="TARGET", help="What it is for; an unknown name lists them all.")],
    out: Annotated[Path, typer.Option("--out", "-o", metavar="DIR", help="Folder to write into.")],
    model: ModelName = None,
    calibration: CalibrationName = None,
    settings: Settings = None,
    ranges: Annotated[
        list[str] | None,
        typer.Option("--range", metavar="INPUT=LEAST:GREATEST", help='Of tables and fits: axial_load="-5:5 kN".'),
    ] = None,
    parameters: Annotated[
        list[str] | None,
        typer.Option("--parameter", metavar="INPUT", help="One more input, such as friction.limiting_film_parameter."),
    ] = None,
    outputs: Annotated[
        list[str] | None, typer.Option("--output", metavar="NAME", help="One more output, as of sweeps.")
    ] = None,
    derivatives: Annotated[
        list[str] | None, typer.Option("--derivatives", metavar="INPUT", help="Also derive the outputs by an input.")
    ] = None,
    options: Annotated[
        list[str] | None, typer.Option("--option", metavar="NAME=VALUE", help="A choice that the target has.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object, SI units.")] = False,
    allow_code: AllowCode = False,
) -> None:
    """Hand the model over to a simulator, a robot or a control, with its range and its worst error."""
    from ballscrew.basis.output.json_text import as_json as json_text
    from ballscrew.cases.case_files import case_file
    from ballscrew.exports import requests
    from ballscrew.questions.hand_over import document as documents
    from ballscrew.questions.hand_over import text

    requests.check_target(to)
    loaded = case_file.load(case, settings or [], model, calibration=calibration, allow_code=allow_code)
    request = requests.Request(ranges or (), parameters or (), outputs or (), derivatives or (), options or ())
    export = requests.of_case(loaded, to, request)
    written = export.write(out)
    typer.echo(json_text(documents.document(export, loaded, written)) if as_json else text.text(export, written))

"""``ballscrew hand-over``: the model as files for another program."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import typer

from ballscrew.faces.cli.common_options import AllowCode, AsJson, CalibrationName, CaseFile, ModelName, Settings
from ballscrew.faces.cli.flags import flags_of
from ballscrew.questions.hand_over.options import HandOverOptions


@flags_of(HandOverOptions)
def hand_over(
    case: CaseFile,
    to: Annotated[
        str, typer.Option("--to", metavar="TARGET", help="Target: c, fmu, table, …; an unknown name lists all.")
    ],
    out: Annotated[Path, typer.Option("--out", "-o", metavar="DIR", help="Folder to write into.")],
    model: ModelName = None,
    calibration: CalibrationName = None,
    settings: Settings = None,
    *,
    written: Mapping[str, Any],
    as_json: AsJson = False,
    allow_code: AllowCode = False,
) -> None:
    """Write the model for a simulator, a robot or a control. Its range and its worst error come with it."""
    from ballscrew.basis.output.json_text import as_json as json_text
    from ballscrew.cases.case_files import case_file
    from ballscrew.exports import requests
    from ballscrew.faces.cli.progress import progress
    from ballscrew.questions.hand_over import document as documents
    from ballscrew.questions.hand_over import text
    from ballscrew.questions.shared.option_values import read

    requests.check_target(to)
    loaded = case_file.load(case, settings or [], model, calibration=calibration, allow_code=allow_code)
    request = requests.Request(**vars(read(HandOverOptions, written)))
    with progress("hand-over"):
        export = requests.of_case(loaded, to, request)
    files = export.write(out)
    typer.echo(json_text(documents.document(export, loaded, files)) if as_json else text.text(export, files))

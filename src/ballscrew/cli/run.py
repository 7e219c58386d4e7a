"""``ballscrew run``: friction at one operating point, with ``--band`` its uncertainty."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ballscrew.cli.common_options import AllowCode, CaseFile, ModelName, Settings


def run(
    case: CaseFile,
    model: ModelName = None,
    settings: Settings = None,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object, SI units.")] = False,
    band: Annotated[
        bool, typer.Option("--band", help="How far off the results may be: uncertain inputs, and other laws.")
    ] = False,
    samples: Annotated[
        int | None, typer.Option("--samples", metavar="N", help="With --band: samples, 16384; where balls differ 1024.")
    ] = None,
    level: Annotated[
        float | None, typer.Option("--level", metavar="SHARE", help="With --band: share in the band, 0.95.")
    ] = None,
    only_given: Annotated[
        bool, typer.Option("--only-given", help="With --band: only what the file says is uncertain.")
    ] = False,
    to: Annotated[
        Path | None, typer.Option("--to", "-o", metavar="FILE", help="With --band: also draw .png, .svg or .pdf.")
    ] = None,
    allow_code: AllowCode = False,
) -> None:
    """Friction at the operating point of a case file; with --band how far off it may be."""
    from ballscrew.cases import case_file

    loaded = case_file.load(case, settings or [], model, allow_code=allow_code)
    if band or to is not None or only_given or (samples, level) != (None, None):
        from ballscrew.cli import band as band_command
        from ballscrew.cli.progress import progress
        from ballscrew.studies.band import Options

        options = Options(samples, level, only_given)
        band_command.check(band, options, to)
        with progress("band") as done:
            band_command.run(loaded, options, to, as_json, done)
        return
    from ballscrew.output import json_text
    from ballscrew.output.documents.run import document
    from ballscrew.output.text.run import print_run
    from ballscrew.studies.run import run as run_case

    found = run_case(loaded)
    if as_json:
        typer.echo(json_text.as_json(document(found)))
    else:
        print_run(found)

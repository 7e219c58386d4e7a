"""``ballscrew reversal``: friction after a reversal, and the models of control engineering fitted to it."""

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
    Settings,
    print_answer,
)
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
    as_sheet: AsSheet = False,
    to: Annotated[
        Path | None, typer.Option("--to", "-o", metavar="FILE", help="Also write a table (.csv, .xlsx) or a picture.")
    ] = None,
    allow_code: AllowCode = False,
) -> None:
    """Friction after a reversal, and models for controllers. Over the angle of the screw, by mechanism.

    Dahl, LuGre and Maxwell-slip elements (GMS) are fitted, each with its error. That helix slip comes back over degrees
    of the screw is a hypothesis.
    """
    from ballscrew.cases.case_files import case_file
    from ballscrew.faces.cli.progress import progress
    from ballscrew.faces.sheets import to_file
    from ballscrew.questions.reversal import compute
    from ballscrew.questions.reversal.answer import document
    from ballscrew.questions.reversal.sheet import sheet
    from ballscrew.questions.shared.option_values import read

    options = read(ReversalOptions, written)
    to_file.check([] if to is None else [to])
    loaded = case_file.load(case, settings or [], model, calibration=calibration, allow_code=allow_code)
    with progress("reversal"):
        report = compute.reversal(loaded, options)
    seen = sheet(report)
    print_answer(seen, lambda: document(report), as_json=as_json, as_sheet=as_sheet)
    if to is not None:
        to_file.write(to, seen)
        typer.echo(f"{to}: {len(report.reversal.screw_angle)} angles", err=as_json or as_sheet)

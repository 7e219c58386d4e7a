"""``ballscrew ripple``: the friction torque over the angle of the screw, with its orders."""

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
from ballscrew.questions.ripple.options import RippleOptions


@flags_of(RippleOptions)
def ripple(
    case: CaseFile,
    *,
    written: Mapping[str, Any],
    model: ModelName = None,
    calibration: CalibrationName = None,
    settings: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="SECTION.FIELD=VALUE", help='Change a value: --set nut.preload="4 kN".'),
    ] = None,
    as_json: AsJson = False,
    as_sheet: AsSheet = False,
    to: Annotated[
        Path | None,
        typer.Option(
            "--to", metavar="FILE", help="Draw torque and orders (.png, .svg, .pdf) or write them (.xlsx, .csv)."
        ),
    ] = None,
    allow_code: AllowCode = False,
) -> None:
    """Friction torque over the angle of the screw.

    Peak to peak, orders with their causes, and what faults change.

    The balls of each circuit are followed through grooves that deviate. Torque is a poor sensor of spalls and a good
    one of lost preload and of circuits without room: --fault all has the figures for this nut.
    """
    from ballscrew.cases.case_files import case_file
    from ballscrew.faces.cli.progress import progress
    from ballscrew.faces.sheets import to_file
    from ballscrew.questions.ripple import compute
    from ballscrew.questions.ripple.answer import document
    from ballscrew.questions.ripple.sheet import sheet
    from ballscrew.questions.shared.option_values import read

    options = read(RippleOptions, written)
    loaded = case_file.load(case, settings or [], model, calibration=calibration, allow_code=allow_code)
    to_file.check([to] if to else [])
    with progress("ripple"):
        report = compute.ripple_of(loaded, options)
    seen = sheet(report)
    print_answer(seen, lambda: document(report), as_json=as_json, as_sheet=as_sheet)
    if to is not None:
        to_file.write(to, seen)
        typer.echo(f"{to}: {len(report.ripple.angle)} angles", err=as_json or as_sheet)

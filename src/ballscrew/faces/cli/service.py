"""``ballscrew service``: the preload left in a nut."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import typer

from ballscrew.faces.cli.common_options import AllowCode, AsJson, AsSheet, CalibrationName, ModelName, print_answer
from ballscrew.faces.cli.flags import flags_of
from ballscrew.questions.service.options import ReadingOptions, ServiceOptions


@flags_of(ReadingOptions, ServiceOptions)
def service(
    logs: Annotated[
        list[Path] | None,
        typer.Argument(
            metavar="[NEW] WORN", help="Log of the new screw and of the worn one; of one alone, against the case."
        ),
    ] = None,
    case: Annotated[
        Path | None, typer.Option("--case", metavar="FILE", help="Case file (TOML) of screw, nut, oil and model.")
    ] = None,
    *,
    written: Mapping[str, Any],
    model: ModelName = None,
    calibration: CalibrationName = None,
    settings: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="SECTION.FIELD=VALUE", help='Change a value: --set nut.preload="4 kN ± 10 %".'),
    ] = None,
    as_json: AsJson = False,
    as_sheet: AsSheet = False,
    picture: Annotated[
        Path | None,
        typer.Option("--picture", metavar="FILE", help="Draw both logs and both preloads: .png, .svg or .pdf."),
    ] = None,
    allow_code: AllowCode = False,
) -> None:
    """Preload left in a nut, by logs or a drag torque.

    From a log when new and one when worn, from one log against the case, or from one drag torque.

    The answer has its interval and its probability. What else could have changed the torque is fitted, too: boundary
    friction, the oil, the seals.
    """
    from ballscrew.cases.case_files import case_file
    from ballscrew.faces.cli.progress import progress
    from ballscrew.faces.sheets import to_file
    from ballscrew.questions.service import compute
    from ballscrew.questions.service.answer import document
    from ballscrew.questions.service.reading import check_question, reading
    from ballscrew.questions.service.sheet import sheet
    from ballscrew.questions.shared.chart_files import check_picture
    from ballscrew.questions.shared.option_values import read

    file = check_question(logs or [], case, written)
    loaded = case_file.load(file, settings or [], model, calibration=calibration, allow_code=allow_code)
    if picture is not None:
        check_picture(picture, "--picture")
    if written["torque"] is not None:
        report = compute.of_torque(loaded, reading(written))
    else:
        options = read(ServiceOptions, written)
        with progress("service") as done:
            report = compute.of_logs(loaded, logs or [], options, done)
    seen = sheet(loaded, report)
    print_answer(seen, lambda: document(loaded, report), as_json=as_json, as_sheet=as_sheet)
    if picture is not None:
        to_file.write(picture, seen, option="--picture")
        typer.echo(f"{picture}: {len(report.estimates)} preloads", err=as_json or as_sheet)

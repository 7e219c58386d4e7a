"""``ballscrew service``: the preload left in a nut."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ballscrew.faces.cli.common_options import (
    AllowCode,
    CalibrationName,
    Inertia,
    KeepGoing,
    ModelName,
    TorqueConstant,
    TorqueKind,
)


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
    torque: Annotated[
        str | None,
        typer.Option("--torque", metavar="VALUE", help='In place of logs: without load, "0.40 ± 0.02 N m".'),
    ] = None,
    speed: Annotated[
        str | None, typer.Option("--speed", metavar="VALUE", help='At which that was measured: "100 rpm".')
    ] = None,
    temperature: Annotated[
        str | None, typer.Option("--temperature", metavar="VALUE", help='Of the nut meanwhile: "35 degC".')
    ] = None,
    tolerance: Annotated[
        float, typer.Option("--tolerance", metavar="SHARE", help="Of the preload, that may be lost.")
    ] = 0.1,
    free: Annotated[
        list[str] | None,
        typer.Option("--free", metavar="NAMES", help="What to fit beside the preload, with commas: constant_torque."),
    ] = None,
    kind: TorqueKind = None,
    column: Annotated[
        list[str] | None,
        typer.Option("--column", metavar="NAME=HEADING", help='A heading by hand, of both logs: load="0 N".'),
    ] = None,
    torque_constant: TorqueConstant = None,
    inertia: Inertia = None,
    keep_going: KeepGoing = False,
    model: ModelName = None,
    calibration: CalibrationName = None,
    settings: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="SECTION.FIELD=VALUE", help='Change a value: --set nut.preload="4 kN ± 10 %".'),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object, SI units.")] = False,
    picture: Annotated[
        Path | None,
        typer.Option("--picture", metavar="FILE", help="Draw both logs and both preloads: .png, .svg or .pdf."),
    ] = None,
    allow_code: AllowCode = False,
) -> None:
    """Preload left in a nut: from a log when new and one when worn, from one log, or from a torque without load.

    The answer has its interval and its probability. What else could have changed the torque is fitted, too: boundary
    friction, the oil, the seals.
    """
    from ballscrew.basis.output.json_text import as_json as json_text
    from ballscrew.cases.case_files import case_file
    from ballscrew.faces.cli.progress import progress
    from ballscrew.questions.service import compute, text
    from ballscrew.questions.service import document as documents
    from ballscrew.questions.service.options import check_question, fit_options, reading
    from ballscrew.questions.shared import chart_files as files

    file = check_question(logs or [], case, torque, speed, temperature)
    loaded = case_file.load(file, settings or [], model, calibration=calibration, allow_code=allow_code)
    if picture is not None:
        files.check_picture(picture, "--picture")
    if torque is not None:
        report = compute.of_torque(loaded, reading(torque, speed or "", temperature))
    else:
        chosen = fit_options(
            loaded, free=free or [], columns=column or [], kind=kind, inertia=inertia,
            torque_constant=torque_constant, keep_going=keep_going,
        )  # fmt: skip
        with progress("service") as done:
            report = compute.of_logs(loaded, logs or [], chosen, tolerance, done)
    if as_json:
        typer.echo(json_text(documents.document(loaded, report)))
    else:
        text.print_service(loaded, report)
    if picture is not None:
        from ballscrew.questions.service import figure as figures  # matplotlib is slow to import

        files.draw(lambda: figures.picture(loaded, report), picture, "--picture")
        typer.echo(f"{picture}: {len(report.estimates)} preloads", err=as_json)

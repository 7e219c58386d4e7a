"""``ballscrew condition``: the state of a nut over time, with an alarm."""

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


def condition(
    tests: Annotated[
        list[Path] | None,
        typer.Argument(
            metavar="TABLE | LOG1 LOG2 …",
            help="A table with a row for each test (date, torque, temperature), or the logs of the tests in order.",
        ),
    ] = None,
    case: Annotated[
        Path | None, typer.Option("--case", metavar="FILE", help="Case file (TOML) of screw, nut, oil and model.")
    ] = None,
    speed: Annotated[
        str | None,
        typer.Option("--speed", metavar="VALUE", help='Of the tests of a table without speeds: "100 rpm".'),
    ] = None,
    at: Annotated[
        str | None,
        typer.Option("--at", metavar="VALUE", help='Temperature to reduce the torques to: "20 degC"; else the first.'),
    ] = None,
    baseline: Annotated[
        int, typer.Option("--baseline", metavar="TESTS", help="First tests, which count as healthy.")
    ] = 5,
    tolerance: Annotated[
        float, typer.Option("--tolerance", metavar="SHARE", help="Of the preload, that may be lost.")
    ] = 0.1,
    false_alarms: Annotated[
        float, typer.Option("--false-alarms", metavar="SHARE", help="Of healthy tests, that may give an alarm.")
    ] = 0.002,
    kind: TorqueKind = None,
    column: Annotated[
        list[str] | None,
        typer.Option("--column", metavar="NAME=HEADING", help='A heading by hand: torque="M_R [N m]".'),
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
    to: Annotated[
        Path | None,
        typer.Option("--to", metavar="FILE", help="Draw torque, preload and alarm over time: .png, .svg or .pdf."),
    ] = None,
    allow_code: AllowCode = False,
) -> None:
    """State of a nut over time: preload left, trend and alarm, from torques that were logged test by test.

    All torques are reduced to one temperature by the model; without logged temperatures the intervals are wide, and the
    output says so first.
    """
    from ballscrew.basis.output.json_text import as_json as json_text
    from ballscrew.cases.case_files import case_file
    from ballscrew.faces.cli.condition_options import check_question, options
    from ballscrew.faces.cli.progress import progress
    from ballscrew.questions.condition import compute, text
    from ballscrew.questions.condition import document as documents
    from ballscrew.questions.shared import chart_files as files

    file = check_question(tests or [], case)
    loaded = case_file.load(file, settings or [], model, calibration=calibration, allow_code=allow_code)
    if to is not None:
        files.check_picture(to)
    chosen = options(
        loaded, tests or [], speed=speed, at=at, baseline=baseline, tolerance=tolerance, false_alarms=false_alarms,
        columns=column or [], kind=kind, inertia=inertia, torque_constant=torque_constant, keep_going=keep_going,
    )  # fmt: skip
    with progress("condition") as done:
        found = compute.of_files(loaded, tests or [], chosen, done)
    if as_json:
        typer.echo(json_text(documents.document(loaded, found)))
    else:
        text.print_condition(loaded, found)
    if to is not None:
        from ballscrew.questions.condition import figure as figures  # matplotlib is slow to import

        files.draw(lambda: figures.picture(loaded, found), to)
        typer.echo(f"{to}: {len(found.states)} tests", err=as_json)

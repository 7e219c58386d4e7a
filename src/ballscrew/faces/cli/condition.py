"""``ballscrew condition``: the state of a nut over time, with an alarm."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any

import typer

from ballscrew.faces.cli.common_options import AllowCode, CalibrationName, ModelName
from ballscrew.faces.cli.flags import flags_of
from ballscrew.questions.condition.options import ConditionOptions


@flags_of(ConditionOptions)
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
    *,
    written: Mapping[str, Any],
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
    """Preload of a nut over time, with trend and alarm. From torques that were logged test by test.

    All torques are reduced to one temperature by the model; without logged temperatures the intervals are wide, and the
    output says so first.
    """
    from ballscrew.basis.output.json_text import as_json as json_text
    from ballscrew.cases.case_files import case_file
    from ballscrew.faces.cli.progress import progress
    from ballscrew.questions.condition import compute, text
    from ballscrew.questions.condition import document as documents
    from ballscrew.questions.shared import chart_files as files
    from ballscrew.questions.shared.option_values import read

    file = _check_question(tests or [], case)
    loaded = case_file.load(file, settings or [], model, calibration=calibration, allow_code=allow_code)
    if to is not None:
        files.check_picture(to)
    compute.check_kind(len(tests or []), written)
    options = read(ConditionOptions, written)
    with progress("condition") as done:
        found = compute.of_files(loaded, tests or [], options, done)
    if as_json:
        typer.echo(json_text(documents.document(loaded, found)))
    else:
        text.print_condition(loaded, found)
    if to is not None:
        from ballscrew.questions.condition import figure as figures  # matplotlib is slow to import

        files.draw(lambda: figures.picture(loaded, found), to)
        typer.echo(f"{to}: {len(found.states)} tests", err=as_json)


def _check_question(tests: Sequence[Path], case: Path | None) -> Path:
    """The case file. Raises :class:`~ballscrew.basis.errors.InputError` for a question without case or tests."""
    from ballscrew.basis.errors import Fault, raise_if_any

    faults: list[Fault] = []
    if case is None:
        faults.append(Fault("--case", "missing", "", "give the case file of the screw: --case FILE"))
    if not tests:
        faults.append(Fault("TABLE", "missing", "", "give a table with a row for each test, or the logs of the tests"))
    raise_if_any(faults)
    assert case is not None
    return case

"""``ballscrew condition``: the state of a nut over time, with an alarm."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any

import typer

from ballscrew.faces.cli.common_options import AllowCode, AsJson, AsSheet, CalibrationName, ModelName, print_answer
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
    as_json: AsJson = False,
    as_sheet: AsSheet = False,
    to: Annotated[
        Path | None,
        typer.Option("--to", metavar="FILE", help="Also write tables (.xlsx, .csv) or a picture (.pdf, .png, .svg)."),
    ] = None,
    allow_code: AllowCode = False,
) -> None:
    """Preload of a nut over time, with trend and alarm. From torques that were logged test by test.

    All torques are reduced to one temperature by the model; without logged temperatures the intervals are wide, and the
    output says so first.
    """
    from ballscrew.cases.case_files import case_file
    from ballscrew.faces.cli.progress import progress
    from ballscrew.faces.sheets import to_file
    from ballscrew.questions.condition import compute
    from ballscrew.questions.condition.answer import document
    from ballscrew.questions.condition.sheet import sheet
    from ballscrew.questions.shared.option_values import read

    file = _check_question(tests or [], case)
    loaded = case_file.load(file, settings or [], model, calibration=calibration, allow_code=allow_code)
    to_file.check([] if to is None else [to])
    compute.check_kind(len(tests or []), written)
    options = read(ConditionOptions, written)
    with progress("condition") as done:
        result = compute.of_files(loaded, tests or [], options, done)
    seen = sheet(loaded, result)
    print_answer(seen, lambda: document(loaded, result), as_json=as_json, as_sheet=as_sheet)
    if to is not None:
        to_file.write(to, seen)
        typer.echo(f"{to}: {len(result.states)} tests", err=as_json or as_sheet)


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

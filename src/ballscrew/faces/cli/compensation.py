"""``ballscrew compensation``: the growth of a warm shaft for a control."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import typer

from ballscrew.faces.cli.common_options import AllowCode, AsJson, AsSheet, CaseFile, ModelName, Settings, print_answer
from ballscrew.faces.cli.flags import flags_of
from ballscrew.questions.compensation.options import CompensationOptions


@flags_of(CompensationOptions)
def compensation(
    case: CaseFile,
    to: Annotated[str, typer.Option("--to", metavar="CONTROL", help="sinumerik or isg (TwinCAT CNC).")],
    out: Annotated[Path, typer.Option("--out", "-o", metavar="FILE", help="File to write.")],
    *,
    written: Mapping[str, Any],
    model: ModelName = None,
    settings: Settings = None,
    as_json: AsJson = False,
    as_sheet: AsSheet = False,
    allow_code: AllowCode = False,
) -> None:
    """Growth of a warm shaft as a table for a control.

    The shaft is that after hours of work; the table compensates positions of an axis with the encoder at the motor.

    Positions grow away from the fixed bearing; of an axis mounted the other way round, --direction towards turns the
    signs. It holds in that thermal state only; a warm-up that stops before the hours is refused.
    The format was checked against the example of the manual, not on a control.
    """
    from ballscrew.basis.atomic_files import atomic_write, check_writable
    from ballscrew.basis.errors import Fault, InputError, nearest
    from ballscrew.questions.compensation import compute
    from ballscrew.questions.compensation.answer import document
    from ballscrew.questions.compensation.sheet import sheet
    from ballscrew.questions.compensation.table import LISTS
    from ballscrew.questions.shared.option_values import read
    from ballscrew.questions.warm_up import compute as warm_up

    if to not in LISTS:
        raise InputError(Fault("--to", "unknown control", to, nearest(to, LISTS)))
    options = read(CompensationOptions, written)
    compute.check(options)
    check_writable("--out", out)
    report = warm_up.warmed_up(warm_up.load(case, settings or [], model, allow_code=allow_code), options.hours)
    result = compute.position_compensation(
        report,
        options.hours,
        zero=options.zero,
        direction=options.direction or "away",
        step=options.step,
        reference=options.reference,
    )
    with atomic_write("--out", out) as path:
        path.write_text(LISTS[to](result, options.axis), encoding="utf-8")
    typer.echo(f"{out}", err=as_json or as_sheet)
    print_answer(sheet(result, report), lambda: document(result, report), as_json=as_json, as_sheet=as_sheet)

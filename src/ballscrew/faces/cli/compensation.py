"""``ballscrew compensation``: the growth of a warm shaft for a control."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ballscrew.faces.cli.common_options import AllowCode, CaseFile, ModelName, Settings


def compensation(
    case: CaseFile,
    to: Annotated[str, typer.Option("--to", metavar="CONTROL", help="sinumerik or isg (TwinCAT CNC).")],
    out: Annotated[Path, typer.Option("--out", "-o", metavar="FILE", help="File to write.")],
    hours: Annotated[float, typer.Option("--hours", metavar="H", help="Hours of work.")] = 4.0,
    axis: Annotated[str, typer.Option("--axis", metavar="NAME", help="Name of the axis at the control.")] = "X1",
    zero: Annotated[
        str, typer.Option("--zero", metavar="LENGTH", help="Place from the fixed bearing where the axis is at zero.")
    ] = "0 mm",
    direction: Annotated[
        str,
        typer.Option(
            "--direction",
            metavar="away|towards",
            help="Positions of the axis grow away from the fixed bearing, or towards it.",
        ),
    ] = "away",
    step: Annotated[str, typer.Option("--step", metavar="LENGTH", help="Distance of the points.")] = "20 mm",
    reference: Annotated[
        str | None,
        typer.Option("--reference", metavar="LENGTH", help="Position of the axis where nothing is compensated."),
    ] = None,
    model: ModelName = None,
    settings: Settings = None,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object, SI units.")] = False,
    allow_code: AllowCode = False,
) -> None:
    """Write the growth of a shaft after hours of work as a compensation of positions, for an encoder at the motor.

    Positions grow away from the fixed bearing; of an axis mounted the other way round, --direction towards turns the
    signs. It holds in that thermal state only; a warm-up that stops before the hours is refused.
    The format was checked against the example of the manual, not on a control.
    """
    from ballscrew.basis.atomic_files import atomic_write, check_writable
    from ballscrew.basis.errors import Fault, InputError, nearest
    from ballscrew.basis.output.json_text import as_json as json_text
    from ballscrew.basis.records import Message
    from ballscrew.questions.compensation import compute, text
    from ballscrew.questions.compensation import document as documents
    from ballscrew.questions.compensation import table as compensation_lists
    from ballscrew.questions.warm_up import compute as warm_up

    if to not in compensation_lists.LISTS:
        raise InputError(Fault("--to", "unknown control", to, nearest(to, compensation_lists.LISTS)))
    if not axis.isidentifier():
        raise InputError(Fault("--axis", "is no name of an axis", axis, "write letters and digits, such as X1"))
    if direction not in compute.DIRECTIONS:
        remedy = nearest(direction, compute.DIRECTIONS)
        raise InputError(Fault("--direction", "unknown direction", direction, remedy))
    if not 0 < hours <= _LONGEST:
        raise InputError(
            Fault(
                "--hours",
                Message("must be above 0 and at most {longest}", {"longest": f"{_LONGEST:g}"}),
                f"{hours:g}",
                "write --hours 4",
            )
        )
    lengths = {"--zero": zero, "--step": step, **({} if reference is None else {"--reference": reference})}
    found = {name: _length(name, text) for name, text in lengths.items()}
    check_writable("--out", out)
    report = warm_up.warmed_up(warm_up.load(case, settings or [], model, allow_code=allow_code), hours)
    made = compute.position_compensation(
        report, hours, zero=found["--zero"], direction=direction, step=found["--step"],
        reference=found.get("--reference"),
    )  # fmt: skip
    with atomic_write("--out", out) as path:
        path.write_text(compensation_lists.LISTS[to](made, axis), encoding="utf-8")
    typer.echo(f"{out}", err=as_json)
    typer.echo(json_text(documents.document(made, report)) if as_json else text.text(made, report))


#: The longest time, h: a year.
_LONGEST = 8766.0


def _length(where: str, text: str) -> float:
    from ballscrew.basis import units
    from ballscrew.basis.errors import Fault, InputError
    from ballscrew.basis.quantities import Info, Quantity

    found = units.parse(where, text, Quantity(where, "m", Info("x", "length", "mm")))
    if isinstance(found, Fault):
        raise InputError(found)
    return found

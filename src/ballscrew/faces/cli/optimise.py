"""``ballscrew optimise``: free geometries for a need."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import typer

from ballscrew.faces.cli.common_options import AllowCode, AsSheet, CalibrationName, ModelName, print_answer
from ballscrew.faces.cli.flags import flags_of
from ballscrew.faces.cli.select import Need, check_file, check_spared, objectives_of
from ballscrew.questions.optimise.options import OptimiseOptions

_TO = "--to"


@flags_of(OptimiseOptions)
def optimise(
    need: Need,
    *,
    written: Mapping[str, Any],
    model: ModelName = None,
    calibration: CalibrationName = None,
    settings: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="SECTION.FIELD=VALUE", help="Change a value: --set optimise.nut=single."),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object with the members, SI units.")] = False,
    as_sheet: AsSheet = False,
    to: Annotated[
        list[Path] | None,
        typer.Option(
            _TO,
            "-o",
            metavar="FILE",
            help="Also write a table (.csv, .xlsx) or a picture (.png, .svg, .pdf); may be repeated.",
        ),
    ] = None,
    allow_code: AllowCode = False,
) -> None:
    """Pareto front of screw geometries for a need. They are free within what makers produce.

    The need is that of ballscrew select; its table [optimise] has bounds and objectives. Each member is evaluated by
    the full model and all checks. Needs the extra optimise.
    """
    from ballscrew.faces.cli.progress import progress
    from ballscrew.faces.sheets import to_file
    from ballscrew.questions.optimise import answer as documents
    from ballscrew.questions.optimise.compute import optimise as optimised
    from ballscrew.questions.optimise.compute import plan
    from ballscrew.questions.optimise.sheet import cost, sheet
    from ballscrew.questions.shared.option_values import read

    check_spared(to or [], need, settings=settings or [])
    for path in to or []:
        check_file(path)
    options = read(OptimiseOptions, written)
    asked: dict[str, Any] = {
        "objectives": objectives_of(options.objectives), "population": options.population,
        "generations": options.generations, "members": options.members, "quantile": options.quantile,
        "settings": settings or [],
        "model": model, "calibration": calibration, "allow_code": allow_code,
    }  # fmt: skip
    with progress("designs", cost(plan(need, **asked))) as done:
        found = optimised(need, seed=options.seed, done=done, **asked)
    seen = sheet(found)
    print_answer(seen, lambda: documents.document(found), as_json=as_json, as_sheet=as_sheet)
    for path in to or []:
        to_file.write(path, seen, option=_TO)
        typer.echo(f"{path}: {len(found.members)} designs", err=True)

"""``ballscrew optimise``: free geometries for a need. The work is done in ``optimisation``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from ballscrew.cli.select import Need, Objectives, check_file, names_of
from ballscrew.command_options.common_options import AllowCode, CalibrationName, ModelName

_TO = "--to"


def optimise(
    need: Need,
    objectives: Objectives = None,
    quantile: Annotated[
        float | None,
        typer.Option("--quantile", metavar="SHARE", help="Objectives at this quantile of the uncertain inputs: 0.9."),
    ] = None,
    population: Annotated[
        int | None, typer.Option("--population", metavar="N", help="Designs of a generation; 200 if left out.")
    ] = None,
    generations: Annotated[
        int | None, typer.Option("--generations", metavar="N", help="Generations with rigid bodies; 60 if left out.")
    ] = None,
    members: Annotated[
        int | None, typer.Option("--members", metavar="N", help="Members shown, in full; 24 if left out.")
    ] = None,
    seed: Annotated[int | None, typer.Option("--seed", metavar="N", help="Of the search; 0 if left out.")] = None,
    model: ModelName = None,
    calibration: CalibrationName = None,
    settings: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="SECTION.FIELD=VALUE", help="Change a value: --set optimise.nut=single."),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object with the members, SI units.")] = False,
    to: Annotated[
        list[Path] | None,
        typer.Option(_TO, "-o", metavar="FILE", help="Also write .csv or .xlsx, .png, .svg or .pdf; repeat."),
    ] = None,
    allow_code: AllowCode = False,
) -> None:
    """What a screw for a need would look like: the Pareto front of free geometries within what is made.

    The need is that of ballscrew select; its table [optimise] has bounds and objectives. Each member is evaluated by
    the full model and all checks. Needs the extra optimise.
    """
    from ballscrew.command_options.progress import progress
    from ballscrew.documents import optimisation as documents
    from ballscrew.optimisation.optimisation import optimise as optimised
    from ballscrew.optimisation.optimisation import plan
    from ballscrew.output.json_text import as_json as json_text
    from ballscrew.text import optimisation as text

    for path in to or []:
        check_file(path)
    asked: dict[str, Any] = {
        "objectives": None if objectives is None else names_of(objectives), "population": population,
        "generations": generations, "members": members, "quantile": quantile, "settings": settings or [],
        "model": model, "calibration": calibration, "allow_code": allow_code,
    }  # fmt: skip
    with progress("designs", text.cost(plan(need, **asked))) as done:
        found = optimised(need, seed=seed, done=done, **asked)
    typer.echo(json_text(documents.document(found)) if as_json else text.text(found))
    for path in to or []:
        from ballscrew.table_files import row_tables, selection_tables

        if path.suffix.lower() in row_tables.KINDS:
            row_tables.write(path, selection_tables.of_optimisation(found.members))
        else:
            from ballscrew.figures import files, optimisation

            files.draw(lambda: optimisation.picture(found), path, _TO)
        typer.echo(f"{path}: {len(found.members)} designs", err=True)

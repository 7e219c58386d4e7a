"""``ballscrew sensitivity``: which input to find out next. The work is done in ``interfaces/sensitivity``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def sensitivity(
    case: Annotated[Path, typer.Argument(help="Case file (TOML), for example examples/olaru2005.toml.")],
    output: Annotated[
        str, typer.Option("--output", metavar="NAME", help="Of which result, for example efficiency.")
    ] = "screw_torque",
    method: Annotated[
        str,
        typer.Option(
            "--method",
            metavar="NAME",
            help="sobol: shares of the variance; morris: screening of many inputs; local: derivatives.",
        ),
    ] = "sobol",
    samples: Annotated[
        int | None,
        typer.Option("--samples", metavar="N", help="A power of two (sobol), or trajectories (morris)."),
    ] = None,
    seed: Annotated[int, typer.Option("--seed", metavar="N", help="The same seed gives the same numbers.")] = 0,
    only_given: Annotated[
        bool, typer.Option("--only-given", help="Only what the case file gives a distribution; nothing usual.")
    ] = False,
    model: Annotated[str | None, typer.Option("--model", metavar="NAME", help="{models}; wins over the file.")] = None,
    settings: Annotated[
        list[str] | None,
        typer.Option(
            "--set", metavar="SECTION.FIELD=VALUE", help='Change a value: --set screw.lead="10 mm ± 0.02 mm".'
        ),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object, SI units.")] = False,
    to: Annotated[
        Path | None, typer.Option("--to", "-o", metavar="FILE", help="Also draw a picture: .png, .svg or .pdf.")
    ] = None,
) -> None:
    """Which uncertain input the band of a result comes from, and what to find out to halve it.

    Uncertain is what the case file gives a distribution, such as "0.54 ± 0.01", and what people rarely know, as
    much as is usual. Laws are not varied here.
    """
    from ballscrew.interfaces import comparison, config, progress
    from ballscrew.interfaces import sensitivity as work

    loaded = config.load(case, settings or [], model)
    asked = work.Asked(output, method, samples, seed, only_given)
    if to is not None:
        comparison.check_picture(to)
    with progress.progress("sensitivity") as done:
        found = work.found(loaded, asked, done)
    if as_json:
        typer.echo(work.json_text(loaded, found))
    else:
        work.print_found(loaded, found)
    if to is not None:
        work.draw(loaded, found, to)
        typer.echo(f"{to}: {len(found.result.inputs)} inputs", err=as_json)

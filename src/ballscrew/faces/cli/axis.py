"""``ballscrew axis``: rigidity between motor and table, over the stroke."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import typer

from ballscrew.faces.cli.common_options import AllowCode, AsJson, AsSheet, CaseFile, ModelName, print_answer
from ballscrew.faces.cli.flags import flags_of
from ballscrew.questions.axis.options import AxisOptions


@flags_of(AxisOptions)
def axis(
    case: CaseFile,
    *,
    written: Mapping[str, Any],
    model: ModelName = None,
    settings: Annotated[
        list[str] | None,
        typer.Option(
            "--set", metavar="SECTION.FIELD=VALUE", help='Change a value: --set installation.ends="fixed-fixed".'
        ),
    ] = None,
    as_json: AsJson = False,
    as_sheet: AsSheet = False,
    to: Annotated[
        list[Path] | None,
        typer.Option(
            "--to", "-o", metavar="FILE", help="Also write a table (.csv, .xlsx) or a picture; may be repeated."
        ),
    ] = None,
    allow_code: AllowCode = False,
) -> None:
    """Rigidity, lost motion and critical speed of an axis.

    The output has the buckling load, too, at places of the nut over the stroke.

    Nut, shaft, bearings, mount and the twist of the shaft, one behind the other. The case has an [installation]; with
    [axis] and [motion] the travel, the largest load and the largest speed are theirs, or else of [operation].
    """
    from ballscrew.faces.sheets import to_file
    from ballscrew.questions.axis import compute
    from ballscrew.questions.axis.answer import document
    from ballscrew.questions.axis.sheet import sheet
    from ballscrew.questions.shared.option_values import read

    options = read(AxisOptions, written)
    loaded = compute.load(case, settings or [], model, allow_code=allow_code)
    to_file.check(to or [])
    report = compute.chain_of(loaded, options.at)
    seen = sheet(report)
    print_answer(seen, lambda: document(report), as_json=as_json, as_sheet=as_sheet)
    for path in to or []:
        to_file.write(path, seen)
        typer.echo(f"{path}: {len(report.chain.position)} places", err=as_json or as_sheet)

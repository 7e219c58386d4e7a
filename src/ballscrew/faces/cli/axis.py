"""``ballscrew axis``: rigidity between motor and table, over the stroke."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ballscrew.faces.cli.common_options import AllowCode, CaseFile, ModelName
from ballscrew.faces.cli.flags import flags_of
from ballscrew.questions.axis.options import AxisOptions

if TYPE_CHECKING:
    from ballscrew.questions.axis.compute import ChainReport

_TO = "--to"


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
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object, SI units.")] = False,
    to: Annotated[
        list[Path] | None,
        typer.Option(_TO, "-o", metavar="FILE", help="Also write a table (.csv, .xlsx) or a picture; may be repeated."),
    ] = None,
    allow_code: AllowCode = False,
) -> None:
    """Rigidity, lost motion and critical speed of an axis.

    The output has the buckling load, too, at places of the nut over the stroke.

    Nut, shaft, bearings, mount and the twist of the shaft, one behind the other. The case has an [installation]; with
    [axis] and [motion] the travel, the largest load and the largest speed are theirs, or else of [operation].
    """
    from ballscrew.basis.output.json_text import as_json as json_text
    from ballscrew.questions.axis import compute, text
    from ballscrew.questions.axis import document as documents
    from ballscrew.questions.shared.option_values import read

    options = read(AxisOptions, written)
    loaded = compute.load(case, settings or [], model, allow_code=allow_code)
    for path in to or []:
        _check(path)
    report = compute.chain_of(loaded, options.at)
    typer.echo(json_text(documents.document(report)) if as_json else text.text(report))
    for path in to or []:
        _write(path, report)
        typer.echo(f"{path}: {len(report.chain.position)} places", err=as_json)


def _check(path: Path) -> None:
    from ballscrew.questions.shared import chart_files as files
    from ballscrew.questions.shared import row_tables

    if path.suffix.lower() in row_tables.KINDS:
        row_tables.check_path(path)
    else:
        files.check_picture(path, _TO)


def _write(path: Path, report: ChainReport) -> None:
    from ballscrew.questions.axis import table as stiffness_table
    from ballscrew.questions.shared import row_tables

    if path.suffix.lower() in row_tables.KINDS:
        row_tables.write(path, stiffness_table.places(report), "axis")
    else:
        from ballscrew.questions.axis import figure as figures  # matplotlib is slow to import
        from ballscrew.questions.shared import chart_files as files

        files.draw(lambda: figures.picture(report), path, _TO)

"""``ballscrew warm-up``: how a screw warms up, and what it does. The work is done in ``axis_studies/warm_up``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ballscrew.cli.common_options import AllowCode, CaseFile, ModelName

if TYPE_CHECKING:
    from ballscrew.axis_studies.warm_up import WarmUpReport

_TO, _HOURS, _COOL_DOWN = "--to", "--hours", "--cool-down"
#: Files that a folder gets.
_TABLES, _COMPENSATION, _PICTURE = ("warm_up.csv", "warm_up.xlsx"), "compensation.csv", "warm_up.png"
#: The longest time, h: a year.
_LONGEST = 8766.0


def warm_up(
    case: CaseFile,
    hours: Annotated[float, typer.Option(_HOURS, metavar="H", help="Hours of work.")] = 4.0,
    cool_down: Annotated[float, typer.Option(_COOL_DOWN, metavar="H", help="Hours of rest after them.")] = 0.0,
    model: ModelName = None,
    settings: Annotated[
        list[str] | None,
        typer.Option(
            "--set", metavar="SECTION.FIELD=VALUE", help='Change a value: --set surroundings.ambient="25 degC".'
        ),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object, SI units.")] = False,
    to: Annotated[
        list[Path] | None,
        typer.Option(
            _TO,
            "-o",
            metavar="PATH",
            help="Write a folder of tables and a picture; or one .csv, .xlsx, .png, .svg or .pdf; repeat.",
        ),
    ] = None,
    allow_code: AllowCode = False,
) -> None:
    """Temperatures, growth, preload and torque over hours, and the state in which they end.

    A case with an [axis] and a [motion] does its motion; one with an [operation] goes to and fro over half the shaft.
    [surroundings] has where the heat goes. The verdict says if there is no end: it runs away.
    """
    from ballscrew.axis_studies import warm_up as studies
    from ballscrew.documents import warm_up as documents
    from ballscrew.output.json_text import as_json as json_text
    from ballscrew.text import warm_up as text

    _check_hours(hours, cool_down)
    loaded = studies.load(case, settings or [], model, allow_code=allow_code)
    files = [path for place in to or [] for path in _files(place)]
    report = studies.warmed_up(loaded, hours, cool_down)
    typer.echo(json_text(documents.document(report)) if as_json else text.text(report))
    for path in files:
        _write(path, report, compensation=path.name == _COMPENSATION and path.parent in (to or []))
        typer.echo(f"{path}", err=as_json)


def _check_hours(hours: float, cool_down: float) -> None:
    """Raise :class:`~ballscrew.errors.InputError` for times that are none."""
    from ballscrew.errors import Fault, raise_if_any

    faults: list[Fault] = []
    if not 0 < hours <= _LONGEST:
        faults.append(Fault(_HOURS, f"must be above 0 and at most {_LONGEST:g}", f"{hours:g}", "write --hours 4"))
    if not 0 <= cool_down <= _LONGEST:
        faults.append(Fault(_COOL_DOWN, f"must be 0 to {_LONGEST:g}", f"{cool_down:g}", "write --cool-down 1"))
    raise_if_any(faults)


def _files(place: Path) -> list[Path]:
    """The files of a place: itself if it ends as one, or those of a folder, which is made. They can be written."""
    from ballscrew.errors import Fault, InputError
    from ballscrew.figures.files import SUFFIXES
    from ballscrew.files import check_writable, write_error
    from ballscrew.table_files import row_tables

    known = (*row_tables.KINDS, *SUFFIXES)
    if place.suffix and not place.is_dir():
        if place.suffix.lower() not in known:
            remedy = f"end it in {', '.join(known[:-1])} or {known[-1]}, or name a folder"
            raise InputError(Fault(_TO, "unknown kind of file", str(place), remedy))
        found = [place]
    else:
        try:
            place.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise write_error(_TO, place, error) from None
        found = [place / name for name in (*_TABLES, _COMPENSATION, _PICTURE)]
    for path in found:
        if path.suffix.lower() in row_tables.KINDS:
            row_tables.check_path(path)
        else:
            check_writable(_TO, path)
    return found


def _write(path: Path, report: WarmUpReport, *, compensation: bool) -> None:
    from ballscrew.table_files import row_tables, warm_up_tables

    if compensation:
        warm_up_tables.write_compensation(path, report)
    elif path.suffix.lower() in row_tables.KINDS:
        warm_up_tables.write(path, report)
    else:
        from ballscrew.figures import files
        from ballscrew.figures import warm_up as figures  # matplotlib is slow to import

        files.draw(lambda: figures.picture(report), path, _TO)

"""``ballscrew warm-up``: how a screw warms up, and what it does."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ballscrew.faces.cli.common_options import AllowCode, AsJson, AsSheet, CaseFile, ModelName, print_answer
from ballscrew.faces.cli.flags import flags_of
from ballscrew.questions.warm_up.options import DriftOptions, WarmUpOptions

if TYPE_CHECKING:
    from ballscrew.cases.case_files.case import Case
    from ballscrew.questions.warm_up.band import WarmUpBandReport

_TO = "--to"
#: Files that a folder gets, with the columns that they have alone.
_FILES = {
    "warm_up.csv": "over time",
    "warm_up.xlsx": "",
    "compensation.csv": "compensation",
    "warm_up_band.csv": "band",
    "warm_up.png": "",
}


@flags_of(DriftOptions, WarmUpOptions)
def warm_up(
    case: CaseFile,
    *,
    written: Mapping[str, Any],
    model: ModelName = None,
    settings: Annotated[
        list[str] | None,
        typer.Option(
            "--set", metavar="SECTION.FIELD=VALUE", help='Change a value: --set surroundings.ambient="25 degC".'
        ),
    ] = None,
    as_json: AsJson = False,
    as_sheet: AsSheet = False,
    to: Annotated[
        list[Path] | None,
        typer.Option(
            _TO,
            "-o",
            metavar="PATH",
            help="Write a folder of tables and a picture; or one .csv, .xlsx, .png, .svg or .pdf; may be repeated.",
        ),
    ] = None,
    allow_code: AllowCode = False,
) -> None:
    """Temperatures, growth and preload over hours. The output has the torque and the steady state, too.

    A case with an [axis] and a [motion] does its motion; one with an [operation] moves to and fro over half the shaft.
    [surroundings] has where the heat goes. Without a steady state the verdict says so: thermal runaway. With --band
    transients are drawn with other surroundings, among them the conduction through the balls, the least known.
    """
    from ballscrew.basis.errors import Fault, InputError, raise_if_any
    from ballscrew.faces.sheets import to_file
    from ballscrew.questions.shared.option_values import read
    from ballscrew.questions.warm_up import answer as documents
    from ballscrew.questions.warm_up import compute as studies
    from ballscrew.questions.warm_up.sheet import sheet

    drift, cool_down = read(DriftOptions, written), written["cool_down"]
    rest = (studies.REST if drift.drift_cycle else 0.0) if cool_down is None else cool_down
    options = read(WarmUpOptions, {**written, "cool_down": rest})
    studies.check_hours(options.hours, options.cool_down)
    if drift.feed_share is not None and not drift.drift_cycle:
        raise InputError(Fault("--feed-share", "needs --drift-cycle", f"{drift.feed_share:g}", "add --drift-cycle"))
    loaded = studies.load(case, settings or [], model, allow_code=allow_code)
    if drift.drift_cycle:
        loaded = studies.drift_cycle(loaded, studies.FEED_SHARE if drift.feed_share is None else drift.feed_share)
    raise_if_any(studies.option_faults(options.band, options.samples, options.level, options.only_given))
    files = [path for place in to or [] for path in _files(place, options.band)]
    banded = _banded(loaded, options) if options.band else None
    report = studies.warmed_up(loaded, options.hours, options.cool_down) if banded is None else banded.report
    seen = sheet(report, banded)
    print_answer(
        seen,
        lambda: documents.document(report) if banded is None else documents.with_band(banded),
        as_json=as_json,
        as_sheet=as_sheet,
    )
    for path in files:
        to_file.write(path, seen, "" if path in (to or []) else _FILES[path.name])
        typer.echo(f"{path}", err=as_json or as_sheet)


def _banded(case: Case, options: WarmUpOptions) -> WarmUpBandReport:
    from ballscrew.faces.cli.progress import progress
    from ballscrew.questions.warm_up import band as studies  # loads xarray

    with progress("band") as done:
        return studies.band(
            case,
            options.hours,
            options.cool_down,
            samples=options.samples,
            level=options.level,
            only_given=options.only_given,
            done=done,
        )


def _files(place: Path, band: bool) -> list[Path]:
    """The files of a place: itself if it ends as one, or those of a folder, which is made. They can be written."""
    from ballscrew.basis.atomic_files import check_writable, write_error
    from ballscrew.basis.errors import Fault, InputError
    from ballscrew.basis.records import Message
    from ballscrew.questions.shared import row_tables
    from ballscrew.questions.shared.chart_files import SUFFIXES

    known = (*row_tables.KINDS, *SUFFIXES)
    if place.suffix and not place.is_dir():
        if place.suffix.lower() not in known:
            remedy = Message(
                "end it in {names} or {known}, or name a folder", {"names": ", ".join(known[:-1]), "known": known[-1]}
            )
            raise InputError(Fault(_TO, "unknown kind of file", str(place), remedy))
        found = [place]
    else:
        try:
            place.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise write_error(_TO, place, error) from None
        found = [place / name for name, columns in _FILES.items() if band or columns != "band"]
    for path in found:
        if path.suffix.lower() in row_tables.KINDS:
            row_tables.check_path(path)
        else:
            check_writable(_TO, path)
    return found

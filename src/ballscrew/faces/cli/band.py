"""The command line of ``ballscrew run --band``."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import typer

from ballscrew.basis.errors import Fault, InputError, raise_if_any
from ballscrew.cases.case_files.case_file import Case
from ballscrew.faces.cli.common_options import print_answer
from ballscrew.questions.band import compute as band
from ballscrew.questions.band import document as documents
from ballscrew.questions.band.options import BandOptions
from ballscrew.questions.band.sheet import sheet
from ballscrew.questions.band.tornado import tornado
from ballscrew.questions.run.compute import run as run_case
from ballscrew.questions.shared import chart_files as files


def check(wanted: bool, options: BandOptions, to: Path | None, self_heating: bool) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` for options without a band, and a picture that cannot be."""
    given = {
        "--samples": options.samples,
        "--level": options.level,
        "--only-given": options.only_given or None,
        "--to": to,
    }
    if not wanted:
        raise_if_any(
            [
                Fault(name, "needs --band", str(value), "add --band")
                for name, value in given.items()
                if value is not None
            ]
        )
    if to is not None and self_heating:
        problem = "draws a curve over the speed, at each of which the oil has another temperature"
        raise InputError(Fault("--to", problem, str(to), "leave it out, or see ballscrew sweep --self-heating"))
    if to is not None:
        files.check_picture(to)


def run_warm(
    case: Case, options: BandOptions, done: Callable[[int, int], None], *, as_json: bool, as_sheet: bool
) -> None:
    """The band of a case as warm as it makes itself: temperature and preload by samples of its surroundings."""
    from ballscrew.questions.band.heat_samples import heat_samples
    from ballscrew.questions.warm_up.self_heating import self_heating
    from ballscrew.questions.warm_up.self_heating_document import with_self_heating

    heating = self_heating(case)
    heat = heat_samples(heating, only_given=options.only_given)
    report = band.band(heating.warm, options, done, heat)

    def document() -> dict[str, Any]:
        return with_self_heating(documents.document(run_case(heating.warm), report), heating)

    print_answer(sheet(heating.warm, report, heating=heating.records), document, as_json=as_json, as_sheet=as_sheet)


def run(
    case: Case,
    options: BandOptions,
    to: Path | None,
    done: Callable[[int, int], None],
    *,
    as_json: bool,
    as_sheet: bool,
) -> None:
    """Compute the band of a case, print it, and draw it where that is asked for."""
    from ballscrew.faces.sheets import to_file

    report = band.band(case, options, done)
    curve, swings = None, None
    if to is not None:
        curve, swings = band.curve(case, report, options, done), tornado(case, report)
    seen = sheet(case, report, curve, swings)
    print_answer(seen, lambda: documents.document(run_case(case), report), as_json=as_json, as_sheet=as_sheet)
    if to is not None:
        to_file.write(to, seen)
        counts = f"{report.band.count} samples of {len(report.inputs)} uncertain inputs"
        typer.echo(f"{to}: {counts}", err=as_json or as_sheet)

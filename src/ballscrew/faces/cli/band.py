"""The command line of ``ballscrew run --band``."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import typer

from ballscrew.basis.errors import Fault, InputError, raise_if_any
from ballscrew.basis.output import json_text
from ballscrew.cases.case_files.case_file import Case
from ballscrew.questions.band import compute as band
from ballscrew.questions.band import document as documents
from ballscrew.questions.band import text
from ballscrew.questions.band.options import BandOptions
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


def run_warm(case: Case, options: BandOptions, as_json: bool, done: Callable[[int, int], None]) -> None:
    """The band of a case as warm as it makes itself: temperature and preload by samples of its surroundings."""
    from ballscrew.basis.output.wrapping import wrapped
    from ballscrew.questions.band.heat_samples import heat_samples
    from ballscrew.questions.warm_up.self_heating import self_heating
    from ballscrew.questions.warm_up.self_heating_document import with_self_heating

    heating = self_heating(case)
    heat = heat_samples(heating, only_given=options.only_given)
    report = band.band(heating.warm, options, done, heat)
    if as_json:
        typer.echo(json_text.as_json(with_self_heating(documents.document(run_case(heating.warm), report), heating)))
    else:
        typer.echo("\n".join(wrapped(record.text) for record in heating.records))
        text.print_band(heating.warm, report)


def run(case: Case, options: BandOptions, to: Path | None, as_json: bool, done: Callable[[int, int], None]) -> None:
    """Compute the band of a case, print it, and draw it where that is asked for."""
    report = band.band(case, options, done)
    if as_json:
        typer.echo(json_text.as_json(documents.document(run_case(case), report)))
    else:
        text.print_band(case, report)
    if to is not None:
        from ballscrew.questions.band import figure as figures  # matplotlib is slow to import

        curve = band.curve(case, report, options, done)
        files.draw(lambda: figures.picture(case, report, curve), to)
        typer.echo(f"{to}: {report.band.count} samples of {len(report.inputs)} uncertain inputs", err=as_json)

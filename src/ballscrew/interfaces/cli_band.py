"""The command line of ``ballscrew run --band``."""

from __future__ import annotations

from collections.abc import Callable

import typer

from ballscrew.interfaces import band, nut_report, report
from ballscrew.interfaces.config import Case


def run(case: Case, options: band.Options, as_json: bool, done: Callable[[int, int], None]) -> None:
    """Compute the band of a case, print it, and draw it where that is asked for."""
    found = band.computed(case, options, done)
    if as_json:
        typer.echo(band.json_text(case, found, _text_of(case)))
    else:
        band.print_band(case, found)
    if options.to is not None:
        band.draw(case, found, options, done)
        typer.echo(f"{options.to}: {found.band.count} samples of {len(found.inputs)} uncertain inputs", err=as_json)


def _text_of(case: Case) -> str:
    """The JSON object of the result without a band."""
    if case.parts is not None:
        return nut_report.json_text(case, case.parts)
    load, speed = case.operation.axial_load, case.operation.screw_speed
    return report.json_text(case, case.model(case.screw, case.lubricant, axial_load=load, screw_speed=speed))

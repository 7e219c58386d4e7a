"""The command line of ``ballscrew run --band``."""

from __future__ import annotations

from collections.abc import Callable

import typer

from ballscrew.interfaces import band, documents
from ballscrew.interfaces.answer import answer
from ballscrew.interfaces.config import Case


def run(case: Case, options: band.Options, as_json: bool, done: Callable[[int, int], None]) -> None:
    """Compute the band of a case, print it, and draw it where that is asked for."""
    found = band.computed(case, options, done)
    if as_json:
        typer.echo(documents.as_json(band.document(answer(case), found)))
    else:
        band.print_band(case, found)
    if options.to is not None:
        band.draw(case, found, options, done)
        typer.echo(f"{options.to}: {found.band.count} samples of {len(found.inputs)} uncertain inputs", err=as_json)

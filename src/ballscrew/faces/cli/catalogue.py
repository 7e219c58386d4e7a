"""``ballscrew catalogue``: rows of catalogues, shipped or one's own."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from ballscrew.faces.cli.common_options import AsJson

app = typer.Typer(
    help="Screws as catalogues list them, and case files made of them.", no_args_is_help=True, rich_markup_mode=None
)

Rows = Annotated[
    Path | None,
    typer.Option("--rows", metavar="FILE", help="A table of your own, .csv or .xlsx, in place of the rows shipped."),
]
KeepGoing = Annotated[
    bool, typer.Option("--keep-going", help="Leave faulty rows of the table out, and say which; fails if none is good.")
]


@app.command("list")
def list_rows(
    words: Annotated[
        list[str] | None, typer.Argument(help="Only rows with these sizes and words: rexroth 40x10.")
    ] = None,
    rows: Rows = None,
    as_json: AsJson = False,
    keep_going: KeepGoing = False,
) -> None:
    """All rows, one line each."""
    from ballscrew.basis.output import json_text
    from ballscrew.cases.screw_tables import catalogue
    from ballscrew.questions.catalogue import text

    found, notes = catalogue.load(rows, keep_going)
    chosen = catalogue.chosen(found, " ".join(words or []), rows)
    _say(notes)
    typer.echo(json_text.as_json(catalogue.list_document(chosen)) if as_json else text.list_text(chosen))


@app.command()
def show(
    name: Annotated[str, typer.Argument(help="Name of the row: hiwin-40-20k4.")],
    rows: Rows = None,
    as_json: AsJson = False,
    as_case: Annotated[bool, typer.Option("--case", help="A case file of the row, ready for ballscrew run.")] = False,
    keep_going: KeepGoing = False,
) -> None:
    """One row: what is listed, what follows from it, what was assumed."""
    from ballscrew.basis.errors import Fault, InputError
    from ballscrew.basis.output import json_text
    from ballscrew.cases.screw_tables import catalogue
    from ballscrew.questions.catalogue import text

    if as_case and as_json:
        raise InputError(Fault("--case", "does not go with --json", "", "give one of the two"))
    found, notes = catalogue.load(rows, keep_going)
    row = catalogue.named(found, name, file=rows)
    _say(notes)
    if as_case:
        typer.echo(catalogue.case_text(row))
    else:
        typer.echo(json_text.as_json(catalogue.show_document(row)) if as_json else text.show_text(row))


def _say(notes: Sequence[str]) -> None:
    """Print omitted rows on the error stream."""
    for note in notes:
        typer.echo(note, err=True)


@app.command()
def own(
    numbers: Annotated[
        str,
        typer.Argument(
            metavar="NUMBERS", help='NAME=VALUE with units, commas between them: "d0=40 mm, lead=10 mm, turns=2x2.5".'
        ),
    ],
    as_json: AsJson = False,
    as_case: Annotated[bool, typer.Option("--case", help="A case file, ready for ballscrew run.")] = False,
) -> None:
    """A nut of your own from a few catalogue numbers.

    It says what is estimated, and makes a case file of it.

    Needed are d0, lead and turns (all circuits of one nut body); each of Ca, C0a, ball, dp, dr, starts, nut, preload,
    D1 that is given makes the rest better.
    """
    from ballscrew.basis.errors import Fault, InputError
    from ballscrew.basis.output import json_text
    from ballscrew.cases.screw_tables import catalogue
    from ballscrew.cases.screw_tables.own_nut import numbers_in, own_nut_of
    from ballscrew.questions.catalogue import own_nut

    if as_case and as_json:
        raise InputError(Fault("--case", "does not go with --json", "", "give one of the two"))
    found = own_nut_of(numbers_in(numbers))
    if as_case:
        typer.echo(catalogue.case_text(found.row, found.estimates))
        _say([f"warning: {line}" for line in own_nut.warnings(found)])
    else:
        typer.echo(json_text.as_json(own_nut.document(found)) if as_json else own_nut.text(found))

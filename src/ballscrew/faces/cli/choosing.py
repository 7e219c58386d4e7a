"""Commands on the rows of catalogues, and on a nut of your own."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ballscrew.faces.cli.options import AsJson, print_answer
from ballscrew.faces.cli.progress import print_notes_of_rows

catalogue = typer.Typer(
    help="Screws as catalogues list them, and case files made of them.", no_args_is_help=True, rich_markup_mode=None
)

CatalogueRows = Annotated[
    Path | None,
    typer.Option("--rows", metavar="FILE", help="A table of your own, .csv or .xlsx, in place of the rows shipped."),
]
KeepGoingInTable = Annotated[
    bool, typer.Option("--keep-going", help="Leave faulty rows of the table out, and say which; fails if none is good.")
]


@catalogue.command("list")
def list_rows(
    words: Annotated[
        list[str] | None, typer.Argument(help="Only rows with these sizes and words: rexroth 40x10.")
    ] = None,
    rows: CatalogueRows = None,
    as_json: AsJson = False,
    keep_going: KeepGoingInTable = False,
) -> None:
    """All rows, one line each."""
    from ballscrew.cases.screw_tables import catalogue as tables
    from ballscrew.questions import catalogue

    screws, notes = tables.load(rows, keep_going)
    chosen = tables.chosen(screws, " ".join(words or []), rows)
    print_notes_of_rows(notes)
    print_answer(lambda: catalogue.list_text(chosen), lambda: tables.list_document(chosen), as_json=as_json)


@catalogue.command()
def show(
    name: Annotated[str, typer.Argument(help="Name of the row: hiwin-40-20k4.")],
    rows: CatalogueRows = None,
    as_json: AsJson = False,
    as_case: Annotated[bool, typer.Option("--case", help="A case file of the row, ready for ballscrew run.")] = False,
    keep_going: KeepGoingInTable = False,
) -> None:
    """One row: what is listed, what follows from it, what was assumed."""
    from ballscrew.basis.errors import Fault, InputError
    from ballscrew.cases.screw_tables.catalogue import case_text, load, named, show_document
    from ballscrew.questions import catalogue

    if as_case and as_json:
        raise InputError(Fault("--case", "does not go with --json", "", "give one of the two"))
    screws, notes = load(rows, keep_going)
    row = named(screws, name, file=rows)
    print_notes_of_rows(notes)
    if as_case:
        typer.echo(case_text(row))
    else:
        print_answer(lambda: catalogue.show_text(row), lambda: show_document(row), as_json=as_json)


@catalogue.command()
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
    from ballscrew.cases.screw_tables.catalogue import case_text
    from ballscrew.cases.screw_tables.own_nut import numbers_in, own_nut_of
    from ballscrew.questions import catalogue

    if as_case and as_json:
        raise InputError(Fault("--case", "does not go with --json", "", "give one of the two"))
    nut = own_nut_of(numbers_in(numbers))
    if as_case:
        typer.echo(case_text(nut.row, nut.estimates))
        print_notes_of_rows([f"warning: {line}" for line in catalogue.warnings(nut)])
    else:
        print_answer(lambda: catalogue.own_nut_text(nut), lambda: catalogue.own_nut_document(nut), as_json=as_json)

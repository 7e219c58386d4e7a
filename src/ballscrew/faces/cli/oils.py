"""``ballscrew oils``: oils and greases of the library or of one's own file."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ballscrew.faces.cli.common_options import AsJson

app = typer.Typer(help="Oils and greases as their makers state them.", no_args_is_help=True, rich_markup_mode=None)

File = Annotated[
    Path | None,
    typer.Option("--oils", metavar="FILE", help="A file of your own, .toml, in place of the library."),
]


@app.command("list")
def list_oils(
    words: Annotated[list[str] | None, typer.Argument(help="Only oils with these words: arcanol polyurea.")] = None,
    file: File = None,
    as_json: AsJson = False,
) -> None:
    """All oils, one line each."""
    from ballscrew.basis.output import json_text
    from ballscrew.cases.case_files import oil_library as oils
    from ballscrew.questions.oils import document as documents
    from ballscrew.questions.oils import text

    found = oils.chosen(oils.oils(file), " ".join(words or []))
    typer.echo(json_text.as_json(documents.document(found)) if as_json else text.list_text(found))


@app.command()
def show(
    name: Annotated[str, typer.Argument(help='Name of the oil: "Arcanol LOAD150".')],
    file: File = None,
    as_json: AsJson = False,
) -> None:
    """One oil: its data sheet, and its viscosities.

    The viscosities are from -40 to 120 degC.
    """
    from ballscrew.basis.output import json_text
    from ballscrew.cases.case_files import oil_library as oils
    from ballscrew.questions.oils import document as documents
    from ballscrew.questions.oils import text

    sheet = oils.oils(file).named(name)
    typer.echo(json_text.as_json(documents.document([sheet])) if as_json else text.show_text(sheet))

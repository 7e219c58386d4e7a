"""``ballscrew list``: the names that case files and options take."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ballscrew.faces.cli.common_options import AsJson


def list_names(
    kind: Annotated[str, typer.Argument(metavar="KIND", help="grades, laws, models, inputs or outputs.")],
    case: Annotated[
        Path | None, typer.Argument(help="A case file; inputs and outputs are then those of its model and nut.")
    ] = None,
    words: Annotated[
        list[str] | None, typer.Option("--word", metavar="WORD", help="Only lines with this word, such as film.")
    ] = None,
    as_json: AsJson = False,
) -> None:
    """List grades, laws, models, inputs or outputs. Grades are those of oils; inputs are what can be varied."""
    from ballscrew.basis.output.json_text import as_json as json_text
    from ballscrew.cases.case_files import case_file
    from ballscrew.questions.names import compute, text

    found = compute.names(kind, None if case is None else case_file.load(case))
    found = [one for one in found if all(word.lower() in " ".join(one).lower() for word in words or ())]
    typer.echo(json_text(compute.document(kind, found)) if as_json else text.text(found))

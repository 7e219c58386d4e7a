"""``ballscrew cite``: the sources of a case as BibTeX."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ballscrew.faces.cli.common_options import AllowCode, ModelName, Settings


def cite(
    case: Annotated[Path | None, typer.Argument(help="Case file; without one, all sources.")] = None,
    model: ModelName = None,
    settings: Settings = None,
    allow_code: AllowCode = False,
) -> None:
    """BibTeX of the sources that a case makes use of."""
    from ballscrew.basis.references import bibliography
    from ballscrew.cases.case_files import case_file

    entries = bibliography()
    keys = (
        list(entries)
        if case is None
        else case_file.references(case_file.load(case, settings or [], model, allow_code=allow_code))
    )
    typer.echo("\n\n".join(entries[key] for key in keys))

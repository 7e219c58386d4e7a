"""``ballscrew fit`` on a log of a moving axis. The work is done in ``studies/fit_motion``."""

from __future__ import annotations

from pathlib import Path

import typer

from ballscrew.cases.case import Case
from ballscrew.studies.moving_log import MovingOptions, moving_log


def fit_moving(
    case: Case, log: Path, test: Path | None, options: MovingOptions, *, as_json: bool, picture: Path | None
) -> None:
    """Fit a case to a moving log, and print, or draw, what is found."""
    read = moving_log(case, log, options)
    other = None if test is None else moving_log(case, test, options, usual_gain=read.gain)
    # solvers are slow to import: only for a log that can be read
    from ballscrew.documents import fit_motion as documents
    from ballscrew.output.json_text import as_json as json_text
    from ballscrew.studies import fit_motion as studies
    from ballscrew.text import fit_motion as text

    found = studies.fit(case, read, other, options)
    if as_json:
        typer.echo(json_text(documents.document(case, found)))
    else:
        text.print_motion_fit(case, found)
    if picture is not None:
        from ballscrew.figures import files
        from ballscrew.figures import fit_motion as figures  # matplotlib is slow to import

        files.draw(lambda: figures.picture(case, found), picture, "--picture")
        typer.echo(f"{picture}: {found.equation.used.size} rows", err=as_json)

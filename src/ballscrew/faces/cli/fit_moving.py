"""``ballscrew fit`` on a log of a moving axis."""

from __future__ import annotations

from pathlib import Path

import typer

from ballscrew.cases.case_files.case import Case
from ballscrew.questions.fit_motion.log import MovingOptions, moving_log


def fit_moving(
    case: Case, log: Path, test: Path | None, options: MovingOptions, *, as_json: bool, picture: Path | None
) -> None:
    """Fit a case to a moving log, and print, or draw, what is found."""
    read = moving_log(case, log, options)
    other = None if test is None else moving_log(case, test, options, usual_gain=read.gain)
    # solvers are slow to import: only for a log that can be read
    from ballscrew.basis.output.json_text import as_json as json_text
    from ballscrew.questions.fit_motion import compute, text
    from ballscrew.questions.fit_motion import document as documents

    found = compute.fit(case, read, other, options)
    if as_json:
        typer.echo(json_text(documents.document(case, found)))
    else:
        text.print_motion_fit(case, found)
    if picture is not None:
        from ballscrew.questions.fit_motion import figure as figures  # matplotlib is slow to import
        from ballscrew.questions.shared import chart_files as files

        files.draw(lambda: figures.picture(case, found), picture, "--picture")
        typer.echo(f"{picture}: {found.equation.used.size} rows", err=as_json)

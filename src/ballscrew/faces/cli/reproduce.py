"""``ballscrew reproduce``: the figures, data and claims of a paper, and the reference model on a preloaded nut."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def reproduce(
    paper: Annotated[str, typer.Argument(help="The paper: olaru2005.")],
    out: Annotated[Path, typer.Option("--out", metavar="DIR", help="Folder for figures, data and claims.")],
) -> None:
    """Figures, data and claims of a paper. Beside them the reference model on a preloaded nut."""
    from ballscrew.basis.errors import Fault, InputError, nearest

    if paper != "olaru2005":
        raise InputError(Fault("reproduce", "unknown paper", paper, nearest(paper, ["olaru2005"])))
    from ballscrew.questions.reproduce.reproduction import reproduce_olaru2005

    files, summary = reproduce_olaru2005(out, _step)
    for line in summary:
        typer.echo(line)
    typer.echo(f"{out}: {len(files)} files; read claims.md and preloaded_nut.md first")


def _step(what: str, done: int, total: int) -> None:
    """One line a step on the error stream."""
    typer.echo(f"[{done}/{total}] {what}", err=True)

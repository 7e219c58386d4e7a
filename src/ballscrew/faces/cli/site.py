"""``ballscrew site``: the model as a static page."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def site(
    out: Annotated[Path, typer.Argument(metavar="OUT", help="Folder to write into; with --single also a file .html.")],
    single: Annotated[bool, typer.Option("--single", help="One HTML file that holds all, to send or to open.")] = False,
    model: Annotated[
        list[str] | None, typer.Option("--model", metavar="NAME", help="Only this model; may be repeated.")
    ] = None,
    nut: Annotated[
        list[str] | None, typer.Option("--nut", metavar="KIND", help="Only this kind of nut; may be repeated.")
    ] = None,
) -> None:
    """Write a page that computes in the browser alone. It needs neither a server nor Python.

    The folder can be put on any web server; a single file opens by a double click. To write it takes the compiler
    of the extra "fast"; to use it takes nothing.
    """
    from ballscrew.faces.cli.progress import progress
    from ballscrew.faces.site import site as pages

    pages.check_place(out, single=single)
    with progress("modules") as done:
        files = pages.site(model or (), nut or (), single=single, done=done)
    written = pages.write(out, files)
    size = sum(len(content) for content in files.values())
    place = written[-1]
    typer.echo(f"{place}: {len(written)} file{'s' if len(written) > 1 else ''}, {size / 1e6:.2f} MB")

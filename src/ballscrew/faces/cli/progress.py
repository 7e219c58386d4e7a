"""The error stream: a bar for those who wait, what is logged meanwhile, and notes on the work that was done."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Generator, Mapping, Sequence
from typing import Any

import typer

from ballscrew.faces.cli import INTERRUPTED


@contextlib.contextmanager
def progress(what: str, cost: str = "") -> Generator[Callable[[int, int], None]]:
    """A progress bar on the error stream, for ``done(finished, total)`` points; silent where nobody looks.

    Above it stands what the work will cost, where that is known before it starts. An interrupt says how far it came.
    """
    reached = (0, 0)
    with _bar(what, cost) as show:

        def done(finished: int, total: int) -> None:
            nonlocal reached
            reached = finished, total
            show(finished, total)

        try:
            yield done
        except KeyboardInterrupt as error:
            if not getattr(error, "__notes__", ()):  # a store says itself what it keeps
                finished, total = reached
                share = f"at {finished:,} of {total:,}" if total else "at the beginning"
                error.add_note(f"{what}: interrupted {share}, nothing is kept · run the same again")
            raise


@contextlib.contextmanager
def _bar(what: str, cost: str) -> Generator[Callable[[int, int], None]]:
    if not sys.stderr.isatty():
        yield _silent
        return
    if cost:
        sys.stderr.write(f"{cost}\n")
    from rich.console import Console
    from rich.progress import Progress, Task, TextColumn

    class Rate(TextColumn):
        def render(self, task: Task) -> Any:
            self.text_format = "" if not task.speed else f"{task.speed:,.0f} points/s"
            return super().render(task)

    columns = (*Progress.get_default_columns(), Rate(""))
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(what, total=None)
        yield lambda finished, total: bar.update(task, completed=finished, total=total)


def _silent(*_: int) -> None:
    """Nothing, for nobody looks."""


def print_notes_of_rows(notes: Sequence[str], interrupted: bool = False) -> None:
    """Print notes on rows of tables; after Ctrl-C the command ends with its exit code."""
    for note in notes:
        typer.echo(note, err=True)
    if interrupted:
        raise typer.Exit(INTERRUPTED)


def print_engine(attributes: Mapping[str, Any]) -> None:
    """Print the engine that evaluated, and why it was that one."""
    reason = attributes.get("engine_reason")
    typer.echo(f"evaluated by {attributes['engine']}" + (f": {reason}" if reason else ""), err=True)


#: What logs that something is compiled.
_COMPILER = "ballscrew.compiler.kernels"


@contextlib.contextmanager
def log_on_stderr() -> Generator[None]:
    """Show on the error stream what the package logs; that something is compiled is said on a terminal in any case."""
    import logging  # not for those who ask for help only

    class Echo(logging.Handler):
        def emit(self, record: logging.LogRecord) -> None:
            if not record.name.startswith(_COMPILER):
                sys.stderr.write(f"{record.getMessage()}\n")  # that of a bar, where there is one: above it

    logger, handler = logging.getLogger("ballscrew"), Echo()
    before = logger.level
    logger.addHandler(handler)
    logger.setLevel(logging.INFO)
    try:
        yield
    finally:
        logger.setLevel(before)
        logger.removeHandler(handler)

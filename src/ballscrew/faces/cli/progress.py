"""A bar for those who wait."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Generator
from typing import Any


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

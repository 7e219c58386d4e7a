"""A bar for those who wait."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Generator
from typing import Any


@contextlib.contextmanager
def progress(what: str, cost: str = "") -> Generator[Callable[[int, int], None]]:
    """A progress bar on the error stream, for ``done(finished, total)`` points; silent where nobody looks.

    Above it stands what the work will cost, where that is known before it starts.
    """
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

"""Values that show and draw themselves in a notebook.

How they look is decided by the face ``notebook``, above all else. It registers itself here (:func:`shown_by`), so that
the physics imports nothing of it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

#: Lines of the text of a value in a notebook or at a prompt.
LINES_OF_REPR = 10

_loaders: list[Callable[[str], Any]] = []


def shown_by(load: Callable[[str], Any]) -> None:
    """Let ``load`` give the modules ``tables`` and ``pictures`` of the face that shows values; the last one counts."""
    _loaders[:] = [load]


def notebook(module: str) -> Any:
    """A module of the face that shows values: ``tables`` or ``pictures``."""
    (load,) = _loaders
    return load(module)


def shortened(lines: Sequence[str], most: int) -> list[str]:
    """The first of the lines, with the number of the others, where there are more than ``most``."""
    return list(lines) if len(lines) <= most else [*lines[: most - 1], f"… and {len(lines) - most + 1} more"]


class Displayed:
    """A value with a table in a notebook."""

    def _repr_html_(self) -> str:
        return notebook("tables").html(self)


class Drawn(Displayed):
    """A value with a table and a picture in a notebook."""

    def plot(self) -> Any:
        """Picture of this, which a notebook shows; its ``save(path)`` writes .png, .svg or .pdf.

        Its ``figure`` is one of matplotlib. Raises :class:`~ballscrew.basis.errors.InputError` for what has no picture.
        """
        return notebook("pictures").picture(self)

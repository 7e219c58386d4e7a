"""Values that show and draw themselves in a notebook.

How they look is decided in the room ``notebook``, above all others. It is loaded by its name when somebody looks, as
the public names of the package are: the rooms of the physics import nothing of it.
"""

from __future__ import annotations

import importlib
from typing import Any


def _notebook(module: str) -> Any:
    return importlib.import_module(f"ballscrew.notebook.{module}")


class Displayed:
    """A value with a table in a notebook."""

    def _repr_html_(self) -> str:
        return _notebook("tables").html(self)


class Drawn(Displayed):
    """A value with a table and a picture in a notebook."""

    def plot(self) -> Any:
        """Picture of this, which a notebook shows; its ``save(path)`` writes .png, .svg or .pdf.

        Its ``figure`` is one of matplotlib. Raises :class:`~ballscrew.errors.InputError` for what has no picture.
        """
        return _notebook("pictures").picture(self)

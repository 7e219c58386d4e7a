"""Picture files: the kinds that can be written, and the one way in which a figure is written to a file."""

from __future__ import annotations

import io
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from ballscrew.basis.atomic_files import atomic_write, check_writable
from ballscrew.basis.errors import Fault, InputError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SUFFIXES = (".png", ".svg", ".pdf")


def check_picture(to: Path, option: str = "--to") -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` if no picture can be written there."""
    if to.suffix.lower() not in SUFFIXES:
        raise InputError(Fault(option, "unknown kind of file", str(to), "end it in .png, .svg or .pdf"))
    check_writable(option, to)


def draw(figure: Callable[[], Figure], to: Path, option: str = "--to") -> None:
    """Draw a figure in the house style and write it, whole or not at all."""
    from ballscrew.questions.shared import (
        charts,  # matplotlib is slow to import: only where a picture is drawn
    )

    buffer = io.BytesIO()
    with charts.house_style():
        charts.save_as(figure(), buffer, to.suffix.lower().removeprefix("."))
    with atomic_write(option, to) as path:
        path.write_bytes(buffer.getvalue())

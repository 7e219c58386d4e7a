"""A sheet written to a file: tables (.csv, .xlsx) or a picture (.png, .svg, .pdf)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

from ballscrew.basis.atomic_files import check_writable
from ballscrew.basis.errors import Fault, raise_if_any
from ballscrew.basis.output.sheet import Sheet
from ballscrew.questions.shared import charts, every_row


def check(paths: Iterable[Path], own_kinds: Sequence[str] = ()) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` now for files that could not be written later.

    ``own_kinds`` are kinds of files that a question writes beside tables and pictures.
    """
    *others, last = (*every_row.KINDS, *charts.SUFFIXES, *own_kinds)
    remedy = f"end it in {', '.join(others)} or {last}"
    unknown = [path for path in paths if path.suffix.lower() not in (*others, last)]
    raise_if_any([Fault("--to", "unknown kind of file", str(path), remedy) for path in unknown])
    for path in paths:
        if path.suffix.lower() in own_kinds:
            check_writable("--to", path)
        elif path.suffix.lower() in every_row.KINDS:
            every_row.check_path(path)
        else:
            charts.check_picture(path)


def write(to: Path, sheet: Sheet, name: str = "", option: str = "--to") -> None:
    """Write one file, whole or not at all: .csv has the columns of a name, or the first; ``option`` asks for it."""
    if to.suffix.lower() in every_row.KINDS:
        from ballscrew.faces.sheets import files

        files.write(to, sheet, name)
    else:
        from ballscrew.faces.sheets import pictures  # matplotlib is slow to import

        charts.draw(lambda: pictures.picture(sheet), to, option)

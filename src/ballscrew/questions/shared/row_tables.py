"""Tables with a row for each screw as CSV or XLSX, numbers in the units of their headings."""

from __future__ import annotations

import csv
import importlib.util
import io
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from ballscrew.basis.atomic_files import check_writable
from ballscrew.basis.errors import Fault, InputError

_DIGITS = 12
#: Endings of files that are written.
KINDS = (".csv", ".xlsx")


class RowTable(NamedTuple):
    """Headings, and the cells of each row below them."""

    headings: Sequence[str]
    rows: Sequence[Sequence[Any]]


# -- files ----------------------------------------------------------------------------------------


def check_path(to: Path) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` now for a file that could not be written later."""
    if to.suffix.lower() not in KINDS:
        raise InputError(Fault("--to", "unknown kind of file", str(to), "end it in .csv or .xlsx"))
    if to.suffix.lower() == ".xlsx" and importlib.util.find_spec("xlsxwriter") is None:
        raise InputError(Fault("--to", "needs xlsxwriter", str(to), 'pip install "ballscrew[data]"'))
    check_writable("--to", to)


def write_csv(path: Path, table: RowTable) -> None:
    """The rows of a table as CSV, below its headings."""
    with path.open("w", encoding="utf-8", newline="") as stream:
        csv.writer(stream, lineterminator="\n").writerows([table.headings, *table.rows])


def xlsx_bytes(tables: Mapping[str, RowTable]) -> bytes:
    """A workbook with a sheet for each table, by title."""
    import xlsxwriter

    buffer = io.BytesIO()
    workbook = xlsxwriter.Workbook(buffer, {"in_memory": True})
    bold = workbook.add_format({"bold": True})
    for title, table in tables.items():
        sheet = workbook.add_worksheet(title)
        sheet.freeze_panes(1, 1)
        for number, row in enumerate([table.headings, *table.rows]):
            sheet.write_row(number, 0, row, bold if number == 0 else None)
        sheet.autofit()
    workbook.close()
    return buffer.getvalue()

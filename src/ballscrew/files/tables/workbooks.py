"""Cells of a spreadsheet, read in a process of its own: a damaged or hostile file may end it or fill the memory.

This module imports little, because each file waits for its imports.
"""

from __future__ import annotations

import io
import zipfile
from typing import Any

#: Bytes that the parts of a spreadsheet may have unpacked: a million rows of ten numbers have half of it.
MOST_UNPACKED = 1 << 30
#: Cells up to the last one; a full column has a million.
MOST_CELLS = 20_000_000


def rows_of(data: bytes) -> list[tuple[int, list[Any]]]:
    """The rows of the first sheet that has any, each with its number; blank rows and comments are left out.

    Raises ``ValueError`` for what cannot be read.
    """
    from python_calamine import CalamineError, CalamineWorkbook

    _check_size(data)
    try:
        workbook = CalamineWorkbook.from_filelike(io.BytesIO(data))
        for name in workbook.sheet_names:
            sheet = workbook.get_sheet_by_name(name)
            _check_extent(sheet.end)
            rows = sheet.to_python(skip_empty_area=False)
            pairs = [(line, cells) for line, row in enumerate(rows, start=1) if _counts(cells := _stripped(row))]
            if pairs:
                return pairs
    except CalamineError as error:
        raise ValueError(str(error)) from None
    return []


def _check_size(data: bytes) -> None:
    """Refuse an archive that unpacks to more than is read, as its directory has it."""
    if not zipfile.is_zipfile(file := io.BytesIO(data)):
        return
    with zipfile.ZipFile(file) as archive:
        unpacked = sum(part.file_size for part in archive.infolist())
    if unpacked > MOST_UNPACKED:
        raise ValueError(f"it unpacks to {unpacked / 2**30:.1f} GiB, {MOST_UNPACKED / 2**30:g} GiB at most")


def _check_extent(end: tuple[int, int] | None) -> None:
    """Refuse a sheet whose last cell is so far out that all cells up to it do not fit into the memory."""
    row, column = (0, 0) if end is None else (1 + end[0], 1 + end[1])
    if row * column > MOST_CELLS:
        raise ValueError(f"it has a cell in row {row}, column {column}: {row * column:,} cells, {MOST_CELLS:,} at most")


def _stripped(row: list[Any]) -> list[Any]:
    return [cell.strip() if isinstance(cell, str) else cell for cell in row]


def _counts(cells: list[Any]) -> bool:
    """Test whether a row belongs to the table: it is neither blank nor a comment."""
    filled = [cell for cell in cells if cell != ""]
    return bool(filled) and not (len(filled) == 1 and str(filled[0]).startswith("#"))

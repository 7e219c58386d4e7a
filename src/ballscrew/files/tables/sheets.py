"""Files with a table in them, as numbered rows of cells: text with delimiters, or a spreadsheet.

Of a spreadsheet the first sheet that is not empty counts; cells with an error in them (#DIV/0!) read as empty.
"""

from __future__ import annotations

import codecs
import csv
import importlib.util
import io
import itertools
import re
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from ballscrew.basis import child_process
from ballscrew.basis.atomic_files import read_bytes
from ballscrew.basis.errors import Fault, InputError
from ballscrew.files.tables import workbooks

#: Bytes of a table at most: its cells take some forty times as much memory.
LARGEST_TABLE = 50_000_000
#: Endings of files that are read as spreadsheets, and how such files begin whatever they are called.
SPREADSHEETS = (".xlsx", ".xlsm", ".xlsb", ".xls", ".ods")
_MAGIC = (b"PK\x03\x04", b"\xd0\xcf\x11\xe0")
_DELIMITERS = (";", "\t", ",")
#: The headings stand within this many rows: some tables have a title above them.
HEADINGS_WITHIN = 10
#: Columns of a table at most: each is looked up among all names that are known.
MOST_COLUMNS = 5_000
#: A spreadsheet may begin with a line for other spreadsheets: which delimiter it has.
_DECLARATION = "sep="
#: What spreadsheets write for a cell that went wrong; no comment, though it begins like one.
_ERROR = re.compile(r"#(?:N/A|NV|[A-ZÄÖÜ0-9/]+[!?])")


class Record(NamedTuple):
    """The cells of a row, and the number that an editor or a spreadsheet shows beside it."""

    line: int
    cells: Sequence[Any]


def records(path: Path, is_heading: Callable[[str], bool]) -> list[Record]:
    """The rows of a file that are neither blank nor comments.

    Of the delimiters, the one that makes most headings counts. Raises
    :class:`~ballscrew.basis.errors.InputError` for what is no table.
    """
    data = _bytes(path)
    result = (
        _of_spreadsheet(path, data)
        if is_spreadsheet(path, data)
        else in_text(path, data.decode(encoding_of(path, data)), is_heading)
    )
    if not result:
        raise InputError(Fault(str(path), "is empty", "", "give a table with headings and rows"))
    return result


def is_spreadsheet(path: Path, begin: bytes) -> bool:
    """Test whether a file is a spreadsheet, by its name or its first bytes."""
    return path.suffix.lower() in SPREADSHEETS or begin.startswith(_MAGIC)


def unreadable(path: Path, error: OSError | ValueError) -> InputError:
    """The error of a file that cannot be opened."""
    missing = isinstance(error, FileNotFoundError)
    reason = "" if missing else getattr(error, "strerror", None) or str(error)
    problem = "does not exist" if missing else "cannot be read"
    return InputError(Fault(str(path), problem, reason, "give the path of a CSV or XLSX file"))


def _bytes(path: Path) -> bytes:
    try:
        return read_bytes(path, LARGEST_TABLE)
    except (OSError, ValueError) as error:
        raise unreadable(path, error) from None


def encoding_of(path: Path, data: bytes, whole: bool = True) -> str:
    """Encoding of a text: UTF-8, UTF-16 if they begin so, or else the old encoding of Western spreadsheets.

    Bytes that are not the ``whole`` of a file may end within a letter.
    """
    wide = data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
    for encoding in ("utf-16",) if wide else ("utf-8-sig", "cp1252"):
        try:
            text = codecs.getincrementaldecoder(encoding)().decode(data, whole)
        except UnicodeDecodeError:
            continue
        if "\0" not in text:
            return encoding
    raise InputError(Fault(str(path), "is neither text nor a spreadsheet", "", "save it as CSV in UTF-8, or as XLSX"))


def in_text(path: Path, text: str, is_heading: Callable[[str], bool], within: int = HEADINGS_WITHIN) -> list[Record]:
    """The rows of a text, whose headings stand within so many of them."""
    line = 0
    try:
        delimiter = delimiter_of(text, is_heading, within)
        result: list[Record] = []
        lines = iter(io.StringIO(text, newline=""))
        for first in lines:
            line += 1
            if not _counts(first):
                continue
            # a quoted cell may go on over several lines
            reader = csv.reader(itertools.chain([first], lines), delimiter=delimiter, strict=True)
            cells = [cell.strip() for cell in next(reader)]
            if any(cells):
                result.append(Record(line, cells))
            line += reader.line_num - 1
    except csv.Error as error:
        where = f"{path.name} row {line}" if line else str(path)
        raise InputError(Fault(where, "cannot be split into cells", str(error), "check its quotes")) from None
    return result


def _counts(line: str) -> bool:
    """Test whether a line of text belongs to the table."""
    start = line.strip()
    comment = start.startswith("#") and not is_error(start)
    return bool(start) and not comment and not start.lower().startswith(_DECLARATION)


def is_error(cell: str) -> bool:
    """Test whether a cell begins with an error of a spreadsheet."""
    return _ERROR.match(cell) is not None


def delimiter_of(text: str, is_heading: Callable[[str], bool], within: int = HEADINGS_WITHIN) -> str:
    """The delimiter that makes most headings of a line near the top, or else most cells."""
    lines = list(itertools.islice(filter(_counts, io.StringIO(text, newline="")), within))

    def score(delimiter: str) -> tuple[int, int]:
        try:
            split = list(csv.reader(lines, delimiter=delimiter))
        except csv.Error:  # a cell longer than any: whoever splits the text with this delimiter finds it again
            return 0, 0
        widest = max(map(len, split), default=0)
        if widest > MOST_COLUMNS:  # it is refused: no heading is looked up
            return 0, widest
        return max((sum(map(is_heading, cells)) for cells in split), default=0), widest

    return max(_DELIMITERS, key=score)


def _of_spreadsheet(path: Path, data: bytes) -> list[Record]:
    if importlib.util.find_spec("python_calamine") is None:
        remedy = 'pip install "ballscrew[data]", or save it as CSV'
        raise InputError(Fault(str(path), "needs python-calamine", "", remedy))
    try:
        return [Record(line, cells) for line, cells in child_process.call(workbooks.rows_of, data)]
    except child_process.ChildError as error:
        remedy = "save the table alone, without cells far from it and without a password, as XLSX or CSV"
        raise InputError(Fault(str(path), "is no spreadsheet that can be read", str(error), remedy)) from None

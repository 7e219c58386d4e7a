"""Files of a log as records and pieces of cells: text, a spreadsheet or a file of MATLAB."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any, BinaryIO, Protocol

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.errors import Fault, InputError
from ballscrew.files.tables.sheets import Record, is_spreadsheet, records
from ballscrew.files.torque_logs.columns import Layout, is_heading
from ballscrew.files.torque_logs.matlab_files import is_matlab, variables
from ballscrew.files.torque_logs.text_files import Piece, TextLog, size_of


class LogSource(Protocol):
    """A file of a log: the first records, in which the headings are, then its rows in pieces."""

    @property
    def found(self) -> Sequence[Record]:
        """The first rows of the file."""
        ...

    @property
    def empty_bytes(self) -> int:
        """The number of empty bytes at the end of the file, which are left out."""
        ...

    def pieces(self, layout: Layout, rows: int) -> Iterator[Piece]:
        """The rows below the headings, at most so many at a time where the format allows it."""
        ...

    def digest(self) -> str:
        """SHA-256 of the file."""
        ...


class SheetLog:
    """A log as a spreadsheet: all of its rows are one piece."""

    empty_bytes = 0

    def __init__(self, path: Path) -> None:
        self._path = path
        self.found: Sequence[Record] = records(path, is_heading)

    def pieces(self, layout: Layout, rows: int) -> Iterator[Piece]:  # noqa: ARG002  (of LogSource)
        """The rows below the headings."""
        body = [row for row in self.found if row.line > layout.line]
        cells = {heading.place: _column(body, heading.place) for heading in layout.headings.values()}
        yield Piece(cells, np.array([row.line for row in body], dtype=np.int64), False)

    def digest(self) -> str:
        """SHA-256 of the file."""
        return hashlib.sha256(self._path.read_bytes()).hexdigest()


class MatlabLog:
    """A log as a file of MATLAB: the variables are the columns, and their rows one piece."""

    empty_bytes = 0

    def __init__(self, path: Path, begin: bytes) -> None:
        self._path = path
        arrays, _ = variables(path, begin)
        sizes = {name: values.size for name, values in arrays.items()}
        if len(set(sizes.values())) > 1:
            listed = ", ".join(f"{name} {size}" for name, size in sizes.items())
            raise InputError(Fault(path.name, "has columns of different lengths", listed, "give every column each row"))
        self._columns = list(arrays.values())
        top = [Record(1 + row, [values[row] for values in self._columns]) for row in range(min(5, self._rows))]
        self.found: Sequence[Record] = [Record(0, list(arrays)), *top]

    @property
    def _rows(self) -> int:
        return self._columns[0].size

    def pieces(self, layout: Layout, rows: int) -> Iterator[Piece]:  # noqa: ARG002  (of LogSource)
        """The rows of the arrays."""
        cells = {heading.place: self._columns[heading.place] for heading in layout.headings.values()}
        yield Piece(cells, np.arange(1, 1 + self._rows), False)

    def digest(self) -> str:
        """SHA-256 of the file."""
        return hashlib.sha256(self._path.read_bytes()).hexdigest()


def source_of(path: Path, file: BinaryIO, done: Callable[[int, int], None] | None) -> LogSource:
    """The source of an open file, by its name or by its first bytes. Raises for a file that is empty."""
    begin, size = file.read(512), size_of(file)
    file.seek(0)
    if not begin:
        raise InputError(Fault(str(path), "is empty", "", "give a table with headings and rows"))
    if is_matlab(path, begin):
        return MatlabLog(path, begin)
    if is_spreadsheet(path, begin):
        return SheetLog(path)
    return TextLog(path, file, None if done is None else lambda read: done(read, size))


def _column(body: Sequence[Record], place: int) -> NDArray[Any]:
    cells = np.empty(len(body), dtype=object)
    cells[:] = [row.cells[place] if place < len(row.cells) else "" for row in body]
    return cells

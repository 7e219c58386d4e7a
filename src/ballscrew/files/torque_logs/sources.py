"""Files of a log as records and pieces of cells: text, a spreadsheet or a file of MATLAB.

Logs in files of MATLAB: every variable is a column, or every field of the only struct.

Logs as text, read piece by piece: a log of ten million rows takes no more memory than one of a million.
"""

from __future__ import annotations

import csv
import hashlib
import importlib.util
import io
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple, Protocol

import numpy as np
import pandas
from numpy.typing import NDArray

from ballscrew.basis import child_process
from ballscrew.basis.errors import Fault, InputError
from ballscrew.files.tables.cells import COMMA, MISSING
from ballscrew.files.tables.sheets import Record, delimiter_of, encoding_of, in_text, is_error, is_spreadsheet, records
from ballscrew.files.torque_logs import matlab_arrays
from ballscrew.files.torque_logs.columns import WITHIN, Layout, is_heading

#: How files of MATLAB begin: those up to version 7, and those since.
OLD, NEW = b"MATLAB 5.0 MAT-file", b"MATLAB 7.3 MAT-file"
_HDF5 = b"\x89HDF\r\n\x1a\n"
_REMEDY = "save the columns as arrays of one length, or one struct of them, with save(..., '-v7')"


def is_matlab(path: Path, begin: bytes) -> bool:
    """Test whether a file is MATLAB's, by its name or its first bytes."""
    return path.suffix.lower() == ".mat" or begin.startswith((OLD, NEW))


def variables(path: Path, begin: bytes) -> tuple[dict[str, NDArray[np.float64]], dict[str, float]]:
    """The columns of a file by name, and its single numbers.

    Raises :class:`~ballscrew.basis.errors.InputError` if there are no columns.
    """
    hdf5 = begin.startswith((NEW, _HDF5))
    if hdf5 and importlib.util.find_spec("h5py") is None:
        remedy = "pip install \"ballscrew[data]\", or save it with save(..., '-v7')"
        raise InputError(Fault(str(path), "needs h5py", "", remedy))
    try:
        names, columns, numbers = child_process.call(matlab_arrays.columns, str(path), hdf5)
    except child_process.ChildError as error:
        raise InputError(Fault(str(path), "is no file of MATLAB that can be read", str(error), _REMEDY)) from None
    if not columns:
        raise InputError(Fault(str(path), "has no columns of numbers", ", ".join(names), _REMEDY))
    return columns, numbers


pd: Any = pandas  # its own types know little of what comes out
#: The headings and what a number looks like are found in so many bytes at the top of a file, and so many of their rows.
_TOP, _TOP_ROWS = 1 << 20, 5000


class Piece(NamedTuple):
    """Some rows as read: cells by place, their numbers in the file, and whether the file may end within the last."""

    cells: dict[int, Any]
    line: NDArray[np.int64]
    cut_off: bool


class HashingReader(io.RawIOBase):
    """A file that is hashed as it is read, with its position, its last byte, and bytes that are no text."""

    def __init__(self, file: BinaryIO, wide: bool, done: Callable[[int], None] | None) -> None:
        self._file, self._wide, self._done = file, wide, done
        self._hash = hashlib.sha256()
        self.size = 0
        self.last = b""
        #: Where empty bytes begin, as those a machine leaves behind that was switched off; whether others follow.
        self.empty_from: int | None = None
        self.is_junk = False

    def readable(self) -> bool:  # noqa: D102  (of io.RawIOBase)
        return True

    def readinto(self, buffer: Any) -> int:  # noqa: D102  (of io.RawIOBase)
        while data := self._file.read(len(buffer)):
            self._hash.update(data)
            kept = data if self._wide else self._without_empty(data)
            self.size += len(data)
            self.last = kept[-1:] or self.last
            if self._done is not None:
                self._done(self.size)
            if kept:
                buffer[: len(kept)] = kept
                return len(kept)
        return 0

    def _without_empty(self, data: bytes) -> bytes:
        at = data.find(0)
        if at < 0 and self.empty_from is None:
            return data
        rest = data if self.empty_from is not None else data[at:]
        if self.empty_from is None:
            self.empty_from = self.size + at
        self.is_junk |= bool(rest.strip(b"\0"))
        return data[: max(at, 0)] if self.empty_from >= self.size else b""

    def digest(self) -> str:
        """SHA-256 of the whole file, to the end of which it is read."""
        while self.readinto(bytearray(1 << 20)):
            pass
        return self._hash.hexdigest()


class _Below:
    """A text below a line of empty cells, which says how many cells a row may have: the reader drops any beyond."""

    def __init__(self, text: io.TextIOBase, cells: int, delimiter: str) -> None:
        self._text, self._first = text, delimiter * (cells - 1) + "\n"

    def read(self, size: int = -1) -> str:
        first, self._first = self._first, ""
        return first or self._text.read(size)

    def __iter__(self) -> Iterator[str]:
        yield from iter(self.read, "")


class TextLog:
    """A log as text: its top at once, its rows piece by piece."""

    def __init__(self, path: Path, file: BinaryIO, done: Callable[[int], None] | None) -> None:
        self.path = path
        top = file.read(_TOP)
        whole = len(top) < _TOP
        text = top.rstrip(b"\0") if whole and not top.startswith((b"\xff\xfe", b"\xfe\xff")) else top
        self._encoding = encoding_of(path, text, whole)
        wide = self._encoding == "utf-16"
        shown = text.decode(self._encoding, "ignore")
        lines = shown.splitlines(keepends=True)
        shown = "".join(lines[: _TOP_ROWS if whole else min(_TOP_ROWS, max(1, len(lines) - 1))])
        self._quoted = '"' in shown
        self._delimiter = delimiter_of(shown, is_heading, WITHIN)
        #: The first rows, in which the headings are.
        self.found: Sequence[Record] = in_text(path, shown, is_heading, WITHIN)
        file.seek(0)
        self._reader = HashingReader(file, wide, done)

    def pieces(self, layout: Layout, rows: int) -> Iterator[Piece]:
        """The rows below the headings, so many at a time."""
        text = io.TextIOWrapper(io.BufferedReader(self._reader, 1 << 20), self._encoding, "replace")
        for _ in range(layout.line):
            text.readline()
        width = max(layout.width, 1 + max(heading.place for heading in layout.headings.values()))
        used = sorted({0, *(heading.place for heading in layout.headings.values()), width})
        first = layout.line  # where the line of empty cells stands
        try:
            reader = pd.read_csv(
                _Below(text, width + 1, self._delimiter),
                sep=self._delimiter,
                header=None,
                usecols=used,
                index_col=False,
                chunksize=rows,
                na_values=list(MISSING),
                keep_default_na=False,
                skip_blank_lines=False,
                skipinitialspace=True,
                low_memory=False,
                decimal="," if layout.decimal == COMMA else ".",
                quoting=csv.QUOTE_MINIMAL if self._quoted else csv.QUOTE_NONE,
            )
            held: Any = None
            for frame in reader:
                if held is not None:
                    yield self._piece(held, first, width, layout)
                    first += len(held)
                held = frame
            if held is not None:
                yield self._piece(held, first, width, layout, self._reader.last not in (b"\n", b"\r"))
        except pd.errors.ParserError as error:
            raise InputError(
                Fault(str(self.path), "cannot be split into cells", str(error), "check its quotes")
            ) from None
        if self._reader.is_junk:
            where = f"{self.path.name} from byte {self._reader.empty_from}"
            raise InputError(Fault(where, "is no text", "", "the file is damaged: cut it off there"))

    def digest(self) -> str:
        """SHA-256 of the file."""
        return self._reader.digest()

    @property
    def empty_bytes(self) -> int:
        """Number of empty bytes at the end of the file."""
        return 0 if self._reader.empty_from is None else self._reader.size - self._reader.empty_from

    def _piece(self, frame: Any, first: int, width: int, layout: Layout, at_end: bool = False) -> Piece:
        line = np.arange(first, first + len(frame))
        cells = {place: frame[place].to_numpy() for place in frame.columns}
        beyond = np.flatnonzero(~pd.isna(frame[width]).to_numpy())
        if beyond.size:
            where, problem = (
                f"{layout.file} row {line[beyond[0]]}",
                f"has more cells than the headings, {layout.width}",
            )
            raise InputError(Fault(where, problem, "", "put quotes around text that holds a delimiter"))
        keep = _not_comments(cells[0])
        if not keep.all():
            line, cells = line[keep], {place: values[keep] for place, values in cells.items()}
        return Piece(cells, line, at_end)


def _not_comments(cells: NDArray[Any]) -> NDArray[np.bool_]:
    if cells.dtype.kind in "fiub":
        return np.ones(cells.size, dtype=bool)
    return np.array([not (isinstance(c, str) and c.startswith("#") and not is_error(c)) for c in cells], dtype=bool)


def size_of(file: BinaryIO) -> int:
    """Size of a file in bytes."""
    return os.fstat(file.fileno()).st_size


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


class _WholeFile:
    """A log whose rows are one piece."""

    empty_bytes = 0

    def __init__(self, path: Path) -> None:
        self._path = path

    def digest(self) -> str:
        """SHA-256 of the file."""
        return hashlib.sha256(self._path.read_bytes()).hexdigest()


class SheetLog(_WholeFile):
    """A log as a spreadsheet: all of its rows are one piece."""

    def __init__(self, path: Path) -> None:
        super().__init__(path)
        self.found: Sequence[Record] = records(path, is_heading)

    def pieces(self, layout: Layout, rows: int) -> Iterator[Piece]:  # noqa: ARG002  (of LogSource)
        """The rows below the headings."""
        body = [row for row in self.found if row.line > layout.line]
        cells = {heading.place: _column(body, heading.place) for heading in layout.headings.values()}
        yield Piece(cells, np.array([row.line for row in body], dtype=np.int64), False)


class MatlabLog(_WholeFile):
    """A log as a file of MATLAB: the variables are the columns, and their rows one piece."""

    def __init__(self, path: Path, begin: bytes) -> None:
        super().__init__(path)
        #: Numbers that are no columns, by name.
        self.numbers: Mapping[str, float]
        self._columns, self.numbers = variables(path, begin)
        rows = min(5, *(values.size for values in self._columns.values()))
        top = [Record(1 + row, [values[row] for values in self._columns.values()]) for row in range(rows)]
        self.found: Sequence[Record] = [Record(0, list(self._columns)), *top]

    def pieces(self, layout: Layout, rows: int) -> Iterator[Piece]:  # noqa: ARG002  (of LogSource)
        """The rows of the arrays. Raises for columns of different lengths."""
        places = sorted(heading.place for heading in layout.headings.values())
        every = list(self._columns.items())
        sizes = {every[place][0]: every[place][1].size for place in places}
        if len(set(sizes.values())) > 1:
            listed = ", ".join(f"{name} {size}" for name, size in sizes.items())
            remedy = "give every column each row"
            raise InputError(Fault(self._path.name, "has columns of different lengths", listed, remedy))
        yield Piece({place: every[place][1] for place in places}, np.arange(1, 1 + max(sizes.values())), False)


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

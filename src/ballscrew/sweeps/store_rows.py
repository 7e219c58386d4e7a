"""The table of blocks of a store: size and checksum of every chunk, and counts of false truth values, as CSV.

Each row ends with a checksum of itself, so that a damaged row is not taken for a block.
"""

from __future__ import annotations

import csv
import io
import zlib
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from ballscrew.errors import (
    Fault,
    InputError,
)

#: The field that errors name, and the remedy for a store that exists already.
WHERE = "sweep.to"
OTHER = "choose another name, or remove it"
#: The remedy for files without the right to read them.
READABLE = "make it readable"
#: The folder of metadata of this package in a store.
OWN = ".ballscrew"
#: Suffixes of the headings of columns: sizes of chunks, and counts of false truth values.
BYTES, FALSE = " bytes", " false"


class Content(NamedTuple):
    """Size and checksum (CRC-32) of a file."""

    bytes: int
    checksum: str

    @classmethod
    def of(cls, key: str, content: Any) -> Content:
        """That of a file under its path in the store: the same content elsewhere has another checksum."""
        view = memoryview(content).cast("B") if len(content) else b""
        return cls(len(view), f"{zlib.crc32(view, zlib.crc32(key.encode())):08x}")


def unreadable(path: Path, error: OSError | ValueError, remedy: str = OTHER) -> InputError:
    """The error of a file of a store that cannot be read; without the right to, the remedy is to get it."""
    why = getattr(error, "strerror", None) or str(error)
    remedy = READABLE if isinstance(error, PermissionError) else remedy
    return InputError(Fault(WHERE, "cannot be read", f"{path}: {why}", remedy))


def count_false(path: Path) -> dict[str, tuple[int, int]]:
    """For each truth value of a complete store that is false somewhere: how often, and the first block with it."""
    found: dict[str, tuple[int, int]] = {}
    try:
        for block in _rows(path):
            for heading, cell in block.items():
                name, truth, _ = heading.partition(FALSE)
                if truth and (count := int(cell)):
                    before, first = found.get(name, (0, int(block["block"])))
                    found[name] = before + count, first
    except (OSError, ValueError) as error:
        where = str(path / OWN / "blocks.csv")
        raise InputError(Fault(WHERE, "has checksums that cannot be read", f"{where}: {error}", OTHER)) from None
    return found


def _rows(path: Path) -> Iterator[dict[str, str]]:
    with (path / OWN / "blocks.csv").open("rb") as file:
        heading = cells_of(next(file, b""))
        for line in file:
            cells = cells_of(line)
            if heading is None or cells is None or len(cells) != len(heading):
                raise ValueError("a damaged row")
            yield dict(zip(heading, cells, strict=True))


def row(cells: Sequence[Any]) -> bytes:
    """The cells of a row, and their checksum, as a line of text."""
    text = io.StringIO()
    csv.writer(text, lineterminator=",").writerow(cells)
    line = text.getvalue().encode()
    return line + f"{zlib.crc32(line):08x}\n".encode()


def cells_of(line: bytes) -> list[str] | None:
    """The cells of a row; None where it is damaged."""
    body, comma, checksum = line.rpartition(b",")
    if checksum != f"{zlib.crc32(body + comma):08x}\n".encode():
        return None
    return next(csv.reader([body.decode()]))

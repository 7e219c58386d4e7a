"""The table of blocks of a store: size and checksum of every chunk, and counts of false truth values, as CSV.

Each row ends with a checksum of itself, so that a damaged row is not taken for a block. All checksums are bound to the
plan, by its digest: what was written for another store has other checksums, wherever it is copied to.
"""

from __future__ import annotations

import csv
import io
import zlib
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from ballscrew.basis.errors import (
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
    def of(cls, plan: str, key: str, content: Any) -> Content:
        """That of a file of a plan, by its digest, under its path in the store: elsewhere it has another checksum."""
        view = memoryview(content).cast("B") if len(content) else b""
        return cls(len(view), f"{zlib.crc32(view, zlib.crc32(f'{plan} {key}'.encode())):08x}")


def unreadable(path: Path, error: OSError | ValueError, remedy: str = OTHER) -> InputError:
    """The error of a file of a store that cannot be read; without the right to, the remedy is to get it."""
    why = getattr(error, "strerror", None) or str(error)
    remedy = READABLE if isinstance(error, PermissionError) else remedy
    return InputError(Fault(WHERE, "cannot be read", f"{path}: {why}", remedy))


def row(plan: str, cells: Sequence[Any]) -> bytes:
    """The cells of a row, and their checksum in the store of a plan, by its digest, as a line of text."""
    text = io.StringIO()
    csv.writer(text, lineterminator="").writerow(cells)  # a comma, which ends it, is refused here from Python 3.13 on
    line = f"{text.getvalue()},".encode()
    return line + _checksum(plan, line)


def cells_of(plan: str, line: bytes) -> list[str] | None:
    """The cells of a row; None where it is damaged, or of another plan."""
    body, comma, checksum = line.rpartition(b",")
    if checksum != _checksum(plan, body + comma):
        return None
    return next(csv.reader([body.decode()]))


def _checksum(plan: str, line: bytes) -> bytes:
    return f"{zlib.crc32(line, zlib.crc32(plan.encode())):08x}\n".encode()

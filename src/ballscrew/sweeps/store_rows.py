"""The table of blocks of a store: checksums and counts of false truth values, one row per block, as CSV."""

from __future__ import annotations

import csv
import io
import zlib
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ballscrew.errors import (
    Fault,
    InputError,
)

#: The field that errors name, and the remedy for a store that exists already.
WHERE = "sweep.to"
OTHER = "choose another name, or remove it"
#: The folder of metadata of this package in a store.
OWN = ".ballscrew"
#: Suffix of the heading of a column that counts false truth values.
FALSE = " false"


def count_false(path: Path) -> dict[str, tuple[int, int]]:
    """For each truth value of a complete store that is false somewhere: how often, and the first block with it."""
    found: dict[str, tuple[int, int]] = {}
    try:
        for block in rows(path):
            for heading, cell in block.items():
                name, truth, _ = heading.partition(FALSE)
                if truth and (count := int(cell)):
                    before, first = found.get(name, (0, int(block["block"])))
                    found[name] = before + count, first
    except (OSError, ValueError, TypeError, AttributeError) as error:
        where = str(path / OWN / "blocks.csv")
        raise InputError(Fault(WHERE, "has checksums that cannot be read", f"{where}: {error}", OTHER)) from None
    return found


def rows(path: Path) -> Iterator[dict[str, str]]:
    """For every block of a complete store its checksums, and how often each truth value is false."""
    with (path / OWN / "blocks.csv").open(encoding="utf-8", newline="") as file:
        yield from csv.DictReader(file)


def crc(values: np.ndarray) -> str:
    """The checksum of numbers, in the order of the grid."""
    buffer: Any = np.ascontiguousarray(values).reshape(-1).view(np.uint8)
    return f"{zlib.crc32(buffer):08x}"


def row(cells: Sequence[Any]) -> bytes:
    """The cells of a row as a line of text."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerow(cells)
    return text.getvalue().encode()

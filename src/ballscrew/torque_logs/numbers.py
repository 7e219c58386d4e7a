"""Cells of a log as numbers in SI: fast where they are plain numbers, one by one where they are not."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas
from numpy.typing import NDArray

from ballscrew.analyses.log_motion import Floats
from ballscrew.analyses.torque_log import seconds
from ballscrew.faults import Fault, InputError
from ballscrew.interfaces import decimals
from ballscrew.interfaces.headings import NOTHING, Heading
from ballscrew.interfaces.log_columns import CLOCK, Layout
from ballscrew.interfaces.rows import shown, value_of
from ballscrew.quantities import within_bounds

#: The decimal marks of a file with decimal commas only.
COMMA = frozenset(",")
pd: Any = pandas  # its own types know little of what comes out
#: What stands for a value that is missing.
MISSING = (*NOTHING, "nan", "NaN", "NAN", "-nan", "-NaN")
#: So many faults are enough to say that a file is not one of numbers.
_ENOUGH = 1000
#: So many cells are looked at for a decimal mark, if the top of the file has none.
_LOOKED_AT = 10_000


@dataclasses.dataclass
class Cells:
    """Makes numbers of the cells of a log, piece by piece, and keeps what is wrong with them."""

    layout: Layout
    keep_going: bool
    faults: list[Fault] = dataclasses.field(default_factory=list[Fault])
    #: Rows with a fault.
    bad_rows: int = 0
    _origin: Any = None

    def numbers(
        self, columns: Mapping[str, Any], line: NDArray[np.int64], at_end: bool = False
    ) -> tuple[dict[str, Floats], NDArray[np.bool_]]:
        """The columns in SI, and which rows are good: without faults, headings or nothing at all in them.

        Of a row ``at_end`` of a file that stops short, faults are not told: it was being written.
        """
        found: dict[str, Floats] = {}
        bad = np.zeros(line.size, dtype=bool)
        words = np.ones(line.size, dtype=bool)
        faults: list[tuple[int, Fault]] = []
        for name, cells in columns.items():
            heading = self.layout.headings[name]
            values, wrong = self._dates(cells) if heading.column.quantity is None else self._plain(cells, heading)
            texts = np.array([shown(cells[place]) in self.layout.words for place in wrong], dtype=bool)
            is_word = np.zeros(line.size, dtype=bool)
            is_word[wrong[texts]] = True
            words &= is_word
            found[name] = values
            faults += self._one_by_one(name, cells, wrong[~texts], line, values)
            faults += self._of_words(name, cells, wrong[texts], line)
        faults = [(place, fault) for place, fault in faults if not words[place]]
        if at_end:
            faults = [(place, fault) for place, fault in faults if place != line.size - 1]
        bad[[place for place, _ in faults]] = True
        self._keep(faults)
        self.bad_rows += int(bad.sum())
        empty = np.all([np.isnan(values) for values in found.values()], axis=0)
        return found, ~(bad | empty)

    def _keep(self, faults: list[tuple[int, Fault]]) -> None:
        ordered = sorted(faults, key=lambda placed: placed[0])
        self.faults += [fault for _, fault in ordered][: _ENOUGH - len(self.faults)]
        if len(self.faults) >= _ENOUGH and not self.keep_going:
            raise InputError(*self.faults)

    def _plain(self, cells: Any, heading: Heading) -> tuple[Floats, NDArray[np.int64]]:
        """Numbers in SI, and the places of cells that are more than a plain number or out of bounds."""
        quantity = heading.column.quantity
        assert quantity is not None
        array = np.asarray(cells)
        values = array.astype(np.float64) if array.dtype.kind in "fiu" else _read(array, self.layout.decimal)
        given = ~np.isnan(values) if array.dtype.kind in "fiu" else np.array([not _is_missing(cell) for cell in array])
        values = heading.offset + heading.scale * values if heading.unit else np.full(values.shape, np.nan)
        return values, np.flatnonzero(given & ~within_bounds(quantity.info, values))

    def _one_by_one(
        self, name: str, cells: Any, places: NDArray[np.int64], line: NDArray[np.int64], values: Floats
    ) -> list[tuple[int, Fault]]:
        heading = self.layout.headings[name]
        faults: list[tuple[int, Fault]] = []
        for place in map(int, places):
            where, cell = self.layout.where(int(line[place]), name), cells[place]
            cell = cell.item() if isinstance(cell, np.generic) else cell
            values[place] = np.nan
            if heading.column.quantity is None:
                remedy = "write times like 2024-05-31 12:00:00.5, all in the same way"
                faults.append((place, Fault(where, "is no date and time", shown(cell), remedy)))
            else:
                value = value_of(where, cell, shown(cell), heading, self.layout.decimal)
                if isinstance(value, Fault):
                    faults.append((place, value))
                else:
                    values[place] = value
            if len(faults) >= _ENOUGH and not self.keep_going:
                break
        return faults

    def _of_words(
        self, name: str, cells: Any, places: NDArray[np.int64], line: NDArray[np.int64]
    ) -> list[tuple[int, Fault]]:
        """Faults of words of the headings among the numbers; they are none where the whole row is of headings."""
        return [
            (place, Fault(self.layout.where(int(line[place]), name), "is not a number", shown(cells[place])))
            for place in map(int, places)
        ]

    def _dates(self, cells: Any) -> tuple[Floats, NDArray[np.int64]]:
        """Seconds from the first date of the file, and the places of cells that are no dates."""
        texts = pd.Series([None if _is_missing(cell) else str(cell) for cell in cells], dtype=object)
        given = texts.notna().to_numpy()
        texts = texts.str.replace(",", ".", regex=False)
        if self.layout.dates == CLOCK:
            found = pd.to_timedelta(texts, errors="coerce").to_numpy(dtype="timedelta64[ns]")
        else:
            dates = pd.to_datetime(texts, format=self.layout.dates, errors="coerce", utc=True)
            found = dates.dt.tz_localize(None).to_numpy(dtype="datetime64[ns]")
        wrong = np.flatnonzero(given & np.isnat(found))
        if self._origin is None and not np.isnat(found).all():
            self._origin = found[~np.isnat(found)][:1]
        if self._origin is None:
            return np.full(found.shape, np.nan), wrong
        return seconds(np.concatenate([self._origin, found]))[1:], wrong


def _is_missing(cell: Any) -> bool:
    return cell is None or (isinstance(cell, float) and np.isnan(cell)) or (isinstance(cell, str) and cell in MISSING)


def _read(cells: NDArray[Any], decimal: frozenset[str]) -> Floats:
    """The cells that are plain numbers, whatever their decimal mark is, as long as it can be no other; else NaN."""
    texts = pd.Series([cell if isinstance(cell, str) else None for cell in cells], dtype=object)
    decimal = decimal or decimals.evidence(cell for cell in cells[:_LOOKED_AT] if isinstance(cell, str))
    if decimal == COMMA:
        texts = texts.where(~texts.str.contains(".", regex=False, na=False)).str.replace(",", ".", regex=False)
    values = pd.to_numeric(texts, errors="coerce").to_numpy(dtype=np.float64, copy=True)
    for place, cell in enumerate(cells):
        if isinstance(cell, int | float) and not isinstance(cell, bool):
            values[place] = cell
    return values

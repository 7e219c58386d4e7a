"""Numbers of a log in SI, piece by piece, from its cells: the columns at once, then the other cells one by one."""

from __future__ import annotations

import dataclasses
from collections import Counter
from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas
from numpy.typing import NDArray

from ballscrew.basis.errors import Fault, InputError
from ballscrew.files.tables.cells import NOT_A_NUMBER, shown, value_of
from ballscrew.files.tables.number_columns import column_numbers, is_missing
from ballscrew.files.tables.sheets import is_error
from ballscrew.files.torque_logs.columns import CLOCK, Layout
from ballscrew.files.torque_logs.log_rows import seconds
from ballscrew.files.torque_logs.motion import Floats

pd: Any = pandas  # its own types know little of what comes out
#: With this many faults a file is no log.
_MAXIMUM_FAULTS = 1000


@dataclasses.dataclass
class NumberReader:
    """Reads the numbers of a log piece by piece, and collects the faults of its cells."""

    layout: Layout
    keep_going: bool
    #: Whether faulty rows can be left out: then the remedy of a fault says how.
    may_keep_going: bool = True
    faults: list[Fault] = dataclasses.field(default_factory=list[Fault])
    #: Rows with a fault.
    bad_rows: int = 0
    #: Errors of a spreadsheet in the cells, by what they say.
    errors: Counter[str] = dataclasses.field(default_factory=Counter[str])
    _origin: Any = None

    def numbers(
        self, columns: Mapping[str, Any], line: NDArray[np.int64], at_end: bool = False
    ) -> tuple[dict[str, Floats], NDArray[np.bool_]]:
        """The columns in SI, and which rows are good: without faults, headings or nothing at all in them.

        Of a row ``at_end`` of a file that stops short, faults do not count: it was being written.
        """
        floats: dict[str, Floats] = {}
        bad = np.zeros(line.size, dtype=bool)
        words = np.ones(line.size, dtype=bool)
        faults: list[tuple[int, Fault]] = []
        for name, cells in columns.items():
            heading = self.layout.headings[name]
            if np.asarray(cells).dtype.kind not in "fiub":
                self.errors.update(cell for cell in cells if isinstance(cell, str) and is_error(cell))
            values, wrong = (
                self._dates(cells)
                if heading.column.quantity is None
                else column_numbers(cells, heading, self.layout.decimal)
            )
            texts = np.array([shown(cells[place]) in self.layout.words for place in wrong], dtype=bool)
            is_word = np.zeros(line.size, dtype=bool)
            is_word[wrong[texts]] = True
            words &= is_word
            floats[name] = values
            faults += self._one_by_one(name, cells, wrong[~texts], line, values)
            faults += self._of_words(name, cells, wrong[texts], line)
        faults = [(place, fault) for place, fault in faults if not words[place]]
        if at_end:
            faults = [(place, fault) for place, fault in faults if place != line.size - 1]
        bad[[place for place, _ in faults]] = True
        self._keep(faults)
        self.bad_rows += int(bad.sum())
        empty = np.all([np.isnan(values) for values in floats.values()], axis=0)
        return floats, ~(bad | empty)

    def _keep(self, faults: list[tuple[int, Fault]]) -> None:
        ordered = sorted(faults, key=lambda placed: placed[0])
        self.faults += [fault for _, fault in ordered][: _MAXIMUM_FAULTS - len(self.faults)]
        if len(self.faults) >= _MAXIMUM_FAULTS and not self.keep_going:
            raise InputError(*self.faults)

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
                    faults.append((place, self._with_option(value)))
                else:
                    values[place] = value
            if len(faults) >= _MAXIMUM_FAULTS and not self.keep_going:
                break
        return faults

    def _with_option(self, fault: Fault) -> Fault:
        """A fault of a word among the numbers, with the option that leaves its row out."""
        if fault.id != NOT_A_NUMBER or self.keep_going or not self.may_keep_going:
            return fault
        remedy = f"{fault.remedy}, or leave such rows out: --keep-going"
        return dataclasses.replace(fault, remedy=remedy)

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
        texts = pd.Series([None if is_missing(cell) else str(cell) for cell in cells], dtype=object)
        given = texts.notna().to_numpy()
        texts = texts.str.replace(",", ".", regex=False)
        if self.layout.dates == CLOCK:
            result = pd.to_timedelta(texts, errors="coerce").to_numpy(dtype="timedelta64[ns]")
        else:
            dates = pd.to_datetime(texts, format=self.layout.dates, errors="coerce", utc=True)
            result = dates.dt.tz_localize(None).to_numpy(dtype="datetime64[ns]")
        wrong = np.flatnonzero(given & np.isnat(result))
        if self._origin is None and not np.isnat(result).all():
            self._origin = result[~np.isnat(result)][:1]
        if self._origin is None:
            return np.full(result.shape, np.nan), wrong
        return seconds(np.concatenate([self._origin, result]))[1:], wrong

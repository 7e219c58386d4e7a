"""Torque logs read from files: bytes to records, layout of the columns, numbers in SI, rows of the log.

As in all tables, a number needs a unit: in its heading, in a row of units below, behind the number, or in
``--column torque="M_ist [N m]"``. Every row is used, or counted with the reason why not.

The columns of a log at a glance: each heading of a file, what it is taken for, and the cells below it.
"""

from __future__ import annotations

import dataclasses
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
import pandas
from numpy.typing import NDArray

from ballscrew.basis import units
from ballscrew.basis.errors import LINES_AT_MOST, Fault, InputError, raise_if_any
from ballscrew.files.tables.cells import NOT_A_NUMBER, column_numbers, is_missing, shown, value_of
from ballscrew.files.tables.headings import BRACKETS, Heading, bare, known_heading_of
from ballscrew.files.tables.sheets import Record, is_error, unreadable
from ballscrew.files.torque_logs.cleaning import HELD
from ballscrew.files.torque_logs.columns import (
    CLOCK,
    COLUMNS,
    NO_LOAD,
    TEMPERATURE,
    TORQUES,
    WITHIN,
    Layout,
    columns_not_used,
    layout,
    temperatures_among,
)
from ballscrew.files.torque_logs.log_rows import REQUIRED, fault_of_celsius, seconds
from ballscrew.files.torque_logs.motion import FeedRates, Floats
from ballscrew.files.torque_logs.reservoir_sampler import ReservoirSampler
from ballscrew.files.torque_logs.sources import Piece, size_of, source_of
from ballscrew.files.torque_logs.torque_log import TorqueLog

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


#: Rows of text that are read at a time.
CHUNK = 200_000
UNREADABLE, CUT_OFF = "a value cannot be read", "the file ends within the row"


def read(
    path: Path,
    columns: Mapping[str, str] | None = None,
    *,
    torque_constant: float | None = None,
    lead: float | None = None,
    keep_going: bool = False,
    done: Callable[[int, int], None] | None = None,
    held: int = HELD,
    chunk: int = CHUNK,
) -> TorqueLog:
    """The log of a file, in SI; :meth:`~ballscrew.files.torque_logs.torque_log.TorqueLog.cleaned` makes it fit for a
    fit.

    ``columns`` says which heading a column has, and in which unit it is, where the file does not: ``"M_ist [N m]"``; or
    what it is in every row: ``"0 N"``. A current needs the ``torque_constant`` (N m/A), a feed rate the ``lead`` (m).
    ``done`` gets the bytes read so far and those of the file. A log longer than ``held`` rows is thinned while it
    is read, ``chunk`` rows at a time.

    Raises :class:`~ballscrew.basis.errors.InputError` for faults of the file as a whole, and for cells that are no
    numbers; with ``keep_going`` their rows are left out and counted.
    """
    path, columns = Path(path), columns or {}
    try:
        with path.open("rb") as file:
            return _read(path, file, columns, (torque_constant, lead), keep_going, done, held, chunk)
    except (OSError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        raise unreadable(path, error) from None


def _read(
    path: Path,
    file: BinaryIO,
    columns: Mapping[str, str],
    factors: tuple[float | None, float | None],
    keep_going: bool,
    done: Callable[[int, int], None] | None,
    held: int,
    chunk: int,
) -> TorqueLog:
    source = source_of(path, file, done)
    if not source.found:
        raise InputError(Fault(str(path), "is empty", "", "give a table with headings and rows"))
    place = layout(path, source.found, columns)
    _check_factors(place, *factors)
    log, numbers, rates = _gathered(place, source.pieces(place, chunk), factors, keep_going, held)
    digest = source.digest()
    notes = [columns_not_used(place.unused)] if place.unused else []
    notes += [NO_LOAD] if place.assumes_no_load else []
    if TEMPERATURE not in place.headings and (others := temperatures_among(place.unused)):
        notes.append(f"if {others[0]} is the temperature of the oil, give --column temperature={others[0]}")
    if numbers.errors:
        kinds, count = ", ".join(sorted(numbers.errors)), sum(numbers.errors.values())
        notes.append(f"{units.number(count)} cells hold errors of a spreadsheet ({kinds}): they count as missing")
    if rates is not None:
        through = units.number(2 * rates.lines.half_width + 1)
        notes.append(
            (
                f"the speed is that of the position over the time, from straight lines through {through} rows, as the "
                f"noise in the first {units.number(held)} allows"
            )
            if rates.rows > held
            else f"the speed is that of the position over the time, from straight lines through {through} rows"
        )
    if source.empty_bytes:
        notes.append(f"the file ends with {units.number(source.empty_bytes)} empty bytes, which are left out")
    if done is not None:
        size = size_of(file)
        done(size, size)
    log = dataclasses.replace(log, source=(path.name, digest), assumes_no_load=place.assumes_no_load)
    return log.with_notes(*notes, *_describe_faults(numbers))


def _check_factors(place: Layout, torque_constant: float | None, lead: float | None) -> None:
    faults: list[Fault] = []
    for name, factor, option in (
        ("current", torque_constant, 'give --torque-constant "0.5 N m/A"'),
        ("feed_rate", lead, "give the lead of the screw, or a column with its speed"),
        ("position", lead, "give the lead of the screw, or a column with its speed"),
    ):
        if (where := _place_of(name, place)) and factor is None:
            needs = "torque constant" if name == "current" else "lead"
            faults.append(Fault(where, f"needs the {needs}", "", option))
    if (where := _place_of("position", place)) and not _place_of("time", place):
        faults.append(Fault(where, "gives no speed without the time", "", "give a column with the time, or the speed"))
    raise_if_any(faults)


def _place_of(name: str, place: Layout) -> str:
    """The place of a column in messages; empty where there is none."""
    if name in place.headings:
        return f'{place.file} column "{place.headings[name].written}"'
    return f"--column {name}" if name in place.constants else ""


def _gathered(
    place: Layout,
    pieces: Iterator[Piece],
    factors: tuple[float | None, float | None],
    keep_going: bool,
    held: int,
) -> tuple[TorqueLog, NumberReader, FeedRates | None]:
    torque_constant, lead = factors
    cells, gathering, cut_off = NumberReader(place, keep_going), ReservoirSampler(held), 0
    rates = FeedRates(held) if "position" in {*place.headings, *place.constants} else None

    def gather(rows: dict[str, NDArray[Any]]) -> None:
        good = rows.pop("good")
        if "feed_rate" in rows and lead is not None:
            rows["screw_speed"] = 2 * np.pi / lead * rows.pop("feed_rate")
        line = rows.pop("line")[good]
        gathering.add({name: column[good] for name, column in rows.items()}, line)

    for piece in pieces:
        raw = {name: piece.cells[heading.place] for name, heading in place.headings.items()}
        values, good = cells.numbers(raw, piece.line, piece.cut_off)
        named = _named(values, place, piece.line.size, torque_constant)
        if piece.cut_off and good.size and _lacks(named, -1):
            good[-1] = False
            cut_off = 1
        rows = {**named, "line": piece.line, "good": good}
        gather(rows if rates is None else rates.add(rows))
    if rates is not None and rates.rows:
        gather(rates.end())
    if not keep_going:
        raise_if_any(cells.faults)
    if not gathering.rows:
        raise_if_any(cells.faults)
        raise InputError(Fault(place.file, "has no rows below its headings", "", "give one row for each measurement"))
    _check_filled(place, gathering)
    log = gathering.log(TORQUES[place.torque])
    if log.temperature is not None and (heading := place.headings.get(TEMPERATURE)) is not None:
        where = f'{place.file} column "{heading.written}"'
        celsius = fault_of_celsius(where, log.temperature, "write [degC] in its heading if these are °C")
        raise_if_any([] if celsius is None else [celsius])
    counts = {**log.left_out, UNREADABLE: cells.bad_rows, CUT_OFF: cut_off}
    left_out = {reason: count for reason, count in counts.items() if count}
    return dataclasses.replace(log, left_out=left_out, rows=gathering.rows + cells.bad_rows + cut_off), cells, rates


def _named(
    values: Mapping[str, Floats], place: Layout, rows: int, torque_constant: float | None
) -> dict[str, NDArray[Any]]:
    """The columns of a log from those of a file; a feed rate or a position in place of the speed stays."""
    constants = {name: np.full(rows, value) for name, value in place.constants.items()}
    result = {**constants, **values}
    if "current" in result and torque_constant is not None:
        result["torque"] = torque_constant * result.pop("current")
    for name in TORQUES:
        if name in result:
            result["torque"] = result.pop(name)
    return result


def _lacks(named: Mapping[str, Floats], row: int) -> bool:
    return any(bool(np.isnan(named[name][row])) for name in (*REQUIRED, "feed_rate", "position") if name in named)


def _check_filled(place: Layout, gathering: ReservoirSampler) -> None:
    """Raise for columns that are needed and empty."""
    ours = {"torque": place.torque, "screw_speed": place.speed}
    raise_if_any(
        [
            Fault(
                f'{place.file} column "{place.headings[heading].written}"',
                "is empty",
                "",
                "give it numbers, or another column",
            )
            for name in REQUIRED
            if not gathering.known.get(name) and (heading := ours.get(name, name)) in place.headings
        ]
    )


def _describe_faults(numbers: NumberReader) -> list[str]:
    """The faults of the rows that were left out: ten lines at most."""
    lines = InputError(*numbers.faults).lines() if numbers.faults else []
    assert len(lines) <= LINES_AT_MOST
    return lines


#: Columns that are listed, rows of cells below each, and letters of a cell.
MOST_COLUMNS, ROWS, LETTERS = 200, 3, 60


@dataclasses.dataclass(frozen=True)
class SeenColumn:
    """A column of a file: its heading, the heading without its unit, what it is taken for, and its first cells."""

    heading: str
    #: Without its unit.
    bare_heading: str
    #: The name of a column of a log; empty for one that is not used.
    taken_for: str
    #: As in the heading, the row below it, or the column given by hand; empty where there is none.
    unit: str
    #: The first cells, as written.
    cells: tuple[str, ...]


@dataclasses.dataclass(frozen=True)
class Preview:
    """The columns of a file, values that count in every row (SI), and the faults for which it is not read as it is."""

    file: str
    columns: tuple[SeenColumn, ...]
    #: Columns that the file has beyond those listed.
    more_columns: int
    constants: Mapping[str, float]
    faults: tuple[Fault, ...]


def preview(path: Path, columns: Mapping[str, str] | None = None) -> Preview:
    """The columns of a log in a file, as :func:`~ballscrew.files.torque_logs.reading.read` takes them.

    ``columns`` are those given by hand, ``{"torque": "M_ist [N m]"}``. Faults of the columns are listed, not raised:
    what they would be taken for is shown all the same. Raises :class:`~ballscrew.basis.errors.InputError` for what is
    no table.
    """
    path, columns = Path(path), columns or {}
    try:
        with path.open("rb") as file:
            result = source_of(path, file, None).found
    except (OSError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        raise unreadable(path, error) from None
    if not result:
        raise InputError(Fault(str(path), "is empty", "", "give a table with headings and rows"))
    try:
        place = layout(path, result, columns)
    except InputError as error:
        start = _headings_row(result, columns)
        return _preview(path, result, start, _recognised(result[start], columns), {}, error.faults)
    seen = {heading.place: heading for heading in place.headings.values()}
    start = next(n for n, record in enumerate(result) if _has(record, seen))
    return _preview(path, result, start, seen, place.constants, ())


def _has(record: Record, headings: Mapping[int, Heading]) -> bool:
    """Test whether a row has all of these headings."""
    cells = record.cells
    return all(n < len(cells) and _text(cells[n]) == " ".join(h.written.split()) for n, h in headings.items())


def _text(cell: object) -> str:
    return " ".join(str(cell).split())


def _headings_row(records: Sequence[Record], columns: Mapping[str, str]) -> int:
    """The row near the top with most headings that are known or given by hand, or else the first one."""
    counts = [len(_recognised(record, columns)) for record in records[:WITHIN]]
    return counts.index(max(counts))


def _recognised(record: Record, columns: Mapping[str, str]) -> dict[int, Heading]:
    """The headings of a row by their places; those given by hand count for what they are given as."""
    by_name = {column.name: column for column in COLUMNS}
    given = {bare(_without_unit(text)): by_name[name] for name, text in columns.items() if name in by_name}
    headings: dict[int, Heading] = {}
    for place, cell in enumerate(record.cells[:MOST_COLUMNS]):
        heading = known_heading_of(cell, place, COLUMNS)
        if isinstance(cell, str) and (column := given.get(bare(_without_unit(cell)))) is not None:
            headings[place] = Heading(cell, column, place, heading.unit if heading else "")
        elif heading is not None and heading.column.name not in columns:
            headings[place] = heading
    return headings


def _without_unit(text: str) -> str:
    parts = BRACKETS.fullmatch(" ".join(text.split()))
    return parts["name"] if parts else " ".join(text.split())


def _preview(
    path: Path,
    records: Sequence[Record],
    start: int,
    seen: Mapping[int, Heading],
    constants: Mapping[str, float],
    faults: Sequence[Fault],
) -> Preview:
    cells, below = records[start].cells, records[start + 1 : start + 1 + ROWS]
    listed = tuple(
        SeenColumn(
            heading=_text(cell)[:LETTERS],
            bare_heading=_without_unit(str(cell))[:LETTERS],
            taken_for=seen[place].column.name if place in seen else "",
            unit=seen[place].unit if place in seen else _unit_in(cell),
            cells=tuple(_text(r.cells[place])[:LETTERS] if place < len(r.cells) else "" for r in below),
        )
        for place, cell in enumerate(cells[:MOST_COLUMNS])
    )
    return Preview(path.name, listed, len(cells) - len(listed), constants, tuple(faults))


def _unit_in(cell: object) -> str:
    parts = BRACKETS.fullmatch(_text(cell))
    return parts["unit"] if parts else ""

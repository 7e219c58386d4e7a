"""Logs of torque that people bring: text, spreadsheets and files of MATLAB, in their own words and units.

As in all tables, a number needs a unit: in its heading, in a row of units below, behind the number, or in
``--column torque="M_ist [N m]"``. Every row is used, or counted with the reason why not.
"""

from __future__ import annotations

import dataclasses
import hashlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from ballscrew.analyses.log_cleaning import HELD
from ballscrew.analyses.log_gathering import Gathering
from ballscrew.analyses.log_motion import Floats
from ballscrew.analyses.torque_log import REQUIRED, TorqueLog
from ballscrew.faults import LINES_AT_MOST, Fault, InputError, raise_if_any
from ballscrew.interfaces.log_cells import Cells
from ballscrew.interfaces.log_columns import TORQUES, Layout, is_heading, layout
from ballscrew.interfaces.log_matlab import is_matlab, variables
from ballscrew.interfaces.log_text import Piece, TextLog, size_of
from ballscrew.interfaces.sheets import Record, is_spreadsheet, records, unreadable

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
    """The log of a file, in SI; :meth:`~ballscrew.analyses.torque_log.TorqueLog.cleaned` makes it fit for a fit.

    ``columns`` says which heading a column has, and in which unit it is, where the file does not: ``"M_ist [N m]"``; or
    what it is in every row: ``"0 N"``. A current needs the ``torque_constant`` (N m/A), a feed rate the ``lead`` (m).
    ``done`` is told the bytes read so far and those of the file. A log longer than ``held`` rows is thinned while it
    is read, ``chunk`` rows at a time.

    Raises :class:`~ballscrew.faults.InputError` for faults of the file as a whole, and for cells that are no numbers;
    with ``keep_going`` their rows are left out and counted.
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
    begin, size = file.read(512), size_of(file)
    file.seek(0)
    if not begin:
        raise InputError(Fault(str(path), "is empty", "", "give a table with headings and rows"))
    text = None
    if is_matlab(path, begin) or is_spreadsheet(path, begin):
        found, whole = _at_once(path, begin)
    else:
        text = TextLog(path, file, None if done is None else lambda read: done(read, size))
        found, whole = text.found, None
    if not found:
        raise InputError(Fault(str(path), "is empty", "", "give a table with headings and rows"))
    place = layout(path, found, columns)
    _check_factors(place, *factors)
    pieces = whole(place) if whole is not None else _pieces_of(text, place, chunk)
    log, cells = _gathered(place, pieces, factors, keep_going, held)
    digest = text.digest() if text is not None else hashlib.sha256(path.read_bytes()).hexdigest()
    notes = [f"columns not used: {', '.join(place.unused)}"] if place.unused else []
    if text is not None and text.empty_bytes:
        notes.append(f"the file ends with {text.empty_bytes} empty bytes, which are left out")
    if done is not None:
        done(size, size)
    return dataclasses.replace(log, source=(path.name, digest)).noted(*notes, *_told(cells))


def _pieces_of(text: TextLog | None, place: Layout, chunk: int) -> Iterator[Piece]:
    assert text is not None
    return text.pieces(place, chunk)


def _at_once(path: Path, begin: bytes) -> tuple[Sequence[Record], Callable[[Layout], Iterator[Piece]]]:
    """The first rows of a spreadsheet or a file of MATLAB, and its only piece."""
    if is_matlab(path, begin):
        arrays = variables(path, begin)
        sizes = {name: values.size for name, values in arrays.items()}
        if len(set(sizes.values())) > 1:
            told = ", ".join(f"{name} {size}" for name, size in sizes.items())
            raise InputError(Fault(path.name, "has columns of different lengths", told, "give every column each row"))
        lists = list(arrays.values())
        top = [Record(1 + row, [values[row] for values in lists]) for row in range(min(5, lists[0].size))]

        def of_arrays(place: Layout) -> Iterator[Piece]:
            cells = {heading.place: lists[heading.place] for heading in place.headings.values()}
            yield Piece(cells, np.arange(1, 1 + lists[0].size), False)

        return [Record(0, list(arrays)), *top], of_arrays
    rows = records(path, is_heading)

    def of_rows(place: Layout) -> Iterator[Piece]:
        body = [row for row in rows if row.line > place.line]
        cells = {heading.place: _column(body, heading.place) for heading in place.headings.values()}
        yield Piece(cells, np.array([row.line for row in body], dtype=np.int64), False)

    return rows, of_rows


def _column(body: Sequence[Record], place: int) -> NDArray[Any]:
    cells = np.empty(len(body), dtype=object)
    cells[:] = [row.cells[place] if place < len(row.cells) else "" for row in body]
    return cells


def _check_factors(place: Layout, torque_constant: float | None, lead: float | None) -> None:
    faults: list[Fault] = []
    for name, factor, option in (
        ("current", torque_constant, 'give --torque-constant "0.5 N m/A"'),
        ("feed_rate", lead, "give the lead of the screw, or a column with its speed"),
    ):
        if name in place.headings and factor is None:
            needs = "torque constant" if name == "current" else "lead"
            faults.append(
                Fault(f'{place.file} column "{place.headings[name].written}"', f"needs the {needs}", "", option)
            )
    raise_if_any(faults)


def _gathered(
    place: Layout,
    pieces: Iterator[Piece],
    factors: tuple[float | None, float | None],
    keep_going: bool,
    held: int,
) -> tuple[TorqueLog, Cells]:
    cells, gathering, cut_off = Cells(place, keep_going), Gathering(held), 0
    for piece in pieces:
        raw = {name: piece.cells[heading.place] for name, heading in place.headings.items()}
        values, good = cells.numbers(raw, piece.line, piece.cut_off)
        named = _named(values, place, piece.line.size, factors)
        if piece.cut_off and good.size and _lacks(named, -1):
            good[-1] = False
            cut_off = 1
        gathering.add({name: column[good] for name, column in named.items()}, piece.line[good])
    if not keep_going:
        raise_if_any(cells.faults)
    if not gathering.rows:
        raise_if_any(cells.faults)
        raise InputError(Fault(place.file, "has no rows below its headings", "", "give one row for each measurement"))
    _check_filled(place, gathering)
    log = gathering.log(TORQUES[place.torque])
    counts = {**log.left_out, UNREADABLE: cells.bad_rows, CUT_OFF: cut_off}
    left_out = {reason: count for reason, count in counts.items() if count}
    return dataclasses.replace(log, left_out=left_out, rows=gathering.rows + cells.bad_rows + cut_off), cells


def _named(
    values: Mapping[str, Floats], place: Layout, rows: int, factors: tuple[float | None, float | None]
) -> dict[str, Floats]:
    """The columns of a log from those of a file."""
    constants = {name: np.full(rows, value) for name, value in place.constants.items()}
    found = {**constants, **values}
    torque_constant, lead = factors
    if "current" in found and torque_constant is not None:
        found["torque"] = torque_constant * found.pop("current")
    if "feed_rate" in found and lead is not None:
        found["screw_speed"] = 2 * np.pi / lead * found.pop("feed_rate")
    for name in TORQUES:
        if name in found:
            found["torque"] = found.pop(name)
    return found


def _lacks(named: Mapping[str, Floats], row: int) -> bool:
    return any(bool(np.isnan(named[name][row])) for name in REQUIRED)


def _check_filled(place: Layout, gathering: Gathering) -> None:
    """Raise for columns that are needed and empty."""
    ours = {"torque": place.torque, "screw_speed": "feed_rate" if "feed_rate" in place.headings else "screw_speed"}
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


def _told(cells: Cells) -> list[str]:
    """What is said of the rows that were left out for their faults: ten lines at most."""
    lines = InputError(*cells.faults).lines() if cells.faults else []
    assert len(lines) <= LINES_AT_MOST
    return lines

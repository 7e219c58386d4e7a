"""The columns of a log at a glance: each heading of a file, what it is taken for, and the cells below it."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from pathlib import Path

from ballscrew.basis.errors import Fault, InputError
from ballscrew.files.tables.headings import Heading, bare, known_heading_of
from ballscrew.files.tables.sheets import Record, unreadable
from ballscrew.files.torque_logs.columns import BRACKETS, COLUMNS, WITHIN, layout
from ballscrew.files.torque_logs.sources import source_of

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

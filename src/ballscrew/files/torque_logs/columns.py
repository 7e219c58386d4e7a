"""Columns of a log: their names in English and German, and their layout in a file.

A column of the user's own name is given as ``--column torque="M_ist [N m]"``; what is the same in every row is given as
``--column axial_load="0 N"``.
"""

from __future__ import annotations

import dataclasses
import datetime
import functools
import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError, nearest, raise_if_any
from ballscrew.basis.quantities import Info, Quantity
from ballscrew.files.tables import cells
from ballscrew.files.tables.headings import (
    BRACKETS,
    NEEDS_UNIT,
    NO_COLUMN,
    SAME_MEANING,
    Column,
    Heading,
    bare,
    checked,
    fits,
    heading_of,
    headings_in,
    known_heading_of,
    likely_headings,
    spelt,
    unused,
)
from ballscrew.files.tables.sheets import Record
from ballscrew.files.torque_logs.log_rows import Kind, quantities, within

#: Headings of a file that a message lists at most.
_LISTED = 20
#: The headings stand within this many rows: loggers write about themselves first.
WITHIN = 60

_NAMES: Mapping[str, tuple[str, ...]] = {
    "axial_load": (
        "F", "Fa", "F_ax", "load", "force", "axial force", "thrust", "thrust force",
        "Axialkraft", "Axiallast", "Kraft", "Last", "Vorschubkraft",
    ),
    "screw_speed": (
        "n", "speed", "rpm", "rotational speed", "rotation speed", "motor speed", "spindle speed", "shaft speed",
        "angular speed", "angular velocity", "omega", "ω", "Drehzahl", "Motordrehzahl", "Spindeldrehzahl",
        "Winkelgeschwindigkeit", "n_ist",
    ),
    "feed_rate": (
        "feed", "feed speed", "linear speed", "linear velocity", "axial speed", "nut speed", "v", "velocity",
        "Vorschub", "Vorschubgeschwindigkeit", "Geschwindigkeit",
    ),
    "position": (
        "pos", "nut position", "axial position", "actual position", "travel", "stroke position",
        "Weg", "Istposition", "Position ist", "Lage", "Verfahrweg", "Mutterposition",
    ),
    "torque": ("T", "M", "Md", "Drehmoment", "Moment", "screw torque", "shaft torque", "spindle torque", "M_ist"),
    "friction_torque": (
        "no-load torque", "drag torque", "idling torque", "running torque", "preload torque", "preload drag torque",
        "M_R", "T_f", "M_f", "Reibmoment", "Reibungsmoment", "Leerlaufmoment", "Leerlaufdrehmoment",
    ),
    "drive_torque": ("motor torque", "T_motor", "M_motor", "Antriebsmoment", "Motormoment", "Antriebsdrehmoment"),
    "current": (
        "I", "Iq", "i_q", "motor current", "q current", "torque current", "Strom", "Motorstrom", "I_ist",
        "drehmomentbildender Strom",
    ),
    "temperature": (
        "T", "temp", "theta", "ϑ", "oil temperature", "oil temp", "T_oil", "nut temperature", "nut temp", "T_nut",
        "screw temperature", "Temperatur", "Öltemperatur", "T_Öl", "Muttertemperatur", "T_Mutter",
    ),
    "time": (
        "t", "timestamp", "time stamp", "date time", "datetime", "elapsed time", "elapsed", "Zeit", "Zeitstempel",
        "Uhrzeit", "Messzeit",
    ),
}  # fmt: skip
#: Words that stand beside a name and change nothing. Set points have others.
_HINTS = ("actual", "actual value", "act", "measured", "filtered", "ist", "Istwert", "mean", "value")
#: Words beside a temperature that is taken as that of the oil; where there are several, one must be chosen.
_PLACES = ("oil", "nut", "screw", "Öl", "Mutter", "Spindel")
TEMPERATURE, LOAD = "temperature", "axial_load"


def columns_not_used(names: Iterable[str]) -> str:
    """The note on columns of a table that nothing takes."""
    return f"columns not used: {', '.join(names)}"


#: The note on a log without a column of the load.
NO_LOAD = 'no column of the load: 0 N in every row; give --column axial_load="your heading [N]" if there is one'
#: The columns that a torque may be in, the one that says most first, and what the torque then is.
TORQUES: Mapping[str, Kind] = {
    "friction_torque": "friction", "drive_torque": "drive", "torque": "unknown", "current": "drive",
}  # fmt: skip
#: The columns that a speed may come from; a position is differentiated.
_SPEEDS = ("screw_speed", "feed_rate", "position")
_QUANTITIES: Mapping[str, Quantity] = {
    **quantities(),
    **{name: dataclasses.replace(quantities()["torque"], name=name) for name in ("friction_torque", "drive_torque")},
    "current": Quantity("current", "A", within(1e6, Info("I", "current of the motor that makes torque"))),
    "position": Quantity("position", "m", within(1e6, Info("x", "position of the nut along the screw", "mm"))),
    "feed_rate": Quantity("feed_rate", "m/s", within(1e6, Info("v", "speed of the nut along the screw", "m/min"))),
}
COLUMNS = tuple(
    Column(
        name,
        _QUANTITIES[name],
        names,
        name in {"axial_load", "screw_speed", "torque"},
        _HINTS + _PLACES * (name == TEMPERATURE),
    )
    for name, names in _NAMES.items()
)


@dataclasses.dataclass(frozen=True, eq=False)
class LogColumns:
    """The columns of a kind of log, which is called by its ``noun``."""

    noun: str
    columns: Sequence[Column]
    #: Columns that stand for each other, the one that says most first.
    families: Sequence[Sequence[str]]
    #: Whether a number may stand for a column: it is the same in every row.
    has_constants: bool = True

    @functools.cached_property
    def by_name(self) -> Mapping[str, Column]:
        """The columns by name."""
        return {column.name: column for column in self.columns}


TORQUE_LOG = LogColumns("a log", COLUMNS, (tuple(TORQUES), _SPEEDS))
_BY_NAME = TORQUE_LOG.by_name

#: Dates and times that are known, as pandas has them.
CLOCK = "clock"
_DATES: Mapping[str, re.Pattern[str]] = {
    "ISO8601": re.compile(r"\d{4}-?\d\d-?\d\d[T ]\d\d:?\d\d.*"),
    "%d.%m.%Y %H:%M:%S.%f": re.compile(r"\d\d?\.\d\d?\.\d{4} \d\d?:\d\d:\d\d[.,]\d+"),
    "%d.%m.%Y %H:%M:%S": re.compile(r"\d\d?\.\d\d?\.\d{4} \d\d?:\d\d:\d\d"),
    CLOCK: re.compile(r"\d\d?:\d\d:\d\d(?:[.,]\d+)?"),
}


@dataclasses.dataclass(frozen=True, eq=False)
class Layout:
    """The layout of a log: headings by name, constants (in SI), decimal mark and format of dates."""

    file: str
    headings: Mapping[str, Heading]
    constants: Mapping[str, float]
    #: The number of the last row of headings.
    line: int
    #: How many columns there are.
    width: int
    decimal: frozenset[str]
    #: The format of times that are dates.
    dates: str
    unused: Sequence[str]
    #: The names and units in the headings, for files that have them more than once.
    words: frozenset[str]
    #: Whether there is no column of the load, and none that could be it: it is 0 N in every row.
    assumes_no_load: bool = False

    def where(self, line: int, name: str) -> str:
        """``log.csv row 7, column "speed [rpm]"``."""
        return f'{self.file} row {line}, column "{self.headings[name].written}"'

    @property
    def speed(self) -> str:
        """The column that has the speed, or that it is computed from."""
        return next((name for name in _SPEEDS if name in self.headings), _SPEEDS[0])

    @property
    def torque(self) -> str:
        """The column that has the torque, or the current."""
        return next(name for name in TORQUES if name in self.headings or name in self.constants)


def temperatures_among(unused: Sequence[str]) -> list[str]:
    """Columns in a unit of temperature among those that are not used, as :class:`Layout` lists them."""
    column = _BY_NAME[TEMPERATURE]
    parts = [(heading, BRACKETS.fullmatch(heading.strip('"'))) for heading in unused]
    return [heading for heading, each in parts if each is not None and fits(each["unit"], column)]


def is_heading(cell: str) -> bool:
    """Test whether a cell is a known heading."""
    return known_heading_of(cell, 0, COLUMNS) is not None


def is_load(cell: Any) -> bool:
    """Test whether a cell is a known heading of the load."""
    heading = known_heading_of(cell, 0, COLUMNS)
    return heading is not None and heading.column.name == LOAD


def layout(
    path: Path,
    records: Sequence[Record],
    flags: Mapping[str, str],
    kind: LogColumns = TORQUE_LOG,
    without: Collection[str] = (),
) -> Layout:
    """The layout of a file, from its first rows and the columns given by the user, by name.

    A log of a ``kind``, in which some columns are not looked for (``without``).

    Raises :class:`~ballscrew.basis.errors.InputError` for columns that are missing, double or without a unit that fits.
    """
    given = given_columns(flags, kind)
    rows, constants, named = renamed(records, given, kind)
    columns = [column for column in _wanted(given, kind) if column.name not in without]
    start, headings = headings_in(path, rows, columns, WITHIN)
    columns, headings = _chosen(columns, headings, constants, kind)
    headings = _as_in_file(headings, start, named)
    body = rows[start + 1 :]
    units_below = bool(body) and _are_units(headings, body[0])
    without_load = LOAD in kind.by_name and _has_no_load(
        rows[start], body[0] if units_below else None, headings, constants
    )
    if without_load:
        constants = {**constants, LOAD: 0.0}
        columns = [column for column in columns if column.name != LOAD]
    if units_below:
        headings = [_with_unit(heading, body[0]) for heading in headings]
    body = body[units_below:]
    dates = _dates_in(headings, body)
    headings = [_of_text(heading) if dates and heading.column.name == "time" else heading for heading in headings]
    try:
        good = checked(path, headings, rows[start], body, columns)
    except InputError as error:
        there = _headings_of(records[start])
        raise InputError(
            *(
                _with_option(fault, headings, kind.by_name, there, constants=kind.has_constants)
                for fault in error.faults
            )
        ) from None
    rest = unused(records[start], good, body[:WITHIN])
    above = [records[start], records[start + 1]] if units_below else [records[start]]
    return Layout(
        path.name,
        {heading.column.name: heading for heading in good},
        constants,
        above[-1].line,
        len(records[start].cells),
        cells.evidence(_texts_in(good, body)),
        dates,
        rest,
        frozenset(cell for record in above for cell in record.cells if isinstance(cell, str) and cell),
        without_load,
    )


# -- columns given by the user ----------------------------------------------------------------


@dataclasses.dataclass(frozen=True)
class _GivenColumn:
    """A column as the user has it: its name and unit, and both as written."""

    column: Column
    written: str
    name: str
    unit: str


def given_columns(flags: Mapping[str, str], kind: LogColumns) -> list[_GivenColumn]:
    """The columns given by the user, by name; raises for names and units that are none."""
    faults: list[Fault] = []
    result: list[_GivenColumn] = []
    for name, text in flags.items():
        column = kind.by_name.get(name) or next((column for column in kind.columns if column.answers_to(name)), None)
        if column is None:
            faults.append(Fault("--column", f"is no column of {kind.noun}", name, nearest(name, kind.by_name)))
            continue
        written = " ".join(text.split())
        parts = BRACKETS.fullmatch(written)
        unit = spelt(parts["unit"]) if parts else ""
        if unit and not fits(unit, column):
            assert column.quantity is not None
            fault = units.parse(f"--column {name}", f"1 {unit}", column.quantity)
            if isinstance(fault, Fault):
                faults.append(dataclasses.replace(fault, given=written))
        result.append(_GivenColumn(column, written, parts["name"] if parts else written, unit))
    raise_if_any(faults)
    return result


def renamed(
    records: Sequence[Record], given: Sequence[_GivenColumn], kind: LogColumns
) -> tuple[list[Record], dict[str, float], dict[tuple[int, int], str]]:
    """Rows with the given columns under their standard names, the constants, and the cells as written."""
    rows = list(records)
    constants: dict[str, float] = {}
    written: dict[tuple[int, int], str] = {}
    for one in given:
        ours = dataclasses.replace(one.column, name=one.name, aliases=(), hints=())
        places = [
            (number, place, heading)
            for number, record in enumerate(records[:WITHIN])
            for place, cell in enumerate(record.cells)
            if isinstance(cell, str) and cell
            for heading in [heading_of(cell, place, (ours,))]
            if heading is not None or bare(cell) in {bare(one.written), bare(one.name)}
        ]
        if not places:
            constants[one.column.name] = _constant(one, records, kind)
            continue
        # "T" is rather "T" than "t"
        number, place, heading = min(places, key=lambda result: _match_rank(one, str(rows[result[0]].cells[result[1]])))
        unit = one.unit or (heading.unit if heading else "")
        written[number, place] = str(records[number].cells[place])
        name = one.column.name.replace("_", " ")
        cells = [_without_column(one.column, cell, kind) for cell in rows[number].cells]
        cells[place] = f"{name} [{unit}]" if unit else name
        rows[number] = Record(rows[number].line, cells)
    return rows, constants, written


def _has_no_load(
    cells: Record, units_below: Record | None, headings: Sequence[Heading], constants: Mapping[str, float]
) -> bool:
    """Test whether a log has no column of the load nor another in a unit of force: it is one of a nut without load."""
    if LOAD in constants or not headings or any(heading.column.name == LOAD for heading in headings):
        return False
    taken = {heading.place for heading in headings}
    given = [BRACKETS.fullmatch(str(cell).strip()) for cell in cells.cells]
    values = [match["unit"] if match else "" for match in given]
    if units_below is not None:
        values = [unit or _bracketed(cell) for unit, cell in zip(values, units_below.cells, strict=False)]
    return not any(unit and fits(spelt(unit), _BY_NAME[LOAD]) for n, unit in enumerate(values) if n not in taken)


def _match_rank(one: _GivenColumn, cell: str) -> int:
    """Rank of a match: exact, but for the unit, or but for capitals and blanks."""
    parts = BRACKETS.fullmatch(cell)
    return 0 if cell == one.written else 1 if one.name in {cell, parts["name"] if parts else cell} else 2


def _without_column(column: Column, cell: Any, kind: LogColumns) -> Any:
    """A cell; empty where it would be read as this column."""
    heading = known_heading_of(cell, 0, kind.columns)
    return "" if heading is not None and heading.column is column else cell


def _constant(one: _GivenColumn, records: Sequence[Record], kind: LogColumns) -> float:
    quantity = one.column.quantity
    assert quantity is not None
    where = f"--column {one.column.name}"
    if kind.has_constants and re.match(r"[-+]?\.?\d", one.written):
        value = units.parse(where, one.written, quantity)
        if isinstance(value, Fault):
            raise InputError(value)
        return value
    headings = _headings_of(likely_headings(records[:WITHIN], kind.columns))
    raise InputError(Fault(where, "is not a column of the file", one.written, nearest(one.name, headings)))


def _headings_of(record: Record) -> list[str]:
    """The headings in a row of a file, those that a message has room for."""
    texts = [cell for cell in record.cells if isinstance(cell, str) and cell]
    return [text for text in texts if not re.match(r"[-+]?[.,]?\d", text)][:_LISTED]


def _as_in_file(headings: Sequence[Heading], start: int, written: Mapping[tuple[int, int], str]) -> list[Heading]:
    """Headings as the file has them, where the user named their columns: messages are about what stands there."""
    return [dataclasses.replace(one, written=written.get((start, one.place), one.written)) for one in headings]


def _wanted(given: Sequence[_GivenColumn], kind: LogColumns) -> list[Column]:
    """The columns to look for: of those that stand for each other, only the one given."""
    names = {one.column.name for one in given}
    others = {other for family in kind.families if names & {*family} for other in family} - names
    return [
        dataclasses.replace(column, aliases=(), hints=()) if column.name in names else column
        for column in kind.columns
        if column.name not in others
    ]


def _chosen(
    columns: Sequence[Column], headings: Sequence[Heading], constants: Mapping[str, float], kind: LogColumns
) -> tuple[list[Column], list[Heading]]:
    """Choose, of columns that stand for each other, the one that says most; columns needed no more are not required."""
    names = {heading.column.name for heading in headings}
    dropped: set[str] = {*constants}
    for family in kind.families:
        there = [name for name in family if name in names or name in constants]
        dropped |= {name for name in family if name not in there[:1]} if there else set[str]()
    return (
        [column for column in columns if column.name not in dropped],
        [heading for heading in headings if heading.column.name not in dropped],
    )


# -- units and dates ------------------------------------------------------------------------------


def _bracketed(cell: Any) -> str:
    return str(cell).strip().strip("[]()").strip()


def _are_units(headings: Sequence[Heading], record: Record) -> bool:
    """Test whether a row has units and no numbers."""
    cells = [(heading.column, record.cells[heading.place]) for heading in headings if heading.place < len(record.cells)]
    texts = all(
        isinstance(cell, str) and not re.match(r"\s*[-+]?[.,]?\d", _unit_without_number(cell)) for _, cell in cells
    )
    return texts and any(cell and fits(_bracketed(cell), column) for column, cell in cells)


def _unit_without_number(cell: str) -> str:
    """A unit that begins with a number: "1/min"."""
    return cell.removeprefix("[").removeprefix("1/")


def _with_unit(heading: Heading, record: Record) -> Heading:
    """The heading with the unit that a row of units has for it, where it has none itself."""
    cell = _bracketed(record.cells[heading.place]) if heading.place < len(record.cells) else ""
    return heading if heading.unit or not cell else dataclasses.replace(heading, unit=spelt(cell))


def _dates_in(headings: Sequence[Heading], body: Sequence[Record]) -> str:
    """The format of the times if they are dates; nothing if they are numbers."""
    place = next((heading.place for heading in headings if heading.column.name == "time"), None)
    if place is None:
        return ""
    cells = [record.cells[place] for record in body if place < len(record.cells) and record.cells[place] != ""]
    if not cells:
        return ""
    if not isinstance(cells[0], str | int | float):  # a spreadsheet's own dates and times
        return "ISO8601" if isinstance(cells[0], datetime.date) else CLOCK
    return next((form for form, pattern in _DATES.items() if pattern.fullmatch(str(cells[0]))), "")


def _of_text(heading: Heading) -> Heading:
    """The heading of a column of dates, which has no unit."""
    return dataclasses.replace(heading, unit="", column=dataclasses.replace(heading.column, quantity=None))


def _texts_in(headings: Sequence[Heading], body: Sequence[Record]) -> list[str]:
    """The cells of quantities that are text: they show which decimal mark a file has."""
    places = [heading.place for heading in headings if heading.column.quantity is not None]
    cells = (record.cells[place] for record in body for place in places if place < len(record.cells))
    return [cell for cell in cells if isinstance(cell, str)]


def _with_option(
    fault: Fault,
    headings: Sequence[Heading],
    columns: Mapping[str, Column],
    there: Sequence[str],
    *,
    constants: bool,
) -> Fault:
    """A fault of a column, with the option of the command line that resolves it.

    ``there`` are the headings of the file. ``constants``: whether a value may stand for a column; of a torque none may.
    """
    column = columns.get(fault.column)
    if column is None or column.quantity is None:
        return fault
    name, unit = column.name, column.quantity.shown_in
    heading = next((one for one in headings if fault.where.endswith(f'column "{one.written}"')), None)
    remedy = fault.remedy
    if fault.id == NO_COLUMN:
        remedy = f'{remedy}, or name it: --column {name}="your heading [{unit}]"'
        if constants and name != "torque":
            remedy += f'; if it is the same in every row, --column {name}="0 {unit}"'
        remedy += f"; headings of the file: {', '.join(there)}"
    elif heading is not None and fault.id == NEEDS_UNIT:
        parts = BRACKETS.fullmatch(heading.written)
        bare_heading = parts["name"] if parts else heading.written
        remedy = f'{remedy}, or give --column {name}="{bare_heading} [{unit}]"'
    elif heading is not None and fault.id == SAME_MEANING:
        remedy = f'give --column {name}="{heading.written}" for the one that is meant'
    return dataclasses.replace(fault, remedy=remedy)

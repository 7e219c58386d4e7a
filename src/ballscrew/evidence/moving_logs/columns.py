"""Columns of a moving log: their names in English and German, and those of the EMPS benchmark."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Collection, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any

from ballscrew.basis.errors import Fault, InputError, nearest
from ballscrew.basis.quantities import Info, Power, Quantity, Torque, Unit, quantities_of
from ballscrew.evidence.moving_logs.moving_log import quantities
from ballscrew.files.tables.headings import (
    NO_COLUMN,
    NO_HEADING,
    Column,
    bare,
    headings_in,
)
from ballscrew.files.tables.sheets import Record
from ballscrew.files.torque_logs.columns import WITHIN, Layout, LogColumns, given_columns, layout, renamed
from ballscrew.files.torque_logs.log_rows import within

_NAMES: Mapping[str, tuple[str, ...]] = {
    "time": ("t", "timestamp", "time stamp", "date time", "elapsed time", "elapsed", "Zeit", "Zeitstempel", "Uhrzeit"),
    "position": (
        "x", "q", "qm", "q_meas", "pos", "nut position", "axial position", "axis position", "travel", "Weg", "Lage",
        "Istposition", "Position ist", "Verfahrweg", "Mutterposition", "x_ist",
    ),
    "speed": (
        "v", "velocity", "feed rate", "feed", "linear speed", "axis speed", "nut speed", "Geschwindigkeit", "Vorschub",
        "Vorschubgeschwindigkeit", "v_ist",
    ),
    "force": (
        "F", "motor force", "drive force", "axial force", "thrust", "thrust force", "Kraft", "Vorschubkraft",
        "Axialkraft", "Antriebskraft", "F_ist",
    ),
    "torque": (
        "T", "M", "motor torque", "drive torque", "screw torque", "shaft torque", "T_motor", "M_motor", "Moment",
        "Drehmoment", "Antriebsmoment", "Motormoment", "M_ist",
    ),
    "current": (
        "I", "Iq", "i_q", "motor current", "q current", "torque current", "Strom", "Motorstrom", "I_ist",
        "current feedback", "drehmomentbildender Strom",
    ),
    "power": (
        "motor power", "output power", "drive power", "active power", "Leistung", "Motorleistung", "Antriebsleistung",
        "Wirkleistung",
    ),
    "voltage": ("u", "vir", "control voltage", "command voltage", "drive voltage", "Stellspannung", "Steuerspannung"),
}  # fmt: skip
_HINTS = ("actual", "actual value", "act", "measured", "filtered", "ist", "Istwert", "value")
#: The columns that the force comes from, the one that says most first, and those that the motion comes from.
FORCES, PATHS = ("force", "torque", "current", "power", "voltage"), ("speed", "position")
#: Units of controllers that write none, by column.
_OF_CONTROLLERS: Mapping[str, str] = {"time": "s", "position": "mm", "speed": "mm/s", "current": "A", "power": "kW"}
#: Names of axes, and a heading of one of several: X1_ActualPosition.
_AXIS = re.compile(r"[A-Za-z]|[A-Za-z]+\d+")
_OF_AXIS = re.compile(r"([A-Za-z]+\d*)[_ .](.+)")


@dataclasses.dataclass(frozen=True)
class _ForceLike:
    """Columns that are made into the force at the nut."""

    torque: Annotated[Torque, within(1e6, Info("M", "torque of the motor at the screw", "N m"))]
    current: Annotated[Any, Unit("A"), within(1e6, Info("I", "current of the motor that makes torque"))]
    power: Annotated[Power, within(1e9, Info("P", "power of the motor", "kW"))]
    voltage: Annotated[Any, Unit("V"), within(1e6, Info("u", "control voltage in proportion to the force"))]


QUANTITIES: Mapping[str, Quantity] = {**quantities(), **quantities_of(_ForceLike)}
COLUMNS = tuple(Column(name, QUANTITIES[name], names, name == "time", _HINTS) for name, names in _NAMES.items())
MOVING_LOG = LogColumns("a moving log", COLUMNS, (FORCES, PATHS), has_constants=False)
_TIMES = frozenset(map(bare, ("time", *_NAMES["time"])))
#: Channels of the EMPS benchmark (JanotGautierBrunot2019) with the units that its description gives, and its gain, N/V.
EMPS: Mapping[str, str] = {"time": "t [s]", "position": "qm [m]", "voltage": "vir [V]"}
EMPS_GAIN = "gtau"


def is_emps(names: Sequence[Any]) -> bool:
    """Test whether the variables of a file are those of the EMPS benchmark."""
    return {text.partition(" ")[0] for text in EMPS.values()} <= {str(name) for name in names}


def moving_layout(path: Path, records: Sequence[Record], flags: Mapping[str, str], *, has_time: bool = True) -> Layout:
    """The layout of a moving log, from its first rows and the headings given by the user, by name.

    ``has_time`` is false for a log whose rows follow each other at a period that is given.

    Raises :class:`~ballscrew.basis.errors.InputError` for columns that are missing, double or without a unit that fits.
    """
    try:
        result = layout(path, records, flags, MOVING_LOG, () if has_time else ("time",))
    except InputError as error:
        axes = _axes(records)
        raise InputError(*[_with_option(fault, axes) for fault in error.faults]) from None
    _check_needed(path, result.headings)
    return result


def _with_option(fault: Fault, axes: Sequence[str]) -> Fault:
    """The fault with the option that makes up for it: of a log of several axes, or without a time."""
    if axes and fault.id in (NO_HEADING, NO_COLUMN):
        return dataclasses.replace(fault, remedy=f"say which axis: --axis {' or --axis '.join(axes)}")
    if fault.id != NO_COLUMN or fault.column != "time":
        return fault
    return dataclasses.replace(fault, remedy=f'{fault.remedy}; where rows follow at a fixed period: --period "0.1 s"')


def _axes(records: Sequence[Record]) -> list[str]:
    """The axes whose speeds or positions a log of several has, by what their headings begin with."""
    matches = (_OF_AXIS.fullmatch(str(cell)) for record in records[:WITHIN] for cell in record.cells)
    paths = [column for column in COLUMNS if column.name in PATHS]
    words = ((match[1], _in_words(match[2])) for match in matches if match and _AXIS.fullmatch(match[1]))
    return [*dict.fromkeys(axis for axis, name in words if any(column.is_named(name) for column in paths))]


def headings_of_axis(records: Sequence[Record], axis: str) -> list[Record]:
    """The first rows of a log of several axes with the headings of one, and with units where these have none.

    Raises :class:`~ballscrew.basis.errors.InputError` for an axis that no heading begins with.
    """
    matches = [[_OF_AXIS.fullmatch(str(cell)) for cell in record.cells] for record in records[:WITHIN]]
    place = next((n for n, row in enumerate(matches) if any(one and one[1] == axis for one in row)), None)
    if place is None:
        axes = dict.fromkeys(one[1] for row in matches for one in row if one)
        raise InputError(Fault("--axis", "no heading begins with it", axis, nearest(axis, axes)))
    cells = [
        _unit_of_controller(match[2]) if match and match[1] == axis else cell if bare(str(cell)) in _TIMES else ""
        for match, cell in zip(matches[place], records[place].cells, strict=True)
    ]
    return [Record(records[place].line, cells), *records[place + 1 :]]


def _unit_of_controller(name: str) -> str:
    """A heading in words, ``Actual Velocity [mm/s]`` of ``ActualVelocity``."""
    words = _in_words(name)
    column = next((column for column in COLUMNS if column.is_named(words)), None)
    unit = "" if column is None else _OF_CONTROLLERS.get(column.name, "")
    return f"{words} [{unit}]" if unit else words


def _in_words(name: str) -> str:
    return re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name).replace("_", " ")


def has_columns(records: Sequence[Record], flags: Mapping[str, str]) -> bool:
    """Test whether there are headings of a time, of a position, and of something that a force is made from."""
    if not records:
        return False
    try:
        rows, _, _ = renamed(records, given_columns(flags, MOVING_LOG), MOVING_LOG)
        _, headings = headings_in(Path("log"), rows, COLUMNS, WITHIN)
    except InputError:
        return False
    names = {heading.column.name for heading in headings}
    return {"time", "position"} <= names and bool(names & {*FORCES})


def _check_needed(path: Path, names: Collection[str]) -> None:
    for family, meaning in ((FORCES, "force"), (PATHS[::-1], "position")):
        if not {*names} & {*family}:
            column = MOVING_LOG.by_name[family[0]]
            others = ", ".join(MOVING_LOG.by_name[name].example for name in family[1:])
            remedy = f'name it: --column {column.name}="your heading [{QUANTITIES[column.name].shown_in}]"; or {others}'
            raise InputError(Fault(path.name, f"has no column of a {meaning}", "", remedy, id=NO_COLUMN))

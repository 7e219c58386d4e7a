"""Moving logs read from files: text, spreadsheets and files of MATLAB.

As in all tables, a number needs a unit: in its heading, in a row of units below, behind the number, or in
``--column position="x_ist [mm]"``. The channels of the EMPS benchmark have those of its description.
"""

from __future__ import annotations

import hashlib
import math
import os
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.errors import Fault, InputError, accepts_units, raise_if_any
from ballscrew.basis.quantities import Length, within_bounds
from ballscrew.evidence.moving_logs.columns import (
    EMPS,
    EMPS_GAIN,
    FORCES,
    QUANTITIES,
    has_columns,
    headings_of_axis,
    is_emps,
    moving_layout,
)
from ballscrew.evidence.moving_logs.moving_log import MovingLog
from ballscrew.files.tables.headings import NO_COLUMN
from ballscrew.files.tables.sheets import Record, unreadable
from ballscrew.files.torque_logs import columns
from ballscrew.files.torque_logs.columns import columns_not_used
from ballscrew.files.torque_logs.motion import Floats
from ballscrew.files.torque_logs.reading import NumberReader, read
from ballscrew.files.torque_logs.sources import LogSource, MatlabLog, source_of
from ballscrew.files.torque_logs.torque_log import TorqueLog

#: Rows of text that are read at a time, and most rows of a moving log.
CHUNK, MOST_ROWS = 200_000, 5_000_000
#: Speeds below this share of the largest make no force of a power.
_SLOWEST = 0.05
_Numbers = dict[str, Floats]


def read_moving(
    path: Path,
    columns: Mapping[str, str] | None = None,
    *,
    lead: float,
    torque_constant: float | None = None,
    gain: float | None = None,
    usual_gain: float | None = None,
    axis: str = "",
    period: float | None = None,
    steady: bool = False,
    keep_going: bool = False,
) -> MovingLog:
    """The moving log of a file, in SI and not yet checked; its force is that at the nut without friction.

    A torque becomes a force by the ``lead`` (m), a current by the ``torque_constant`` (N m/A) as well, a control
    voltage by the ``gain`` (N/V), which the channel ``gtau`` of the EMPS benchmark gives; ``usual_gain`` holds where
    neither does. Where rows at constant speed alone count (``steady``), a current may stay one without a torque
    constant, and a power becomes a force over the ``speed``, beyond a twentieth of its largest: it has the heat of the
    motor in it. ``axis`` begins the headings of one axis of several (``X1``), in the units of controllers where they
    have none, mm, mm/s, A and kW; ``period`` (s) is the time between rows of a log without one.
    ``columns`` says which heading a column has, and its unit: ``{"position": "x_ist [mm]"}``.

    Raises :class:`~ballscrew.basis.errors.InputError` for faults of the file, and for cells that are no numbers; with
    ``keep_going`` these count as missing.
    """
    path, columns = Path(path), columns or {}
    try:
        result, line, notes, own_gain = _rows_of(path, columns, keep_going, axis, period)
        digest = hashlib.sha256(path.read_bytes()).hexdigest()
    except (OSError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        raise unreadable(path, error) from None
    for name, values in result.items():
        values[~within_bounds(QUANTITIES[name].info, values)] = np.nan
    raise_if_any(_empty(path.name, result))
    known = next(one for one in (gain, own_gain, usual_gain, math.nan) if one is not None)
    drive = next(name for name in FORCES if name in result)
    if drive == "power" and not steady:
        remedy = "--steady, or a log of the current"
        raise InputError(Fault(f"{path.name} column power", "tells no force where the axis turns round", "", remedy))
    in_amperes = steady and torque_constant is None and drive == "current"
    force = result["current"] if in_amperes else _force(path.name, result, lead, torque_constant, known)
    return MovingLog(
        result["time"],
        force,
        result.get("position"),
        result.get("speed"),
        line=line,
        notes=tuple(notes),
        source=(path.name, digest),
        gain=known,
        unit="A" if in_amperes else "N",
    )


def is_moving(path: Path, columns: Mapping[str, str]) -> bool:
    """Test whether a file is a moving log: time, position and a force, or what one is made from, but no axial load.

    A log with an axial load beside a torque and a speed is one of torques at steady speed. A file that cannot be read
    is none: its faults are found where it is read.
    """
    if {"axial_load", "screw_speed", "feed_rate"} & {*columns}:
        return False
    try:
        with path.open("rb") as file:
            source = source_of(path, file, None)
        return _is_emps(source) or (has_columns(source.found, columns) and not _is_steady(path, source.found))
    except (InputError, OSError, ValueError):
        return False


def _is_steady(path: Path, records: Sequence[Record]) -> bool:
    """Test whether a file has all the columns of a log of torques at steady speed, with or without their units.

    The load is among them: a file that could be of a moving axis is one of no load only if a person says so.
    """
    if not any(columns.is_load(cell) for record in records[: columns.WITHIN] for cell in record.cells):
        return False
    try:
        columns.layout(path, records, {})
    except InputError as error:
        return all(fault.id != NO_COLUMN for fault in error.faults)
    return True


def _is_emps(source: LogSource) -> bool:
    return isinstance(source, MatlabLog) and is_emps(source.found[0].cells)


def _rows_of(
    path: Path, columns: Mapping[str, str], keep_going: bool, axis: str, period: float | None
) -> tuple[_Numbers, NDArray[np.int64], list[str], float | None]:
    """Columns in SI, the numbers of their rows, remarks, and the gain of the EMPS benchmark."""
    notes: list[str] = []
    gain: float | None = None
    with path.open("rb") as file:
        source = source_of(path, file, None)
        if isinstance(source, MatlabLog) and _is_emps(source):
            columns, gain = {**EMPS, **columns}, source.numbers.get(EMPS_GAIN)
            notes.append("read as a record of the EMPS benchmark: t in s, qm in m, vir in V, gtau in N/V")
        if not source.found:
            raise InputError(Fault(str(path), "is empty", "", "give a table with headings and rows"))
        top = headings_of_axis(source.found, axis) if axis else source.found
        place = moving_layout(path, top, columns, has_time=period is None)
        cells = NumberReader(place, keep_going)
        parts: list[_Numbers] = []
        lines: list[NDArray[np.int64]] = []
        for piece in source.pieces(place, CHUNK):
            raw = {name: piece.cells[heading.place] for name, heading in place.headings.items()}
            values, _ = cells.numbers(raw, piece.line, piece.cut_off)
            # a cell that is no number is a missing one, a row without any is none
            empty = np.all([np.isnan(v) for v in values.values()], axis=0)
            parts.append({name: v[~empty] for name, v in values.items()})
            lines.append(piece.line[~empty])
            if sum(part.size for part in lines) > MOST_ROWS:
                remedy = "cut it: a fit of a motion needs a few strokes, not days"
                raise InputError(Fault(path.name, f"has more than {MOST_ROWS} rows", "", remedy))
    if not keep_going:
        raise_if_any(cells.faults)
    line = np.concatenate(lines) if lines else np.empty(0, dtype=np.int64)
    if not line.size:
        raise InputError(Fault(path.name, "has no rows below its headings", "", "give one row for each sample"))
    result = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    if place.unused and not axis:
        notes.append(columns_not_used(place.unused))
    if period is not None:
        result["time"] = period * np.arange(line.size, dtype=float)
        notes.append(f"time: a row each {period:g} s, as given")
    if axis:
        notes.append(f"axis {axis}: units that headings do not have are mm, mm/s, A and kW")
    if cells.bad_rows:
        notes.append(f"{cells.bad_rows} rows have cells that are no numbers: they count as missing")
    return result, line, notes, gain


def _empty(name: str, floats: Mapping[str, Floats]) -> list[Fault]:
    return [
        Fault(f"{name} column {column}", "has no number in any row", "", "give a column with numbers in it")
        for column, values in floats.items()
        if not np.isfinite(values).any()
    ]


def _force(name: str, result: _Numbers, lead: float, torque_constant: float | None, gain: float) -> Floats:
    """The force at the nut from the column that there is."""
    column = next(one for one in FORCES if one in result)
    values = result[column]
    if column == "current" and torque_constant is None:
        remedy = '--torque-constant "0.5 N m/A", or --steady for friction over speed in amperes'
        raise InputError(Fault(f"{name} column {column}", "needs the torque constant", "", remedy))
    if column == "voltage" and not math.isfinite(gain):
        raise InputError(Fault(f"{name} column {column}", "needs the gain to the force", "", '--gain "35 N/V"'))
    if column == "power":
        return _force_of_power(name, values, result.get("speed"))
    scale = {
        "force": 1.0,
        "torque": 2 * math.pi / lead,
        "current": 2 * math.pi / lead * (torque_constant or 0.0),
        "voltage": gain,
    }[column]
    return scale * values


def _force_of_power(name: str, power: Floats, speed: Floats | None) -> Floats:
    """The force of a power at a speed, N; NaN where the axis is too slow to tell."""
    if speed is None:
        remedy = "give the column of the speed, or a current or a force"
        raise InputError(Fault(f"{name} column power", "makes a force only over a speed that is logged", "", remedy))
    slow = np.abs(speed) < _SLOWEST * np.nanmax(np.abs(speed))
    return np.where(slow, np.nan, power / np.where(slow, np.nan, speed))


@accepts_units("read_log")
def read_log(
    path: str | os.PathLike[str],
    columns: Mapping[str, str] | None = None,
    *,
    lead: Length | None = None,
    torque_constant: float | None = None,
    keep_going: bool = False,
) -> TorqueLog | MovingLog:
    """The log of the file ``path``, as ``ballscrew fit`` reads it: .csv, .txt, .xlsx, .mat and others.

    Headings have the units. A log of steady tests has loads, speeds and torques: it is a :class:`~ballscrew.TorqueLog`,
    for :func:`~ballscrew.fit`. A log of positions and forces over time is a :class:`~ballscrew.MovingLog`, for
    :func:`~ballscrew.fit_motion`; it needs the ``lead`` (m), as feed rates in the other do. ``columns`` says which
    heading a column has where the file does not: ``{"torque": "M_ist [N m]"}``. A current needs the ``torque_constant``
    (N m/A).

    Raises :class:`~ballscrew.basis.errors.InputError` for a file that cannot be read; with ``keep_going`` rows with
    faults are left out and counted.
    """
    place, named = Path(path), dict(columns or {})
    if not is_moving(place, named):
        return read(place, named, torque_constant=torque_constant, lead=lead, keep_going=keep_going)
    if lead is None:
        raise InputError(Fault("read_log.lead", "is needed for a log of positions", "", "give lead=screw.lead"))
    return read_moving(place, named, lead=float(lead), torque_constant=torque_constant, keep_going=keep_going)

"""Files of recorded motions: time, position or speed, perhaps force and temperature; text and spreadsheets."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from ballscrew.axis.motion.states import Numbers
from ballscrew.axis.motion.trajectory import Trajectory, faults_of_times
from ballscrew.basis.errors import Fault, InputError, raise_if_any
from ballscrew.basis.quantities import Info, Quantity
from ballscrew.files.tables.cells import evidence
from ballscrew.files.tables.headings import Column, checked, headings_in, unused
from ballscrew.files.tables.sheets import unreadable
from ballscrew.files.torque_logs.columns import WITHIN, Layout
from ballscrew.files.torque_logs.reading import NumberReader
from ballscrew.files.torque_logs.sources import source_of

#: Rows that are read at a time, and rows at most.
_CHUNK, MOST_ROWS = 200_000, 5_000_000
_HINTS = ("actual", "actual value", "act", "measured", "ist", "Istwert", "value")
_OF: Mapping[str, tuple[Quantity, tuple[str, ...]]] = {
    "time": (
        Quantity("time", "s", Info("t", "time", "s")),
        ("t", "timestamp", "elapsed time", "elapsed", "Zeit", "Messzeit"),
    ),
    "position": (
        Quantity("position", "m", Info("x", "position of the axis", "mm")),
        ("x", "s", "q", "pos", "axis position", "actual position", "travel", "Weg", "Lage", "Istposition", "x_ist"),
    ),
    "speed": (
        Quantity("speed", "m/s", Info("v", "speed of the axis", "m/min")),
        ("v", "velocity", "feed rate", "feed", "axis speed", "linear speed", "Geschwindigkeit", "Vorschub", "v_ist"),
    ),
    "force": (
        Quantity("force", "N", Info("F_x", "force of the process", "N")),
        ("F", "process force", "cutting force", "load", "Kraft", "Prozesskraft", "Schnittkraft"),
    ),
    "temperature": (
        Quantity("temperature", "K", Info("T", "temperature of the oil", "degC", above=0)),
        ("T", "temp", "oil temperature", "nut temperature", "Temperatur", "Öltemperatur"),
    ),
}
COLUMNS = tuple(Column(name, of, names, name == "time", _HINTS) for name, (of, names) in _OF.items())
#: Ratios of units that are mixed up: m and mm, inch and mm, minutes and seconds, cm.
_RATIOS = (1000.0, 25.4, 60.0, 10.0, 100.0)
#: A step of the position so many times one that is rarely exceeded is no motion; the ratio then is one of units within.
_JUMP, _RARELY, _SAME = 10.0, 0.99, 0.05


def read_trajectory(path: Path) -> Trajectory:
    """The trajectory of a file. Raises :class:`~ballscrew.basis.errors.InputError` that names the row and the
    remedy.
    """
    try:
        with path.open("rb") as file:
            source = source_of(path, file, None)
            start, headings = headings_in(path, source.found, COLUMNS, WITHIN)
            first, body = source.found[start], source.found[start + 1 :]
            good = checked(path, headings, first, body, COLUMNS)
            texts = (cell for row in body for cell in row.cells if isinstance(cell, str))
            layout = Layout(
                path.name,
                {h.column.name: h for h in good},
                {},
                first.line,
                len(first.cells),
                evidence(texts),
                "",
                unused(first, good, body[:WITHIN]),
                frozenset(),
            )
            _check_columns(path, layout)
            cells = NumberReader(layout, keep_going=False, may_keep_going=False)
            parts: list[dict[str, Numbers]] = []
            lines: list[np.ndarray] = []
            for piece in source.pieces(layout, _CHUNK):
                raw = {name: piece.cells[heading.place] for name, heading in layout.headings.items()}
                values, kept = cells.numbers(raw, piece.line, piece.cut_off)
                parts.append({name: column[kept] for name, column in values.items()})
                lines.append(piece.line[kept])
                if sum(one.size for one in lines) > MOST_ROWS:
                    raise InputError(Fault(path.name, f"has more than {MOST_ROWS} rows", "", "cut it to a few cycles"))
    except (OSError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        raise unreadable(path, error) from None
    raise_if_any(cells.faults)
    if not parts or sum(one.size for one in lines) < 3:
        raise InputError(Fault(path.name, "has too few rows below its headings", "", "give one for each sample"))
    columns = {name: np.concatenate([part[name] for part in parts]) for name in layout.headings}
    line = np.concatenate(lines)
    raise_if_any(_faults(path.name, columns, line))
    return Trajectory(
        time=columns["time"],
        position=columns.get("position"),
        speed=None if "position" in columns else columns["speed"],
        force=columns.get("force"),
        temperature=columns.get("temperature"),
        source=path.name,
    )


def _check_columns(path: Path, layout: Layout) -> None:
    if "position" not in layout.headings and "speed" not in layout.headings:
        remedy = 'add one; it may also be called "x [mm]" or "v [m/min]"'
        raise InputError(Fault(path.name, 'has neither a column "position [mm]" nor "speed [m/min]"', "", remedy))


def _faults(name: str, columns: Mapping[str, Numbers], line: np.ndarray) -> list[Fault]:
    """Missing numbers, times that run back, gaps, and units that change midway, each with its row."""
    where = f"{name} row {{0}}"
    missing = [
        Fault(
            where.format(line[int(np.argmax(np.isnan(values)))]),
            f"has no {column}",
            "",
            "fill it in, or cut it out",
        )
        for column, values in columns.items()
        if column != "temperature" and np.isnan(values).any()
    ]
    if missing:
        return missing
    faults = faults_of_times(columns["time"], where, line)
    path = columns.get("position", columns.get("speed"))
    return faults if faults or path is None else _of_units(path, where, line)


def _of_units(path: Numbers, where: str, line: np.ndarray) -> list[Fault]:
    """A jump after which all numbers are larger or smaller by the ratio of two units."""
    steps = np.abs(np.diff(path))
    at = int(np.argmax(steps))
    usual = float(np.quantile(np.delete(steps, at), _RARELY))
    before, after = float(path[at]), float(path[at + 1])
    if not steps[at] > _JUMP * usual or not before or not after:
        return []
    ratio = max(abs(after / before), abs(before / after))
    factor = next((known for known in _RATIOS if abs(ratio / known - 1) < _SAME), None)
    if factor is None:
        return []
    given = (
        f"{ratio:.4g} times the number before it" if abs(after) > abs(before) else f"1/{ratio:.4g} of the one before"
    )
    return [Fault(where.format(line[at + 1]), "has another unit than the rows above", given, "write all in one unit")]

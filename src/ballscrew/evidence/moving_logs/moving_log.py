"""Logs of a moving axis: time, position (or speed) and the force that drives it, at even steps of time.

Signs: a positive force drives towards positive positions.
"""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Mapping
from typing import Annotated, Any, Self

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.errors import Fault, InputError, raise_if_any, si_value
from ballscrew.basis.quantities import Force, Info, Length, Quantity, Speed, quantities_of
from ballscrew.files.torque_logs.log_rows import Time, within
from ballscrew.files.torque_logs.motion import Floats

#: Fewer rows than these do not tell four numbers and their errors.
LEAST_ROWS = 200
#: A step of time may differ so much, as a share, from the usual one before rows are put on an even grid.
EVEN = 0.01
#: So many missing rows in one place are filled in by straight lines; more are a gap.
FILLED = 3
#: A step of the position is a jump if it is so many times the largest usual one, which one row in a hundred exceeds.
_JUMP, _USUAL = 20.0, 0.99
#: Speeds below this share of the largest are rest.
REST = 1e-3
#: The position must move by so many times the step in which it is written.
_RESOLVED = 20.0


@dataclasses.dataclass(frozen=True, eq=False)
class MovingLog:
    """A recorded motion of an axis in SI: arrays of equal length, one number for each row.

    ``position`` may be left out where there is a ``speed``. ``line`` numbers the rows in the file, from 1. Raises
    :class:`~ballscrew.basis.errors.InputError` for columns of unequal length, and for neither a position nor a speed.
    """

    time: Annotated[Time, within(1e18, Info("t", "time", "s"))]
    force: Annotated[Force, within(1e9, Info("F", "force of the motor at the nut, along the screw", "N"))]
    position: Annotated[Length | None, within(1e6, Info("x", "position of the nut along the screw", "mm"))] = None
    speed: Annotated[Speed | None, within(1e6, Info("v", "speed of the nut along the screw", "mm/s"))] = None
    line: Any = None
    #: How many rows there were before any was left out or filled in.
    rows: int = 0
    #: Remarks on the log, one line each.
    notes: tuple[str, ...] = ()
    #: Name and SHA-256 of the file it came from.
    source: tuple[str, str] | None = None
    #: Force for each volt of a control voltage, N/V, where the force came from one.
    gain: float = np.nan
    #: Unit of the ``force``; A where it is the current of a motor whose torque constant is not known.
    unit: str = "N"

    def __post_init__(self) -> None:
        if self.position is None and self.speed is None:
            raise InputError(Fault("log", "has neither a position nor a speed", "", "give one of them"))
        for name, values in self.columns.items():
            in_si = si_value(f"log.{name}", values, quantities()[name].unit)
            object.__setattr__(self, name, np.asarray(in_si, dtype=np.float64))
        line = np.arange(1, len(self) + 1) if self.line is None else np.asarray(self.line)
        object.__setattr__(self, "line", line)
        object.__setattr__(self, "rows", self.rows or len(self))
        sizes = {name: np.shape(values) for name, values in {**self.columns, "line": line}.items()}
        if len(set(sizes.values())) > 1 or np.ndim(self.time) != 1:
            told = ", ".join(f"{name} {' x '.join(map(str, shape)) or 'one'}" for name, shape in sizes.items())
            raise InputError(Fault("log", "has columns of different lengths", told, "give every column each row"))

    def __len__(self) -> int:
        return int(np.size(self.time))

    @classmethod
    def of(cls, data: Any) -> MovingLog:
        """A log from ``data``, arrays by name in SI (a mapping, a frame), or the log itself.

        ``time`` (s) and ``force`` (N) are needed, and ``position`` (m) or ``speed`` (m/s).
        Raises :class:`~ballscrew.basis.errors.InputError` for columns that are missing or of unequal length.
        """
        if isinstance(data, MovingLog):
            return data
        known = ("time", "force", "position", "speed")
        missing = [Fault(f"log.{name}", "missing", "", "give an array") for name in known[:2] if name not in data]
        raise_if_any(missing)
        return cls(**{name: data[name] for name in known if name in data})

    @property
    def columns(self) -> dict[str, Any]:
        """The columns that are there, by name."""
        every = {name: getattr(self, name) for name in ("time", "force", "position", "speed")}
        return {name: values for name, values in every.items() if values is not None}

    @property
    def path_column(self) -> str:
        """The column that tells the motion: the position, or else the speed."""
        return "speed" if self.position is None else "position"

    @functools.cached_property
    def step(self) -> float:
        """The usual step of time, s."""
        return float(np.median(np.diff(self.time)))

    def select(self, keep: NDArray[Any] | slice) -> Self:
        """The rows to ``keep``: of a mask, of indices or of a slice."""
        columns = {name: values[keep] for name, values in self.columns.items()}
        return dataclasses.replace(self, **columns, line=self.line[keep])

    def with_notes(self, *notes: str) -> Self:
        """The same log with further ``notes``, each once."""
        return dataclasses.replace(self, notes=tuple(dict.fromkeys((*self.notes, *filter(None, notes)))))

    def checked(self, *, keep_going: bool = False) -> MovingLog:
        """The log at even steps of time, without missing values; faults are named with their rows.

        Up to three rows that are missing in one place are filled in by straight lines. With ``keep_going`` the longest
        stretch without a fault is used. Raises :class:`~ballscrew.basis.errors.InputError` for missing values, time
        that runs back or stands still, gaps, jumps of the position (a unit that changes, an encoder that is reset),
        and logs that are too short or do not move.
        """
        name = self.source[0] if self.source else "log"
        known = np.all([np.isfinite(values) for values in self.columns.values()], axis=0)
        log: MovingLog = self if known.all() else self.select(known)
        _check_length(name, len(log))
        faults = _missing(name, self, known) + _breaks(name, log)
        if faults and not keep_going:
            raise InputError(*(fault for _, fault in faults))
        if faults:
            log = _longest_stretch(log)
            _check_length(name, len(log))
            left = f"{self.rows - len(log)} of {self.rows} rows are left out: the longest stretch without a fault stays"
            log = log.with_notes(str(faults[0][1]), left)
        log = _on_even_grid(log)
        _check_motion(name, log)
        return log


@functools.cache
def quantities() -> Mapping[str, Quantity]:
    """The columns of a log: their units and bounds."""
    return {
        name: each for name, each in quantities_of(MovingLog).items() if name in ("time", "force", "position", "speed")
    }


def _check_length(name: str, rows: int) -> None:
    if rows < LEAST_ROWS:
        remedy = f"record {LEAST_ROWS} rows or more, with several strokes in both directions"
        raise InputError(Fault(name, "is too short for a fit of a motion", f"{rows} rows", remedy))


def _missing(name: str, log: MovingLog, known: NDArray[np.bool_]) -> list[tuple[int, Fault]]:
    """Faults of runs of rows with missing values that are too long to fill in."""
    edges = np.flatnonzero(np.diff(np.concatenate([[True], known, [True]]).astype(np.int8)))
    missing: list[tuple[int, Fault]] = []
    for begin, end in edges.reshape(-1, 2).tolist():
        if end - begin > FILLED:
            lacks = next(n for n, values in log.columns.items() if not np.isfinite(values[begin:end]).all())
            problem = f"has no {lacks} in {end - begin} rows one after the other"
            remedy = "cut the log there, or give --keep-going, which uses the longest stretch without a fault"
            missing.append((begin, Fault(f"{name} row {log.line[begin]}", problem, "", remedy)))
    return missing


def _breaks(name: str, log: MovingLog) -> list[tuple[int, Fault]]:
    """Faults between rows: time that runs back, gaps, jumps of the position."""
    tests = (
        (_runs_back, "time runs back or stands still", "cut the log there: one record at a time"),
        (_gaps, "a gap in time", "record without gaps, or cut the log there"),
        (_jumps, "position jumps", "a unit changes there or the encoder was reset: cut the log there"),
    )
    breaks: list[tuple[int, Fault]] = []
    for test, problem, remedy in tests:
        for place in np.flatnonzero(test(log)).tolist():
            column = log.columns["time" if test is not _jumps else log.path_column]
            given = f"{column[place]:.6g} to {column[place + 1]:.6g}"
            breaks.append((place, Fault(f"{name} row {log.line[place + 1]}", problem, given, remedy)))
        if breaks:  # a jump beside a gap is the gap
            break
    return breaks


def _runs_back(log: MovingLog) -> NDArray[np.bool_]:
    return np.diff(log.time) <= 0


def _gaps(log: MovingLog) -> NDArray[np.bool_]:
    return np.diff(log.time) > (FILLED + 1.5) * log.step


def _jumps(log: MovingLog) -> NDArray[np.bool_]:
    if log.position is None:
        return np.zeros(len(log) - 1, dtype=bool)
    change = np.abs(np.diff(log.position)) / np.maximum(np.round(np.diff(log.time) / log.step), 1.0)
    # of a log that rests most of its time, the steps that move
    moving = change[change > 0]
    return change > _JUMP * float(np.quantile(moving, _USUAL)) if moving.size else np.zeros(change.size, dtype=bool)


def _longest_stretch(log: MovingLog) -> MovingLog:
    tests: tuple[Callable[[MovingLog], NDArray[np.bool_]], ...] = (_runs_back, _gaps, _jumps)
    broken = np.any([test(log) for test in tests], axis=0)
    ends = np.concatenate([[0], np.flatnonzero(broken) + 1, [len(log)]])
    longest = int(np.argmax(np.diff(ends)))
    return log.select(slice(int(ends[longest]), int(ends[longest + 1])))


def _on_even_grid(log: MovingLog) -> MovingLog:
    """The log at even steps of time; between rows by straight lines where they are not even already."""
    off = np.abs(np.diff(log.time) / log.step - 1)
    if float(off.max()) <= EVEN:
        return log
    step = log.step
    time = log.time[0] + step * np.arange(int((log.time[-1] - log.time[0]) / step * (1 + 1e-12)) + 1)
    nearest: NDArray[Any] = np.clip(np.searchsorted(log.time, time), 0, len(log) - 1)
    columns = {name: np.interp(time, log.time, values) for name, values in log.columns.items() if name != "time"}
    told = f"steps of time differ by up to {float(off.max()):.0%}: rows are put on an even grid by straight lines"
    return dataclasses.replace(log, time=time, **columns, line=log.line[nearest]).with_notes(told)


def _check_motion(name: str, log: MovingLog) -> None:
    path: Floats = log.columns[log.path_column]
    steps = np.unique(np.abs(np.diff(path)))
    resolution = float(steps[steps > 0].min()) if (steps > 0).any() else np.inf
    if float(np.ptp(path)) < _RESOLVED * resolution:
        remedy = "record strokes in both directions, with the position in finer steps"
        raise InputError(Fault(name, f"does not move: its {log.path_column} is the same in all rows", "", remedy))
    if float(np.ptp(log.force)) == 0:
        raise InputError(Fault(name, "has the same force in all rows", "", "record what the motor gives"))

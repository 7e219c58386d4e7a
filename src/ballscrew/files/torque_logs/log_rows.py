"""Rows of a log of torque: the columns measured on a ball screw, in SI.

Signs: a positive axial load is one that a positive speed works against. A torque that drives the screw has the sign of
the speed where it does work; a friction torque has it everywhere.
"""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Mapping
from typing import Annotated, Any, Literal, Self, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.errors import Fault, InputError, si_value
from ballscrew.basis.quantities import AngularSpeed, Force, Info, Quantity, Temperature, Torque, Unit, quantities_of
from ballscrew.files.torque_logs.motion import Floats, Motion

#: Kind of the torque of a log; unknown where the heading is only "torque".
Kind: TypeAlias = Literal["friction", "drive", "unknown"]
#: Names of the torque in data from Python, and its kind.
TORQUES: Mapping[str, Kind] = {"torque": "unknown", "friction_torque": "friction", "drive_torque": "drive"}
REQUIRED = ("axial_load", "screw_speed", "torque")
OPTIONAL = ("temperature", "time")
INERTIA = Quantity(
    "inertia", "kg m^2", Info("J", "moment of inertia that the torque accelerates, seen at the screw", at_least=0)
)
#: A median temperature below this is one in °C given as one in kelvin: no ball screw is so cold.
COLDEST = 150.0

Time = Annotated[Any, Unit("s")]


def within(limit: float, info: Info) -> Info:
    """The same with bounds to both sides."""
    return dataclasses.replace(info, at_least=-limit, at_most=limit, hint="check the number and its unit")


@dataclasses.dataclass(frozen=True, eq=False)
class LogRows:
    """Rows of a log of torque in SI: arrays of equal length, one number for each row.

    The bounds lie far beyond all machines: what loggers write for no value (9.9e37) is no measurement.

    Raises :class:`~ballscrew.basis.errors.InputError` if the lengths differ.
    """

    axial_load: Annotated[
        Force, within(1e12, Info("F", "axial load; positive where a positive speed works against it", "N"))
    ]
    screw_speed: Annotated[AngularSpeed, within(1e9, Info(r"\omega", "speed of the screw, negative in reverse", "rpm"))]
    torque: Annotated[Torque, within(1e6, Info("M", "measured torque", "N m"))]
    temperature: Annotated[
        Temperature | None, Info("T", "temperature of the oil", "degC", above=0, hint="not colder than absolute zero")
    ] = None
    time: Annotated[Time | None, within(1e18, Info("t", "time", "s"))] = None
    #: Numbers of the rows in the file, or in the arrays given, from 1.
    line: Any = None
    #: Whether the torque is ``"friction"`` or ``"drive"`` torque, or ``"unknown"``.
    kind: Kind = "unknown"
    #: How many rows there were before any was left out.
    rows: int = 0
    #: Rows left out, by reason.
    left_out: Mapping[str, int] = dataclasses.field(default_factory=dict[str, int])
    #: Remarks on the log, one line each.
    notes: tuple[str, ...] = ()
    #: Name and SHA-256 of the file it came from.
    source: tuple[str, str] | None = None
    #: Whether no load was given: it is taken as none.
    assumes_no_load: bool = False
    #: Whether it is the result of cleaning.
    is_clean: bool = False
    #: Random numbers of the rows: those with the smallest are kept when a log is thinned.
    keys: Floats | None = None
    #: Derivatives of the speed, where they are known already.
    motion: Motion | None = None

    def __post_init__(self) -> None:
        for name, values in self.columns.items():
            if not (type(values) is np.ndarray and values.dtype == np.float64):  # those of another log are
                in_si = si_value(f"log.{name}", values, quantities()[name].unit)
                object.__setattr__(self, name, np.asarray(in_si, dtype=np.float64))
        line = np.arange(1, len(self) + 1) if self.line is None else np.asarray(self.line)
        object.__setattr__(self, "line", line)
        object.__setattr__(self, "rows", self.rows or len(self))
        sizes = {name: values.shape for name, values in {**self.columns, "line": line}.items()}
        if len(set(sizes.values())) > 1 or self.torque.ndim != 1:
            told = ", ".join(f"{name} {' x '.join(map(str, shape)) or 'one'}" for name, shape in sizes.items())
            raise InputError(Fault("log", "has columns of different lengths", told, "give every column each row"))

    def __len__(self) -> int:
        return int(np.size(self.torque))

    @property
    def columns(self) -> dict[str, Any]:
        """The columns that are there, by name."""
        every = {name: getattr(self, name) for name in (*REQUIRED, *OPTIONAL)}
        return {name: values for name, values in every.items() if values is not None}

    @property
    def forward(self) -> NDArray[np.bool_]:
        """The rows at which the screw turns forward."""
        return self.screw_speed > 0

    @property
    def backward(self) -> NDArray[np.bool_]:
        """The rows at which the screw turns in reverse."""
        return self.screw_speed < 0

    @property
    def usage(self) -> str:
        """Number of rows that are used, and why the others are not: ``2522 of 3108 rows used; left out: 407, …``."""
        said = f"{len(self)} of {self.rows} rows used"
        reasons = [f"{count} rows, {reason}" for reason, count in self.left_out.items()]
        return f"{said}; left out: {'; '.join(reasons)}" if reasons else said

    def select(self, keep: NDArray[Any], reason: str = "") -> Self:
        """The rows to ``keep``: of a mask or of indices. The others are counted under ``reason``."""
        columns = {name: values[keep] for name, values in self.columns.items()}
        line = self.line[keep]
        lost = len(self) - line.size
        counts = {**self.left_out, reason: self.left_out.get(reason, 0) + lost} if reason and lost else self.left_out
        keys = None if self.keys is None else self.keys[keep]
        motion = None if self.motion is None else self.motion.select(keep)
        return dataclasses.replace(self, **columns, line=line, left_out=counts, keys=keys, motion=motion)

    def with_notes(self, *notes: str) -> Self:
        """The same log with further ``notes``, each once."""
        return dataclasses.replace(self, notes=tuple(dict.fromkeys((*self.notes, *filter(None, notes)))))


@functools.cache
def quantities() -> Mapping[str, Quantity]:
    """The columns of a log: their units and bounds."""
    return {name: each for name, each in quantities_of(LogRows).items() if name in (*REQUIRED, *OPTIONAL)}


def seconds(dates: NDArray[Any]) -> Floats:
    """Dates and times (``datetime64`` or ``timedelta64``) as seconds from the first that is known."""
    known = dates[~np.isnat(dates)]
    if not known.size:
        return np.full(dates.shape, np.nan)
    return (dates - known[0]) / np.timedelta64(1, "s")


def fault_of_celsius(where: str, temperature: Floats, remedy: str) -> Fault | None:
    """The fault of temperatures in °C that are given as kelvin; None for others."""
    measured = temperature[np.isfinite(temperature)]
    if not measured.size or np.median(measured) >= COLDEST:
        return None
    return Fault(where, "must be in kelvin", f"{np.median(measured):.4g}", remedy)

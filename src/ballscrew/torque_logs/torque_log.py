"""Logs of torque: what was measured on a ball screw, row by row, and what of it is fit to calibrate a model.

Signs: a positive axial load is one that a positive speed works against. A torque that drives the screw has the sign of
the speed where it does work; a friction torque has it everywhere.
"""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Mapping
from typing import Annotated, Any, Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ballscrew.analyses.log_motion import Floats, Motion
from ballscrew.faults import Fault, InputError, nearest, raise_if_any
from ballscrew.quantities import AngularSpeed, Force, Info, Quantity, Temperature, Torque, Unit, quantities_of

#: What the torque of a log is. Of an unknown one, the heading says only "torque".
Kind: TypeAlias = Literal["friction", "drive", "unknown"]
#: The names a torque has in data from Python, and what it then is.
TORQUES: Mapping[str, Kind] = {"torque": "unknown", "friction_torque": "friction", "drive_torque": "drive"}
REQUIRED = ("axial_load", "screw_speed", "torque")
OPTIONAL = ("temperature", "time")
#: No ball screw runs below this: it is a temperature in °C that was given as one in kelvin.
_COLDEST = 150.0

INERTIA = Quantity(
    "inertia", "kg m^2", Info("J", "moment of inertia that the torque accelerates, seen at the screw", at_least=0)
)
TORQUE_CONSTANT = Quantity("torque_constant", "N m/A", Info("k_T", "torque of the motor for each ampere", above=0))

Time = Annotated[Any, Unit("s")]


@dataclasses.dataclass(frozen=True, eq=False)
class TorqueLog:
    """A log of torque in SI: arrays of equal length, one number for each row.

    Raises :class:`~ballscrew.faults.InputError` if the lengths differ. See :meth:`of` for data of other kinds,
    and :meth:`cleaned` for the rows that a model can be fitted to.
    """

    axial_load: Annotated[Force, Info("F", "axial load; positive where a positive speed works against it", "N")]
    screw_speed: Annotated[AngularSpeed, Info(r"\omega", "speed of the screw, negative in reverse", "rpm")]
    torque: Annotated[Torque, Info("M", "measured torque", "N m")]
    temperature: Annotated[
        Temperature | None, Info("T", "temperature of the oil", "degC", above=0, hint="not colder than absolute zero")
    ] = None
    time: Annotated[Time | None, Info("t", "time", "s")] = None
    #: Numbers of the rows in the file, or in the arrays given, from 1.
    line: Any = None
    kind: Kind = "unknown"
    #: How many rows there were before any was left out.
    rows: int = 0
    #: Rows left out, by reason.
    left_out: Mapping[str, int] = dataclasses.field(default_factory=dict[str, int])
    #: What is to be said of the log, one line each.
    notes: tuple[str, ...] = ()
    #: Name and SHA-256 of the file it came from.
    source: tuple[str, str] | None = None
    #: Whether :meth:`cleaned` made it.
    is_clean: bool = False
    #: Random numbers of the rows: those with the smallest stay when a log is thinned.
    keys: Floats | None = None
    #: How the speed changes, where that is known already.
    motion: Motion | None = None

    def __post_init__(self) -> None:
        for name, values in self.columns.items():
            object.__setattr__(self, name, np.asarray(values, dtype=np.float64))
        line = np.arange(1, len(self) + 1) if self.line is None else np.asarray(self.line)
        object.__setattr__(self, "line", line)
        object.__setattr__(self, "rows", self.rows or len(self))
        sizes = {name: values.shape for name, values in {**self.columns, "line": line}.items()}
        if len(set(sizes.values())) > 1 or self.torque.ndim != 1:
            told = ", ".join(f"{name} {' x '.join(map(str, shape)) or 'one'}" for name, shape in sizes.items())
            raise InputError(Fault("log", "has columns of different lengths", told, "give every column each row"))

    def __len__(self) -> int:
        return int(np.size(self.torque))

    @classmethod
    def of(cls, data: Any) -> TorqueLog:
        """A log from arrays by name: a mapping, a pandas DataFrame or an xarray Dataset; in SI.

        ``axial_load``, ``screw_speed`` and a torque are needed; the torque is called ``friction_torque``,
        ``drive_torque`` or just ``torque``. ``temperature`` (K) and ``time`` (s, or dates) may be there too. A single
        number stands for every row. A log passes as it is.

        Raises :class:`~ballscrew.faults.InputError` for columns that are missing, of unequal length or no numbers.
        """
        return data if isinstance(data, TorqueLog) else _log_of(data)

    @property
    def columns(self) -> dict[str, Any]:
        """The columns that are there, by name."""
        every = {name: getattr(self, name) for name in (*REQUIRED, *OPTIONAL)}
        return {name: values for name, values in every.items() if values is not None}

    @property
    def forward(self) -> NDArray[np.bool_]:
        """Where the screw turns forward."""
        return self.screw_speed > 0

    @property
    def backward(self) -> NDArray[np.bool_]:
        """Where the screw turns in reverse."""
        return self.screw_speed < 0

    def taken(self, keep: NDArray[Any], reason: str = "") -> TorqueLog:
        """Some of the rows: of a mask or of places. The others are counted under ``reason``."""
        columns = {name: values[keep] for name, values in self.columns.items()}
        line = self.line[keep]
        lost = len(self) - line.size
        counts = {**self.left_out, reason: self.left_out.get(reason, 0) + lost} if reason and lost else self.left_out
        keys = None if self.keys is None else self.keys[keep]
        motion = None if self.motion is None else self.motion.taken(keep)
        return dataclasses.replace(self, **columns, line=line, left_out=counts, keys=keys, motion=motion)

    def noted(self, *notes: str) -> TorqueLog:
        """The same with more to be said of it; what was said already is not said again."""
        return dataclasses.replace(self, notes=tuple(dict.fromkeys((*self.notes, *filter(None, notes)))))

    def cleaned(self, *, inertia: float | None = None, most: int = 100_000) -> TorqueLog:
        """The rows that a model of steady motion can be fitted to; a log that is clean passes as it is.

        Rows without a value, at rest and under acceleration are left out, signs are put right where there is no doubt,
        and of the rest at most ``most`` rows stay. ``inertia`` (kg m²) is what the torque accelerates: its share is
        taken off a torque that is not said to be one of friction. ``left_out`` and ``notes`` say what was done.

        Raises :class:`~ballscrew.faults.InputError` if fewer than three rows are left, or if the signs make no sense.
        """
        from ballscrew.analyses import log_cleaning

        return self if self.is_clean else log_cleaning.cleaned(self, inertia, most)


@functools.cache
def quantities() -> Mapping[str, Quantity]:
    """The columns of a log: their units and bounds."""
    return {name: found for name, found in quantities_of(TorqueLog).items() if name in (*REQUIRED, *OPTIONAL)}


def random_keys(rows: int) -> Floats:
    """The random numbers of the rows of a log, always the same."""
    return np.random.default_rng(0).random(rows)


def _log_of(data: Any) -> TorqueLog:
    if not hasattr(data, "keys") or not hasattr(data, "__getitem__"):
        remedy = "give a mapping of arrays, a pandas DataFrame or an xarray Dataset"
        raise InputError(Fault("data", "is no log", type(data).__name__, remedy))
    names = [str(name) for name in (data.variables if hasattr(data, "data_vars") else data.keys())]
    torques = [name for name in TORQUES if name in names]
    known = [*(name for name in (*REQUIRED, *OPTIONAL) if name in names and name not in TORQUES), *torques[:1]]
    others = [name for name in names if name not in known]
    faults = [
        Fault("data", f'has no column "{name}"', "", _hint(name, others))
        for name in REQUIRED
        if name not in known and not (name == "torque" and torques)
    ]
    if len(torques) > 1:
        faults.append(Fault("data", "has more than one torque", ", ".join(torques), "give one of them"))
    raise_if_any(faults)
    arrays: dict[str, Any] = {}
    for name, values in _raw(data, known).items():
        made = _numbers(name, values)
        if isinstance(made, Fault):
            faults.append(made)
        else:
            arrays["torque" if name in TORQUES else name] = made
    raise_if_any(faults)
    size = max((array.size for array in arrays.values() if array.ndim), default=1)
    arrays = {name: np.full(size, array) if array.ndim == 0 else array for name, array in arrays.items()}
    log = TorqueLog(**arrays, kind=TORQUES[torques[0]])
    return log.noted(f"columns not used: {', '.join(others)}" if others else "")


def _raw(data: Any, names: list[str]) -> dict[str, Any]:
    """The arrays by name; those of a dataset along all of its dimensions."""
    if not hasattr(data, "data_vars"):
        return {name: data[name] for name in names}
    import xarray as xr

    arrays = xr.broadcast(*(data[name] for name in names))
    return {name: array.to_numpy().reshape(-1) for name, array in zip(names, arrays, strict=True)}


def _hint(name: str, others: list[str]) -> str:
    unit = quantities()[name].unit
    alike = nearest(name, others) if others else ""
    return alike if alike.startswith("did") else f"give an array in {unit}"


def _numbers(name: str, values: Any) -> Floats | Fault:
    """An array of floats; times that are dates as seconds from the first."""
    array = np.asarray(values)
    if array.dtype.kind in "Mm" and name == "time":
        return seconds(array)
    if array.dtype.kind == "O" and array.ndim == 1:
        array = np.array([np.nan if value is None else value for value in array])
    if array.dtype.kind not in "fiu":
        given = str(array.dtype) if array.dtype.kind in "bcmM" else next(map(str, array.reshape(-1)), "")
        return Fault(f"data.{name}", "must be an array of numbers", given, "give a numpy.array of floats")
    if array.ndim > 1:
        return Fault(f"data.{name}", "must have one dimension", str(array.shape), "give one number for each row")
    array = array.astype(np.float64)
    if name == "temperature" and np.isfinite(array).any() and np.nanmedian(array) < _COLDEST:
        given = f"{np.nanmedian(array):.4g}"
        return Fault(f"data.{name}", "must be in kelvin", given, "add 273.15 to temperatures in °C")
    return array


def seconds(dates: NDArray[Any]) -> Floats:
    """Dates and times (``datetime64`` or ``timedelta64``) as seconds from the first that is known."""
    known = dates[~np.isnat(dates)]
    if not known.size:
        return np.full(dates.shape, np.nan)
    return (dates - known[0]) / np.timedelta64(1, "s")

"""Torque logs: arrays by name made into rows in SI, and cleaned for the calibration of a model.

The signs are those of :mod:`~ballscrew.files.torque_logs.log_rows`.
"""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np

from ballscrew.basis.errors import Fault, InputError, accepts_units, closest, nearest, raise_if_any, without_unit
from ballscrew.basis.quantities import MomentOfInertia
from ballscrew.files.torque_logs import cleaning
from ballscrew.files.torque_logs.columns import columns_not_used
from ballscrew.files.torque_logs.log_rows import (
    OPTIONAL,
    REQUIRED,
    TORQUES,
    LogRows,
    fault_of_celsius,
    quantities,
    seconds,
)
from ballscrew.files.torque_logs.motion import Floats

#: The note on data without a load.
NO_LOAD = "no axial load: 0 N in every row"


@dataclasses.dataclass(frozen=True, eq=False)
class TorqueLog(LogRows):
    """A log of torque in SI: arrays of equal length, one number for each row.

    Raises :class:`~ballscrew.basis.errors.InputError` if the lengths differ. See :meth:`of` for data of other kinds,
    and :meth:`cleaned` for the rows that a model can be fitted to.
    """

    @classmethod
    def of(cls, data: Any) -> TorqueLog:
        """A log from ``data``, arrays by name: a mapping, a pandas DataFrame or an xarray Dataset; in SI.

        ``screw_speed`` and a torque are needed, and ``axial_load`` where there was one: without it and without a column
        of another name the load is 0 N, which a note says. The torque is called ``friction_torque``,
        ``drive_torque`` or just ``torque``. ``temperature`` (K) and ``time`` (s, or dates) may be there too. A single
        number stands for every row. A log passes as it is.

        Raises :class:`~ballscrew.basis.errors.InputError` for columns that are missing, of unequal length or no
        numbers.
        """
        return data if isinstance(data, TorqueLog) else _log_of(data)

    @accepts_units("log")
    def cleaned(self, *, inertia: MomentOfInertia | None = None, most: int = 100_000) -> TorqueLog:
        """The rows that a model of steady motion can be fitted to; a log that is clean passes as it is.

        Rows without a value, at rest and under acceleration are left out, signs are put right where there is no doubt,
        and of the rest at most ``most`` rows stay. ``inertia`` (kg m²) is what the torque accelerates: its share is
        taken off a torque that is not said to be one of friction. ``left_out`` and ``notes`` say what was done.

        Raises :class:`~ballscrew.basis.errors.InputError` if fewer than three rows are left, or if the signs make no
        sense.
        """
        return self if self.is_clean else cleaning.cleaned(self, inertia, most)


def _log_of(data: Any) -> TorqueLog:
    named = _Named.of(data)
    raise_if_any(named.faults)
    arrays: dict[str, Any] = _arrays(data, named.known)
    if named.without_load:
        arrays["axial_load"] = np.zeros(())
    size = max((array.size for array in arrays.values() if array.ndim), default=1)
    arrays = {name: np.full(size, array) if array.ndim == 0 else array for name, array in arrays.items()}
    log = TorqueLog(**arrays, kind=TORQUES[named.torques[0]], assumes_no_load=named.without_load)
    not_used = columns_not_used(named.others) if named.others else ""
    return log.with_notes(not_used, NO_LOAD if named.without_load else "")


@dataclasses.dataclass(frozen=True)
class _Named:
    """The columns of data by name: those that a log has, with one torque, and the others."""

    known: list[str]
    others: list[str]
    torques: list[str]

    @classmethod
    def of(cls, data: Any) -> _Named:
        """Those of arrays by name. Raises :class:`~ballscrew.basis.errors.InputError` for anything else."""
        if not hasattr(data, "keys") or not hasattr(data, "__getitem__"):
            remedy = "give a mapping of arrays, a pandas DataFrame or an xarray Dataset"
            raise InputError(Fault("data", "is no log", type(data).__name__, remedy))
        names = [str(name) for name in (data.variables if hasattr(data, "data_vars") else data.keys())]
        torques = [name for name in TORQUES if name in names]
        known = [*(name for name in (*REQUIRED, *OPTIONAL) if name in names and name not in TORQUES), *torques[:1]]
        return cls(known, [name for name in names if name not in known], torques)

    @property
    def without_load(self) -> bool:
        """True where there was no load; a column of another name may be that of the load."""
        return "axial_load" not in self.known and not self.others

    @property
    def faults(self) -> list[Fault]:
        """The faults of columns that are missing, and of torques beside each other."""
        there = {*self.known, *(["torque"] if self.torques else []), *(["axial_load"] if self.without_load else [])}
        faults = [
            Fault("data", f'has no column "{name}"', "", _hint(name, self.others))
            for name in REQUIRED
            if name not in there
        ]
        if len(self.torques) > 1:
            given = ", ".join(self.torques)
            faults.append(Fault("data", "has more than one torque", given, "give one of them"))
        return faults


def _arrays(data: Any, names: list[str]) -> dict[str, Any]:
    """The arrays of numbers by the name of their column in a log. Raises
    :class:`~ballscrew.basis.errors.InputError`.
    """
    faults: list[Fault] = []
    arrays: dict[str, Any] = {}
    for name, values in _raw(data, names).items():
        made = _numbers(name, values)
        if isinstance(made, Fault):
            faults.append(made)
        else:
            arrays["torque" if name in TORQUES else name] = made
    raise_if_any(faults)
    return arrays


def _raw(data: Any, names: list[str]) -> dict[str, Any]:
    """The arrays by name; those of a dataset along all of its dimensions."""
    if not hasattr(data, "data_vars"):
        return {name: data[name] for name in names}
    import xarray as xr

    arrays = xr.broadcast(*(data[name] for name in names))
    return {name: array.to_numpy().reshape(-1) for name, array in zip(names, arrays, strict=True)}


def _hint(name: str, others: list[str]) -> str:
    if closest(name, others):
        return nearest(name, others)
    return f"give an array in {quantities()[name].unit}"


def _numbers(name: str, values: Any) -> Floats | Fault:
    """An array of floats; times that are dates as seconds from the first."""
    quantity = quantities()["torque" if name in TORQUES else name]
    values = without_unit(f"data.{name}", values, quantity.unit)
    if isinstance(values, Fault):
        return values
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
    celsius = fault_of_celsius("data.temperature", array, "add 273.15 to temperatures in °C")
    return array if name != "temperature" or celsius is None else celsius

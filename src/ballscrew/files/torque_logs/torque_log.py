"""Torque logs: arrays by name made into rows in SI, and cleaned for the calibration of a model.

The signs are those of :mod:`~ballscrew.torque_logs.log_rows`.
"""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np

from ballscrew.errors import Fault, InputError, accepts_units, nearest, raise_if_any, without_unit
from ballscrew.quantities import MomentOfInertia
from ballscrew.torque_logs import cleaning
from ballscrew.torque_logs.log_rows import OPTIONAL, REQUIRED, TORQUES, LogRows, quantities, seconds
from ballscrew.torque_logs.motion import Floats

#: A median temperature below this is one in °C given as one in kelvin: no ball screw is so cold.
_COLDEST = 150.0
#: The note on data without a load.
NO_LOAD = "no axial load: 0 N in every row"


@dataclasses.dataclass(frozen=True, eq=False)
class TorqueLog(LogRows):
    """A log of torque in SI: arrays of equal length, one number for each row.

    Raises :class:`~ballscrew.errors.InputError` if the lengths differ. See :meth:`of` for data of other kinds,
    and :meth:`cleaned` for the rows that a model can be fitted to.
    """

    @classmethod
    def of(cls, data: Any) -> TorqueLog:
        """A log from arrays by name: a mapping, a pandas DataFrame or an xarray Dataset; in SI.

        ``screw_speed`` and a torque are needed, and ``axial_load`` where there was one: without it and without a column
        of another name the load is 0 N, which a note says. The torque is called ``friction_torque``,
        ``drive_torque`` or just ``torque``. ``temperature`` (K) and ``time`` (s, or dates) may be there too. A single
        number stands for every row. A log passes as it is.

        Raises :class:`~ballscrew.errors.InputError` for columns that are missing, of unequal length or no numbers.
        """
        return data if isinstance(data, TorqueLog) else _log_of(data)

    @accepts_units("log")
    def cleaned(self, *, inertia: MomentOfInertia | None = None, most: int = 100_000) -> TorqueLog:
        """The rows that a model of steady motion can be fitted to; a log that is clean passes as it is.

        Rows without a value, at rest and under acceleration are left out, signs are put right where there is no doubt,
        and of the rest at most ``most`` rows stay. ``inertia`` (kg m²) is what the torque accelerates: its share is
        taken off a torque that is not said to be one of friction. ``left_out`` and ``notes`` say what was done.

        Raises :class:`~ballscrew.errors.InputError` if fewer than three rows are left, or if the signs make no sense.
        """
        return self if self.is_clean else cleaning.cleaned(self, inertia, most)


def _log_of(data: Any) -> TorqueLog:
    if not hasattr(data, "keys") or not hasattr(data, "__getitem__"):
        remedy = "give a mapping of arrays, a pandas DataFrame or an xarray Dataset"
        raise InputError(Fault("data", "is no log", type(data).__name__, remedy))
    names = [str(name) for name in (data.variables if hasattr(data, "data_vars") else data.keys())]
    torques = [name for name in TORQUES if name in names]
    known = [*(name for name in (*REQUIRED, *OPTIONAL) if name in names and name not in TORQUES), *torques[:1]]
    others = [name for name in names if name not in known]
    # another name may be that of the load
    without_load = "axial_load" not in known and not others
    faults = [
        Fault("data", f'has no column "{name}"', "", _hint(name, others))
        for name in REQUIRED
        if name not in known and not (name == "torque" and torques) and not (name == "axial_load" and without_load)
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
    if without_load:
        arrays["axial_load"] = np.zeros(())
    size = max((array.size for array in arrays.values() if array.ndim), default=1)
    arrays = {name: np.full(size, array) if array.ndim == 0 else array for name, array in arrays.items()}
    log = TorqueLog(**arrays, kind=TORQUES[torques[0]], assumes_no_load=without_load)
    notes = [f"columns not used: {', '.join(others)}" if others else "", NO_LOAD if without_load else ""]
    return log.with_notes(*notes)


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
    if name == "temperature" and np.isfinite(array).any() and np.nanmedian(array) < _COLDEST:
        given = f"{np.nanmedian(array):.4g}"
        return Fault(f"data.{name}", "must be in kelvin", given, "add 273.15 to temperatures in °C")
    return array

"""Axes: values to vary as labelled arrays, their ends, and the faults in them."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ballscrew.basis.arrays import map_blocks
from ballscrew.basis.errors import Fault, fault_of, fault_of_declared_unit, without_unit
from ballscrew.basis.quantities import Quantity

#: Numbers of a block: they are in the cache when they are read for the second time.
BLOCK = 2**18


def ends(values: NDArray[Any]) -> NDArray[Any]:
    """The least and the greatest element of an array with at least one; NaN as both where it has one."""
    if values.size <= 2 * BLOCK or not values.flags.c_contiguous:
        return np.array([values.min(), values.max()])
    flat = values.reshape(-1)
    result = np.empty((2, math.ceil(flat.size / BLOCK)), dtype=values.dtype)

    def of_block(block: slice) -> None:
        part = flat[block]
        result[:, block.start // BLOCK] = part.min(), part.max()

    map_blocks(of_block, flat.size, block_size=BLOCK)
    return np.array([result[0].min(), result[1].max()])


def axis_of(section: str, name: str, values: Any, quantity: Quantity) -> xr.DataArray | Fault:
    """Values as a labelled array: a sequence gets a dimension of its own name."""
    where = f"{section}.{name}"
    numbers = without_unit(where, values.data if isinstance(values, xr.DataArray) else values, quantity.unit)
    if isinstance(numbers, Fault):
        return numbers
    if isinstance(values, xr.DataArray):
        if not all(isinstance(dimension, str) for dimension in values.dims):
            return Fault(where, "has a dimension whose name is no text", str(values.dims), "name it by a text")
        if (fault := fault_of_declared_unit(where, values, quantity.unit)) is not None:
            return fault
        numbers = values if numbers is values.data else values.copy(data=numbers)
    values = numbers
    try:
        if np.ma.isMaskedArray(values) or np.asarray(values).dtype.kind not in "fiu":
            raise TypeError("a mask would be lost, and what is no number would become one")
        if isinstance(values, xr.DataArray):
            axis = values.astype(float, copy=False)
        else:
            array = np.asarray(values, dtype=float)
            if array.ndim > 1:
                return Fault(where, "has several axes", f"shape {array.shape}", "name them: pass an xarray.DataArray")
            axis = xr.DataArray(array, dims=(name,) if array.ndim else ())
    except (TypeError, ValueError):
        return Fault(where, "must be numbers in SI", str(values), "give a number or a plain list of numbers")
    return axis if axis.size else Fault(where, "has no values", "", "give at least one")


def faults_of_axis(part: str, quantity: Quantity, values: np.ndarray, extremes: np.ndarray) -> list[Fault]:
    """Faults of an axis: its ends (NaN comes out as both) and, where whole numbers are needed, the first broken one."""
    telling = (extremes[:1] if np.isnan(extremes[0]) else extremes).tolist()
    if quantity.info.whole:
        telling += values[values != np.floor(values)].ravel()[:1].tolist()
    faults = [fault_of(part, quantity, float(value)) for value in dict.fromkeys(telling)]
    return [fault for fault in faults if fault is not None]

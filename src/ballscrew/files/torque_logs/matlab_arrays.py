"""Arrays of a file of MATLAB, read in a process of its own: a damaged file may crash the libraries that read it.

This module imports little, because each file waits for its imports.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray


def columns(path: str, hdf5: bool) -> tuple[list[str], dict[str, NDArray[np.float64]], dict[str, float]]:
    """The names of all variables, those that are columns of numbers, and those that are one number beside columns.

    A single struct stands for its fields.

    Raises whatever the libraries raise for files that cannot be read.
    """
    result = _read_hdf5(path) if hdf5 else _read_mat5(path)
    if len(result) == 1 and isinstance(only := next(iter(result.values())), Mapping):
        result = {name: np.asarray(one) if isinstance(one, int | float) else one for name, one in only.items()}
    arrays = {
        name: np.atleast_1d(np.squeeze(values)) for name, values in result.items() if isinstance(values, np.ndarray)
    }
    arrays = {name: values for name, values in arrays.items() if values.ndim == 1 and values.dtype.kind in "fiub"}
    longest = max((values.size for values in arrays.values()), default=0)
    kept = {name: values for name, values in arrays.items() if values.size > (longest > 1)}
    numbers = {name: float(values[0]) for name, values in arrays.items() if name not in kept and values.size == 1}
    return list(result), {name: np.asarray(values, np.float64) for name, values in kept.items()}, numbers


def _read_mat5(path: str) -> dict[str, Any]:
    from scipy.io import loadmat

    return {
        name: np.asarray(values) if isinstance(values, int | float) else values
        for name, values in loadmat(path, simplify_cells=True).items()
        if not name.startswith("__")
    }


def _read_hdf5(path: str) -> dict[str, Any]:
    import h5py

    with h5py.File(path) as file:
        return {str(name): _read_group(item) for name, item in file.items() if not str(name).startswith("#")}


def _read_group(item: Any) -> Any:
    """An array, or the arrays of a struct by name."""
    if hasattr(item, "items"):
        return {str(name): _read_group(inner) for name, inner in item.items()}
    text = item.attrs.get("MATLAB_class", b"") == b"char"
    return None if text else np.asarray(item)

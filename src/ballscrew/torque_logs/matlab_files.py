"""Logs in files of MATLAB: every variable is a column, or every field of the only struct."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ballscrew.errors import Fault, InputError

#: How files of MATLAB begin: those up to version 7, and those since.
OLD, NEW = b"MATLAB 5.0 MAT-file", b"MATLAB 7.3 MAT-file"
_HDF5 = b"\x89HDF\r\n\x1a\n"
#: Errors of SciPy's and h5py's readers for damaged files; NotImplementedError is a RuntimeError.
_DAMAGED = (
    OSError, EOFError, ValueError, TypeError, LookupError, AttributeError, ArithmeticError, RuntimeError, MemoryError,
    NameError, SystemError, zlib.error, struct.error,
)  # fmt: skip
_REMEDY = "save the columns as arrays of one length, or one struct of them, with save(..., '-v7')"


def is_matlab(path: Path, begin: bytes) -> bool:
    """Test whether a file is MATLAB's, by its name or its first bytes."""
    return path.suffix.lower() == ".mat" or begin.startswith((OLD, NEW))


def variables(path: Path, begin: bytes) -> dict[str, NDArray[Any]]:
    """The columns of a file by name. Raises :class:`~ballscrew.errors.InputError` if there are none."""
    read = _read_hdf5 if begin.startswith((NEW, _HDF5)) else _read_mat5
    try:
        found = read(path)
    except _DAMAGED as error:
        if isinstance(error, InputError):
            raise
        raise InputError(Fault(str(path), "is no file of MATLAB that can be read", str(error), _REMEDY)) from None
    if len(found) == 1 and isinstance(only := next(iter(found.values())), Mapping):
        found = dict(only)
    columns = {
        name: np.atleast_1d(np.squeeze(values)) for name, values in found.items() if isinstance(values, np.ndarray)
    }
    columns = {name: values for name, values in columns.items() if values.ndim == 1 and values.dtype.kind in "fiub"}
    longest = max((values.size for values in columns.values()), default=0)
    if longest == 0:
        raise InputError(Fault(str(path), "has no columns of numbers", ", ".join(found), _REMEDY))
    return {name: np.asarray(values, np.float64) for name, values in columns.items() if values.size > 1 or longest == 1}


def _read_mat5(path: Path) -> dict[str, Any]:
    from scipy.io import loadmat
    from scipy.io.matlab import MatReadError

    try:
        found = loadmat(path, simplify_cells=True)
    except MatReadError as error:  # derived from Exception alone
        raise ValueError(str(error)) from None
    return {
        name: np.asarray(values) if isinstance(values, int | float) else values
        for name, values in found.items()
        if not name.startswith("__")
    }


def _read_hdf5(path: Path) -> dict[str, Any]:
    try:
        import h5py
    except ImportError:
        remedy = "pip install \"ballscrew[data]\", or save it with save(..., '-v7')"
        raise InputError(Fault(str(path), "needs h5py", "", remedy)) from None
    with h5py.File(path) as file:
        return {str(name): _read_group(item) for name, item in file.items() if not str(name).startswith("#")}


def _read_group(item: Any) -> Any:
    """An array, or the arrays of a struct by name."""
    if hasattr(item, "items"):
        return {str(name): _read_group(inner) for name, inner in item.items()}
    text = item.attrs.get("MATLAB_class", b"") == b"char"
    return None if text else np.asarray(item)

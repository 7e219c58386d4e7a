"""Logs in files of MATLAB: every variable is a column, or every field of the only struct."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis import child_process
from ballscrew.basis.errors import Fault, InputError
from ballscrew.files.torque_logs import matlab_arrays

#: How files of MATLAB begin: those up to version 7, and those since.
OLD, NEW = b"MATLAB 5.0 MAT-file", b"MATLAB 7.3 MAT-file"
_HDF5 = b"\x89HDF\r\n\x1a\n"
_REMEDY = "save the columns as arrays of one length, or one struct of them, with save(..., '-v7')"


def is_matlab(path: Path, begin: bytes) -> bool:
    """Test whether a file is MATLAB's, by its name or its first bytes."""
    return path.suffix.lower() == ".mat" or begin.startswith((OLD, NEW))


def variables(path: Path, begin: bytes) -> tuple[dict[str, NDArray[np.float64]], dict[str, float]]:
    """The columns of a file by name, and its single numbers.

    Raises :class:`~ballscrew.basis.errors.InputError` if there are no columns.
    """
    hdf5 = begin.startswith((NEW, _HDF5))
    if hdf5 and importlib.util.find_spec("h5py") is None:
        remedy = "pip install \"ballscrew[data]\", or save it with save(..., '-v7')"
        raise InputError(Fault(str(path), "needs h5py", "", remedy))
    try:
        names, columns, numbers = child_process.call(matlab_arrays.columns, str(path), hdf5)
    except child_process.ChildError as error:
        raise InputError(Fault(str(path), "is no file of MATLAB that can be read", str(error), _REMEDY)) from None
    if not columns:
        raise InputError(Fault(str(path), "has no columns of numbers", ", ".join(names), _REMEDY))
    return columns, numbers

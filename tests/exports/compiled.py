"""C sources compiled by the compiler of this machine, called through ctypes."""

import ctypes
import shutil
import subprocess

import numpy as np
import pytest

COMPILER = shutil.which("gcc") or shutil.which("cc")
#: What the source must pass without a word.
STRICT = ("-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror")

needs_a_compiler = pytest.mark.skipif(COMPILER is None, reason="no C compiler on this machine")


def library(folder, *sources, level="-O0"):
    """A shared library of sources."""
    made = folder / "made.so"
    command = [COMPILER, *STRICT, level, "-shared", "-fPIC", *map(str, sources), "-o", str(made), "-lm"]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[:2000]
    return ctypes.CDLL(str(made))


def names(made, table):
    """The names of a table that ends with NULL."""
    texts = ctypes.POINTER(ctypes.c_char_p).from_buffer(
        ctypes.c_void_p(ctypes.addressof(ctypes.c_char_p.in_dll(made, table)))
    )
    found = []
    while texts[len(found)] is not None:
        found.append(texts[len(found)].decode())
    return found


def evaluated(function, points, count):
    """The outputs of a function of C at points, a row each."""
    given = np.ascontiguousarray(points, dtype=float)
    found = np.empty((len(given), count))
    pointer = ctypes.c_void_p
    function.argtypes, function.restype = [pointer, pointer], None
    for i in range(len(given)):
        function(given.ctypes.data + i * given.strides[0], found.ctypes.data + i * found.strides[0])
    return found

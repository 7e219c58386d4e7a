"""The interpreter in C: the prebuilt library that exports deliver, called here to measure their errors."""

from __future__ import annotations

import ctypes
import functools
import platform
import sys
import weakref
from collections.abc import Mapping
from importlib import resources

import numpy as np
from numpy.typing import NDArray

from ballscrew.exports.programs.program_file import program_file
from ballscrew.exports.subject import HandOver
from ballscrew.exports.worst_error import Values, WorstError, worst_errors

#: Sources of the interpreter, package data.
SOURCES = ("ballscrew_program.c", "ballscrew_list.c", "ballscrew_loads.c")
HEADERS = ("ballscrew_program.h", "ballscrew_list.h", "ballscrew_loads.h")
#: The prebuilt library for Linux on x86-64.
LINUX64 = "linux64/ballscrew.so"
#: Prebuilt libraries by platform, and the names that FMI 2 and FMI 3 have for it. All but the first were cross-compiled
#: and never run.
LIBRARIES: Mapping[str, tuple[str, str]] = {
    LINUX64: ("linux64", "x86_64-linux"),
    "win64/ballscrew.dll": ("win64", "x86_64-windows"),
    "darwin64/ballscrew.dylib": ("darwin64", "x86_64-darwin"),
    "aarch64-linux/ballscrew.so": ("", "aarch64-linux"),
    "aarch64-darwin/ballscrew.dylib": ("", "aarch64-darwin"),
}
#: Points at which an interpreted program is compared with the model; with elastic bodies each takes milliseconds.
POINTS, POINTS_OF_ELASTIC_BODIES = 500, 50


def data(name: str) -> bytes:
    """A file of the package that exports are made of."""
    return resources.files("ballscrew").joinpath("data", "exports", *name.split("/")).read_bytes()


def errors_of_program(handed: HandOver) -> tuple[WorstError, ...]:
    """The worst error of the program as it is run in C; empty where no prebuilt library runs on this machine."""
    if not runs_here():
        return ()
    points, found = program_at_points(handed)
    return worst_errors(handed, lambda _: found, points=points)


def program_at_points(handed: HandOver) -> tuple[Values, dict[str, NDArray[np.float64]]]:
    """Points of the working range, and the outputs of the program at them, as it is run in C."""
    points = handed.sample(POINTS_OF_ELASTIC_BODIES if handed.has_elastic_bodies else POINTS)
    return points, Interpreted(program_file(handed)).at(points)


def runs_here() -> bool:
    """Whether the prebuilt library runs on this machine."""
    if not (sys.platform == "linux" and platform.machine() == "x86_64"):
        return False
    try:
        prebuilt_library()
    except OSError:  # another C library, or an older one
        return False
    return True


class Interpreted:
    """A program in the interpreter. Not for several threads at once."""

    def __init__(self, content: bytes) -> None:
        self._library = prebuilt_library()
        self._program = self._library.ballscrew_program_of(content, len(content))
        if not self._program:
            raise ValueError("no program, or a damaged one")
        weakref.finalize(self, self._library.ballscrew_program_free, self._program)
        self.inputs, self.outputs = (
            _names(function(self._program))
            for function in (self._library.ballscrew_program_inputs, self._library.ballscrew_program_outputs)
        )

    def at(self, points: Values) -> dict[str, NDArray[np.float64]]:
        """The outputs at points, which have a value of every input each."""
        given = np.stack([points[name] for name in self.inputs], axis=-1).astype(float)
        given = np.ascontiguousarray(given)
        found = np.empty((len(given), len(self.outputs)))
        evaluate, first, other = self._library.ballscrew_program_evaluate, given.ctypes.data, found.ctypes.data
        for i in range(len(given)):
            evaluate(self._program, first + i * given.strides[0], other + i * found.strides[0])
        return dict(zip(self.outputs, found.T, strict=True))


def _names(texts: ctypes.Array[ctypes.c_char_p]) -> list[str]:
    found: list[str] = []
    while (text := texts[len(found)]) is not None:
        found.append(text.decode())
    return found


@functools.cache
def prebuilt_library() -> ctypes.CDLL:
    """The prebuilt library. Raises ``OSError`` where it cannot be loaded."""
    with resources.as_file(resources.files("ballscrew").joinpath("data", "exports", *LINUX64.split("/"))) as path:
        found = ctypes.CDLL(str(path))
    pointer, names = ctypes.c_void_p, ctypes.POINTER(ctypes.c_char_p)
    found.ballscrew_program_of.argtypes, found.ballscrew_program_of.restype = (
        [ctypes.c_char_p, ctypes.c_size_t],
        pointer,
    )
    found.ballscrew_program_free.argtypes, found.ballscrew_program_free.restype = [pointer], None
    found.ballscrew_program_evaluate.argtypes = [pointer, pointer, pointer]
    found.ballscrew_program_evaluate.restype = None
    for function in (found.ballscrew_program_inputs, found.ballscrew_program_outputs):
        function.argtypes, function.restype = [pointer], names
    return found

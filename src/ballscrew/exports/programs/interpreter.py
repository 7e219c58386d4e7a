"""The interpreter in C, prebuilt and as source, and ``--to program``: the model as data beside it.

It is called here, too, to measure the errors of what it delivers.
"""

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

from ballscrew.exports.export import Export, Target, Values, WorstError, data, worst_errors
from ballscrew.exports.programs.program_file import program_file
from ballscrew.exports.readme import readme
from ballscrew.exports.subject import HandOver

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
_NOTES = """\
program.bin is the model; ballscrew_program.c, strict C99 with libm only, reads and runs it, and states its format. The
library linux64/ballscrew.so, prebuilt for Linux on x86-64, has the functions of ballscrew_program.h. Those for Windows,
macOS and Linux on ARM were cross-compiled and never run. Elsewhere:
  cc -std=c99 -O2 -shared -fPIC *.c -o ballscrew.so -lm
Any program that calls functions of C can call it; one that reads it with Python's ctypes:
  import ctypes
  library = ctypes.CDLL("linux64/ballscrew.so")
  library.ballscrew_program_read.restype = ctypes.c_void_p
  program = ctypes.c_void_p(library.ballscrew_program_read(b"program.bin"))
  inputs, outputs = (ctypes.c_double * {inputs})({usual}), (ctypes.c_double * {outputs})()
  library.ballscrew_program_evaluate(program, inputs, outputs)
Each thread reads a program of its own. Compiled source (--to c) is several times as fast.
"""


def export(job: HandOver) -> Export:
    """The model as data, with the interpreter: no compiler is needed."""
    errors = errors_of_program(job)
    notes = _NOTES.format(
        inputs=len(job.inputs),
        outputs=len(job.output_names),
        usual=", ".join(f"{entry.value:.9g}" for entry in job.inputs),
    )
    files = {
        "program.bin": program_file(job),
        **{name: data(name) for name in (*SOURCES, *HEADERS, *LIBRARIES)},
        "README.txt": readme(job, "Program for an interpreter", notes, errors),
    }
    return Export.of(job, "program", files, errors)


PROGRAM = Target(export)


def errors_of_program(job: HandOver) -> tuple[WorstError, ...]:
    """The worst error of the program as it is run in C; empty where no prebuilt library runs on this machine."""
    if not runs_here():
        return ()
    points, outputs = program_at_points(job)
    return worst_errors(job, lambda _: outputs, points=points)


def program_at_points(job: HandOver) -> tuple[Values, dict[str, NDArray[np.float64]]]:
    """Points of the working range, and the outputs of the program at them, as it is run in C."""
    points = job.sample(POINTS_OF_ELASTIC_BODIES if job.has_elastic_bodies else POINTS)
    return points, Interpreted(program_file(job)).at(points)


def runs_here() -> bool:
    """Return whether the prebuilt library runs on this machine."""
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
        outputs = np.empty((len(given), len(self.outputs)))
        evaluate, first, other = self._library.ballscrew_program_evaluate, given.ctypes.data, outputs.ctypes.data
        for i in range(len(given)):
            evaluate(self._program, first + i * given.strides[0], other + i * outputs.strides[0])
        return dict(zip(self.outputs, outputs.T, strict=True))


def _names(texts: ctypes.Array[ctypes.c_char_p]) -> list[str]:
    names: list[str] = []
    while (text := texts[len(names)]) is not None:
        names.append(text.decode())
    return names


@functools.cache
def prebuilt_library() -> ctypes.CDLL:
    """The prebuilt library. Raises ``OSError`` where it cannot be loaded."""
    with resources.as_file(resources.files("ballscrew").joinpath("data", "exports", *LINUX64.split("/"))) as path:
        library = ctypes.CDLL(str(path))
    pointer, names = ctypes.c_void_p, ctypes.POINTER(ctypes.c_char_p)
    library.ballscrew_program_of.argtypes, library.ballscrew_program_of.restype = (
        [ctypes.c_char_p, ctypes.c_size_t],
        pointer,
    )
    library.ballscrew_program_free.argtypes, library.ballscrew_program_free.restype = [pointer], None
    library.ballscrew_program_evaluate.argtypes = [pointer, pointer, pointer]
    library.ballscrew_program_evaluate.restype = None
    for function in (library.ballscrew_program_inputs, library.ballscrew_program_outputs):
        function.argtypes, function.restype = [pointer], names
    return library

"""The interpreter in C, prebuilt and as source, and ``--to program``: the model as data beside it.

It is called here, too, to measure the errors of what it delivers.

A program as a file of data for the interpreter in C; ``data/exports/ballscrew_program.c`` states the format.
"""

from __future__ import annotations

import ctypes
import functools
import platform
import struct
import sys
import weakref
from collections.abc import Mapping, Sequence
from importlib import resources
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ballscrew.compiler.tracing.program import Program
from ballscrew.compiler.tracing.tape import choose
from ballscrew.exports.export import Export, Target, Values, WorstError, data, readme, refusal, worst_errors
from ballscrew.exports.programs.two_levels import TwoLevels, two_levels
from ballscrew.exports.subject import HandOver

#: The operations of the interpreter, each at its number.
OPERATIONS: Mapping[Any, int] = {
    np.add: 0, np.subtract: 1, np.multiply: 2, np.divide: 3, choose: 4, np.sqrt: 5, np.minimum: 6, np.maximum: 7,
    np.exp: 8, np.log: 9, np.power: 10, np.absolute: 11, np.greater: 12, np.greater_equal: 13, np.less: 14,
    np.less_equal: 15, np.equal: 16, np.not_equal: 17, np.bitwise_and: 18, np.logical_and: 18, np.bitwise_or: 19,
    np.logical_or: 19, np.bitwise_xor: 20, np.logical_xor: 20, np.invert: 21, np.logical_not: 21, np.isfinite: 22,
    np.isnan: 23, np.isinf: 24, np.sin: 25, np.cos: 26, np.tan: 27, np.arcsin: 28, np.arccos: 29, np.arctan: 30,
    np.arctan2: 31, np.sinh: 32, np.cosh: 33, np.tanh: 34, np.arcsinh: 35, np.expm1: 36, np.log1p: 37, np.floor: 38,
    np.ceil: 39, np.cbrt: 40, np.hypot: 41, np.remainder: 42,
}  # fmt: skip
_MAGIC = b"BSCREW02"
_REDUCTIONS: Mapping[Any, int] = {np.sum: 0, np.max: 1, np.argmax: 2, np.take_along_axis: 3}
#: Most places, as each has two bytes.
_MOST_PLACES = 2**16


def program_file(job: HandOver) -> bytes:
    """The recorded model as the bytes of a file.

    Raises :class:`~ballscrew.basis.errors.InputError` for a model that cannot be recorded, for an operation that the
    interpreter lacks, and for a program that is too large.
    """
    limits = job.formula_range
    inputs = {entry.name: (entry.value, *limits[entry.name]) for entry in job.inputs}
    model = two_levels(job) if job.has_elastic_bodies else job.program
    return file_of(model, inputs, job.output_names)


def file_of(
    model: Program | TwoLevels, inputs: Mapping[str, tuple[float, float, float]], outputs: Sequence[str]
) -> bytes:
    """A model as the bytes of a file: each input with its usual, least and greatest value; ``valid`` is last."""
    names = b"".join(name.encode() + b"\0" for name in (*inputs, *outputs))
    ranges = [end for ends in zip(*inputs.values(), strict=True) for end in ends]
    levels = 1 if isinstance(model, Program) else 2
    body = _list(model, outputs) if isinstance(model, Program) else _of_two_levels(model, outputs)
    head = _MAGIC + _counts(len(inputs), len(outputs), len(names), levels)
    return head + names + np.array(ranges, dtype="<f8").tobytes() + body


def _of_two_levels(parts: TwoLevels, outputs: Sequence[str]) -> bytes:
    """A nut with elastic bodies."""
    at_points, of_ball = list(parts.points.outputs), list(parts.each_ball.outputs)
    of_ball += list(parts.each_ball.constants)
    tables = [(int(by_ball), what if by_ball else at_points.index(str(what))) for by_ball, what in parts.tables]
    reductions = [
        (_REDUCTIONS[entry.function], of_ball.index(entry.values), entry.place or 0)
        for entry in parts.stages.reductions
    ]
    whole, numbers = parts.nut[:4], parts.nut[4:]
    return b"".join(
        [
            _counts(len(parts.inputs), *parts.inputs),
            _counts(0 if parts.preload is None else parts.preload + 1, parts.solved),
            _counts(len(tables), *(word for table in tables for word in table)),
            _counts(len(reductions), *(word for entry in reductions for word in entry)),
            _counts(*whole),
            np.array(numbers, dtype="<f8").tobytes(),
            _list(parts.points, at_points),
            _list(parts.each_ball, of_ball),
            _list(parts.behind, outputs),
        ]
    )


def _counts(*numbers: Any) -> bytes:
    return struct.pack(f"<{len(numbers)}I", *numbers)


def _list(program: Program, outputs: Sequence[str]) -> bytes:
    """A list of steps."""
    constants, places, code, size = _assembled(program)
    if size > _MOST_PLACES:
        remedy = "ask for fewer outputs and derivatives, or take the source (--to c)"
        raise refusal("to", "the program is too large for the interpreter", "", remedy)
    words = [*(places[name] for name in outputs), *(word for step in code for word in step)]
    further = size - program.inputs - len(constants)
    counts = _counts(program.inputs, len(outputs), len(constants), further, len(code))
    return counts + np.array(constants, dtype="<f8").tobytes() + np.array(words, dtype="<u2").tobytes()


def _places_of_constants(program: Program) -> dict[str, int]:
    """The place of each constant behind the inputs, by its bits: those of the steps, then those of the outputs."""
    numbers = [o for _, step in program.steps for kind, o in step.operands if kind != "step"]
    written = dict.fromkeys(float(number).hex() for number in (*numbers, *program.constants.values()))
    return {text: place for place, text in enumerate(written, start=program.inputs)}


def _operation(function: Any) -> int:
    """The number of an operation of the interpreter. Raises ``InputError`` for one that it lacks."""
    if function not in OPERATIONS:
        remedy = "write the law with functions of the C library, or take a table (--to table)"
        problem = f"the interpreter has no {function.__name__}"
        raise refusal("to", problem, "", remedy)
    return OPERATIONS[function]


def _assembled(program: Program) -> tuple[list[float], dict[str, int], list[tuple[int, ...]], int]:
    """The constants, the place of each output, the steps, and the number of places; a place is used again."""
    constants = _places_of_constants(program)
    places = {name: constants[float(value).hex()] for name, value in program.constants.items()}
    last = {int(o): i for i, step in program.steps for kind, o in step.operands if kind == "step"}
    kept = set(program.outputs.values())
    place = {i: i for i in range(program.inputs)}
    free: list[int] = []
    size = program.inputs + len(constants)
    code: list[tuple[int, ...]] = []
    for i, step in program.steps:
        operation = _operation(step.function)
        operands = [place[int(o)] if kind == "step" else constants[float(o).hex()] for kind, o in step.operands]
        ended = {int(o) for kind, o in step.operands if kind == "step" and int(o) >= program.inputs}
        free += [place[o] for o in sorted(ended) if last[o] == i and o not in kept]
        if not free:
            free.append(size)
            size += 1
        place[i] = free.pop()
        code.append((operation, *operands, *[0] * (3 - len(operands)), place[i]))
    places |= {name: place[i] for name, i in program.outputs.items()}
    return [float.fromhex(text) for text in constants], places, code, size


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

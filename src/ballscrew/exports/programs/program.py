"""``--to program``: the model as data with its interpreter in C, prebuilt and as source: no compiler is needed."""

from __future__ import annotations

from ballscrew.exports.export import Export
from ballscrew.exports.programs import interpreter
from ballscrew.exports.programs.program_file import program_file
from ballscrew.exports.readme import readme
from ballscrew.exports.subject import HandOver

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


def export(handed: HandOver) -> Export:
    """The model as data, with the interpreter."""
    errors = interpreter.errors_of_program(handed)
    notes = _NOTES.format(
        inputs=len(handed.inputs),
        outputs=len(handed.output_names),
        usual=", ".join(f"{one.value:.9g}" for one in handed.inputs),
    )
    files = {
        "program.bin": program_file(handed),
        **{
            name: interpreter.data(name)
            for name in (*interpreter.SOURCES, *interpreter.HEADERS, *interpreter.LIBRARIES)
        },
        "README.txt": readme(handed, "Program for an interpreter", notes, errors).encode(),
    }
    return Export.of(handed, "program", files, valid_range=handed.formula_range, worst_error=errors)

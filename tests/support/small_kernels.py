"""Small programs, compiled and played, for the tests beside this file."""

import numpy as np

from ballscrew.compiler.kernels.emission import kernel_text
from ballscrew.compiler.kernels.kernel import Kernel, aligned_array
from ballscrew.compiler.tracing.program import Interpreter, Program
from ballscrew.compiler.tracing.tape import Tape


def recorded(function, inputs):
    """The program of a function of some inputs; one output, ``out``."""
    tape = Tape(inputs)
    with np.errstate(all="ignore"):
        return Program.of(tape, {"out": function(*(tape.value(i) for i in range(inputs)))})


def text_of(program, *, lanes=None, mask=False):
    return kernel_text(program, ["points"] * program.inputs, {"out": mask}, lanes=lanes)


def compiled(program, *, lanes=None, mask=False):
    return Kernel.of(text_of(program, lanes=lanes, mask=mask), ["points"] * program.inputs)


def run(program, *arrays, lanes=None, mask=False):
    """The output of a kernel for whole arrays."""
    out = aligned_array(len(arrays[0]), bool if mask else float)
    compiled(program, lanes=lanes, mask=mask)(slice(0, 1), slice(0, len(out)), len(out), arrays, [out])
    return out


def played(program, *arrays, mask=False):
    """The same by NumPy."""
    out = np.empty(len(arrays[0]), dtype=bool if mask else float)
    with np.errstate(all="ignore"):
        Interpreter(program).run(arrays, {"out": out})
    return out

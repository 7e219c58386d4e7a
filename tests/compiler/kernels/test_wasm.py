"""Kernels as WebAssembly: what a module imports and exports, and that it needs nobody else."""

import json
import subprocess

import numpy as np
import pytest

from ballscrew.compiler.kernels import wasm
from ballscrew.compiler.kernels.emission import kernel_text
from ballscrew.compiler.tracing.program import Program
from ballscrew.compiler.tracing.tape import Tape
from support.node import node

#: Asks a module for its imports and exports, and runs one function over seven points.
ASKED = """
import { readFile } from "node:fs/promises";
const module = new WebAssembly.Module(await readFile(process.argv[2]));
const memory = new WebAssembly.Memory({ initial: 2 });
const stack = new WebAssembly.Global({ value: "i32", mutable: true }, 65536);
const env = { __linear_memory: memory, __stack_pointer: stack };
const { exports } = new WebAssembly.Instance(module, { env });
const numbers = new Float64Array(memory.buffer), addresses = new Uint32Array(memory.buffer);
addresses.set([70000, 71000], 65536 / 4);
for (let i = 0; i < 7; i++) numbers[70000 / 8 + i] = i - 3;
exports.second(7, 1, 7, 65536, 65540);
console.log(JSON.stringify({
  imports: WebAssembly.Module.imports(module), exports: WebAssembly.Module.exports(module),
  found: [...numbers.subarray(71000 / 8, 71000 / 8 + 8)].map(String),
}));
"""


def part(name, function):
    tape = Tape(1)
    program = Program.of(tape, {"y": function(tape.value(0))})
    return wasm.Part(name, kernel_text(program, ["points"], {"y": False}, lanes=wasm.LANES))


def module():
    return wasm.module_of([part("first", np.exp), part("second", lambda x: np.log(x) + np.arctan(x) ** 3)])


def test_a_module_needs_a_memory_and_a_stack_and_nothing_else(tmp_path):
    (tmp_path / "m.wasm").write_bytes(module())
    (tmp_path / "asked.mjs").write_text(ASKED)
    command = [node(), tmp_path / "asked.mjs", tmp_path / "m.wasm"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    found = json.loads(done.stdout)
    assert {(one["name"], one["kind"]) for one in found["imports"]} == {
        ("__linear_memory", "memory"),
        ("__stack_pointer", "global"),
    }
    assert [(one["name"], one["kind"]) for one in found["exports"]] == [("first", "function"), ("second", "function")]
    x = np.arange(-3.0, 4.0)
    with np.errstate(all="ignore"):
        expected = np.log(x) + np.arctan(x) ** 3
    *values, behind = (float(text.replace("Infinity", "inf")) for text in found["found"])
    assert np.array(values) == pytest.approx(expected, rel=1e-14, nan_ok=True)
    assert behind == 0.0  # the last vector has one point, and no more is written


def test_two_compilations_are_the_same_bytes():
    assert module() == module()


def test_a_kernel_that_calls_a_library_is_refused():
    one = part("first", np.exp)
    calling = one.text.replace("define void @kernel(", "declare double @gamma(double)\ndefine void @kernel(", 1)
    calling = calling.replace(
        "  ret void\n}", "  %s = call double @gamma(double 1.0)\n  store double %s, ptr %spare\n  ret void\n}", 1
    )
    with pytest.raises(ValueError, match="needs a linker: it calls gamma"):
        wasm.module_of([wasm.Part("first", calling)])


def test_what_is_no_object_is_refused():
    with pytest.raises(ValueError, match="no WebAssembly"):
        wasm._linked(b"\x7fELF", ["first"])

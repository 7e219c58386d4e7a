"""Kernels as WebAssembly modules: the same assembly, compiled for a browser instead of this processor.

A module has its functions and the memory that it is given, and nothing else: constants are immediate, elementary
functions are polynomials of :mod:`ballscrew.compiler.kernels.ir`, so that no library of the browser takes part,
and neither fused products nor relaxed vectors are used. Results are therefore the same to the last bit on every machine
(but the payload of NaN). Needs vectors of 128 bits and bulk memory: Chrome 91, Firefox 89, Safari 16.4 or later.

An object file of LLVM is nearly such a module: it imports its memory and the pointer of its stack. What is left to do
is to drop the sections of the linker and to say which functions are exported.
"""

from __future__ import annotations

import functools
import importlib
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from ballscrew.compiler.kernels import kernel
from ballscrew.compiler.kernels.emission import SIGNATURE

#: Doubles of a vector of 128 bits.
LANES = 2
#: What a module may use; fused products (``relaxed-simd``) would make results depend on the machine.
FEATURES = "+simd128,+bulk-memory"
TRIPLE = "wasm32-unknown-unknown"
_PREAMBLE = b"\x00asm\x01\x00\x00\x00"
#: Numbers of sections, and of what is imported or exported.
_CUSTOM, _IMPORT, _EXPORT, _START, _ELEMENT, _DATA = 0, 2, 7, 8, 9, 11
_FUNCTION, _TABLE, _MEMORY, _GLOBAL = 0, 1, 2, 3
#: The custom section with the names of functions, its table of them, and the flags of a name that is not here.
_LINKING, _SYMBOL_TABLE, _UNDEFINED, _NAMED = "linking", 8, 0x10, 0x40


class Part(NamedTuple):
    """One function of a module: its name, and the assembly of a kernel."""

    name: str
    text: str


def module_of(parts: Sequence[Part]) -> bytes:
    """A module whose functions ``name(count, rows, tile, inputs, outputs)`` are kernels of :data:`LANES` lanes.

    ``count`` is the number of columns, ``rows`` that of rows (1 for a kernel over points), ``tile`` that of the columns
    worked on at a time; ``inputs`` and ``outputs`` are addresses of tables of addresses, 32 bits each, of arrays. The
    module imports its memory and the pointer of its stack, as ``env.__linear_memory`` and ``env.__stack_pointer``.

    Raises ``ImportError`` without the compiler, and :class:`ValueError` for a kernel that needs other functions.
    """
    llvm = _llvm()
    whole = llvm.parse_assembly("")
    for part in parts:
        one = llvm.parse_assembly(_named(part))
        one.verify()
        whole.link_in(one)
    machine = llvm.Target.from_triple(TRIPLE).create_target_machine(features=FEATURES, opt=kernel.CODE_OPTIMISATION)
    whole.triple = TRIPLE
    kernel.optimise(whole, machine)
    return _linked(machine.emit_object(whole), [part.name for part in parts])


@functools.cache
def _llvm() -> Any:
    llvm = importlib.import_module("llvmlite.binding")
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    return llvm


def _named(part: Part) -> str:
    """The assembly of a kernel as a function that only its own module sees, and one of 32-bit numbers around it."""
    inner = part.text.replace("define void @kernel(", f"define internal void @kernel_{part.name}(", 1)
    kinds = [argument.split()[0] for argument in SIGNATURE.split(", ")]
    values = ("0", "%r", "0", "%c", "%c", "%t", "false", "%inputs", "%outputs")
    given = ", ".join(f"{kind} {value}" for kind, value in zip(kinds, values, strict=True))
    return "\n".join(
        [
            inner,
            f"define void @{part.name}(i32 %count, i32 %rows, i32 %tile, ptr %inputs, ptr %outputs) {{",
            "  %c = zext i32 %count to i64",
            "  %r = zext i32 %rows to i64",
            "  %t = zext i32 %tile to i64",
            f"  call void @kernel_{part.name}({given})",
            "  ret void",
            "}",
            "",
        ]
    )


def _linked(code: bytes, names: Sequence[str]) -> bytes:
    """An object file as a module: without the sections of the linker, and with its exports.

    Raises :class:`ValueError` for an object that needs a linker: one with data, or with functions of others.
    """
    if not code.startswith(_PREAMBLE):
        raise ValueError("no WebAssembly")
    sections = list(_sections(code))
    by_kind = dict(sections)
    if _DATA in by_kind or _ELEMENT in by_kind:
        raise ValueError("the object needs a linker: it has data")
    _raise_for_imported_functions(by_kind.get(_IMPORT, b"\0"))
    places = _places_of_functions(sections)
    exports = b"".join(_name(name) + bytes([_FUNCTION]) + _number(places[name]) for name in names)
    kept = [(kind, body) for kind, body in sections if kind != _CUSTOM]
    before = [each for each in kept if each[0] < _EXPORT]
    behind = [each for each in kept if each[0] >= _START]
    every = [*before, (_EXPORT, _number(len(names)) + exports), *behind]
    return _PREAMBLE + b"".join(bytes([kind]) + _number(len(body)) + body for kind, body in every)


def _sections(code: bytes) -> Iterator[tuple[int, bytes]]:
    at = len(_PREAMBLE)
    while at < len(code):
        kind = code[at]
        size, at = _read_number(code, at + 1)
        yield kind, code[at : at + size]
        at += size


def _raise_for_imported_functions(section: bytes) -> None:
    """Raise :class:`ValueError` where the object takes functions from others, as of a mathematical library."""
    count, at = _read_number(section, 0)
    for _ in range(count):
        _, at = _read_name(section, at)
        name, at = _read_name(section, at)
        kind, at = section[at], at + 1
        if kind == _FUNCTION:
            raise ValueError(f"the object needs a linker: it calls {name}")
        if kind == _GLOBAL:
            at += 2
            continue
        at += kind == _TABLE
        has_most, at = section[at] & 1, at + 1
        for _ in range(1 + has_most):
            _, at = _read_number(section, at)


def _places_of_functions(sections: Sequence[tuple[int, bytes]]) -> dict[str, int]:
    """The functions of an object by name, of the table of symbols that it has for linkers."""
    places: dict[str, int] = {}
    for kind, body in sections:
        if kind != _CUSTOM:
            continue
        name, at = _read_name(body, 0)
        if name != _LINKING:
            continue
        _, at = _read_number(body, at)
        while at < len(body):
            part, at = body[at], at + 1
            size, at = _read_number(body, at)
            if part == _SYMBOL_TABLE:
                places |= _functions(body[at : at + size])
            at += size
    return places


def _functions(symbols: bytes) -> dict[str, int]:
    """Functions and globals come first in the table of symbols of an object without data."""
    functions: dict[str, int] = {}
    count, at = _read_number(symbols, 0)
    for _ in range(count):
        kind, at = symbols[at], at + 1
        flags, at = _read_number(symbols, at)
        place, at = _read_number(symbols, at)
        if flags & _UNDEFINED and not flags & _NAMED:  # it has the name of its import
            continue
        name, at = _read_name(symbols, at)
        if kind == 0:
            functions[name] = place
    return functions


def _name(text: str) -> bytes:
    return _number(len(text.encode())) + text.encode()


def _number(value: int) -> bytes:
    """A number in LEB128."""
    result = b""
    while value > 127:
        result += bytes([value & 127 | 128])
        value >>= 7
    return result + bytes([value])


def _read_number(code: bytes, at: int) -> tuple[int, int]:
    value = shift = 0
    while True:
        byte = code[at]
        value |= (byte & 127) << shift
        shift, at = shift + 7, at + 1
        if byte < 128:
            return value, at


def _read_name(code: bytes, at: int) -> tuple[str, int]:
    size, at = _read_number(code, at)
    return code[at : at + size].decode(), at + size

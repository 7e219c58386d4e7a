"""LLVM's assembly, written a vector at a time.

A :class:`Writer` collects the instructions of one function. Every value is a vector of ``lanes``
doubles, or of as many truth values; constants are spread over the lanes. Vectors are explicit, so
whether a loop is vectorised is not left to an optimiser that may decide otherwise in silence.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from typing import NewType

#: The name or the constant that stands for a vector in the assembly.
Value = NewType("Value", str)


def constant(number: float) -> Value:
    """A number in every lane, to the last bit."""
    return Value(f"splat (double 0x{struct.unpack('<Q', struct.pack('<d', number))[0]:016X})")


def integer(number: int) -> Value:
    """A 64-bit integer in every lane."""
    return Value(f"splat (i64 {number})")


class Writer:
    """The instructions of one function, in order."""

    def __init__(self, lanes: int) -> None:
        self.lanes = lanes
        self.lines: list[str] = []
        self._names = 0
        self.doubles, self.integers, self.masks = (f"<{lanes} x {kind}>" for kind in ("double", "i64", "i1"))

    def new_name(self) -> Value:
        """A new name."""
        self._names += 1
        return Value(f"%v{self._names}")

    def instruction(self, text: str) -> Value:
        """Write ``name = text``."""
        name = self.new_name()
        self.lines.append(f"  {name} = {text}")
        return name

    def arithmetic(self, operation: str, left: Value, right: Value) -> Value:
        """``fadd``, ``fsub``, ``fmul``, ``fdiv``; sums of products may be fused into one rounding."""
        return self.instruction(f"{operation} contract {self.doubles} {left}, {right}")

    def exact(self, operation: str, left: Value, right: Value) -> Value:
        """An operation that must round by itself, where polynomials count on it."""
        return self.instruction(f"{operation} {self.doubles} {left}, {right}")

    def on_integers(self, operation: str, left: Value, right: Value) -> Value:
        """``add``, ``sub``, ``shl``, ``ashr``, ``and``, … of integers."""
        return self.instruction(f"{operation} {self.integers} {left}, {right}")

    def on_masks(self, operation: str, left: Value, right: Value) -> Value:
        """``and``, ``or``, ``xor`` of truth values."""
        return self.instruction(f"{operation} {self.masks} {left}, {right}")

    def multiply_add(self, factor: Value, other: Value, addend: Value) -> Value:
        """``factor · other + addend``, in one rounding where the machine can."""
        return self.intrinsic("fmuladd", factor, other, addend)

    def intrinsic(self, name: str, *operands: Value) -> Value:
        """A function of LLVM's own, from doubles to doubles."""
        listed = ", ".join(f"{self.doubles} {operand}" for operand in operands)
        return self.instruction(f"call {self.doubles} @llvm.{name}.v{self.lanes}f64({listed})")

    def call(self, function: str, *operands: Value) -> Value:
        """A function of this module, from doubles to doubles."""
        listed = ", ".join(f"{self.doubles} {operand}" for operand in operands)
        return self.instruction(f"call {self.doubles} @{function}({listed})")

    def compare(self, relation: str, left: Value, right: Value) -> Value:
        """A mask: ``oeq``, ``olt``, … as LLVM spells them."""
        return self.instruction(f"fcmp {relation} {self.doubles} {left}, {right}")

    def choose(self, mask: Value, yes: Value, no: Value) -> Value:
        """``yes`` where the mask holds, else ``no``."""
        return self.instruction(f"select {self.masks} {mask}, {self.doubles} {yes}, {self.doubles} {no}")

    def bits(self, value: Value) -> Value:
        """The bits of doubles as integers."""
        return self.instruction(f"bitcast {self.doubles} {value} to {self.integers}")

    def from_bits(self, value: Value) -> Value:
        """Doubles from their bits."""
        return self.instruction(f"bitcast {self.integers} {value} to {self.doubles}")

    def broadcast(self, kind: str, scalar: str) -> Value:
        """A scalar in every lane."""
        vector = f"<{self.lanes} x {kind}>"
        first = self.instruction(f"insertelement {vector} poison, {kind} {scalar}, i64 0")
        return self.instruction(
            f"shufflevector {vector} {first}, {vector} poison, <{self.lanes} x i32> zeroinitializer"
        )

    def polynomial(self, variable: Value, coefficients: Sequence[float]) -> Value:
        """Horner's scheme; the coefficients rise with the power."""
        result = constant(coefficients[-1])
        for coefficient in coefficients[-2::-1]:
            result = self.multiply_add(variable, result, constant(coefficient))
        return result

    def function(self, name: str, arguments: Sequence[Value], result: Value) -> str:
        """The instructions so far as a function that is always inlined."""
        listed = ", ".join(f"{self.doubles} {argument}" for argument in arguments)
        body = "\n".join([*self.lines, f"  ret {self.doubles} {result}"])
        return f"define internal {self.doubles} @{name}({listed}) alwaysinline {{\n{body}\n}}\n"

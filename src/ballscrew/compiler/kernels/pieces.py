"""Long programs in pieces: each a function of its own, as a compiler needs more than proportionally long for long ones.

A piece reads what it needs of the inputs and of earlier pieces from a table in memory, a vector for each value, and
writes there what later ones need. The numbers are those of the program in one function, but for the rounding of sums of
products that are fused across its border.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable, Mapping

from ballscrew.compiler.kernels.ir import Value, Writer
from ballscrew.compiler.tracing.program import Program
from ballscrew.compiler.tracing.steps import Step

#: Steps of a piece: of four thousand, a compiler needs a tenth of the time for each that it needs of forty thousand.
STEPS = 3000

#: Emits the steps of a program: writer, program and the values of its inputs; returns values by their number.
Emit = Callable[[Writer, Program, dict[int, Value]], Mapping[int, Value]]


@dataclasses.dataclass(frozen=True)
class Pieces:
    """The functions of the pieces as text, and where each value has its place in the table."""

    functions: str
    count: int
    places: Mapping[int, int]

    def write(self, w: Writer, inputs: Mapping[int, Value], wanted: Iterable[int]) -> dict[int, Value]:
        """Emit the stores of the inputs, the calls of the pieces, and the loads of what is wanted."""
        for i, value in inputs.items():
            if i in self.places:
                _store(w, self.places[i], value)
        for k in range(self.count):
            w.lines.append(f"  call void @piece{k}(ptr %table)")
        return {i: _load(w, self.places[i]) for i in dict.fromkeys(wanted)}

    def table(self, w: Writer) -> list[str]:
        """The room for the table."""
        return [f"  %table = alloca [{max(len(self.places), 1)} x {w.doubles}], align 64"]


def pieces_of(program: Program, lanes: int, emit: Emit) -> Pieces:
    """A program in pieces of :data:`STEPS` steps."""
    chunks = [program.steps[k : k + STEPS] for k in range(0, len(program.steps), STEPS)]
    places = _places(program, chunks)
    texts = [_function(program, k, chunk, places, lanes, emit) for k, chunk in enumerate(chunks)]
    return Pieces("\n".join(texts), len(chunks), places)


def _places(program: Program, chunks: list[tuple[tuple[int, Step], ...]]) -> dict[int, int]:
    """A place for each step that a piece reads from before it, and for each output; a truth is a number."""
    crossing = set(program.outputs.values())
    for chunk in chunks:
        here = {i for i, _ in chunk}
        crossing |= {o for _, step in chunk for o in step.read if o not in here}
    return {i: place for place, i in enumerate(sorted(crossing))}


def _function(
    program: Program,
    number: int,
    chunk: tuple[tuple[int, Step], ...],
    places: Mapping[int, int],
    lanes: int,
    emit: Emit,
) -> str:
    w = Writer(lanes)
    here = {i for i, _ in chunk}
    read = dict.fromkeys(o for _, step in chunk for o in step.read if o not in here)
    result = emit(w, dataclasses.replace(program, steps=chunk), {i: _load(w, places[i]) for i in read})
    for i, step in chunk:
        if i in places:
            value = result[i]
            if step.is_mask:
                value = w.instruction(f"uitofp {w.masks} {value} to {w.doubles}")
            _store(w, places[i], value)
    body = "\n".join([*w.lines, "  ret void"])
    return f"define internal void @piece{number}(ptr noalias %table) noinline {{\n{body}\n}}\n"


def _load(w: Writer, place: int) -> Value:
    address = w.instruction(f"getelementptr {w.doubles}, ptr %table, i64 {place}")
    return w.instruction(f"load {w.doubles}, ptr {address}, align 16")


def _store(w: Writer, place: int, value: Value) -> None:
    address = w.instruction(f"getelementptr {w.doubles}, ptr %table, i64 {place}")
    w.lines.append(f"  store {w.doubles} {value}, ptr {address}, align 16")

"""A program: the steps of a recording that some outputs need, and its interpreter on NumPy.

NumPy runs a program block by block into a few buffers that stay in the cache. Results agree with plain
arrays to about 1e-14 relative, do not depend on the size of the blocks, and keep the limits at zero
load and at rest (the logarithm of zero is minus infinity).

Programs as documents of plain lists, which other processes read: steps by the names of their functions, no code.
"""

from __future__ import annotations

import copy
import dataclasses
import functools
import operator
import threading
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ballscrew.compiler.tracing.tape import Operand, Step, Tape, Traced, choose

#: The origin of the values of an input: one for each point, column or row of a grid; or as a call says by a stride, one
#: for each point or one for all.
Source = Literal["points", "columns", "rows", "strided"]

#: Most sizes of blocks whose buffers a thread keeps.
MOST_WORKSPACES = 4


@dataclasses.dataclass(frozen=True)
class Program:
    """Steps in order, each with its number; the inputs have the first numbers."""

    inputs: int
    steps: tuple[tuple[int, Step], ...]
    #: The step of each output, and the outputs that are constant.
    outputs: Mapping[str, int]
    constants: Mapping[str, Any]
    #: The steps that are known to be positive, zero or NaN.
    nonnegative: frozenset[int] = frozenset()

    @classmethod
    def of(cls, tape: Tape, outputs: Mapping[str, Any]) -> Program:
        """The part of a tape that the outputs need."""
        traced = {name: value.index for name, value in outputs.items() if isinstance(value, Traced)}
        constants = {name: value for name, value in outputs.items() if not isinstance(value, Traced)}
        steps = {i: step for i, step in enumerate(tape.steps) if step is not None}
        chosen = required_steps(steps, traced.values())
        known = frozenset(i for i in (*range(tape.inputs), *(i for i, _ in chosen)) if tape.nonnegative[i])
        return cls(tape.inputs, chosen, traced, constants, known)

    @functools.cached_property
    def interpreter(self) -> Interpreter:
        """The interpreter of the program."""
        return Interpreter(self)

    @property
    def text(self) -> str:
        """The program as text: a line for each step, then the outputs."""
        lines = [f"inputs {self.inputs}"]
        lines += [f"{i} {step.function.__name__} {step.operands}" for i, step in self.steps]
        return "\n".join([*lines, f"{dict(self.outputs)} {dict(self.constants)}"])


class Renumbering:
    """Steps on their way from a program into a part of it, which has numbers of its own: first those of its inputs."""

    def __init__(self, inputs: int, number: dict[int, int]) -> None:
        self.inputs = inputs
        #: The number in the part by that in the whole: of the inputs to begin with.
        self.number = number
        self._steps: list[tuple[int, Step]] = []

    def add(self, step: Step) -> int:
        """Add a step whose operands have the numbers of the part; return its own."""
        self._steps.append((self.inputs + len(self._steps), step))
        return self._steps[-1][0]

    def move(self, index: int, step: Step) -> None:
        """Move a step of the whole, after those that it reads."""
        self.number[index] = self.add(step.renumbered(self.number))

    def part_of(self, program: Program) -> Program:
        """The part, with the outputs of the whole."""
        outputs = {name: self.number[i] for name, i in program.outputs.items()}
        nonnegative = frozenset(self.number[i] for i in program.nonnegative if i in self.number)
        return Program(self.inputs, tuple(self._steps), outputs, program.constants, nonnegative)


def required_steps(steps: Mapping[int, Step], wanted: Iterable[int]) -> tuple[tuple[int, Step], ...]:
    """The steps that some of them depend on, each just before its first use, which keeps the live set small."""
    needed: dict[int, None] = {}
    for last in wanted:
        stack = [last]
        while stack:
            index = stack[-1]
            if index not in steps or index in needed:
                stack.pop()
            elif missing := [i for i in steps[index].read if i in steps and i not in needed]:
                stack += reversed(missing)
            else:
                needed[stack.pop()] = None
    return tuple((i, steps[i]) for i in needed)


#: A function, its operands out of the slots, and the slot of its result.
_Call = tuple[Any, Callable[[list[Any]], Iterable[Any]], int]


def _taken_from(positions: Sequence[int]) -> Callable[[list[Any]], Iterable[Any]]:
    """Getter of some items of a list; compiled code of Python takes half as long as a list comprehension."""
    only = positions[0]
    return operator.itemgetter(slice(only, only + 1)) if len(positions) == 1 else operator.itemgetter(*positions)


class Interpreter:
    """Runs a program on blocks of points with NumPy.

    Everything a step touches (inputs, constants, buffers, results) sits in one list of slots, and a
    step is a function, what gets its operands out of them, and the place of its result: little is left for
    Python to do between two operations of NumPy, where threads wait for the interpreter lock.
    """

    def __init__(self, program: Program) -> None:
        self.program = program
        self._slots: list[Any] = [None] * program.inputs
        #: By slot, whether a buffer is for a mask.
        self.buffers: dict[int, bool] = {}
        self._results: dict[str, int] = {}
        self._calls = self._assign_slots()
        self._local = threading.local()

    def with_own_buffers(self) -> Interpreter:
        """The same interpreter with buffers of its own, which go when it goes."""
        interpreter = copy.copy(self)
        interpreter._local = threading.local()
        return interpreter

    def _assign_slots(self) -> list[_Call]:
        """Assign a slot to every step: that of its result, or a buffer that is free again after its last use."""
        steps, outputs = self.program.steps, self.program.outputs
        last_use = {o: i for i, step in steps for kind, o in step.operands if kind == "step"}
        position: dict[Operand, int] = {i: i for i in range(self.program.inputs)}
        position |= self._slots_of_results()
        calls: list[_Call] = []
        free: dict[bool, list[int]] = {True: [], False: []}
        for i, step in steps:
            operands = [position[o] if kind == "step" else self._new_slot(np.array(o)) for kind, o in step.operands]
            if i not in position:
                position[i] = free[step.is_mask].pop() if free[step.is_mask] else self._new_buffer(step.is_mask)
            calls.append((step.function, _taken_from(operands), position[i]))
            for o in dict.fromkeys(o for kind, o in step.operands if kind == "step" and last_use[o] == i):
                if position[o] in self.buffers:
                    free[self.buffers[position[o]]].append(position[o])
        self._copies = {name: position[i] for name, i in outputs.items() if name not in self._results}
        return calls

    def _slots_of_results(self) -> dict[Operand, int]:
        """A slot for each step that is an output, which goes straight into the first result that it is."""
        slots: dict[Operand, int] = {}
        computed = {i for i, _ in self.program.steps}
        for name, index in self.program.outputs.items():
            if index in computed and index not in slots:
                slots[index] = self._results[name] = self._new_slot()
        return slots

    def _new_slot(self, value: Any = None) -> int:
        self._slots.append(value)
        return len(self._slots) - 1

    def _new_buffer(self, is_mask: bool) -> int:
        slot = self._new_slot()
        self.buffers[slot] = is_mask
        return slot

    def run(self, inputs: Sequence[Any], results: Mapping[str, NDArray[Any]]) -> None:
        """Evaluate one block: arrays of inputs in, arrays of results filled."""
        slots = self._workspace(len(next(iter(results.values()))))
        slots[: self.program.inputs] = inputs
        for name, slot in self._results.items():
            slots[slot] = results[name]
        for function, operands_of, result in self._calls:
            function(*operands_of(slots), out=slots[result])
        for name, slot in self._copies.items():
            results[name][...] = slots[slot]
        for name, value in self.program.constants.items():
            results[name][...] = value

    def _workspace(self, size: int) -> list[Any]:
        """The slots of this thread with buffers of this size, kept from block to block."""
        workspaces: dict[int, list[Any]] | None = getattr(self._local, "workspaces", None)
        if workspaces is None:
            workspaces = self._local.workspaces = {}
        if size not in workspaces:
            if len(workspaces) >= MOST_WORKSPACES:
                workspaces.clear()
            slots = workspaces[size] = list(self._slots)
            for slot, is_mask in self.buffers.items():
                slots[slot] = np.empty(size, dtype=bool if is_mask else float)
        return workspaces[size]


def can_be_written(program: Program) -> bool:
    """True where each step is an elementwise function of NumPy, or a choice."""
    return all(_named(step.function.__name__) is step.function for _, step in program.steps)


def as_document(program: Program) -> dict[str, Any]:
    """A program as lists and tables of numbers and names."""
    return {
        "inputs": program.inputs,
        "steps": [(i, *_written(step)) for i, step in program.steps],
        "outputs": dict(program.outputs),
        "constants": {name: _plain(value) for name, value in program.constants.items()},
        "nonnegative": sorted(program.nonnegative),
    }


def from_document(held: Mapping[str, Any]) -> Program:
    """The reverse of :func:`as_document`. Raises ``ValueError`` for a function that it does not write."""
    steps: list[tuple[int, Step]] = []
    for i, name, operands, is_mask in held["steps"]:
        function = _named(name)
        if function is None:
            raise ValueError(name)
        steps.append((i, Step(function, tuple((kind, operand) for kind, operand in operands), is_mask)))
    return Program(held["inputs"], tuple(steps), held["outputs"], held["constants"], frozenset(held["nonnegative"]))


def _written(step: Step) -> tuple[str, list[tuple[str, Any]], bool]:
    operands = [(kind, _plain(operand)) for kind, operand in step.operands]
    return step.function.__name__, operands, bool(step.is_mask)


def _plain(value: Any) -> Any:
    """A number or a truth value of Python's own."""
    return value.item() if isinstance(value, np.generic | np.ndarray) else value


def _named(name: str) -> Any:
    """The function of a name; None where there is none."""
    if name == choose.__name__:
        return choose
    result = getattr(np, name, None)
    return result if isinstance(result, np.ufunc) else None

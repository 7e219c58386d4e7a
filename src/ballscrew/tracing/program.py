"""A program: the steps of a recording that the outputs asked for need, and how NumPy plays them.

NumPy plays a program block by block into a few buffers that stay in the cache. Results agree with plain
arrays to about 1e-14 relative, do not depend on the size of the blocks, and keep the limits at zero
load and at rest (the logarithm of zero is minus infinity).
"""

from __future__ import annotations

import dataclasses
import functools
import threading
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ballscrew.engine.steps import Operand, Step
from ballscrew.engine.tape import Tape, Traced


@dataclasses.dataclass(frozen=True)
class Program:
    """Steps in order, each with its number; the inputs have the first numbers."""

    inputs: int
    steps: tuple[tuple[int, Step], ...]
    #: Which step an output is, and the outputs that are the same everywhere.
    outputs: Mapping[str, int]
    constants: Mapping[str, Any]
    #: The steps that are known to be positive, zero or NaN.
    nonnegative: frozenset[int] = frozenset()

    @classmethod
    def of(cls, tape: Tape, outputs: Mapping[str, Any]) -> Program:
        """What of a tape the outputs need."""
        traced = {name: value.index for name, value in outputs.items() if isinstance(value, Traced)}
        constants = {name: value for name, value in outputs.items() if not isinstance(value, Traced)}
        steps = {i: step for i, step in enumerate(tape.steps) if step is not None}
        chosen = needed(steps, traced.values())
        known = frozenset(i for i in (*range(tape.inputs), *(i for i, _ in chosen)) if tape.nonnegative[i])
        return cls(tape.inputs, chosen, traced, constants, known)

    @functools.cached_property
    def player(self) -> Player:
        """NumPy, ready to play the program."""
        return Player(self)

    @property
    def text(self) -> str:
        """The program as text: a line for each step, and where the outputs are."""
        lines = [f"inputs {self.inputs}"]
        lines += [f"{i} {step.function.__name__} {step.operands}" for i, step in self.steps]
        return "\n".join([*lines, f"{dict(self.outputs)} {dict(self.constants)}"])


def needed(steps: Mapping[int, Step], wanted: Iterable[int]) -> tuple[tuple[int, Step], ...]:
    """The steps that some of them depend on, each just before it is first used: few values are then held at a time."""
    found: dict[int, None] = {}
    for last in wanted:
        waiting = [last]
        while waiting:
            index = waiting[-1]
            missing = [
                int(o)
                for kind, o in (steps[index].operands if index in steps else ())
                if kind == "step" and int(o) in steps and int(o) not in found
            ]
            if missing and index not in found:
                waiting += reversed(missing)
            else:
                waiting.pop()
                if index in steps:
                    found[index] = None
    return tuple((i, steps[i]) for i in found)


class Player:
    """NumPy, ready to play a program on blocks.

    Everything a step touches (inputs, constants, buffers, results) sits in one list of slots, and a
    step is a function and the positions of its operands and its result: little is left for the
    interpreter to do between two operations of NumPy, which is what threads have to queue for.
    """

    def __init__(self, program: Program) -> None:
        self.program = program
        self._slots: list[Any] = [None] * program.inputs
        #: By slot, whether a buffer is for a mask.
        self.buffers: dict[int, bool] = {}
        self._results: dict[str, int] = {}
        self._calls = self._arrange()
        self._local = threading.local()

    def _arrange(self) -> list[tuple[Any, list[int], int]]:
        """Give every step a slot: its result's, or a buffer that is given up after its last use."""
        steps, outputs = self.program.steps, self.program.outputs
        last_use = {o: i for i, step in steps for kind, o in step.operands if kind == "step"}
        position: dict[Operand, int] = {i: i for i in range(self.program.inputs)}
        computed = {i for i, _ in steps}
        for name, index in outputs.items():
            if index in computed and index not in position:
                position[index] = self._results[name] = self._new_slot()
        calls: list[tuple[Any, list[int], int]] = []
        free: dict[bool, list[int]] = {True: [], False: []}
        for i, step in steps:
            operands = [position[o] if kind == "step" else self._new_slot(np.array(o)) for kind, o in step.operands]
            if i not in position:
                position[i] = free[step.is_mask].pop() if free[step.is_mask] else self._new_buffer(step.is_mask)
            calls.append((step.function, operands, position[i]))
            for o in dict.fromkeys(o for kind, o in step.operands if kind == "step" and last_use[o] == i):
                if position[o] in self.buffers:
                    free[self.buffers[position[o]]].append(position[o])
        self._copies = {name: position[i] for name, i in outputs.items() if name not in self._results}
        return calls

    def _new_slot(self, value: Any = None) -> int:
        self._slots.append(value)
        return len(self._slots) - 1

    def _new_buffer(self, is_mask: bool) -> int:
        slot = self._new_slot()
        self.buffers[slot] = is_mask
        return slot

    def play(self, inputs: Sequence[Any], results: Mapping[str, NDArray[Any]]) -> None:
        """Evaluate one block: arrays of inputs in, arrays of results filled."""
        slots = self._workspace(len(next(iter(results.values()))))
        slots[: self.program.inputs] = inputs
        for name, slot in self._results.items():
            slots[slot] = results[name]
        for function, operands, result in self._calls:
            function(*[slots[position] for position in operands], out=slots[result])
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
            slots = workspaces[size] = list(self._slots)
            for slot, is_mask in self.buffers.items():
                slots[slot] = np.empty(size, dtype=bool if is_mask else float)
        return workspaces[size]

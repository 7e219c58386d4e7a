"""Evaluating a plan: by NumPy block by block, or by a compiled kernel where that pays."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping
from typing import Literal

import numpy as np
from numpy.typing import NDArray

import ballscrew
from ballscrew._arrays import BLOCK_SIZE, map_blocks
from ballscrew.analyses.plan import Plan
from ballscrew.engine.program import Program

#: What can evaluate a plan.
Engine = Literal["numpy", "compiled"]


class Evaluation:
    """A plan made ready; the same numbers whatever the blocks and the threads."""

    def __init__(self, plan: Plan, program: Program | None) -> None:
        self.plan = plan
        self.program = program

    @classmethod
    def of(cls, plan: Plan, engine: Engine | None = None) -> Evaluation:
        """Choose how to evaluate a plan, unless told."""
        return cls(plan, plan.recorded())

    @property
    def fingerprint(self) -> str:
        """A digest of the formulas as they are evaluated: two evaluations that share it give the same bits."""
        said = ballscrew.__version__ if self.program is None else self.program.text
        return hashlib.sha256(said.encode()).hexdigest()

    def empty(self, count: int) -> dict[str, NDArray[np.generic]]:
        """Room for the results of so many points."""
        return self.plan.empty(count)

    def fill(
        self,
        results: Mapping[str, NDArray[np.generic]],
        block: slice,
        *,
        block_size: int | None = None,
        threads: int | None = None,
        done: Callable[[int, int], None] | None = None,
    ) -> None:
        """Evaluate the points of a block of the flattened grid; ``results`` has room for just these."""
        total = block.stop - block.start

        def evaluate(part: slice) -> None:
            points = self.plan.points(slice(block.start + part.start, block.start + part.stop))
            with np.errstate(all="ignore"):
                if self.program is not None:
                    inputs = [points[name] for name in self.plan.varying]
                    self.program.play(inputs, {name: values[part] for name, values in results.items()})
                else:
                    result = self.plan.subject.at(self.plan.fixed | points)
                    for name, output in self.plan.wanted.items():
                        results[name][part] = output.read(result)

        map_blocks(
            evaluate,
            total,
            block_size=block_size or max(1, BLOCK_SIZE // self.plan.subject.balls),
            threads=threads,
            done=None if done is None else lambda n: done(n, total),
        )

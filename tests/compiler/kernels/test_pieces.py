"""A long program in pieces computes what it computes in one."""

import numpy as np
import pytest

from ballscrew.compiler.kernels import emission
from ballscrew.compiler.kernels.emission import kernel_text
from ballscrew.compiler.kernels.kernel import Kernel
from ballscrew.compiler.tracing.program import Program
from ballscrew.compiler.tracing.tape import Tape

LONG = 400


def long_program():
    """Steps that read far back, truth values among them, and an output that is an input."""
    tape = Tape(2, nonnegative=[True, False])
    x, y = tape.value(0), tape.value(1)
    early = np.sqrt(x + 1.0)
    above = y > 0.25
    value = x + y
    for k in range(LONG):
        value = np.where(above & (value < 3.0), value * 1.01 + early / (k + 1), value - 0.5 * y)
    return Program.of(tape, {"value": value, "above": above, "same": tape.value(1), "early": early})


def evaluated(text, points):
    kernel = Kernel.of(text, ["points", "points"])
    count = len(points[0])
    found = [np.empty(count), np.empty(count, dtype=bool), np.empty(count), np.empty(count)]
    kernel(slice(0, 1), slice(0, count), count, points, found)
    return found


@pytest.mark.slow
@pytest.mark.parametrize("steps", [7, 100, 1000])
def test_the_numbers_are_those_of_one_function(steps, monkeypatch):
    monkeypatch.setattr(emission, "STEPS", steps)
    program = long_program()
    masks = {"value": False, "above": True, "same": False, "early": False}
    rng = np.random.default_rng(3)
    points = [rng.uniform(0, 2, 101), rng.uniform(-1, 1, 101)]
    whole = kernel_text(program, ["points", "points"], masks)
    parted = kernel_text(program, ["points", "points"], masks, in_pieces=True)
    assert parted.count("define internal void @piece") == -(-len(program.steps) // steps)
    for one, other in zip(evaluated(whole, points), evaluated(parted, points), strict=True):
        assert other == pytest.approx(one, rel=1e-14)


def test_a_short_program_stays_in_one():
    program = long_program()
    masks = {"value": False, "above": True, "same": False, "early": False}
    assert len(program.steps) < emission.STEPS
    assert kernel_text(program, ["points", "points"], masks, in_pieces=True) == kernel_text(
        program, ["points", "points"], masks
    )

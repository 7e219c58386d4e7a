"""Reductions over the rows of a grid, recorded and cut (analytic)."""

import numpy as np
import pytest

from ballscrew.compiler.tracing.grid import split
from ballscrew.compiler.tracing.merging import cut_at_reductions, reduced
from ballscrew.compiler.tracing.program import Program
from ballscrew.compiler.tracing.tape import COLUMNS, ROWS, CannotRecordError, Tape

GROUPS = [COLUMNS, ROWS | COLUMNS]
SPEED, LOAD = np.array([2.0, 3.0, 5.0, 7.0]), np.arange(12.0).reshape(3, 4) % 5


def recorded():
    """A tape, what each column has, and what each point has; the last axis of an array stands for the rows."""
    tape = Tape(2, GROUPS, reduces=True)
    return tape, tape.value(0), tape.value(1)


def formula(speed, load):
    work = load * (speed + 1)
    place = np.argmax(load, axis=-1)
    return {
        "sum": speed + np.sum(work, axis=-1),
        "greatest": np.max(work, axis=-1),
        "of the greatest": np.take_along_axis(np.sqrt(work), place, axis=-1),
        "is large": np.take_along_axis(work > 8, place, axis=-1),
        "same in all rows": np.max(speed, axis=-1),
    }


def test_a_program_is_cut_at_its_reductions():
    tape, speed, load = recorded()
    program = Program.of(tape, formula(speed, load))
    stages = cut_at_reductions(program, GROUPS)
    cut = split(stages.before, GROUPS)
    assert [source for source, _ in cut.tables].count("points") == 1
    flat = {name: np.empty(LOAD.size) for name in stages.before.outputs}
    stages.before.interpreter.run([np.tile(SPEED, 3), LOAD.ravel()], flat)
    values = {name: held.reshape(LOAD.shape) for name, held in flat.items()}
    found = {name: np.empty(4, dtype=bool if name == "is large" else float) for name in program.outputs}
    stages.behind.interpreter.run([SPEED, None, *reduced(stages.reductions, values, {})], found)
    work, place = LOAD * (SPEED + 1), np.argmax(LOAD, axis=0)
    there = np.take_along_axis(work, place[None], axis=0)[0]
    assert np.array_equal(found["sum"], SPEED + work.sum(axis=0))
    assert np.array_equal(found["greatest"], work.max(axis=0))
    assert np.allclose(found["of the greatest"], np.sqrt(there), rtol=1e-15)
    assert np.array_equal(found["is large"], there > 8)
    assert np.array_equal(found["same in all rows"], SPEED)


def test_what_is_reduced_is_not_reduced_again():
    _, speed, load = recorded()
    total = np.sum(load, axis=-1)
    for wrong in (lambda: np.sum(load / total, axis=-1), lambda: np.sum(speed, axis=-1), lambda: np.sum(load, axis=0)):
        with pytest.raises(CannotRecordError):
            wrong()
    with pytest.raises(CannotRecordError):
        np.sum(Tape(1).value(0), axis=-1)


def test_a_result_of_each_row_is_refused():
    tape, speed, load = recorded()
    program = Program.of(tape, {"load": load * speed, "sum": np.sum(load, axis=-1)})
    with pytest.raises(CannotRecordError, match="each row"):
        cut_at_reductions(program, GROUPS)

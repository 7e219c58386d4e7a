"""Modules for browsers: the recordings of structures as WebAssembly, and of the oils.

No formula is written again: a module is the recording of the model with all its numbers as inputs, compiled. Both pages
have the same ones, the static one and the served one, and the same program that runs them.
"""

from __future__ import annotations

import dataclasses
import functools
import hashlib
import json
from collections.abc import Collection, Mapping, Sequence
from importlib import resources
from typing import Any, NamedTuple

import numpy as np

from ballscrew.basis.quantities import Info, Quantity, quantities_of
from ballscrew.compiler.kernels import kernel, wasm
from ballscrew.compiler.kernels.emission import kernel_text
from ballscrew.compiler.tracing.merging import merged_program
from ballscrew.compiler.tracing.program import Program, Renumbering, Source
from ballscrew.compiler.tracing.tape import Tape
from ballscrew.engine.evaluation.by_ball import stages_by_ball
from ballscrew.engine.evaluation.outputs import OF_LOADS, OPERATION, Output, known_outputs
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.evaluation.structures import OF_BALLS, inputs_of_structure, recorded_structure
from ballscrew.physics.components.materials import OF_A_GRADE, Lubricant
from ballscrew.physics.components.nut import Nut
from ballscrew.physics.components.oil_grades import TEMPERATURE, OilState, grades, nominal_oil
from ballscrew.physics.components.operating_state import settled
from ballscrew.physics.friction.ball_section import MostLoadedBall, most_loaded_ball
from ballscrew.physics.solvers.load_distribution import (
    BallLoads,
    ElasticNutNumbers,
    elastic_nut_numbers,
    preload_of_rigid_bodies,
)

#: What the most loaded ball of a nut carries.
BALL = MostLoadedBall._fields
#: What a module gives, where the nut has it, besides the parts of the torque and the conditions of validity.
OUTPUTS = (
    "screw_torque", "nut_torque", "ideal_torque", "drive_torque", "holding_torque", "self_locking", "efficiency",
    "back_driving_efficiency", "contact_load", "largest_contact_load", "maximum_pressure", "minimum_film_parameter",
    "screw_film_parameter", "nut_film_parameter", "screw_friction_coefficient", "nut_friction_coefficient",
    "screw_maximum_pressure", "nut_maximum_pressure", "friction_coefficient", "friction_angle", "friction_power",
    "rolling_share", "deflection", "rigidity", "remaining_preload", "lift_off_load", "residual", "valid",
    "screw_semi_major_axis", "nut_semi_major_axis", "power_imbalance", *BALL,
)  # fmt: skip
#: Of these what sweeps do not ask for.
_FURTHER: Mapping[str, Output] = {
    "power_imbalance": Output(
        "power_imbalance",
        Quantity("power_imbalance", "1", Info("", "power of the torque beyond what is dissipated, as a share of that")),
        lambda result: result.power_imbalance,
    ),
    **{
        name: Output(
            name,
            quantities_of(BallLoads)[name],
            lambda result, n=name: getattr(most_loaded_ball(result.loads), n),
        )
        for name in BALL
    },
}
_PARTS = ("contribution_", "validity_")
#: The diameter of an elastic nut; NaN for one of the usual size.
NUT_DIAMETER = "bodies.nut_outer_diameter"
#: What the solver of the balls is given of a point besides the numbers of the nut.
OF_POINT = ("load", "preload")
#: A temperature at which every oil is one.
_ANY_TEMPERATURE = 313.15
#: Columns of a kernel over balls and points that are worked on at a time.
TILE = 128


class Function(NamedTuple):
    """A function of a module: the names of what it reads and gives, in their order, and of what is the same always."""

    name: str
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    constants: Mapping[str, float]


class Module(NamedTuple):
    """A module: its bytes and what is in it."""

    code: bytes
    functions: tuple[Function, ...]
    #: Of a nut whose balls are solved one by one: the parts that run one after the other, as a document.
    by_ball: Mapping[str, Any] | None = None

    @property
    def file(self) -> str:
        """The name of its file, which its content decides."""
        return f"{hashlib.sha256(self.code).hexdigest()[:16]}.wasm"

    @property
    def described(self) -> dict[str, Any]:
        """The document for who runs it: its file, and what each function reads and gives."""
        by_ball = {} if self.by_ball is None else {"by_ball": self.by_ball}
        return {"file": self.file, **described(self.functions[0]), **by_ball}


class KeptModule(NamedTuple):
    """A module as it is kept on disk and sent to a page: what runs it has to know, and its bytes."""

    document: Mapping[str, Any]
    code: bytes

    @classmethod
    def of(cls, module: Module) -> KeptModule:
        """The kept form of a module which was made now."""
        return cls(json.loads(json.dumps(module.described)), module.code)

    @property
    def file(self) -> str:
        """The name of its file."""
        return self.document["file"]


def kept_module(name: str) -> KeptModule | None:
    """A module from the disk by the name of its structure; None where there is none."""
    kept = kernel.kept(name)
    return None if kept is None else KeptModule(json.loads(kept[0]), kept[1])


def described(function: Function) -> dict[str, Any]:
    """A function as a document."""
    return {
        "function": function.name,
        "inputs": list(function.inputs),
        "outputs": list(function.outputs),
        "constants": dict(function.constants),
    }


def outputs_of(nut: Nut, outputs: Collection[str] = OUTPUTS) -> Mapping[str, Output]:
    """Outputs, of some, that the module of such a nut gives, and all parts of the torque, by name."""
    further = {n: output for n, output in _FURTHER.items() if not (nut.is_row and n in BALL)}
    known = {**known_outputs(nut), **further}
    left_out = {"lift_off_load"} if nut.one_by_one else ()  # a search, which no recording holds
    return {n: o for n, o in known.items() if (n in outputs or n.startswith(_PARTS)) and n not in left_out}


def module_of(subject: Configuration, outputs: Collection[str] = OUTPUTS, varying: Sequence[str] = ()) -> Module:
    """The module of a configuration whose oil is its numbers alone, with some outputs and with all parts of the torque.

    Of numbers that are constants elsewhere, those ``varying`` are inputs, too. Outputs that such a nut has not are left
    out. Raises :class:`~ballscrew.compiler.tracing.tape.CannotRecordError` for what cannot be recorded.
    """
    names = inputs_of_structure(subject, varying)
    program = recorded_structure(subject, outputs_of(subject.nut, outputs), names)
    if subject.nut.one_by_one:
        return _by_ball(subject, names, program)
    return compiled([("evaluate", names, program)])


def _by_ball(subject: Configuration, names: tuple[str, ...], program: Program) -> Module:
    """The module of a nut with elastic bodies."""
    stages, cut = stages_by_ball(program, names)
    known = (*names, *OF_LOADS, *OF_BALLS)
    reduced = tuple(f"reduced_{place}" for place in range(len(stages.reductions)))
    numbers, program_of_numbers = _numbers(subject, names)
    sources: list[Source] = [source for source, _ in cut.tables]
    tables = tuple((s, name if s == "columns" else known[int(name)]) for s, name in cut.tables)
    masks = dict.fromkeys(cut.points.outputs, False)
    text = kernel_text(cut.points, sources, masks, lanes=wasm.LANES, reduced=stages.sums, in_pieces=True)
    parts, functions = _functions(
        [
            ("numbers", numbers, program_of_numbers),
            ("points", known, cut.columns),
            ("behind", (*known, *reduced), stages.behind),
        ]
    )
    nut, bodies = subject.nut, subject.nut.bodies
    assert bodies is not None, "elastic bodies"
    by_ball = {
        "halves": nut.halves,
        "four_contacts": nut.contacts_per_ball == 4,
        "swells": bodies.swelling,
        # the numbers of the nut for the solver, in its order, the load, the preload, and more of the nut
        "numbers": described(functions[0]),
        "points": described(functions[1]),
        # by input "columns" and an output of the function of the points, or "points" and what each ball has
        "ball": {
            "function": "ball",
            "inputs": tables,
            "outputs": list(cut.points.outputs),
            "reduced": list(stages.sums),
        },
        # over the balls: "sum", "max", "argmax", or "take" at the place that an earlier one has found
        "reductions": [(_REDUCTIONS[step.function], step.values, step.place) for step in stages.reductions],
        "behind": described(functions[2]),
        "tile": TILE,
        "solver": [*ElasticNutNumbers._fields, *OF_POINT],
    }
    return Module(wasm.module_of([*parts, wasm.Part("ball", text)]), (functions[2],), by_ball)


_REDUCTIONS: Mapping[Any, str] = {np.sum: "sum", np.max: "max", np.argmax: "argmax", np.take_along_axis: "take"}


def _numbers(subject: Configuration, names: tuple[str, ...]) -> tuple[tuple[str, ...], Program]:
    """The numbers of a nut for the solver of its balls as a program of some of the inputs; the names of these."""
    every = (*names, NUT_DIAMETER)
    tape = Tape(len(every), None, [subject.is_nonnegative(name) for name in names] + [False])
    points = {name: tape.value(i) for i, name in enumerate(every)}
    diameter = points.pop(NUT_DIAMETER)
    here = subject.changed({name: value for name, value in points.items() if name not in OPERATION})
    screw, nut, bodies = here.screw, here.nut, here.nut.bodies
    assert bodies is not None, "elastic bodies"
    usual: Any = bodies.sized(screw)
    outer = np.where(np.isnan(diameter), usual.nut_outer_diameter, diameter)
    solved = elastic_nut_numbers(screw, nut, dataclasses.replace(usual, nut_outer_diameter=outer))
    load, preload = settled(points[OPERATION[0]]), preload_of_rigid_bodies(screw, nut)
    of_point = dict(zip(OF_POINT, (load, preload), strict=True))
    return every, merged_program(tape, {**solved._asdict(), **of_point, "balls": screw.carrying_balls})


@functools.cache
def module_of_solver() -> Module:
    """The solver of the balls between elastic bodies, as ``make interpreter`` compiles it of its source in C."""
    return Module(resources.files("ballscrew").joinpath("data/exports/wasm32/loads.wasm").read_bytes(), ())


@functools.cache
def oils() -> tuple[str, ...]:
    """The grades of oil of which all numbers but the slope of the pressure modulus follow the temperature."""
    return tuple(grade for grade in grades() if _at(grade, _ANY_TEMPERATURE).pressure_modulus_slope is None)


def module_of_oils() -> Module:
    """The numbers of each grade of oil at a temperature: a function for each, in the order of :func:`oils`."""
    wanted = [name for name in OF_A_GRADE if name != "pressure_modulus_slope"]
    programs: list[tuple[str, tuple[str, ...], Program]] = []
    for place, grade in enumerate(oils()):
        tape = Tape(1, None, [True])
        state = _at(grade, tape.value(0))
        program = merged_program(tape, {name: getattr(state, name) for name in wanted})
        programs.append((f"oil_{place}", (TEMPERATURE.name,), program))
    return compiled(programs)


def _at(grade: str, temperature: Any) -> OilState:
    """The nominal numbers of a grade at a temperature, a number or one that is recorded."""
    oil: Any = Lubricant.from_grade(grade, _ANY_TEMPERATURE).made_as
    return nominal_oil(dataclasses.replace(oil, temperature=temperature))


def compiled(programs: Sequence[tuple[str, tuple[str, ...], Program]]) -> Module:
    """Functions over points as one module."""
    parts, functions = _functions(programs)
    return Module(wasm.module_of(parts), functions)


def _functions(
    programs: Sequence[tuple[str, tuple[str, ...], Program]],
) -> tuple[list[wasm.Part], tuple[Function, ...]]:
    """Programs over points as parts of a module, and what each of them reads: nothing that no step needs."""
    parts: list[wasm.Part] = []
    functions: list[Function] = []
    for name, inputs, whole in programs:
        program, read = _of_what_it_reads(whole)
        sources: list[Source] = ["points"] * program.inputs
        masks = dict.fromkeys(program.outputs, False)
        parts.append(wasm.Part(name, kernel_text(program, sources, masks, lanes=wasm.LANES, in_pieces=True)))
        constants = {name: float(value) for name, value in program.constants.items()}
        functions.append(Function(name, tuple(inputs[i] for i in read), tuple(program.outputs), constants))
    return parts, tuple(functions)


def _of_what_it_reads(program: Program) -> tuple[Program, list[int]]:
    """A program without the inputs that it does not read, and the places of those that are left."""
    read = sorted(
        {o for _, step in program.steps for o in step.read if o < program.inputs}
        | {o for o in program.outputs.values() if o < program.inputs}
    )
    part = Renumbering(len(read), {i: place for place, i in enumerate(read)})
    for i, step in program.steps:
        part.move(i, step)
    return part.part_of(program), read

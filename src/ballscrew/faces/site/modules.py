"""The modules of the static page: the recordings of structures as WebAssembly, and of the oils.

No formula is written again: a module is the recording of the model with all its numbers as inputs, compiled.
"""

from __future__ import annotations

import dataclasses
import hashlib
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from ballscrew.compiler.kernels import wasm
from ballscrew.compiler.kernels.emission import kernel_text
from ballscrew.compiler.tracing.merging import merged_program
from ballscrew.compiler.tracing.program import Program, Source
from ballscrew.compiler.tracing.tape import Tape
from ballscrew.engine.evaluation.outputs import known_outputs
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.faces.site import kinds
from ballscrew.physics.components.materials import OF_A_GRADE, TEMPERATURE, Lubricant, grades, nominal_oil
from ballscrew.physics.components.oil_grades import OilState

#: The function of a module that evaluates the model.
EVALUATE = "evaluate"
#: What a module gives, where the nut has it, besides the parts of the torque and the conditions of validity.
OUTPUTS = (
    "screw_torque", "nut_torque", "ideal_torque", "drive_torque", "holding_torque", "self_locking", "efficiency",
    "back_driving_efficiency", "contact_load", "largest_contact_load", "maximum_pressure", "minimum_film_parameter",
    "screw_film_parameter", "nut_film_parameter", "screw_friction_coefficient", "nut_friction_coefficient",
    "screw_maximum_pressure", "nut_maximum_pressure", "rolling_share", "deflection", "rigidity", "remaining_preload",
    "lift_off_load", "residual", "valid",
)  # fmt: skip
_PARTS = ("contribution_", "validity_")
#: A temperature at which every oil is one.
_ANY_TEMPERATURE = 313.15


class Function(NamedTuple):
    """A function of a module: the names of what it reads and gives, in their order, and of what is the same always."""

    name: str
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    constants: Mapping[str, float]


class Module(NamedTuple):
    """A module: its bytes and its functions."""

    code: bytes
    functions: tuple[Function, ...]

    @property
    def file(self) -> str:
        """The name of its file, which its content decides."""
        return f"{hashlib.sha256(self.code).hexdigest()[:16]}.wasm"


def module_of_structure(model: str, kind: str) -> Module:
    """The module of a model and a kind of nut."""
    subject = kinds.subject_of(kinds.case_of(kinds.PAPER, model, kind))
    program, names = recorded(subject)
    return _compiled([(EVALUATE, names, program)])


def recorded(subject: Configuration) -> tuple[Program, tuple[str, ...]]:
    """The outputs of a structure as a program of all its numbers, and their names."""
    names = kinds.inputs_of(subject)
    known = known_outputs(subject.nut)
    wanted = {n: output for n, output in known.items() if n in OUTPUTS or n.startswith(_PARTS)}
    tape = Tape(len(names), None, [subject.is_nonnegative(name) for name in names])
    points = {name: tape.value(i) for i, name in enumerate(names)}
    return subject.recorded(tape, points, wanted), names


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
    return _compiled(programs)


def _at(grade: str, temperature: Any) -> OilState:
    """The nominal numbers of a grade at a temperature, a number or one that is recorded."""
    oil: Any = Lubricant.from_grade(grade, _ANY_TEMPERATURE).made_as
    return nominal_oil(dataclasses.replace(oil, temperature=temperature))


def _compiled(programs: Sequence[tuple[str, tuple[str, ...], Program]]) -> Module:
    """Functions over points as one module."""
    parts: list[wasm.Part] = []
    functions: list[Function] = []
    for name, inputs, program in programs:
        sources: list[Source] = ["points"] * len(inputs)
        masks = dict.fromkeys(program.outputs, False)
        parts.append(wasm.Part(name, kernel_text(program, sources, masks, lanes=wasm.LANES, in_pieces=True)))
        constants = {name: float(value) for name, value in program.constants.items()}
        functions.append(Function(name, inputs, tuple(program.outputs), constants))
    return Module(wasm.module_of(parts), tuple(functions))

"""The structure of a configuration: what is left of it when all its numbers are inputs.

One recording of a structure serves every case of its kind: nothing is recorded again when a number changes. What is
not a number stays in the key: the laws, the kind of the nut, what is given and what is None; and exponents of laws,
which are folded into the powers. Rows and rigid nuts are recorded whole, point by point; nuts whose balls differ by
ball, with the results of the solver of the loads as further inputs (:mod:`ballscrew.engine.evaluation.by_ball`).
"""

from __future__ import annotations

import dataclasses
from collections.abc import Hashable, Mapping, Sequence
from typing import Any

from ballscrew.compiler.tracing.gradient import partials
from ballscrew.compiler.tracing.merging import merged_program
from ballscrew.compiler.tracing.program import Program
from ballscrew.compiler.tracing.steps import COLUMNS, ROWS
from ballscrew.compiler.tracing.tape import CannotRecordError, Tape
from ballscrew.engine.evaluation.outputs import (
    DEFAULT_OUTPUTS,
    NUT_OUTPUTS,
    OF_LOADS,
    OPERATION,
    Output,
    known_outputs,
    slope_name,
)
from ballscrew.engine.evaluation.plan import Configuration, read_input
from ballscrew.engine.evaluation.recordings import UnknownPartError, key_of
from ballscrew.physics.components.materials import INPUTS_OF_SHEET
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.physics.components.screw import MATERIALS
from ballscrew.physics.solvers.load_distribution import BallLoads, KindLoads

#: What each ball has of the solved loads.
OF_BALLS = ("forward_load", "backward_load", "forward_angle", "backward_angle")
#: What sets numbers of the oil, which are inputs themselves.
OF_STATE = frozenset({TEMPERATURE.name, *INPUTS_OF_SHEET})
#: What no recording depends on: only the solver of the loads does, or only what has set numbers that are inputs.
_ASIDE = frozenset({"bodies", "deviations", "grade", "sheet", "temperature", "made_as"})
#: Outputs that are recorded together.
_USUAL = frozenset({*NUT_OUTPUTS, "drive_torque", "holding_torque", "self_locking", "minimum_film_parameter"})
_USUAL_OF_ROWS = frozenset({*DEFAULT_OUTPUTS, "screw_maximum_pressure", "nut_maximum_pressure"})
_USUAL_PARTS = ("contribution_", "validity_")


def inputs_of_structure(subject: Configuration, varying: Sequence[str] = ()) -> tuple[str, ...]:
    """The names of all numbers of a configuration that are inputs of its recording, the operating point first.

    An exponent of a law is a constant, unless it varies: folded into the powers, it costs nothing. A number that
    is None is left out, unless it varies.
    """
    varied = set(map(own_name, varying))
    seen: set[str] = set()
    names: list[str] = []
    parts = subject.by_section
    for name, (part, _) in subject.inputs.items():
        own = own_name(name)
        is_exponent = part == "model" and name.rpartition(".")[2].endswith("exponent") and name not in varied
        if part == "operation" or name in OF_STATE or own in seen or is_exponent:
            continue
        seen.add(own)
        if own in varied or read_input(parts[part], name) is not None:
            names.append(own)
    return (*OPERATION, *names)


def own_name(name: str) -> str:
    """The name of an input without the section of the nut, which may be left out."""
    return name.removeprefix("nut.")


def outputs_of_structure(subject: Configuration, outputs: Sequence[str]) -> Mapping[str, Output]:
    """The outputs that are recorded for those asked for: the usual ones, where these are among them, or just these.

    What a few outputs more cost is saved by having one recording and one kernel for most purposes.
    """
    known = known_outputs(subject.nut)
    of_kind = _USUAL | _USUAL_OF_ROWS if subject.nut.is_row else _USUAL
    usual = {n: output for n, output in known.items() if n in of_kind or n.startswith(_USUAL_PARTS)}
    return usual if usual.keys() >= set(outputs) else {name: known[name] for name in outputs}


def structure_key(subject: Configuration, outputs: Sequence[str], names: Sequence[str]) -> Hashable | None:
    """All that the recording of some outputs depends on, whose inputs have these names.

    None where a law from outside may compute something else each time.
    """
    try:
        return _structure(subject, names), tuple(outputs), tuple(names)
    except UnknownPartError:
        return None


def _structure(subject: Configuration, names: Sequence[str]) -> Hashable:
    """A configuration as a key, without the numbers that are inputs and without what only the loads depend on."""
    asides = {*names, *_ASIDE}

    def of(part: Any, prefix: str = "") -> Hashable:
        laws = [f for f in dataclasses.fields(part) if f"{prefix}{f.name}" not in asides]
        return type(part), *((f.name, of_field(getattr(part, f.name), f.name)) for f in laws)

    def of_field(value: Any, name: str) -> Hashable:
        if name == "nut":
            return of(value)
        if name == "losses":
            return tuple((n, of_law(law, f"losses.{n}.")) for n, law in value.items())
        is_part = name in subject.model.laws_with_coefficients or name in MATERIALS
        return of_law(value, f"{name}.") if is_part else key_of(value)

    def of_law(law: Any, prefix: str) -> Hashable:
        key_of(law)  # raises for one from outside
        return of(law, prefix) if dataclasses.is_dataclass(law) else key_of(law)

    return of(subject.model), of(subject.screw), of(subject.lubricant), subject.nut.one_by_one


def numbers_alone(subject: Configuration) -> Configuration:
    """The same with an oil that is its numbers alone; a law from outside may ask for the grade of the oil."""
    oil = dataclasses.replace(subject.lubricant, grade=None, sheet=None, temperature=None)
    return Configuration(subject.model, subject.screw, oil)


def recorded_structure(
    subject: Configuration, wanted: Mapping[str, Output], names: Sequence[str], by: Sequence[str] = ()
) -> Program:
    """The outputs wanted as a program of the inputs of these names, in their order.

    Each output is followed by its derivatives ``by`` inputs, where balls are alike.

    That of a nut whose balls differ has the results of the solver as further inputs, for the nut (``OF_LOADS``) and for
    each ball (:data:`OF_BALLS`), and reductions over the balls. Raises
    :class:`~ballscrew.compiler.tracing.tape.CannotRecordError` for laws that cannot be recorded, and for a nut whose
    balls differ and that was set at rest; :class:`~ballscrew.compiler.tracing.gradient.UnknownDerivativeError` for
    functions whose derivative is not known.
    """
    if subject.nut.one_by_one:
        return _recorded_by_ball(subject, wanted, names)
    tape = Tape(len(names), None, [subject.is_nonnegative(name) for name in names])
    points = {name: tape.value(i) for i, name in enumerate(names)}
    if not by:
        return subject.recorded(tape, points, wanted)
    values: dict[str, Any] = {}
    with subject.recording():
        result = subject.at(points)
        for name, output in wanted.items():
            values[name] = output.read(result)
            slopes = partials(tape, values[name], [names.index(own_name(x)) for x in by])
            values |= {slope_name(name, x): slope for x, slope in zip(by, slopes, strict=True)}
    return merged_program(tape, values)


def _recorded_by_ball(subject: Configuration, wanted: Mapping[str, Output], names: Sequence[str]) -> Program:
    """The program of all inputs, the results of the solver for the nut, and those for each ball."""
    if subject.nut.set_at_rest:
        raise CannotRecordError("the preload of a nut that was set at rest follows the friction of its balls")
    groups = groups_by_ball(names)
    nonnegative = [subject.is_nonnegative(name) for name in names] + [False] * len(OF_LOADS) + [True] * len(OF_BALLS)
    tape = Tape(len(groups), groups, nonnegative, reduces=True)
    traced = [tape.value(i) for i in range(tape.inputs)]
    points = dict(zip(names, traced, strict=False))
    of_nut = dict(zip(OF_LOADS, traced[len(names) :], strict=False))
    of_balls = dict(zip(OF_BALLS, traced[-len(OF_BALLS) :], strict=True))
    with subject.recording(by_ball=True):
        lift_off = of_nut.pop("lift_off_load")
        kinds = (KindLoads(balls=1.0, **of_balls),)
        loads = BallLoads(kinds=kinds, one_by_one=True, lift_off=lift_off, **of_nut)
        result = subject.under(loads, points)
        return merged_program(tape, {name: output.read(result) for name, output in wanted.items()})


def groups_by_ball(names: Sequence[str]) -> list[int]:
    """The groups of the inputs of a recording by ball: points are columns, balls are rows."""
    return [COLUMNS] * (len(names) + len(OF_LOADS)) + [ROWS | COLUMNS] * len(OF_BALLS)


#: What NumPy needs for one step at one point, on two threads, and the steps of a program whose buffers
#: begin to outgrow the cache; and what a kernel costs before its first point if it has to be compiled.
#: Only the choice of an engine depends on these numbers, so that they need not be exact.
NUMPY_STEP_SECONDS, STEPS_IN_CACHE = 2.5e-10, 5000
COMPILING_SECONDS, COMPILING_STEP_SECONDS = 0.05, 1.2e-4
#: Points of a structure that have to be asked for, in one call or in several, before a kernel is compiled for it; and
#: points of one call beyond which a kernel of just this call pays, whose constants are folded.
ENOUGH_TO_COMPILE, ENOUGH_TO_FOLD = 20_000, 4_000_000

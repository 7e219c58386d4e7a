"""The axis, the motion, the motor and the surroundings of a case, and the rule of one efficiency, from its sections."""

from __future__ import annotations

import dataclasses
import functools
import math
import reprlib
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ballscrew.axis.duty_cycle.axis import Axis, Motor
from ballscrew.axis.motion.profiles import Motion, Segment
from ballscrew.axis.motion.trajectory import Trajectory
from ballscrew.axis.thermal.surroundings import Surroundings
from ballscrew.basis import units
from ballscrew.basis.errors import MISSING, Fault, InputError, either, nearest, overflow_as_input_error
from ballscrew.basis.quantities import fields_of
from ballscrew.cases.schema.case_schema import MODELS, read_table
from ballscrew.cases.schema.duty_schema import (
    CONSTANT_EFFICIENCY,
    KEYS,
    MOTIONS,
    POINT,
    TRAJECTORY,
    Counterforce,
    duty_sections,
    fields_of_motion,
)
from ballscrew.cases.schema.reader import Reader
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.sizing.installation import Installation

#: What a question about a motion needs besides the screw.
NEEDED = ("axis", "motion")
#: Keys of a motion by its field.
_FIELDS = {key: name for name, key in KEYS.items()}


class Moved(NamedTuple):
    """The parts of a case that moves; None for what it does not have, or what is wrong."""

    axis: Axis | None = None
    motion: Motion | None = None
    motor: Motor | None = None
    surroundings: Surroundings | None = None


def moved(reader: Reader) -> Moved:
    """Axis, motion, motor and surroundings, of which a case may have none."""
    return Moved(
        _axis(reader) if "axis" in reader else None,
        _motion(reader) if "motion" in reader else None,
        _motor(reader) if "motor" in reader else None,
        _surroundings(reader) if "surroundings" in reader else None,
    )


def needed(usual: Sequence[str], moves: bool, efficiency: float | None) -> Sequence[str]:
    """The sections that a case needs: one that moves no operating point, the rule of one efficiency no oil."""
    values = [name for name in usual if not (name == "lubricant" and efficiency is not None)]
    return [*(name for name in values if name != "operation"), *NEEDED] if moves else values


@overflow_as_input_error()
def misfits(moved: Moved, installation: Installation | None, root_diameter: float | None) -> list[Fault]:
    """Faults of lengths that contradict each other: of the motion, the shaft between its bearings, and its bore."""
    surroundings = moved.surroundings or Surroundings()
    whole, free = surroundings.shaft_length, None if installation is None else installation.unsupported_length
    quantity, faults = fields_of(Surroundings)["stroke"], list[Fault]()

    def shown(length: float) -> str:
        return units.shown(length, quantity)

    if whole is not None and free is not None and free > whole:
        given, remedy = f"{shown(free)} of {shown(whole)}", "give at most that of the surroundings"
        faults.append(
            Fault("installation.unsupported_length", "is longer than the shaft between its bearings", given, remedy)
        )
    if root_diameter is not None and surroundings.bore >= root_diameter:
        given = f"{shown(surroundings.bore)} in a shaft of {shown(root_diameter)}"
        faults.append(Fault("surroundings.bore", "leaves no shaft", given, "give a smaller bore"))
    if whole is None and free is None:
        return faults
    length = min(float(one) for one in (whole, free) if one is not None)
    if surroundings.stroke is not None and surroundings.stroke >= length:
        given = f"{shown(surroundings.stroke)} on {shown(length)}"
        remedy = "shorten the stroke, or lengthen the shaft"
        faults.append(Fault("surroundings.stroke", "does not fit between the bearings", given, remedy))
    if moved.motion is not None:
        try:
            moved.motion.states().places_on(length, surroundings.first_position)
        except InputError as error:
            faults += error.faults
    return faults


@overflow_as_input_error()
def travel(axis: Axis, motion: Motion, lead: float) -> OperatingState:
    """The operating point of steady travel forwards, at the largest speed and without any process."""
    states = motion.states()
    fastest = float(np.max(np.abs(states.speed)))
    load = axis.gravity_force + axis.resting_guide_friction
    return OperatingState(axial_load=load, screw_speed=2 * math.pi * fastest / lead)


def efficiency(reader: Reader, chosen: str | None, moves: bool) -> float | None:
    """The efficiency of the rule of that name; None for a model, which :mod:`~ballscrew.cases.case_files.case_file`
    makes.
    """
    table = reader.tables.get("model", {})
    if not isinstance(table, dict):
        return None
    named = table.get("name")
    if CONSTANT_EFFICIENCY not in (named, chosen) or (chosen not in (None, CONSTANT_EFFICIENCY)):
        if "efficiency" in table and named != CONSTANT_EFFICIENCY:
            remedy = f'leave it out, or write name = "{CONSTANT_EFFICIENCY}"'
            reader.refuse("model.efficiency", "a model computes it", str(table["efficiency"]), remedy)
        return None
    part = reader.part()
    values = reader.values_of("model")
    if not moves:
        remedy = f"take a model: {', '.join(MODELS)}"
        problem = "is a rule, which only ballscrew duty takes"
        reader.refuse("model.name", problem, CONSTANT_EFFICIENCY, remedy)
    reader.faults += [
        Fault(f"model.{name}", f'does not count with "{CONSTANT_EFFICIENCY}"', reprlib.repr(value), "leave it out")
        for name, value in table.items()
        if name not in ("name", "efficiency")
    ]
    if not part.is_faulty and "efficiency" not in values:
        reader.refuse("model.efficiency", MISSING, "", "add efficiency = 0.9")
    return values["efficiency"] if not part.is_faulty else math.nan


def _axis(reader: Reader) -> Axis | None:
    part = reader.part()
    values: dict[str, Any] = reader.values_of("axis")
    weight = values.get("counterweight")
    if isinstance(weight, Counterforce):
        del values["counterweight"]
        if "counterforce" in values:
            given = str(reader.tables["axis"]["counterweight"])
            reader.refuse("axis.counterweight", "is a force beside the counterforce", given, "give one of them")
        values["counterforce"] = float(weight)
    return None if part.is_faulty else Axis(**values)


def _motion(reader: Reader) -> Motion | None:
    part = reader.part()
    table, values = reader.tables["motion"], reader.values_of("motion")
    if part.is_faulty:
        return None
    kinds = (*MOTIONS, TRAJECTORY)
    kind: str = values.pop("kind", "")
    if not kind:
        reader.refuse("motion.kind", MISSING, "", f"add kind = {either(kinds)}")
    elif kind not in kinds:
        reader.refuse("motion.kind", "unknown kind of motion", kind, nearest(kind, kinds))
    else:
        reader.faults += _misplaced(kind, table)
        reader.faults += _missing(kind, table)
    if part.is_faulty:
        return None
    if kind == TRAJECTORY:
        from ballscrew.axis.motion.trajectory_file import read_trajectory  # loads pandas

        return _made(reader, "motion", functools.partial(read_trajectory, reader.folder / values["file"]))
    if "segment" in values:
        values["segment"] = _segments(reader, values["segment"])
    given = {_FIELDS.get(key, key): value for key, value in values.items()}
    return _made(reader, "motion", functools.partial(MOTIONS[kind], **given)) if not part.is_faulty else None


def _misplaced(kind: str, table: Mapping[str, Any]) -> list[Fault]:
    """Faults of fields that another kind of motion has."""
    own = fields_of_motion(kind)
    faults: list[Fault] = []
    for name, value in table.items():
        if name != "kind" and name not in own:
            kinds = [other for other in (*MOTIONS, TRAJECTORY) if name in fields_of_motion(other)]
            remedy = f"leave it out, or write kind = {either(kinds)}"
            faults.append(Fault(f"motion.{name}", f'a motion of kind "{kind}" has none', reprlib.repr(value), remedy))
    return faults


def _missing(kind: str, table: Mapping[str, Any]) -> list[Fault]:
    """Faults of fields that a kind of motion needs."""
    if kind == TRAJECTORY:
        return [] if "file" in table else [Fault("motion.file", MISSING, "", 'add file = "run.csv"')]
    known, missing = fields_of(MOTIONS[kind]), list[Fault]()
    for field in dataclasses.fields(MOTIONS[kind]):
        key = KEYS.get(field.name, field.name)
        if field.default is dataclasses.MISSING and key not in table:
            quantity = known.get(key)
            remedy = f"add tables [[motion.{key}]]"
            if quantity is not None:
                remedy = f'add {key} = "… {quantity.shown_in}"'
            missing.append(Fault(f"motion.{key}", MISSING, "", remedy))
    return missing


def _segments(reader: Reader, tables: list[Any]) -> tuple[Segment, ...]:
    segments: list[Segment] = []
    for number, table in enumerate(tables, start=1):
        where, part = f"motion.segment {number}", reader.part()
        values: dict[str, Any] = read_table(where, duty_sections()["segment"], table, reader.faults)
        made = None
        if not part.is_faulty:
            made = _made(reader, where, functools.partial(Segment, **values))
        segments += [] if made is None else [made]
    return tuple(segments)


def _made(reader: Reader, where: str, make: Callable[[], Any]) -> Any:
    """Return what ``make`` returns; its faults are those of a place in the file."""

    def place_of(field: str) -> str:
        section, _, name = field.partition(".")
        return f"{where}.{name}" if section in ("motion", "segment") and where != section else field

    return reader.made(make, place_of)


def _motor(reader: Reader) -> Motor | None:
    part = reader.part()
    values: dict[str, Any] = reader.values_of("motor")
    if "curve" in values:
        values["curve"] = _curve(reader, values["curve"])
    return _made(reader, "motor", functools.partial(Motor, **values)) if not part.is_faulty else None


def _surroundings(reader: Reader) -> Surroundings | None:
    part = reader.part()
    values: dict[str, Any] = reader.values_of("surroundings")
    if part.is_faulty:
        return None
    return _made(reader, "surroundings", functools.partial(Surroundings, **values))


def _curve(reader: Reader, points: list[Any]) -> tuple[tuple[float, float], ...]:
    pairs: list[tuple[float, float]] = []
    for number, point in enumerate(points, start=1):
        part = f"point {number}"
        if not isinstance(point, list) or len(point) != len(POINT):
            remedy = 'write curve = [["0 rpm", "7 N m"], ["3000 rpm", "5 N m"]]'
            problem = "is not a speed and a torque"
            reader.refuse("motor.curve", problem, reprlib.repr(point), remedy, part=part)
            continue
        numbers = [units.parse("motor.curve", raw, quantity) for raw, quantity in zip(point, POINT, strict=True)]
        wrong = [dataclasses.replace(number, part=part) for number in numbers if isinstance(number, Fault)]
        reader.faults += wrong
        if not wrong:
            speed, torque = (float(number) for number in numbers if not isinstance(number, Fault))
            pairs.append((speed, torque))
    return tuple(pairs)


def inputs(
    axis: Axis | None, motion: Motion | None, motor: Motor | None, surroundings: Surroundings | None
) -> dict[str, Any]:
    """Axis, motion, motor and surroundings in SI, by section, as far as a case has them."""
    values: dict[str, Any] = {}
    if axis is not None:
        values["axis"] = {**_numbers(axis), "brake_holds": axis.brake_holds}
    if motion is not None:
        kind = next((name for name, cls in MOTIONS.items() if type(motion) is cls), TRAJECTORY)
        values["motion"] = {"kind": kind, **_of_motion(motion)}
    if motor is not None:
        values["motor"] = {**_numbers(motor), "curve": [list(point) for point in motor.curve]}
    if surroundings is not None:
        bracing = {"bracing": surroundings.bracing} if surroundings.bracing else {}
        values["surroundings"] = {**_numbers(surroundings), **bracing}
    return values


def _of_motion(motion: Any) -> dict[str, Any]:
    if isinstance(motion, Trajectory):
        return {"file": motion.source, "samples": int(np.size(motion.time))}
    numbers = _numbers(motion)
    if hasattr(motion, "returns"):
        numbers["return"] = motion.returns
    if hasattr(motion, "segments"):
        numbers["segment"] = [{**({"name": s.name} if s.name else {}), **_numbers(s)} for s in motion.segments]
    return numbers


def _numbers(part: Any) -> dict[str, Any]:
    return {name: value for name in fields_of(type(part)) if (value := getattr(part, name)) is not None}

"""The export: the files of a target, their range, their worst error against the model, and what warns of them.

Text about an export, beside its files and at their head: inputs and outputs, ranges, worst error, sources.
"""

from __future__ import annotations

import contextlib
import dataclasses
import importlib
import re
from collections.abc import Callable, Mapping, Sequence
from importlib import resources
from pathlib import Path, PurePosixPath
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis import units
from ballscrew.basis.atomic_files import atomic_write, check_writable
from ballscrew.basis.errors import Fault, InputError, closest
from ballscrew.basis.quantities import Quantity
from ballscrew.basis.records import Record
from ballscrew.cases.case_files.case import Case
from ballscrew.exports.subject import TEMPERATURE, HandOver
from ballscrew.physics.components.materials import OF_A_GRADE
from ballscrew.physics.friction.validity import NUT_REASONS

#: Values at points by name.
Values = Mapping[str, NDArray[Any]]


class Option(NamedTuple):
    """A choice that a target has: its usual value (and type), its meaning, its quantity if it has a unit."""

    default: Any
    meaning: str
    quantity: Quantity | None = None
    #: What to give instead of a number that is not positive, where it must be.
    positive: str = ""


class Target(NamedTuple):
    """A target as its module has it, under its name in capitals: its export, its choices, those that a case gives."""

    export: Callable[[HandOver], Export]
    options: Mapping[str, Option] = {}
    options_of_case: Callable[[Case], Mapping[str, Any]] = lambda _: {}


def warning(name: str, subject: str, text: str, **numbers: Any) -> Record:
    """A warning of an export, ``hand_over.`` and a name; ``numbers`` are further fields of the record."""
    fields: dict[str, Any] = {"severity": "warning", "holds": False, **numbers}
    return Record(f"hand_over.{name}", subject, text, **fields)


def refusal(name: str, problem: str, given: str = "", remedy: str = "") -> InputError:
    """The error of a hand-over that cannot be made: in which argument, its problem, what was given, what to do."""
    return InputError(Fault(f"hand_over.{name}", problem, given, remedy))


def data(name: str) -> bytes:
    """A file of the package that exports are made of."""
    return resources.files("ballscrew").joinpath("data", "exports", *name.split("/")).read_bytes()


def filled(name: str, **values: Any) -> str:
    """A file of the package with values in place of ``@NAME@``; numbers have all their digits."""
    words = {key.upper(): value if isinstance(value, str) else repr(value) for key, value in values.items()}
    return re.sub(r"@([A-Z_]+)@", lambda match: words[match[1]], data(name).decode())


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Export:
    """A model handed over: its files, their range, their worst error against the model, and what to know of them."""

    #: The name of the target, ``c``.
    target: str
    #: The content of each file by its name; a name may have folders, ``models/screw.xml``.
    files: Mapping[str, bytes]
    #: The least and the greatest value of each input, in SI. Beyond them the nearest value counts, and ``valid`` is 0.
    valid_range: Mapping[str, tuple[float, float]]
    #: The worst error of each output over the range, measured when this was made.
    worst_error: tuple[WorstError, ...]
    #: The range over which the error was measured.
    measured_range: Mapping[str, tuple[float, float]] = dataclasses.field(
        default_factory=dict[str, tuple[float, float]]
    )
    #: Warnings of the model and of the target.
    warnings: tuple[Record, ...] = ()
    #: Version, model, sources, and all inputs with their values.
    provenance: Mapping[str, Any] = dataclasses.field(default_factory=dict[str, Any])
    #: The quantity of each input.
    quantities: Mapping[str, Quantity] = dataclasses.field(default_factory=dict[str, Quantity])

    @classmethod
    def of(
        cls,
        job: HandOver,
        target: str,
        files: Mapping[str, str | bytes],
        worst_error: Sequence[WorstError],
        *,
        valid_range: Mapping[str, tuple[float, float]] | None = None,
        measured_range: Mapping[str, tuple[float, float]] | None = None,
        warnings: Sequence[Record] = (),
    ) -> Export:
        """An export of the model of a ``job``, with its provenance and the warnings that every target has.

        ``target``, ``files`` and ``worst_error`` are the fields of these names; ``valid_range`` is that of the model
        unless given, ``measured_range`` the working range; ``warnings`` are further ones.
        """
        return cls(
            target=target,
            files={name: text.encode() if isinstance(text, str) else text for name, text in files.items()},
            valid_range=job.formula_range if valid_range is None else valid_range,
            worst_error=tuple(worst_error),
            measured_range=job.working_range if measured_range is None else measured_range,
            warnings=(*_warnings(job), *warnings),
            provenance=job.provenance,
            quantities={entry.name: entry.quantity for entry in job.inputs},
        )

    def write(self, directory: str | Path) -> list[Path]:
        """Write all files into the folder ``directory``, which is made where there is none; return their paths.

        All of them are written whole, or none. Raises
        :class:`~ballscrew.basis.errors.InputError` for a place that cannot be written.
        """
        places = {Path(directory) / PurePosixPath(name): content for name, content in self.files.items()}
        for path in places:
            check_writable("--out", path)
        with contextlib.ExitStack() as stack:  # at its end all files get their names
            for path, content in places.items():
                stack.enter_context(atomic_write("--out", path)).write_bytes(content)
        return list(places)


def _warnings(job: HandOver) -> list[Record]:
    """Starvation, and a warning where the temperature changes nothing."""
    if job.has_effect[TEMPERATURE]:
        return [*job.starvation]
    text = (
        "the oil is given by its numbers, so that the input temperature changes nothing; give a grade or a data sheet"
    )
    return [*job.starvation, warning("temperature", "temperature", text)]


@dataclasses.dataclass(frozen=True, slots=True, kw_only=True)
class WorstError:
    """The worst error of an output: the largest absolute one with its point, and the largest relative one.

    Of a truth value, such as ``valid``, the error is 1 where it differs.
    """

    output: str
    unit: str
    #: Largest absolute error; infinite where a number is missing that the model has.
    value: float
    #: Inputs of the point where it occurs, in SI.
    at: Mapping[str, float]
    #: Largest error of a point relative to the value of the model at it, zeros aside.
    relative: float
    #: Inputs of the point where that occurs.
    relative_at: Mapping[str, float]
    #: Largest absolute value of the model over the points.
    largest: float
    #: Number of points.
    points: int

    @property
    def of_largest(self) -> float:
        """Largest absolute error as a share of the largest value."""
        return self.value / self.largest if self.largest else (0.0 if self.value == 0 else np.inf)

    def document(self) -> dict[str, Any]:
        """The error as it stands in JSON."""
        return {**dataclasses.asdict(self), "of_largest": self.of_largest}


def worst_errors(
    job: HandOver,
    approximate: Callable[[Values], Values],
    *,
    points: Values | None = None,
    exact: Values | None = None,
    outputs: Sequence[str] | None = None,
) -> tuple[WorstError, ...]:
    """The worst error of each output of ``approximate``, a function of points by input, against the model.

    Points are those of :meth:`~ballscrew.exports.subject.HandOver.sample` unless given; ``exact`` is the model at them,
    where it is known already. Points where the model has no number are left out.
    """
    at = job.sample() if points is None else points
    true, approximated = job.evaluate(at) if exact is None else exact, approximate(at)
    names = [name for name in job.output_names if name in approximated] if outputs is None else outputs
    return tuple(_worst(name, job.units[name], true[name], approximated[name], at) for name in names)


def _worst(name: str, unit: str, exact: NDArray[Any], approximated: Any, at: Values) -> WorstError:
    true = np.asarray(exact, dtype=float)
    off = np.abs(np.asarray(approximated, dtype=float) - true)
    off = np.where(np.isfinite(true), np.where(np.isnan(off), np.inf, off), 0.0)
    size = np.where(np.isfinite(true), np.abs(true), 0.0)
    relative = np.divide(off, size, out=np.zeros_like(off), where=size > 0)
    first, other = int(np.argmax(off)), int(np.argmax(relative))
    place, other_place = ({n: float(np.broadcast_to(v, off.shape)[i]) for n, v in at.items()} for i in (first, other))
    return WorstError(
        output=name,
        unit=unit,
        value=float(off[first]),
        at=place,
        relative=float(relative[other]),
        relative_at=other_place,
        largest=float(np.max(size)),
        points=off.size,
    )


_FOLDER = __name__.rpartition(".")[0]


class Place(NamedTuple):
    """The module of a target, as ``room.module``, and a few words for people."""

    module: str
    meaning: str


TARGETS: Mapping[str, Place] = {
    "c": Place("programs.c99", "C99 source of the model, with libm only"),
    "table": Place("tables.table", "table over load and speed: CSV, JSON, NetCDF, Parquet"),
    "modelica": Place("tables.modelica", "Modelica component with the interfaces of its standard library"),
    "matlab": Place("tables.matlab", "table as .mat with a function, and a component of Simscape"),
    "linuxcnc": Place("tables.curves", "HAL file with the friction over speed, for lincurve"),
    "beckhoff": Place("tables.curves", "friction table of TwinCAT CNC and of ISG-kernel"),
    "drive": Place("tables.curves", "friction over speed as a few points, for the characteristic of a drive"),
    "program": Place("programs.interpreter", "the model as data, with an interpreter in C that is prebuilt for Linux"),
    "fmu": Place("programs.fmu", "FMU 2.0 or 3.0, co-simulation and model exchange"),
    "mujoco": Place("programs.joints", "joint parameters and an engine plugin for MuJoCo"),
    "urdf": Place("programs.joints", "friction of a joint in URDF, SDF and USD"),
}


#: Programs and formats that people ask for by name, and the target whose files they take.
_TAKEN_BY: Mapping[str, str] = {
    **dict.fromkeys(("simulink", "simscape", "octave", "mat"), "matlab"),
    **dict.fromkeys(("dymola", "openmodelica", "mo"), "modelica"),
    **dict.fromkeys(("csv", "json", "netcdf", "parquet", "excel", "xlsx", "lookup"), "table"),
    **dict.fromkeys(("twincat", "isg"), "beckhoff"),
    **dict.fromkeys(("sdf", "usd", "gazebo", "ros", "isaac"), "urdf"),
    **dict.fromkeys(("c99", "cpp", "c++"), "c"),
}


def target(name: str) -> Target:
    """A target by its name. Raises :class:`~ballscrew.basis.errors.InputError` for an unknown one."""
    if name not in TARGETS:
        remedy = f"known: {', '.join(TARGETS)}"
        if reads := _TAKEN_BY.get(str(name).casefold()):
            remedy = f'write "{reads}", whose files {name} takes; {remedy}'
        elif meant := closest(name, TARGETS):
            remedy = f'did you mean "{meant}"? {remedy}'
        raise refusal("to", "unknown target", str(name), remedy)
    return getattr(importlib.import_module(f".{TARGETS[name].module}", _FOLDER), name.upper())


def options_of(name: str) -> Mapping[str, Option]:
    """The choices that a target has, by name."""
    return target(name).options


_SIGNS = """\
Signs: axial_load > 0 is the load that a positive screw_speed lifts. screw_torque is the size of the friction;
drive_torque = ideal_torque + sign(screw_speed) * screw_torque is the torque on the shaft in motion. At rest friction
holds up to screw_torque either way: drive_torque is then the ideal one, and holding_torque what must hold the load,
for a positive load negative where the screw locks itself.
Beyond the range of an input its nearest value counts, and valid is 0. All numbers are in SI units.
"""


def readme(job: HandOver, kind: str, notes: str, errors: Sequence[WorstError] = ()) -> str:
    """The text of an export of some kind, with notes of its own."""
    subject, made_of = job.subject, job.provenance
    limits = job.formula_range
    inputs = [
        f"  {entry.name} [{entry.quantity.unit}]: {job.meanings[entry.name]}; usually {entry.value:.9g}, "
        f"{limits[entry.name][0]:.9g} to {limits[entry.name][1]:.9g}"
        for entry in job.inputs
    ]
    outputs = [f"  {name} [{job.units[name]}]: {job.meanings[name]}" for name in job.output_names]
    rows = [
        f"  {entry.output}: {entry.value:.2g}, relative {entry.relative:.2g}, at {entry.points} points"
        for entry in errors
    ]
    return "\n".join(
        [
            f"{kind} of the friction of a ball screw, model {subject.model.label}, {type(subject.nut).__name__}",
            f"Made by ballscrew {made_of['version']} (MIT licence).",
            "",
            "Inputs:",
            *inputs,
            "",
            "Outputs:",
            *outputs,
            "",
            _SIGNS,
            "valid is 0 beyond the range of an input, and where one of these is so:",
            *(f"  {reason}" for name, reason in NUT_REASONS.items() if name != "inputs"),
            "",
            notes,
            *(f"Beware: {record.text}.\n" for record in job.starvation),
            *(["Worst error against the model in Python:", *rows, ""] if rows else []),
            f"Sources of the model: {', '.join(made_of['references'])}",
            "",
            "All else is fixed at:",
            *_fixed(job, made_of["inputs"]),
            "",
        ]
    )


def _fixed(job: HandOver, values: Mapping[str, float]) -> list[str]:
    follows = set(OF_A_GRADE) if job.subject.lubricant.follows_temperature else set()
    return [
        f"  {name} = {float(value)!r}{' at the usual temperature' if name in follows else ''}"
        for name, value in values.items()
        if name not in job.input_names
    ]


#: What happens beyond the range, and at rest.
BEYOND = "Beyond the range the nearest value counts, and valid is 0."
AT_REST = (
    "At rest friction is a set: it holds any torque up to screw_torque either way. The torque on the shaft in motion "
    "is ideal_torque + sign(screw_speed) * screw_torque."
)
SIGNS = "A positive axial_load is one that a positive screw_speed lifts; screw_torque is the size of the friction."


def made_of(job: HandOver) -> list[str]:
    """Model, nut, version and sources."""
    made = job.provenance
    return [
        f"Friction of a ball screw: model {made['model']}, {made['nut']}, made by ballscrew {made['version']}.",
        f"Sources of the model: {', '.join(made['references'])}.",
    ]


def ranges(job: HandOver, ends: Mapping[str, tuple[float, float]]) -> list[str]:
    """The range of each input, in SI and as people write it."""
    quantities = {entry.name: entry.quantity for entry in job.inputs}
    lines: list[str] = []
    for name, (least, greatest) in ends.items():
        quantity = quantities[name]
        both = [units.shown(end, quantity, 6) for end in (least, greatest)]
        shown = both[0] if least == greatest else f"{both[0]} to {both[1]}"
        si = f"{least:.6g}" if least == greatest else f"{least:.6g} to {greatest:.6g}"
        lines.append(f"{name} [{quantity.unit}]: {si} ({shown})" + (", fixed" if least == greatest else ""))
    return lines


def table_lines(job: HandOver, ends: Mapping[str, tuple[float, float]], worst: Sequence[WorstError]) -> list[str]:
    """Lines about a table: what it is of, its range, its error, rest and beyond."""
    of_each = [
        f"  {error.output} [{error.unit}]: {error.value:.3g}, {100 * error.of_largest:.2g} % of its largest "
        f"{error.largest:.4g}"
        for error in worst
        if error.output != "valid"
    ]
    return [
        *made_of(job),
        SIGNS,
        AT_REST,
        "Range:",
        *(f"  {line}" for line in ranges(job, ends)),
        BEYOND,
        f"Worst error against the model over this range, at {worst[0].points} points, measured when it was made:",
        *of_each,
        *(f"Beware: {record.text}." for record in job.starvation),
    ]


def table_readme(job: HandOver, about: Sequence[str], of_files: str) -> str:
    """A README: what the files are, what is to be known of them, and all numbers that they are made of."""
    unit = {name: "" if quantity.unit == "1" else quantity.unit for name, (_, quantity) in job.subject.inputs.items()}
    values = [f"  {name} = {value:.9g} {unit[name]}".rstrip() for name, value in job.provenance["inputs"].items()]
    return "\n".join([of_files, *about, "Made of:", *values, ""])

"""The targets by name, each in a module of its own that is loaded when it is asked for.

A new target is a module of ``programs`` or ``tables`` with ``export(handed: HandOver) -> Export``, perhaps with its
choices as ``OPTIONS``, with what a case says of them as ``options_of_case(case)``, and a line here.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from ballscrew.basis.errors import Fault, InputError, closest
from ballscrew.basis.quantities import Quantity
from ballscrew.cases.case_files.case import Case
from ballscrew.exports.export import Export
from ballscrew.exports.subject import HandOver

_FOLDER = __name__.rpartition(".")[0]


class Target(NamedTuple):
    """A target: the module that makes its export, as ``room.module``, and a few words for people."""

    module: str
    meaning: str


class Option(NamedTuple):
    """A choice that a target has: its usual value (and type), its meaning, its quantity if it has a unit."""

    default: Any
    meaning: str
    quantity: Quantity | None = None


TARGETS: Mapping[str, Target] = {
    "c": Target("programs.c99", "C99 source of the model, with libm only"),
    "table": Target("tables.table", "table over load and speed: CSV, JSON, NetCDF, Parquet"),
    "modelica": Target("tables.modelica", "Modelica component with the interfaces of its standard library"),
    "matlab": Target("tables.matlab", "table as .mat with a function, and a component of Simscape"),
    "linuxcnc": Target("tables.linuxcnc", "HAL file with the friction over speed, for lincurve"),
    "beckhoff": Target("tables.beckhoff", "friction table of TwinCAT CNC and of ISG-kernel"),
    "drive": Target("tables.drive", "friction over speed as a few points, for the characteristic of a drive"),
    "program": Target("programs.program", "the model as data, with an interpreter in C that is prebuilt for Linux"),
    "fmu": Target("programs.fmu", "FMU 2.0 or 3.0, co-simulation and model exchange"),
    "mujoco": Target("programs.mujoco", "joint parameters and an engine plugin for MuJoCo"),
    "urdf": Target("programs.urdf", "friction of a joint in URDF, SDF and USD"),
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


def target_module(name: str) -> Any:
    """The module of a target. Raises :class:`~ballscrew.basis.errors.InputError` for an unknown one."""
    if name not in TARGETS:
        remedy = f"known: {', '.join(TARGETS)}"
        if reads := _TAKEN_BY.get(str(name).casefold()):
            remedy = f'write "{reads}", whose files {name} takes; {remedy}'
        elif meant := closest(name, TARGETS):
            remedy = f'did you mean "{meant}"? {remedy}'
        raise InputError(Fault("hand_over.to", "unknown target", str(name), remedy))
    return importlib.import_module(f".{TARGETS[name].module}", _FOLDER)


def export_of(name: str) -> Callable[[HandOver], Export]:
    """The function that makes the export of a target."""
    return target_module(name).export


def options_of(name: str) -> Mapping[str, Option]:
    """The choices that a target has, by name."""
    return getattr(target_module(name), "OPTIONS", {})


def options_of_case(name: str, case: Case) -> Mapping[str, Any]:
    """The choices of a target that follow from a case, where the target says so."""
    found = getattr(target_module(name), "options_of_case", None)
    return {} if found is None else found(case)

"""The targets by name, each in a module of its own that is loaded when it is asked for.

A new target is a module of this room with ``export(handed: HandOver) -> Export``, perhaps with its choices as
``OPTIONS``, with what a case says of them as ``options_of_case(case)``, and a line here.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from ballscrew.cases.case import Case
from ballscrew.errors import Fault, InputError, nearest
from ballscrew.exports.export import Export
from ballscrew.exports.subject import HandOver
from ballscrew.quantities import Quantity

_ROOM = __name__.rpartition(".")[0]


class Target(NamedTuple):
    """A target: the module that makes its export, of this room or ``.room.module``, and a few words for people."""

    module: str
    meaning: str


class Option(NamedTuple):
    """A choice that a target has: its usual value (and type), its meaning, its quantity if it has a unit."""

    default: Any
    meaning: str
    quantity: Quantity | None = None


TARGETS: Mapping[str, Target] = {
    "c": Target("c99", "C99 source of the model, with libm only"),
    "table": Target(".table_exports.table", "table over load and speed: CSV, JSON, NetCDF, Parquet"),
    "modelica": Target(".table_exports.modelica", "Modelica component with the interfaces of its standard library"),
    "matlab": Target(".table_exports.matlab", "table as .mat with a function, and a component of Simscape"),
    "linuxcnc": Target(".table_exports.linuxcnc", "HAL file with the friction over speed, for lincurve"),
    "beckhoff": Target(".table_exports.beckhoff", "friction table of TwinCAT CNC and of ISG-kernel"),
    "drive": Target(".table_exports.drive", "friction over speed as a few points, for the characteristic of a drive"),
    "program": Target("program", "the model as data, with an interpreter in C that is prebuilt for Linux"),
    "fmu": Target("fmu", "FMU 2.0 or 3.0, co-simulation and model exchange"),
    "mujoco": Target("mujoco", "joint parameters and an engine plugin for MuJoCo"),
    "urdf": Target("urdf", "friction of a joint in URDF, SDF and USD"),
}


def target_module(name: str) -> Any:
    """The module of a target. Raises :class:`~ballscrew.errors.InputError` for an unknown one."""
    if name not in TARGETS:
        remedy = nearest(name, TARGETS) + f" (known: {', '.join(TARGETS)})"
        raise InputError(Fault("hand_over.to", "unknown target", str(name), remedy))
    return importlib.import_module(f".{TARGETS[name].module}", _ROOM)


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

"""The targets by name, each in a module that is loaded when it is asked for.

A new target is a function of a job that returns an export, in a module of ``programs`` or ``tables`` that has it as a
:class:`~ballscrew.exports.export.Target` under its name in capitals, and a line here.
"""

from __future__ import annotations

import importlib
from collections.abc import Mapping
from typing import NamedTuple

from ballscrew.basis.errors import closest
from ballscrew.exports.export import Option, Target, refusal

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

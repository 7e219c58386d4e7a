"""Cases that the page starts from: the paper's screw, and the examples of axes that move."""

from __future__ import annotations

import functools
import tomllib
from collections.abc import Mapping
from importlib import resources
from typing import Any

from ballscrew.basis import units
from ballscrew.basis.quantities import fields_of
from ballscrew.cases.schema.case_schema import DEFAULT_MODEL
from ballscrew.evidence.papers.olaru2005 import case
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import BallScrew

#: Examples with a motion by the names of their files, which are those of the folder ``examples`` of the repository.
_MOVING: Mapping[str, str] = {
    "vertical_axis": "a vertical axis of 400 kg with its motor",
    "feed_axis": "a horizontal feed axis with its bearings and guides",
    "warm_up": "a feed screw that warms up over hours",
}


@functools.cache
def starts() -> dict[str, Any]:
    """Cases to start from, by name; those that move have a motion."""
    values: dict[str, Any] = {
        "paper": {"title": "the screw of Olaru et al. (2005)", "moves": False, "case": _paper()},
    }
    folder = resources.files("ballscrew").joinpath("data/starts")
    for name, title in _MOVING.items():
        tables = tomllib.loads(folder.joinpath(f"{name}.toml").read_text(encoding="utf-8"))
        values[name.replace("_", "-")] = {"title": title, "moves": True, "case": tables}
    return values


#: Cases to which logs belong, by the question: all of them are examples of the repository.
_LOGS: Mapping[str, tuple[str, ...]] = {
    "condition": ("service.toml", "nut_over_years.csv"), "fit": ("rig.toml", "rig_log.csv"),
    "service": ("service.toml", "nut_new.csv", "nut_worn.csv"),
}  # fmt: skip


#: The numbers that are fitted to them: the log of the rig has the friction of seals, which the balls do not explain.
_FREE: Mapping[str, tuple[str, ...]] = {"fit": ("friction.boundary_friction_coefficient", "constant_torque")}


def logs() -> dict[str, Any]:
    """Logs to try, which are synthetic, each with its case."""
    folder = resources.files("ballscrew").joinpath("data/logs")
    texts = {name: folder.joinpath(name).read_text(encoding="utf-8") for names in _LOGS.values() for name in names}
    return {
        question: {
            "file": case,
            "case": tomllib.loads(texts[case]),
            "logs": [{"name": name, "text": texts[name]} for name in names],
            "free": list(_FREE.get(question, ())),
        }
        for question, (case, *names) in _LOGS.items()
    }


def _paper() -> dict[str, Any]:
    """The paper's screw, oil and operating point as the tables of a case."""
    return {
        "screw": _written(case.SCREW, BallScrew),
        "lubricant": _written(case.OIL, Lubricant),
        "operation": {
            name: units.written(value, fields_of(OperatingState)[name])
            for name, value in (("axial_load", case.AXIAL_LOAD), ("screw_speed", case.SCREW_SPEED))
        },
        "model": {"name": DEFAULT_MODEL},
    }


def _written(part: Any, cls: type) -> dict[str, Any]:
    """The numbers of a part that have no default, or another value than that, as they are written in a file."""
    usual = {name: getattr(cls, name, None) for name in fields_of(cls)}
    values = {name: getattr(part, name) for name in fields_of(cls)}
    return {
        name: value if fields_of(cls)[name].unit == "1" else units.written(value, fields_of(cls)[name])
        for name, value in values.items()
        if value is not None and value != usual[name]
    }

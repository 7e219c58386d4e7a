"""Motion of a need by short names: a mass that goes there and back over the stroke, with an acceleration."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ballscrew.basis.errors import MISSING, Fault

#: Short names of an axis and its motion, and the places they stand for.
OF_MOTION: Mapping[str, str] = {
    "mass": "axis.mass",
    "inclination": "axis.inclination",
    "acceleration": "motion.acceleration",
    "dwell": "motion.dwell",
}
#: What a mass needs beside it, by place, with what to add.
_BESIDE: Mapping[str, str] = {
    "axis.mass": 'add mass = "400 kg", or write force and feed alone',
    "motion.acceleration": 'add acceleration = "3 m/s^2": with the mass it makes the load',
    "need.stroke": 'add stroke = "600 mm", the way of the mass',
    "need.feed": 'add feed = "15 m/min", the largest speed of the mass',
}
#: What takes the place of a load and a speed beside a mass.
_WITHOUT_RESTS = "motion: there and back over the stroke without rests, as no dwell was given"
_HORIZONTAL = "axis: horizontal, as no inclination was given"
_INSTEAD: Mapping[str, str] = {
    "axial_load": "leave it out: mass, inclination and acceleration make the load; a force at work is [motion] force",
    "screw_speed": "write the feed: each lead then has a speed of its own",
}


def with_motion(tables: dict[str, Any], faults: list[Fault]) -> list[str]:
    """Make ``[motion]`` a trapezoid of stroke, feed and acceleration where it has no kind; return what was assumed.

    The feed moves from ``[need]`` to the motion; what is missing, and a force or a screw speed beside it, are faults.
    """
    axis, motion = tables.setdefault("axis", {}), tables.setdefault("motion", {})
    if not isinstance(axis, dict) or not isinstance(motion, dict) or "kind" in motion:
        return []
    missing = [Fault(place, MISSING, "", _BESIDE[place]) for place in _BESIDE if _at(tables, place) is None]
    operation = tables.get("operation", {})
    wrong = [
        Fault(f"operation.{name}", "is given beside a mass", str(operation[name]), _INSTEAD[name])
        for name in _INSTEAD
        if operation.get(name) is not None
    ]
    if missing or wrong:
        faults += [*missing, *wrong]
        tables["need"].pop("feed", None)  # it is no second fault
        return []
    motion |= {"kind": "trapezoid", "stroke": tables["need"]["stroke"], "speed": tables["need"].pop("feed")}
    return [
        *([] if "dwell" in motion else [_WITHOUT_RESTS]),
        *([] if "inclination" in axis else [_HORIZONTAL]),
    ]


def _at(tables: Mapping[str, Any], place: str) -> Any:
    section, _, name = place.partition(".")
    table = tables.get(section)
    return table.get(name) if isinstance(table, dict) else None

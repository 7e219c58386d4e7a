"""Options of the command line that set fields of a case; faults of such fields name the option."""

from __future__ import annotations

import dataclasses
from collections.abc import Collection, Iterable, Mapping

from ballscrew.basis.errors import MISSING, Fault, message_of
from ballscrew.basis.records import Message, Setting, Value

#: The options by the field that they set.
OPTIONS: Mapping[str, str] = {
    "operation.axial_load": "--axial-load",
    "operation.screw_speed": "--speed",
    "nut.type": "--nut",
    "nut.preload": "--preload",
    "installation.unsupported_length": "--length",
    "installation.ends": "--ends",
    "lubricant.grade": "--grade",
    "lubricant.temperature": "--temperature",
    "model.calibration": "--calibration",
    "model.name": "--model",
}


def in_options(faults: Iterable[Fault], given: Collection[str]) -> list[Fault]:
    """Faults of fields that options gave, or that are missing beside such, with options in place of fields."""
    sections = {place.partition(".")[0] for place in given}
    return [_in_options(fault, given, sections) for fault in faults]


def _in_options(fault: Fault, given: Collection[str], sections: Collection[str]) -> Fault:
    option, section = OPTIONS.get(fault.where), fault.where.partition(".")[0]
    if option is None or not (fault.where in given or (fault.problem == MISSING and section in sections)):
        return fault

    remedy = message_of(fault.remedy).changed(_option_of)
    options = {field: f"{name} " for field, name in OPTIONS.items()}
    return dataclasses.replace(fault, where=option, remedy=Message(remedy.template, {**options, **remedy.values}))


def _option_of(value: Value) -> Value:
    return f"{OPTIONS[value.path]} " if isinstance(value, Setting) and value.path in OPTIONS else value

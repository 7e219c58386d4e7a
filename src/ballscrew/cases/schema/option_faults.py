"""Options of the command line that set fields of a case; faults of such fields name the option."""

from __future__ import annotations

import dataclasses
from collections.abc import Collection, Iterable, Mapping

from ballscrew.basis.errors import MISSING, Fault, to_set

#: The options that each command with a case has, by the field that they set.
OPTIONS: Mapping[str, str] = {"model.calibration": "--calibration", "model.name": "--model"}


def in_options(faults: Iterable[Fault], given: Collection[str], options: Mapping[str, str] = OPTIONS) -> list[Fault]:
    """Faults of fields that options gave, or that are missing beside such, with options in place of fields."""
    sections = {place.partition(".")[0] for place in given}
    return [_in_options(fault, given, sections, options) for fault in faults]


def _in_options(fault: Fault, given: Collection[str], sections: Collection[str], options: Mapping[str, str]) -> Fault:
    option, section = options.get(fault.where), fault.where.partition(".")[0]
    if option is None or not (fault.where in given or (fault.problem == MISSING and section in sections)):
        return fault
    remedy = fault.remedy
    for field, name in options.items():
        if field.partition(".")[0] == section:
            remedy = remedy.replace(to_set(field), f"{name} ")
    return dataclasses.replace(fault, where=option, remedy=remedy)

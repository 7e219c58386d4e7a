"""The reader of a case: its tables in SI, validated once, and the faults that are found in them.

Faults of a field that an option of the command line sets name the option.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Collection, Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

from ballscrew.basis.errors import MISSING, Fault, InputError, to_set
from ballscrew.cases.schema.case_schema import NUT_TABLES, validated
from ballscrew.cases.schema.duty_schema import DUTY_TABLES, SUPPORT_TABLES
from ballscrew.physics.sizing.catalogue import CatalogueRow

T = TypeVar("T")

#: The sections with a schema, in the order of messages.
_VALIDATED = ("screw", "lubricant", "operation", "model", *NUT_TABLES, *DUTY_TABLES, *SUPPORT_TABLES)


class Part(NamedTuple):
    """A part of a case that is read."""

    faults: list[Fault]
    #: The number of faults before it.
    before: int

    @property
    def is_faulty(self) -> bool:
        """True where faults were found since the part began."""
        return len(self.faults) > self.before


@dataclasses.dataclass
class Reader:
    """The tables of a case as they are written and in SI, and the faults that were found so far.

    Parts of a case are built by functions that take the reader and add to its faults; they return None where a fault
    leaves nothing to build.
    """

    tables: Mapping[str, Any]
    #: Where the files are that the case names.
    folder: Path = Path()
    #: The catalogue rows in place of those of files.
    rows: Mapping[str, CatalogueRow] | None = None
    faults: list[Fault] = dataclasses.field(default_factory=list)

    def __post_init__(self) -> None:
        self._values: dict[str, dict[str, Any]] = {}
        self._errors: dict[str, list[Fault]] = {}
        for name in _VALIDATED:
            if name in self.tables or name == "model":  # which may be left out
                self._errors[name] = []
                self._values[name] = validated(name, self.tables.get(name, {}), self._errors[name])

    def __contains__(self, name: str) -> bool:
        return name in self.tables

    def values_of(self, name: str) -> dict[str, Any]:
        """A copy of the values of a section in SI; the errors in it are faults from now on."""
        self.faults += self._errors[name]
        return dict(self._values[name])

    def part(self) -> Part:
        """A part of the case that begins to be read."""
        return Part(self.faults, len(self.faults))

    def refuse(self, where: str, problem: str, given: str = "", remedy: str = "", *, part: str = "") -> None:
        """Add a fault of a field."""
        self.faults.append(Fault(where, problem, given, remedy, part=part))

    def made(self, make: Callable[[], T], place_of: Callable[[str], str]) -> T | None:
        """Return what ``make`` returns; its faults are of the place in the file that ``place_of`` gives for each."""
        try:
            return make()
        except InputError as error:
            self.faults += [dataclasses.replace(fault, where=place_of(fault.where)) for fault in error.faults]
            return None


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

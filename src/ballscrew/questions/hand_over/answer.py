"""``ballscrew hand-over --json``: the document of an export; all in SI."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from pathlib import Path, PurePath
from typing import Any, NamedTuple

from ballscrew.basis import units
from ballscrew.basis.output.text import wrapped
from ballscrew.cases.case_files.case import Case
from ballscrew.exports.export import TARGETS, Export, Option, WorstError, options_of
from ballscrew.questions.shared import declared
from ballscrew.questions.shared.declared import envelope, from_attributes, parts_like


@dataclasses.dataclass(frozen=True, eq=False)
class HandOverResults(parts_like(Export, "target", "files", "valid_range", "measured_range", "worst_error")):
    """The files of an export, their range and their worst error."""

    #: The files that were written.
    files: Sequence[str]
    #: The worst error of each output over the range.
    worst_error: Mapping[str, WorstError]


def document(export: Export, case: Case, written: Sequence[PurePath]) -> dict[str, Any]:
    """The document of an export that was written."""
    errors = {error.output: error for error in export.worst_error}
    results = from_attributes(HandOverResults, export, files=list(map(str, written)), worst_error=errors)
    units = {name: error.unit for name, error in errors.items()}
    whole = envelope(case, results, units=units, warnings=[*case.implausible(), *export.warnings])
    return {**whole, "provenance": dict(export.provenance)}


class Choice(NamedTuple):
    """A choice that a target has."""

    name: str
    default: str
    meaning: str


class Target(NamedTuple):
    """A target of a hand-over."""

    name: str
    meaning: str
    options: Sequence[Choice]


class Targets(NamedTuple):
    """The targets of a hand-over."""

    targets: Sequence[Target]


def targets() -> dict[str, Any]:
    """The targets, and the choices that each has."""
    choices = {
        name: [Choice(choice, _written(option), option.meaning) for choice, option in options_of(name).items()]
        for name in TARGETS
    }
    return declared.document(Targets([Target(name, TARGETS[name].meaning, each) for name, each in choices.items()]))


def _written(option: Option) -> str:
    """The usual value of a choice as it is written; empty where the case gives it."""
    value = option.default
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float) and not math.isfinite(value):
        return ""
    return str(value) if option.quantity is None else units.shown(value, option.quantity)


def text(export: Export, written: Sequence[Path]) -> str:
    """The files, the range, the worst error of each output, and the warnings."""
    return "\n".join(map(wrapped, [*(f"{path}" for path in written), *lines(export)]))


def lines(export: Export) -> list[str]:
    """The range, the worst error of each output, and the warnings, one line each."""
    names: list[str] = []
    for heading, entries in blocks(export):
        names += [heading, *(f"  {entry}" for entry in entries)]
    return [*names, *(f"warning: {record.text}" for record in export.warnings)]


def blocks(export: Export) -> list[tuple[str, list[str]]]:
    """Headings and what stands below them: the range of each input, and the worst error of each output."""
    ranges = [_ends(name, ends, export) for name, ends in export.valid_range.items()]
    pairs = [("range, beyond which the nearest value counts and valid is 0:", ranges)]
    if export.worst_error:
        over = "; ".join(_of_range(name, ends, export) for name, ends in export.measured_range.items())
        heading = f"worst error against the model at random points, {over}:"
        pairs.append((heading, [_error(one) for one in export.worst_error]))
    return pairs


def _ends(name: str, ends: tuple[float, float], export: Export) -> str:
    least, greatest = (units.shown(end, export.quantities[name]) for end in ends)
    if ends[0] == ends[1]:
        return f"{name}: {least}"
    return f"{name}: {least} to {greatest}"


def _of_range(name: str, ends: tuple[float, float], export: Export) -> str:
    least, greatest = (units.shown(end, export.quantities[name]) for end in ends)
    if ends[0] == ends[1]:
        return f"{name} {least}"
    return f"{name} {least} to {greatest}"


def _error(one: WorstError) -> str:
    if one.output == "valid":
        differs = "the same at all" if one.value == 0 else "differs at some of"
        return f"valid: {differs} {one.points} points"
    written = f"{one.value:.2g}" + ("" if one.unit == "1" else f" {one.unit}")
    return f"{one.output}: {written}, relative {one.relative:.2g}, of its largest value {one.of_largest:.2g}"

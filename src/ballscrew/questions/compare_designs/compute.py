"""Designs side by side: the cases of several files, or of a project, each run and checked."""

from __future__ import annotations

import copy
import dataclasses
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.version import __version__
from ballscrew.cases.case_files import case_file, project
from ballscrew.questions.check.compute import Checked, checked, with_nut_named
from ballscrew.questions.check.document import list_document


@dataclasses.dataclass(frozen=True, eq=False)
class SideBySide:
    """Designs with what the model and all checks say of them, in the order that they were given."""

    designs: Sequence[Checked]
    #: Whether each stands at its own load and speed, and not at those of the first one.
    own: bool


def is_one_case(paths: Sequence[Path]) -> bool:
    """Test whether there is nothing to stand beside: one path of one design. Raises ``InputError``."""
    return len(paths) == 1 and len(project.read(paths[0])) == 1


def side_by_side(
    paths: Sequence[str | Path],
    *,
    own: bool = False,
    settings: Sequence[str] = (),
    model: str | None = None,
    calibration: str | None = None,
    allow_code: bool = False,
) -> SideBySide:
    """The designs of case files and projects, at the load and speed of the first one, or each at its own.

    A design is called as its project calls it, or as its file. Raises :class:`~ballscrew.basis.errors.InputError` with
    the name of the design that is at fault.
    """
    values = [(design, Path(path).parent) for path in paths for design in project.read(path)]
    names = [design.name for design, _ in values]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise InputError(Fault("compare", "two designs of one name", twice, "name the files, or the designs, apart"))
    tables = [case_file.override(copy.deepcopy(dict(design.tables)), settings) for design, _ in values]
    operation = tables[0].get("operation")
    checks: list[Checked] = []
    for (design, folder), each in zip(values, tables, strict=True):
        at = each if own or operation is None else {**each, "operation": operation}
        checks.append(_checked(design.name, at, folder, model, calibration, allow_code))
    return SideBySide(checks, own)


def _checked(
    name: str, tables: dict[str, Any], folder: Path, model: str | None, calibration: str | None, allow_code: bool
) -> Checked:
    try:
        made, notes = with_nut_named(tables, folder)
        case = case_file.build(made, model, folder, calibration=calibration, allow_code=allow_code)
        return checked(name, case, notes)
    except InputError as error:
        faults = [dataclasses.replace(fault, where=f"{name}: {fault.where}") for fault in error.faults]
        raise InputError(*faults) from None


#: Results whose change against the first design is stated.
COMPARED = ("screw_torque", "drive_torque", "efficiency", "back_driving_efficiency", "friction_power")


def document(result: SideBySide) -> dict[str, Any]:
    """All designs in SI, each as ``ballscrew check --json`` has it; a change is a share of the value of the first."""
    first = result.designs[0]
    return {
        "at": "own" if result.own else "first",
        "designs": [
            {**whole, "change": {name: change_of(name, one, first) for name in COMPARED}}
            for whole, one in zip(list_document(result.designs), result.designs, strict=True)
        ],
        "provenance": {"version": __version__},
    }


def change_of(name: str, one: Checked, first: Checked) -> float | None:
    """The change of a result against that of the first design; None where their signs make it meaningless."""
    value, start = (float(getattr(each.run.friction, name)) for each in (one, first))
    return value / start - 1 if value > 0 and start > 0 else None

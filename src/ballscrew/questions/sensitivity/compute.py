"""The sensitivity of a case: how much of the uncertainty of a result each uncertain input explains."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from typing import cast

from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.quantities import Quantity, fields_of
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.uncertain_inputs import NOTHING_GIVEN, Uncertain, all_of
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty import sensitivity as analysis
from ballscrew.engine.uncertainty.sensitivity import ANOTHER_METHOD, Method, Sensitivity
from ballscrew.physics.components.materials import TEMPERATURE
from ballscrew.physics.components.screw import MATERIALS
from ballscrew.questions.sensitivity.options import SensitivityOptions


@dataclasses.dataclass(frozen=True, eq=False)
class SensitivityReport:
    """The sensitivity of a case, its uncertain inputs, and the part and quantity of each input."""

    result: Sensitivity
    uncertain: Mapping[str, Uncertain]
    known: Mapping[str, tuple[str, Quantity]]

    def describe(self, name: str) -> str:
        """The meaning of an input, short enough for a table."""
        law, _, field = name.rpartition(".")
        if law in MATERIALS:
            return f"{law} {field}".replace("_", " ")
        # "decay" and "share of load" alone say little
        if name == TEMPERATURE.name or field == "share_of_load" or (law and "_" not in field):
            return self.known[name][1].info.meaning
        return field.replace("_", " ")


def sensitivity(
    case: case_file.Case, options: SensitivityOptions, done: Callable[[int, int], None] | None = None
) -> SensitivityReport:
    """Sensitivity of a case. Raises ``InputError`` that names options of the command line."""
    uncertain = all_of(case, options.only_given)
    if not uncertain:
        raise InputError(NOTHING_GIVEN)
    point = {name: getattr(case.operation, name) for name in fields_of(case.operation)}
    try:
        result = analysis.sensitivity(
            case.model,
            case.screw,
            case.lubricant,
            distributions={name: u.distribution for name, u in uncertain.items()},
            output=options.output.replace(".", "_"),
            method=cast("Method", options.method),
            samples=options.samples,
            seed=options.seed,
            done=done,
            **point,
        )
    except InputError as error:
        raise InputError(*(_of_command_line(fault) for fault in error.faults)) from None
    known = Configuration(case.model, case.screw, case.lubricant).inputs
    return SensitivityReport(result, uncertain, known)


def _of_command_line(fault: Fault) -> Fault:
    """The fault of an argument, as one of the option that gives it."""
    section, _, name = fault.where.partition(".")
    where = f"--{name}" if section == "sensitivity" and "." not in name else fault.where
    remedy = "add --method sobol or --method morris" if fault.remedy == ANOTHER_METHOD else fault.remedy
    return dataclasses.replace(fault, where=where, remedy=remedy)

"""The condition of a case's nut over time: from a table of torques, or from logs of which each is a test."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.uncertain_inputs import all_of, joint_of
from ballscrew.evidence.service.condition import BASELINE, FALSE_ALARMS, condition
from ballscrew.evidence.service.condition_values import Condition
from ballscrew.files.torque_logs import reading, torque_series
from ballscrew.files.torque_logs.log_rows import Kind
from ballscrew.questions.service.compute import distributions

#: Options of the command line by the fields in which a condition finds faults.
_OPTIONS: Mapping[str, str] = {
    "condition.tolerance": "--tolerance", "condition.baseline": "--baseline", "condition.screw_speed": "--speed",
    "condition.false_alarms": "--false-alarms", "condition.reference_temperature": "--at",
    "lubricant.temperature": "--at",
}  # fmt: skip


@dataclasses.dataclass(frozen=True, kw_only=True)
class Options:
    """Settings of a condition; numbers in SI."""

    columns: Mapping[str, str] = dataclasses.field(default_factory=dict[str, str])
    #: Speed of the tests of a table without speeds; that of the case is of another motion.
    speed: float | None = None
    reference_temperature: float | None = None
    baseline: int = BASELINE
    false_alarms: float = FALSE_ALARMS
    tolerance: float = 0.1
    kind: Kind = "unknown"
    inertia: float | None = None
    torque_constant: float | None = None
    keep_going: bool = False


def of_files(
    case: Case, paths: Sequence[Path], options: Options, done: Callable[[int, int], None] | None = None
) -> Condition:
    """The condition from the table in one file, or from logs in several, in their order."""
    tests: Any
    if len(paths) == 1:
        tests = torque_series.read(paths[0], options.columns, options.keep_going)
        speed = _speed(tests, options)
    else:
        tests = [
            reading.read(
                path, options.columns, torque_constant=options.torque_constant, lead=float(case.screw.lead),
                keep_going=options.keep_going, done=done,
            )
            for path in paths
        ]  # fmt: skip
        speed = None
    try:
        found = condition(
            case.model, case.screw, case.lubricant, tests,
            screw_speed=speed, baseline=options.baseline, false_alarms=options.false_alarms,
            tolerance=options.tolerance, reference_temperature=options.reference_temperature,
            uncertain=distributions(case), joint=joint_of(case, all_of(case)), kind=options.kind,
            inertia=options.inertia,
        )  # fmt: skip
    except InputError as error:
        raise InputError(*(_with_option(fault) for fault in error.faults)) from None
    records = (*units.in_display_units_of(found.warning_records), *case.implausible())
    return dataclasses.replace(found, warning_records=records)


def _speed(series: torque_series.TorqueSeries, options: Options) -> float | None:
    """The speed of tests that have none in the table; without one the condition refuses them."""
    if options.speed is not None and series.screw_speed is not None and np.isfinite(series.screw_speed).all():
        raise InputError(Fault("--speed", "is given beside a column of speeds", "", "leave one of them out"))
    return options.speed


def _with_option(fault: Fault) -> Fault:
    """The fault, with the option of the command line that it is in."""
    return dataclasses.replace(fault, where=_OPTIONS.get(fault.where, fault.where))

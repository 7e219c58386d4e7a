"""The condition of a case's nut over time: from a table of torques, or from logs of which each is a test."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError, fault_of, raise_if_any
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.uncertain_inputs import all_of, joint_of
from ballscrew.evidence.service.condition import condition
from ballscrew.evidence.service.condition_values import Condition
from ballscrew.files.torque_logs import reading, torque_series
from ballscrew.physics.components.materials import TEMPERATURE
from ballscrew.questions.condition.options import ConditionOptions
from ballscrew.questions.service.compute import distributions
from ballscrew.questions.shared.options import options_of

#: Flags of the command line by the fields in which a condition finds faults.
_FLAGS: Mapping[str, str] = {
    **{f"condition.{name}": option.flag for name, option in options_of(ConditionOptions).items()},
    "condition.screw_speed": "--speed",
    "lubricant.temperature": "--at",
}


def check_kind(count: int, written: Mapping[str, Any]) -> None:
    """Refuse options of logs beside a table, which is ``count`` 1, and of a table beside several logs.

    ``written`` has the options as they were written. Raises :class:`~ballscrew.basis.errors.InputError`.
    """
    if count > 1:
        names, problem, remedy = ["speed"], "is for a table", "leave it out: logs have their speeds"
    else:
        names, problem = ["kind", "inertia", "torque_constant"], "is for logs"
        remedy = "leave it out: a table has mean friction torques"
    flags = options_of(ConditionOptions)
    raise_if_any(
        [Fault(flags[name].flag, problem, written[name], remedy) for name in names if written[name] is not None]
    )


def of_files(
    case: Case, paths: Sequence[Path], options: ConditionOptions, done: Callable[[int, int], None] | None = None
) -> Condition:
    """The condition from the table in one file, or from logs in several, in their order."""
    _check_temperature(options.reference_temperature)
    tests: Any
    if len(paths) == 1:
        tests = torque_series.read(paths[0], options.columns, options.keep_going)
        speed = _speed(tests, options)
    else:
        tests = [
            reading.read(
                path,
                options.columns,
                torque_constant=options.torque_constant,
                lead=float(case.screw.lead),
                keep_going=options.keep_going,
                done=done,
            )
            for path in paths
        ]
        speed = None
    try:
        found = condition(
            case.model,
            case.screw,
            case.lubricant,
            tests,
            screw_speed=speed,
            baseline=options.baseline,
            false_alarms=options.false_alarms,
            tolerance=options.tolerance,
            reference_temperature=options.reference_temperature,
            distributions=distributions(case),
            joint=joint_of(case, all_of(case)),
            kind=options.kind,
            inertia=options.inertia,
        )
    except InputError as error:
        raise InputError(*(_with_option(fault) for fault in error.faults)) from None
    records = (*found.warning_records, *case.implausible())
    return dataclasses.replace(found, warning_records=records)


def _speed(series: torque_series.TorqueSeries, options: ConditionOptions) -> float | None:
    """The speed of tests that have none in the table; without one the condition refuses them."""
    if options.speed is not None and series.screw_speed is not None and np.isfinite(series.screw_speed).all():
        raise InputError(Fault("--speed", "is given beside a column of speeds", "", "leave one of them out"))
    return options.speed


def _check_temperature(temperature: float | None) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` for a temperature that no oil has a viscosity at."""
    if temperature is not None:
        fault = fault_of("lubricant", TEMPERATURE, temperature, units.shown(temperature, TEMPERATURE))
        if fault is not None:
            raise InputError(_with_option(fault))


def _with_option(fault: Fault) -> Fault:
    """The fault, with the option of the command line that it is in."""
    return dataclasses.replace(fault, where=_FLAGS.get(fault.where, fault.where))

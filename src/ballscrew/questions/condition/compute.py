"""The condition of a case's nut over time: from a table of torques, or from logs of which each is a test."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any, Literal, NamedTuple

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError, fault_of, raise_if_any
from ballscrew.basis.quantities import Info, Unit
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.uncertain_inputs import all_of, joint_of
from ballscrew.engine.uncertainty.sobol import Estimate
from ballscrew.evidence.service.condition import condition
from ballscrew.evidence.service.condition_parts import Part
from ballscrew.evidence.service.condition_values import Condition, State
from ballscrew.files.torque_logs import reading, torque_series
from ballscrew.physics.components.materials import TEMPERATURE
from ballscrew.questions.condition.options import ConditionOptions
from ballscrew.questions.service.compute import distributions
from ballscrew.questions.shared.declared import FINITE, from_attributes, parts_like
from ballscrew.questions.shared.envelope import envelope
from ballscrew.questions.shared.option_values import faults_named, flags_of, with_flag
from ballscrew.questions.shared.options import options_of

#: Flags of the command line by the fields in which a condition finds faults.
_FLAGS: Mapping[str, str] = {
    **flags_of("condition", ConditionOptions),
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
    with faults_named(_FLAGS):
        result = condition(
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
    records = (*result.warning_records, *case.implausible())
    return dataclasses.replace(result, warning_records=records)


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
            raise InputError(with_flag(fault, _FLAGS))


@dataclasses.dataclass(frozen=True, eq=False)
class TestState(parts_like(State, "label", "time", "temperature")):
    """The state of an axis in one test."""

    torque: Annotated[Estimate, Unit("N m"), Info("", "friction torque, reduced to one temperature and one speed")]
    #: Over that of the first tests.
    preload: Estimate
    #: Sum of the torque's changes downward, in standard deviations; null in the baseline.
    fall: float
    #: The same upward.
    rise: float
    #: Of both sums.
    limit: float
    #: Causes beside each other, for tests of several speeds.
    parts: Mapping[str, Part]


class TrendOfPreload(NamedTuple):
    """The slope of the logarithm of the preload; null where there are too few tests."""

    slope: float
    low: float
    high: float
    of: str
    unit: Literal["1", "1/s"]


@dataclasses.dataclass(frozen=True, eq=False)
class ConditionResults(
    parts_like(
        Condition,
        *("states", "alarm", "alarm_direction", "lost_since", "verdict", "probability_of_loss", "trend", "baseline"),
        *("tolerance", "false_alarms", "scatter", "exponent", "per_kelvin", "factor"),
        *("reference_temperature", "reference_speed", "temperatures"),
    )
):
    """The state in each test, the trend, and the alarm."""

    states: Sequence[TestState]
    trend: TrendOfPreload
    tolerance: Annotated[float, FINITE]
    false_alarms: Annotated[float, FINITE]
    #: Torque of the first tests over that of the model.
    factor: Estimate


def document(case: Case, result: Condition) -> dict[str, Any]:
    """Inputs, the state in each test, trend, alarm, warnings and provenance."""
    by_test, trend = result.per == "test", result.trend
    results = from_attributes(
        ConditionResults,
        result,
        states=[_state(number, state, result) for number, state in enumerate(result.states)],
        trend=TrendOfPreload(*trend, "logarithm of the preload", "1" if by_test else "1/s"),
        factor=Estimate(result.factor, *result.factor_interval),
    )
    sources = {
        "logs": [{"log": name, "sha256": digest} for name, digest in result.sources],
        "notes": list(result.notes),
    }
    units = {
        "torque": "N m",
        "temperature": "K",
        "preload": "1",
        "time": "1" if by_test else "s",
        "reference_speed": "rad/s",
        "per_kelvin": "1/K",
        "constant_torque": "N m",
    }
    return envelope(
        case,
        results,
        units=units,
        warnings=result.warning_records,
        verdicts=result.verdict_records,
        sources=sources,
    )


def _state(number: int, state: State, result: Condition) -> TestState:
    return from_attributes(
        TestState,
        state,
        torque=Estimate(state.torque, state.torque_low, state.torque_high),
        preload=Estimate(state.preload, state.preload_low, state.preload_high),
        **{name: values[number] for name, values in result.chart._asdict().items()},
    )

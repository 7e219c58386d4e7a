"""The results of a condition over time, declared once: JSON and its schema follow from the annotations."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Annotated, Any, Literal, NamedTuple

from ballscrew.basis.quantities import Info, Unit
from ballscrew.cases.case_files.case import Case
from ballscrew.engine.uncertainty.sobol import Estimate
from ballscrew.evidence.service.condition_parts import Part
from ballscrew.evidence.service.condition_values import Condition, State
from ballscrew.questions.shared.declared import FINITE, from_attributes, parts_like
from ballscrew.questions.shared.envelope import envelope


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


def document(case: Case, found: Condition) -> dict[str, Any]:
    """Inputs, the state in each test, trend, alarm, warnings and provenance."""
    by_test, trend = found.per == "test", found.trend
    results = from_attributes(
        ConditionResults,
        found,
        states=[_state(number, state, found) for number, state in enumerate(found.states)],
        trend=TrendOfPreload(*trend, "logarithm of the preload", "1" if by_test else "1/s"),
        factor=Estimate(found.factor, *found.factor_interval),
    )
    sources = {
        "logs": [{"log": name, "sha256": digest} for name, digest in found.sources],
        "notes": list(found.notes),
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
        warnings=found.warning_records,
        verdicts=found.verdict_records,
        sources=sources,
    )


def _state(number: int, state: State, found: Condition) -> TestState:
    return from_attributes(
        TestState,
        state,
        torque=Estimate(state.torque, state.torque_low, state.torque_high),
        preload=Estimate(state.preload, state.preload_low, state.preload_high),
        **{name: values[number] for name, values in found.chart._asdict().items()},
    )

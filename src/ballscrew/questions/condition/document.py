"""``ballscrew condition --json``: the document of a condition over time; all in SI."""

from __future__ import annotations

from typing import Any

from ballscrew.basis.records import documents
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.provenance import of_case
from ballscrew.evidence.service.condition_values import Condition, State


def document(case: Case, found: Condition) -> dict[str, Any]:
    """Inputs, the state in each test, trend, alarm, warnings and provenance."""
    return {
        "inputs": case_file.inputs(case),
        "results": {
            "states": [_state(i, one, found) for i, one in enumerate(found.states)],
            "alarm": found.alarm,
            "alarm_direction": None if found.alarm is None else "fall" if found.chart.falls else "rise",
            "lost_since": found.lost_since,
            "verdict": found.verdict,
            "probability_of_loss": found.probability_of_loss,
            "trend": {
                "slope": found.trend.slope, "low": found.trend.low, "high": found.trend.high,
                "of": "logarithm of the preload", "unit": "1" if found.per == "test" else "1/s",
            },
            "baseline": found.baseline,
            "tolerance": found.tolerance,
            "false_alarms": found.false_alarms,
            "scatter": found.scatter,
            "exponent": found.exponent,
            "per_kelvin": found.per_kelvin,
            "factor": {"value": found.factor, "low": found.factor_interval[0], "high": found.factor_interval[1]},
            "reference_temperature": found.reference_temperature,
            "reference_speed": found.reference_speed,
            "temperatures": found.temperatures,
        },
        "units": {
            "torque": "N m", "temperature": "K", "preload": "1", "time": "1" if found.per == "test" else "s",
            "reference_speed": "rad/s", "per_kelvin": "1/K", "constant_torque": "N m",
        },
        "warnings": documents(found.warning_records),
        "verdicts": documents(found.verdict_records),
        "checks": [],
        "provenance": {
            **of_case(case),
            "logs": [{"log": name, "sha256": digest} for name, digest in found.sources],
            "notes": list(found.notes),
        },
    }  # fmt: skip


def _state(number: int, one: State, found: Condition) -> dict[str, Any]:
    chart = found.chart
    return {
        "label": one.label,
        "time": one.time,
        "temperature": one.temperature,
        "torque": {"value": one.torque, "low": one.torque_low, "high": one.torque_high},
        "preload": {"value": one.preload, "low": one.preload_low, "high": one.preload_high},
        "fall": chart.fall[number],
        "rise": chart.rise[number],
        "limit": chart.limit[number],
        "parts": {
            name: {"value": part.value, "low": part.low, "high": part.high, "told": part.told}
            for name, part in one.parts.items()
        },
    }

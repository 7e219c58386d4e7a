"""The JSON document of a duty: the numbers of a cycle, its parts, life, brake, motor and the rule of catalogues."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ballscrew.axis.brake import Brake, LetGo
from ballscrew.axis.drive import MotorCheck
from ballscrew.axis.motor import Motor
from ballscrew.axis_studies import duty_records
from ballscrew.axis_studies.duty import NUMBERS, OF_BATH, DutyReport, slug_of
from ballscrew.cases import case_file, provenance
from ballscrew.records import documents
from ballscrew.sizing.checks import Check

if TYPE_CHECKING:  # loads xarray
    from ballscrew.axis_studies.duty_band import DutyBandReport

_OF_LET_GO: Mapping[str, str] = {
    "temperature": "K", "load_torque": "N m", "breakaway_torque": "N m", "running_torque": "N m",
    "holding_torque": "N m", "acceleration": "m/s^2", "speed_after_stroke": "m/s", "steady_speed": "m/s", "safety": "1",
}  # fmt: skip
_OF_PHASE: Mapping[str, str] = {
    "start": "s", "duration": "s", "largest_load": "N", "torque_peak": "N m", "torque_rms": "N m", "energy": "J",
}  # fmt: skip
_OF_CYCLE: Mapping[str, str] = {
    "time": "s", "position": "m", "speed": "m/s", "acceleration": "m/s^2", "axial_load": "N", "motor_speed": "rad/s",
    "torque": "N m", "power": "W",
}  # fmt: skip
#: States of a cycle in a document; of more, each second, third … one: all of them are in a table in a file.
MOST_STATES = 2000
_BY = ("torque_peak_by", "torque_rms_by", "energy_by", "energy_lost_by")


def document(report: DutyReport) -> dict[str, Any]:
    """The document of a duty, in SI."""
    return {
        "inputs": case_file.inputs(report.case),
        "results": results(report),
        "units": _units(report),
        "warnings": documents(duty_records.warnings(report)),
        "verdicts": documents(duty_records.verdicts(report)),
        "checks": [_check(check) for check in report.checks],
        "provenance": provenance.of_case(report.case),
    }


def with_band(found: DutyBandReport) -> dict[str, Any]:
    """The document of a duty with its bands."""
    bands = found.bands
    return {
        **document(found.report),
        "band": {
            "level": bands.level,
            "samples": bands.count,
            **{
                name: {"value": one.value, "median": one.median, **one.band._asdict()}
                for name, one in bands.numbers.items()
            },
            "inputs": {name: {"source": one.source, "given": one.given} for name, one in found.inputs.items()},
        },
    }


def results(report: DutyReport) -> dict[str, Any]:
    """All results of a cycle in SI."""
    duty = report.duty
    moving = duty.states.direction != 0
    return {
        **report.numbers,
        "torque_by": "rule" if report.by_rule else "mechanics",
        "torque_peak_by": _by_slug(report.torque_peak_by),
        "torque_rms_by": _by_slug(report.torque_rms_by),
        "energy_by": _by_slug(duty.energy_by),
        "energy_lost_by": _by_slug(duty.energy_lost_by),
        "energy_lost_in": {slug_of(name): _by_slug(parts) for name, parts in report.energy_lost_in.items()},
        "heat_by_element": _by_slug(duty.heat),
        "screw_torque": duty.screw_torque,
        "flooded_torque": report.flooded_torque,
        "full_bath": None if report.by_rule else dict(report.full_bath),
        "largest_load": report.largest_load,
        "maximum_pressure": _extreme(np.fmax.reduce, duty.screw.maximum_pressure[moving]),
        "minimum_film_parameter": _extreme(np.fmin.reduce, duty.screw.film_parameter[moving]),
        "valid": bool(np.all(duty.screw.valid[moving])),
        "life": _life(report),
        "brake": _brake(report.brake),
        **({} if report.motor is None else {"motor": _motor(report.motor)}),
        "rules": {
            "mechanics": {"torque_rms": duty.torque_rms, "torque_peak": duty.torque_peak},
            "catalogue": {
                "efficiency": report.rule.efficiency,
                "torque_rms": report.rule.torque_rms,
                "torque_peak": report.rule.torque_peak,
            },
        },
        "phases": [phase._asdict() for phase in report.phases],
        "cycle": _cycle(report),
        **({} if report.smoothing is None else {"smoothing": report.smoothing._asdict()}),
        "operating_points": duty.screw.points,
    }


def _cycle(report: DutyReport) -> dict[str, Any]:
    """The states of the cycle over time, and the torque by cause; each of them, or each one in ``every``."""
    duty, states = report.duty, report.duty.states
    every = -(-len(states.time) // MOST_STATES)
    columns = {
        "time": states.time, "position": states.position, "speed": states.speed, "acceleration": states.acceleration,
        "axial_load": duty.axial_load, "motor_speed": duty.motor_speed, "torque": duty.torque, "power": duty.power,
    }  # fmt: skip
    return {
        "every": every,
        **{name: [float(value) for value in column[::every]] for name, column in columns.items()},
        "flooded_torque": [float(value) for value in duty.flooded.torque[::every]] if duty.starved else None,
        "torque_by": {
            slug_of(cause): [float(value) for value in part[::every]] for cause, part in report.torque_by_cause.items()
        },
    }


def _check(check: Check) -> dict[str, Any]:
    """A check as a record, with the share of its limit that is used and what it lacks."""
    beside = {"name": check.name, "utilisation": check.utilisation, "missing": check.missing}
    return {**check.record.document(), **beside}


def _by_slug(parts: Mapping[str, float]) -> dict[str, float]:
    return {slug_of(name): float(value) for name, value in parts.items()}


def _extreme(end: Any, values: Any) -> float:
    return float(end(values)) if values.size else float("nan")


def _life(report: DutyReport) -> dict[str, Any]:
    life = report.life
    return {
        "dynamic_load_rating": life.dynamic_load_rating,
        "rating_source": report.rating_source,
        "preload": life.preload,
        "load_factor": life.load_factor,
        "mean_loads": {name.replace(" ", "_"): load for name, load in life.mean_loads.items()},
        "lives": {name.replace(" ", "_"): turns for name, turns in life.lives.items()},
        "revolutions": life.revolutions,
        "revolutions_of_the_worse": life.revolutions_of_the_worse,
    }


def _brake(brake: Brake) -> dict[str, Any]:
    return {
        "falls": brake.falls,
        "starts": brake.starts,
        "holding_torque": brake.holding_torque,
        "load_torque": brake.load_torque,
        "brake_torque": brake.brake_torque,
        "brake_factor": brake.brake_factor,
        "conditions": [_let_go(found) for found in brake.conditions],
    }


def _let_go(found: LetGo) -> dict[str, Any]:
    numbers = {name: getattr(found, name) for name in _OF_LET_GO}
    return {"condition": found.condition, "falls": found.falls, "goes_on": found.goes_on, **numbers}


def _motor(against: MotorCheck) -> dict[str, Any]:
    duty, at = against.duty, against.worst
    return {
        "suffices": all(check.holds is not False for check in against.checks),
        "utilisation": float(against.utilisation[at]),
        "worst": {
            "phase": duty.states.phases[int(duty.states.phase[at])],
            "torque": against.worst_torque[1],
            "condition": against.worst_torque[0] or None,
            "speed": float(duty.motor_speed[at]),
        },
        "copper_loss": against.copper_loss,
        "flooded_copper_loss": against.flooded_copper_loss,
        "curve": _curve(against.motor),
    }


def _curve(motor: Motor) -> dict[str, Any]:
    """Torque that a motor gives for a short time and for ever, at the corners of its curve."""
    largest = float(motor.largest_speed)
    speeds = [0.0, *(speed for speed, _ in motor.curve if 0 < speed < largest), largest]
    return {
        "speed": speeds,
        "peak_torque": [float(torque) for torque in motor.peak_at(np.array(speeds))],
        "rated_torque": float(motor.rated_torque),
    }


def _units(report: DutyReport) -> dict[str, Any]:
    by = {name: "J" if name.startswith("energy") else "N m" for name in _BY}
    torques = {"torque_rms": "N m", "torque_peak": "N m"}
    curve = {"speed": "rad/s", "peak_torque": "N m", "rated_torque": "N m"}
    motor = {
        "worst": {"torque": "N m", "speed": "rad/s"},
        "copper_loss": "J",
        "flooded_copper_loss": "J",
        "curve": curve,
    }
    causes = dict.fromkeys(map(slug_of, report.torque_by_cause), "N m")
    return {
        **{name: quantity.unit for name, quantity in NUMBERS.items()},
        **{name: dict.fromkeys((slug_of(part) for part in report.duty.parts), unit) for name, unit in by.items()},
        "energy_lost_in": "J",
        "heat_by_element": dict.fromkeys(map(slug_of, report.duty.heat), "W"),
        "screw_torque": "N m",
        "flooded_torque": "N m",
        "full_bath": {name: quantity.unit for name, quantity in OF_BATH.items()},
        "largest_load": "N",
        "maximum_pressure": "Pa",
        "minimum_film_parameter": "1",
        "life": {"dynamic_load_rating": "N", "preload": "N", "mean_loads": "N", "lives": "1", "revolutions": "1"},
        "brake": {
            "holding_torque": "N m", "load_torque": "N m", "brake_torque": "N m", "brake_factor": "1",
            "conditions": dict(_OF_LET_GO),
        },
        **({} if report.motor is None else {"motor": motor}),
        "rules": {"mechanics": torques, "catalogue": {"efficiency": "1", **torques}},
        "phases": dict(_OF_PHASE),
        "cycle": {**_OF_CYCLE, "flooded_torque": "N m", "torque_by": causes},
        **({} if report.smoothing is None else {"smoothing": _of_smoothing(report)}),
    }  # fmt: skip


def _of_smoothing(report: DutyReport) -> dict[str, str]:
    recorded = "m" if getattr(report.motion, "position", None) is not None else "m/s"
    return {"noise": recorded, "acceleration_noise": "m/s^2", "torque_rms_unsmoothed": "N m"}

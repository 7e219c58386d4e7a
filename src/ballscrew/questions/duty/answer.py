"""The results of a duty, declared once: JSON, its units and its schema follow from the annotations."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, Any, Literal, NamedTuple

import numpy as np

from ballscrew.axis.duty_cycle.brake import Brake
from ballscrew.axis.duty_cycle.drive import MotorCheck
from ballscrew.basis.quantities import (
    Acceleration,
    AngularSpeed,
    Duration,
    Energy,
    Force,
    Info,
    Length,
    Power,
    Pressure,
    Ratio,
    Speed,
    Torque,
    Unit,
)
from ballscrew.physics.sizing.checks import Check
from ballscrew.questions.duty import verdicts
from ballscrew.questions.duty.compute import (
    NUMBERS,
    OF_BATH,
    DutyReport,
    PhaseNumbers,
    PositionSmoothing,
    SpeedSmoothing,
    slug_of,
)
from ballscrew.questions.shared.check_lines import source_document
from ballscrew.questions.shared.declared import FINITE, LEFT_OUT, from_attributes, table_of
from ballscrew.questions.shared.envelope import envelope

if TYPE_CHECKING:  # loads xarray
    from ballscrew.questions.duty.band import DutyBandReport

#: States of a cycle in a document; of more, each second, third … one: all of them are in a table in a file.
MOST_STATES = 2000


class FullBath(table_of(OF_BATH)):
    """Numbers of the cycle in a full bath of oil."""


class Life(NamedTuple):
    """Life of the screw by ISO 3408-5 over the cycle."""

    #: Dynamic load rating of one nut body or half.
    dynamic_load_rating: Force | None
    #: Where the rating comes from.
    rating_source: str
    #: Axial preload; zero of a nut without.
    preload: Force
    #: Factor on the loads for shocks.
    load_factor: Ratio
    mean_loads: Annotated[Mapping[str, float], Unit("N"), Info("F_m", "mean load of each flank or half")]
    lives: Annotated[Mapping[str, float], Unit("1"), Info("L", "turns of each flank or half")]
    #: Basic rating life L10 by both flanks or halves, revolutions.
    revolutions: Ratio
    #: Turns by the larger mean load alone.
    revolutions_of_the_worse: Ratio


class WorstState(NamedTuple):
    """The state whose torque comes nearest to the peak torque of the motor at its speed."""

    #: The phase of the motion that it is in.
    phase: str
    #: Torque of the motor.
    torque: Torque
    #: The condition of the track that counts there; None where nothing is starved of oil.
    condition: str | None
    #: Speed of the motor.
    speed: AngularSpeed


class MotorCurve(NamedTuple):
    """What a motor gives, at the corners of its curve."""

    #: Speed of the motor.
    speed: Annotated[Sequence[AngularSpeed], FINITE]
    #: Torque that it gives for a short time.
    peak_torque: Annotated[Sequence[Torque], FINITE]
    #: Torque that it gives for ever.
    rated_torque: Annotated[Torque, FINITE]


class MotorUse(NamedTuple):
    """The cycle against the motor."""

    #: True where no check of the motor fails.
    suffices: bool
    utilisation: Annotated[float, Info("", "torque over the peak torque at its speed, at its largest")]
    #: The state in which it is largest.
    worst: WorstState
    #: Heat of the current in a cycle; null without constant or resistance of the motor.
    copper_loss: Energy | None
    #: The same in a full bath of oil.
    flooded_copper_loss: Energy | None
    #: Curve of the motor.
    curve: MotorCurve


class Mechanics(NamedTuple):
    """Torque of the motor by mechanics."""

    torque_rms: Annotated[Torque, NUMBERS["torque_rms"].info]
    torque_peak: Annotated[Torque, NUMBERS["torque_peak"].info]


class Catalogue(NamedTuple):
    """Torque of the motor by the rule of catalogues."""

    #: Efficiency of the screw that the rule takes.
    efficiency: Ratio
    torque_rms: Annotated[Torque, NUMBERS["torque_rms"].info]
    torque_peak: Annotated[Torque, NUMBERS["torque_peak"].info]


class Rules(NamedTuple):
    """Torque of the motor by both rules."""

    #: By mechanics, with the friction of the model.
    mechanics: Mechanics
    #: By the rule of catalogues, with one efficiency.
    catalogue: Catalogue


class Cycle(NamedTuple):
    """The states of a cycle over time, and the torque of the motor by cause."""

    #: 1 where each state of the motion is here, or each second, third … one.
    every: int
    #: Time since the start of the cycle.
    time: Annotated[Sequence[Duration], FINITE]
    #: Position.
    position: Annotated[Sequence[Length], FINITE]
    #: Speed.
    speed: Annotated[Sequence[Speed], FINITE]
    #: Acceleration.
    acceleration: Annotated[Sequence[Acceleration], FINITE]
    #: Load of the nut.
    axial_load: Sequence[Force]
    #: Speed of the motor.
    motor_speed: Sequence[AngularSpeed]
    #: Torque of the motor by mechanics.
    torque: Sequence[Torque]
    #: Power of the motor.
    power: Sequence[Power]
    #: Torque of the motor in a full bath of oil; null where nothing is starved of oil.
    flooded_torque: Sequence[Torque] | None
    #: Torque of the motor by cause.
    torque_by: Mapping[str, Sequence[Torque]]


@dataclasses.dataclass(frozen=True, eq=False)
class DutyResults(table_of(NUMBERS)):
    """The results of a cycle of an axis."""

    #: What the torques above are by: mechanics, or the rule of catalogues where the case asks for it.
    torque_by: Literal["rule", "mechanics"]
    #: Parts of the peak torque.
    torque_peak_by: Mapping[str, Torque]
    #: Parts of the RMS torque.
    torque_rms_by: Mapping[str, Torque]
    inertia_by: Annotated[Mapping[str, float], Unit("kg m^2"), Info("J", "moment of inertia at the motor")]
    #: Energy of a cycle by cause.
    energy_by: Mapping[str, Energy]
    #: Energy lost in a cycle by mechanism.
    energy_lost_by: Mapping[str, Energy]
    energy_lost_in: Annotated[
        Mapping[str, Mapping[str, float]], Unit("J"), Info("E_f", "energy lost by element and mechanism")
    ]
    #: Mean heat of each element over the cycle.
    heat_by_element: Mapping[str, Power]
    screw_torque: Annotated[Torque, OF_BATH["screw_torque"].info]
    #: Largest torque of the motor in a full bath of oil; null for one efficiency.
    flooded_torque: Torque | None
    #: Numbers of the cycle in a full bath of oil; null for one efficiency, which knows no oil.
    full_bath: FullBath | None
    #: Largest size of the axial load.
    largest_load: Force
    #: Largest contact pressure.
    maximum_pressure: Pressure
    #: Least film parameter in motion.
    minimum_film_parameter: Ratio
    #: True where the model holds in all states in motion.
    valid: bool
    #: Mean loads and life over the cycle.
    life: Life
    #: What the axis does with its motor off.
    brake: Brake
    #: The cycle against the motor, where there is one.
    motor: Annotated[MotorUse | None, LEFT_OUT]
    #: The torque of the motor by mechanics and by the rule of catalogues.
    rules: Rules
    #: What each phase of the motion asks of the motor.
    phases: Sequence[PhaseNumbers]
    #: The states over time.
    cycle: Cycle
    #: How a recorded motion was smoothed.
    smoothing: Annotated[PositionSmoothing | SpeedSmoothing | None, LEFT_OUT]
    #: Operating points of the screw for which the model was evaluated.
    operating_points: int


def document(report: DutyReport) -> dict[str, Any]:
    """The document of a duty, in SI."""
    return envelope(
        report.case,
        results(report),
        warnings=verdicts.warnings(report),
        verdicts=verdicts.verdicts(report),
        checks=map(_check, report.checks),
    )


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


def results(report: DutyReport) -> DutyResults:
    """The results of a duty."""
    duty, life, rule, moving = report.duty, report.life, report.rule, report.duty.states.direction != 0
    mean_loads, lives = _by_slug(life.mean_loads), _by_slug(life.lives)
    return from_attributes(
        DutyResults,
        report,
        **report.numbers,
        torque_by="rule" if report.by_rule else "mechanics",
        torque_peak_by=_by_slug(report.torque_peak_by),
        torque_rms_by=_by_slug(report.torque_rms_by),
        inertia_by=_by_slug(report.axis.inertia_by),
        energy_by=_by_slug(duty.energy_by),
        energy_lost_by=_by_slug(duty.energy_lost_by),
        energy_lost_in={slug_of(name): _by_slug(parts) for name, parts in report.energy_lost_in.items()},
        heat_by_element=_by_slug(duty.heat),
        screw_torque=duty.screw_torque,
        full_bath=None if report.by_rule else FullBath(**report.full_bath),
        maximum_pressure=_extreme(np.fmax.reduce, duty.screw.maximum_pressure[moving]),
        minimum_film_parameter=_extreme(np.fmin.reduce, duty.screw.film_parameter[moving]),
        valid=bool(np.all(duty.screw.valid[moving])),
        life=from_attributes(Life, life, rating_source=report.rating_source, mean_loads=mean_loads, lives=lives),
        motor=None if report.motor is None else _motor_use(report.motor),
        rules=Rules(from_attributes(Mechanics, duty), from_attributes(Catalogue, rule)),
        cycle=_cycle(report),
        operating_points=duty.screw.points,
    )


def _motor_use(against: MotorCheck) -> MotorUse:
    duty, motor, at, (condition, torque) = against.duty, against.motor, against.worst, against.worst_torque
    largest = float(motor.largest_speed)
    speeds = [0.0, *(speed for speed, _ in motor.curve if 0 < speed < largest), largest]
    return from_attributes(
        MotorUse,
        against,
        suffices=all(check.holds is not False for check in against.checks),
        utilisation=float(against.utilisation[at]),
        worst=WorstState(
            duty.states.phases[int(duty.states.phase[at])], torque, condition or None, float(duty.motor_speed[at])
        ),
        curve=MotorCurve(speeds, motor.peak_at(np.array(speeds)).tolist(), float(motor.rated_torque)),
    )


def _cycle(report: DutyReport) -> Cycle:
    duty, states = report.duty, report.duty.states
    every = -(-len(states.time) // MOST_STATES)

    def some(values: Any) -> list[float]:
        return values[::every].tolist()

    return Cycle(
        every,
        *map(some, (states.time, states.position, states.speed, states.acceleration)),
        *map(some, (duty.axial_load, duty.motor_speed, duty.torque, duty.power)),
        flooded_torque=some(duty.flooded.torque) if duty.starved else None,
        torque_by={slug_of(cause): some(part) for cause, part in report.torque_by_cause.items()},
    )


def _by_slug(parts: Mapping[str, Any]) -> dict[str, float]:
    return {slug_of(name): float(value) for name, value in parts.items()}


def _extreme(end: Any, values: Any) -> float:
    return float(end(values)) if values.size else float("nan")


def _check(check: Check) -> dict[str, Any]:
    """A check as a record, with the share of its limit that is used, what it lacks and its source."""
    beside = {"name": check.name, "utilisation": check.utilisation, "missing": check.missing}
    return {**check.record.document(), **beside, **source_document(check)}

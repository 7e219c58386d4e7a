"""The results of a duty, declared once: JSON, its units and its schema follow from the annotations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, Any, Literal, NamedTuple

import numpy as np

from ballscrew.axis.duty_cycle.brake import Brake
from ballscrew.axis.duty_cycle.cycle_life import CycleLife
from ballscrew.axis.duty_cycle.drive import MotorCheck
from ballscrew.axis.duty_cycle.motor import Motor
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
)  # fmt: skip
from ballscrew.questions.duty.compute import (
    NUMBERS,
    OF_BATH,
    CycleNumbers,
    DutyReport,
    PhaseNumbers,
    PositionSmoothing,
    SpeedSmoothing,
    slug_of,
)  # fmt: skip
from ballscrew.questions.shared.declared import FINITE, LEFT_OUT, Answer, table_of

#: States of a cycle in a document; of more, each second, third … one: all of them are in a table in a file.
MOST_STATES = 2000


_INERTIA = Unit("kg m^2")


def _by_slug(parts: Mapping[str, Any]) -> dict[str, float]:
    return {slug_of(name): float(value) for name, value in parts.items()}


class FullBath(table_of(OF_BATH)):
    """Numbers of the cycle in a full bath of oil."""


class Life(Answer):
    """Life of the screw by ISO 3408-5 over the cycle."""

    def __init__(self, life: CycleLife, source: str) -> None:
        self._life, self._source = life, source

    @property
    def dynamic_load_rating(self) -> Force | None:
        """Dynamic load rating of one nut body or half."""
        return self._life.dynamic_load_rating

    @property
    def rating_source(self) -> str:
        """Where the rating comes from."""
        return self._source

    @property
    def preload(self) -> Force:
        """Axial preload; zero of a nut without."""
        return self._life.preload

    @property
    def load_factor(self) -> Ratio:
        """Factor on the loads for shocks."""
        return self._life.load_factor

    @property
    def mean_loads(self) -> Annotated[Mapping[str, float], Unit("N"), Info("F_m", "mean load of each flank or half")]:
        """Mean load of each flank or half."""
        return _with_keys(self._life.mean_loads)

    @property
    def lives(self) -> Annotated[Mapping[str, float], Unit("1"), Info("L", "turns of each flank or half")]:
        """Basic rating life L10 of each flank or half, revolutions."""
        return _with_keys(self._life.lives)

    @property
    def revolutions(self) -> Ratio:
        """Basic rating life L10 by both flanks or halves, revolutions."""
        return self._life.revolutions

    @property
    def revolutions_of_the_worse(self) -> Ratio:
        """Turns by the larger mean load alone."""
        return self._life.revolutions_of_the_worse


def _with_keys(values: Mapping[str, float]) -> dict[str, float]:
    return {name.replace(" ", "_"): value for name, value in values.items()}


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


class MotorCurve(Answer):
    """What a motor gives, at the corners of its curve."""

    def __init__(self, motor: Motor) -> None:
        largest = float(motor.largest_speed)
        self._motor = motor
        self._speeds = [0.0, *(speed for speed, _ in motor.curve if 0 < speed < largest), largest]

    @property
    def speed(self) -> Annotated[Sequence[AngularSpeed], FINITE]:
        """Speed of the motor."""
        return self._speeds

    @property
    def peak_torque(self) -> Annotated[Sequence[Torque], FINITE]:
        """Torque that it gives for a short time."""
        return [float(torque) for torque in self._motor.peak_at(np.array(self._speeds))]

    @property
    def rated_torque(self) -> Annotated[Torque, FINITE]:
        """Torque that it gives for ever."""
        return float(self._motor.rated_torque)


class MotorUse(Answer):
    """The cycle against the motor."""

    def __init__(self, against: MotorCheck) -> None:
        self._against = against

    @property
    def suffices(self) -> bool:
        """True where no check of the motor fails."""
        return all(check.holds is not False for check in self._against.checks)

    @property
    def utilisation(self) -> Annotated[float, Info("", "torque over the peak torque at its speed, at its largest")]:
        """Torque over the peak torque at its speed, where that is largest."""
        return float(self._against.utilisation[self._against.worst])

    @property
    def worst(self) -> WorstState:
        """The state in which it is largest."""
        duty, at = self._against.duty, self._against.worst
        condition, torque = self._against.worst_torque
        phase = duty.states.phases[int(duty.states.phase[at])]
        return WorstState(phase, torque, condition or None, float(duty.motor_speed[at]))

    @property
    def copper_loss(self) -> Energy | None:
        """Heat of the current in a cycle; null without constant or resistance of the motor."""
        return self._against.copper_loss

    @property
    def flooded_copper_loss(self) -> Energy | None:
        """The same in a full bath of oil."""
        return self._against.flooded_copper_loss

    @property
    def curve(self) -> MotorCurve:
        """Curve of the motor."""
        return MotorCurve(self._against.motor)


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


class Cycle(Answer):
    """The states of a cycle over time, and the torque of the motor by cause."""

    def __init__(self, report: DutyReport) -> None:
        self._report, self._duty, self._states = report, report.duty, report.duty.states
        self._every = -(-len(self._states.time) // MOST_STATES)

    def _some(self, values: Any) -> list[float]:
        return [float(value) for value in values[:: self._every]]

    @property
    def every(self) -> int:
        """1 where each state of the motion is here, or each second, third … one."""
        return self._every

    @property
    def time(self) -> Annotated[Sequence[Duration], FINITE]:
        """Time since the start of the cycle."""
        return self._some(self._states.time)

    @property
    def position(self) -> Annotated[Sequence[Length], FINITE]:
        """Position."""
        return self._some(self._states.position)

    @property
    def speed(self) -> Annotated[Sequence[Speed], FINITE]:
        """Speed."""
        return self._some(self._states.speed)

    @property
    def acceleration(self) -> Annotated[Sequence[Acceleration], FINITE]:
        """Acceleration."""
        return self._some(self._states.acceleration)

    @property
    def axial_load(self) -> Sequence[Force]:
        """Load of the nut."""
        return self._some(self._duty.axial_load)

    @property
    def motor_speed(self) -> Sequence[AngularSpeed]:
        """Speed of the motor."""
        return self._some(self._duty.motor_speed)

    @property
    def torque(self) -> Sequence[Torque]:
        """Torque of the motor by mechanics."""
        return self._some(self._duty.torque)

    @property
    def power(self) -> Sequence[Power]:
        """Power of the motor."""
        return self._some(self._duty.power)

    @property
    def flooded_torque(self) -> Sequence[Torque] | None:
        """Torque of the motor in a full bath of oil; null where nothing is starved of oil."""
        return self._some(self._duty.flooded.torque) if self._duty.starved else None

    @property
    def torque_by(self) -> Mapping[str, Sequence[Torque]]:
        """Torque of the motor by cause."""
        return {slug_of(cause): self._some(part) for cause, part in self._report.torque_by_cause.items()}


class DutyResults(CycleNumbers):
    """The results of a cycle of an axis."""

    def __init__(self, report: DutyReport) -> None:
        super().__init__(report)
        self._duty = report.duty
        self._moving = report.duty.states.direction != 0

    @property
    def torque_by(self) -> Literal["rule", "mechanics"]:
        """What the torques above are by: mechanics, or the rule of catalogues where the case asks for it."""
        return "rule" if self._report.by_rule else "mechanics"

    @property
    def torque_peak_by(self) -> Mapping[str, Torque]:
        """Parts of the peak torque."""
        return _by_slug(self._report.torque_peak_by)

    @property
    def torque_rms_by(self) -> Mapping[str, Torque]:
        """Parts of the RMS torque."""
        return _by_slug(self._report.torque_rms_by)

    @property
    def inertia_by(self) -> Annotated[Mapping[str, float], _INERTIA, Info("J", "moment of inertia at the motor")]:
        """Moment of inertia at the motor by what turns, or of all in one as it is given."""
        return _by_slug(self._report.axis.inertia_by)

    @property
    def energy_by(self) -> Mapping[str, Energy]:
        """Energy of a cycle by cause."""
        return _by_slug(self._duty.energy_by)

    @property
    def energy_lost_by(self) -> Mapping[str, Energy]:
        """Energy lost in a cycle by mechanism."""
        return _by_slug(self._duty.energy_lost_by)

    @property
    def energy_lost_in(
        self,
    ) -> Annotated[Mapping[str, Mapping[str, float]], Unit("J"), Info("E_f", "energy lost by element and mechanism")]:
        """Energy lost in a cycle by element and mechanism."""
        return {slug_of(name): _by_slug(parts) for name, parts in self._report.energy_lost_in.items()}

    @property
    def heat_by_element(self) -> Mapping[str, Power]:
        """Mean heat of each element over the cycle."""
        return _by_slug(self._duty.heat)

    @property
    def screw_torque(self) -> Annotated[Torque, OF_BATH["screw_torque"].info]:
        """Largest friction torque of the screw in the cycle."""
        return self._duty.screw_torque

    @property
    def flooded_torque(self) -> Torque | None:
        """Largest torque of the motor in a full bath of oil; null for one efficiency."""
        return self._report.flooded_torque

    @property
    def full_bath(self) -> FullBath | None:
        """Numbers of the cycle in a full bath of oil; null for one efficiency, which knows no oil."""
        return None if self._report.by_rule else FullBath(**self._report.full_bath)

    @property
    def largest_load(self) -> Force:
        """Largest size of the axial load."""
        return self._report.largest_load

    @property
    def maximum_pressure(self) -> Pressure:
        """Largest contact pressure."""
        return _extreme(np.fmax.reduce, self._duty.screw.maximum_pressure[self._moving])

    @property
    def minimum_film_parameter(self) -> Ratio:
        """Least film parameter in motion."""
        return _extreme(np.fmin.reduce, self._duty.screw.film_parameter[self._moving])

    @property
    def valid(self) -> bool:
        """True where the model holds in all states in motion."""
        return bool(np.all(self._duty.screw.valid[self._moving]))

    @property
    def life(self) -> Life:
        """Mean loads and life over the cycle."""
        return Life(self._report.life, self._report.rating_source)

    @property
    def brake(self) -> Brake:
        """What the axis does with its motor off."""
        return self._report.brake

    @property
    def motor(self) -> Annotated[MotorUse | None, LEFT_OUT]:
        """The cycle against the motor, where there is one."""
        return None if self._report.motor is None else MotorUse(self._report.motor)

    @property
    def rules(self) -> Rules:
        """The torque of the motor by mechanics and by the rule of catalogues."""
        rule = self._report.rule
        return Rules(
            Mechanics(self._duty.torque_rms, self._duty.torque_peak),
            Catalogue(rule.efficiency, rule.torque_rms, rule.torque_peak),
        )

    @property
    def phases(self) -> Sequence[PhaseNumbers]:
        """What each phase of the motion asks of the motor."""
        return self._report.phases

    @property
    def cycle(self) -> Cycle:
        """The states over time."""
        return Cycle(self._report)

    @property
    def smoothing(self) -> Annotated[PositionSmoothing | SpeedSmoothing | None, LEFT_OUT]:
        """How a recorded motion was smoothed."""
        return self._report.smoothing

    @property
    def operating_points(self) -> int:
        """Operating points of the screw for which the model was evaluated."""
        return self._duty.screw.points


def _extreme(end: Any, values: Any) -> float:
    return float(end(values)) if values.size else float("nan")

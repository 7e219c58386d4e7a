"""A duty against its motor: torque for ever, torque for a short time, and speed."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping

import numpy as np

from ballscrew.axis.duty_cycle.duty import Duty
from ballscrew.axis.duty_cycle.motor import Motor
from ballscrew.axis.motion.states import Numbers
from ballscrew.basis import units
from ballscrew.basis.arrays import ByValue, lazy
from ballscrew.basis.quantities import Energy, fields_of
from ballscrew.physics.friction.starvation import FULL_BATH
from ballscrew.physics.sizing.checks import Check

_LARGEST_SPEED = fields_of(Motor)["largest_speed"]


#: The condition of the track of balls that a torque is of, where both are judged.
AS_GIVEN = "starved of oil"


@dataclasses.dataclass(frozen=True, eq=False)
class MotorCheck(ByValue):
    """A duty against a motor.

    Where the screw is starved of oil (:attr:`~ballscrew.axis.duty_cycle.duty.Duty.starved`), its torque in a full bath
    is judged as well, and the larger counts.
    """

    duty: Duty
    motor: Motor
    #: The torque that is checked, N m; None for that of the duty.
    by_rule: Numbers | None = None

    @property
    def torque(self) -> Numbers:
        """Torque of the motor, N m, with the inlet as it is given."""
        return self.duty.torque if self.by_rule is None else self.by_rule

    @lazy
    def torques(self) -> Mapping[str, Numbers]:
        """The torques that are judged, N m, by the condition of the track; one without a name where nothing starves."""
        if self.by_rule is not None or not self.duty.starved:
            return {"": self.torque}
        return {AS_GIVEN: self.torque, FULL_BATH: self.duty.flooded.torque}

    @lazy
    def utilisation(self) -> Numbers:
        """Largest torque over the peak torque at the speed of each state; infinite beyond the largest speed."""
        peak = self.motor.peak_at(self.duty.motor_speed)
        size = np.max(np.abs(list(self.torques.values())), axis=0)
        return np.where(peak > 0, size / np.where(peak > 0, peak, 1.0), np.where(size > 0, math.inf, 0.0))

    @lazy
    def worst(self) -> int:
        """The state whose torque comes nearest to the peak torque at its speed."""
        return int(np.argmax(self.utilisation))

    @lazy
    def worst_torque(self) -> tuple[str, float]:
        """The condition of the track that counts in that state, and the torque there, N m."""
        values = {condition: float(torque[self.worst]) for condition, torque in self.torques.items()}
        condition = max(values, key=lambda name: abs(values[name]))
        return condition, values[condition]

    @lazy
    def worst_rms(self) -> tuple[str, float]:
        """The condition of the track that has the larger RMS torque, and that torque, N m."""
        states = self.duty.states
        values = {
            condition: math.sqrt(states.integral(torque**2) / states.cycle_time)
            for condition, torque in self.torques.items()
        }
        condition = max(values, key=lambda name: values[name])
        return condition, values[condition]

    @lazy
    def copper_loss(self) -> Energy | None:
        r"""Heat of the current in a cycle, :math:`R \int (\tau/K_t)^2 dt`, J; None without constant or resistance."""
        return self._copper_loss(self.torque)

    @lazy
    def flooded_copper_loss(self) -> Energy | None:
        """The same in a full bath of oil."""
        return self._copper_loss(self.torque if self.by_rule is not None else self.duty.flooded.torque)

    def _copper_loss(self, torque: Numbers) -> Energy | None:
        K_t, R = self.motor.torque_constant, self.motor.resistance
        if K_t is None or R is None:
            return None
        return self.duty.states.integral(R * (torque / K_t) ** 2)

    @property
    def checks(self) -> tuple[Check, ...]:
        """Torque for ever, torque for a short time and speed, each against what the motor gives."""
        at, motor = self.worst, self.motor
        speed = self.speed_check.value
        assert speed is not None
        name = self.duty.states.phases[int(self.duty.states.phase[at])]
        peak = float(motor.peak_at(self.duty.motor_speed[at : at + 1])[0])
        rms_where, rms = self.worst_rms
        where, largest = self.worst_torque
        of_rms = _of(rms_where, "RMS torque, rests included, against the rated torque")
        of_peak = _of(where, f"torque against the curve of the motor, worst in “{name}”")
        if speed > motor.largest_speed:
            of_peak = (
                f"the motor has no torque above {units.shown(motor.largest_speed, _LARGEST_SPEED)}, where its "
                f"curve ends; the cycle needs {units.shown(speed, _LARGEST_SPEED)}"
            )
        return (
            Check.at_most(of_rms, "motor_rms_torque", rms, motor.rated_torque, "N m"),
            Check.at_most(of_peak, "motor_peak_torque", abs(largest), peak, "N m"),
            self.speed_check,
        )

    @property
    def speed_check(self) -> Check:
        """Speed against the largest of the motor: it knows no torque."""
        speed = float(np.max(np.abs(self.duty.motor_speed)))
        message = "speed of the motor against its largest"
        return Check.at_most(message, "motor_speed", speed, self.motor.largest_speed, "rad/s")


def _of(condition: str, message: str) -> str:
    """A message, and the condition of the track that it is of."""
    return f"{message}, {condition}" if condition else message

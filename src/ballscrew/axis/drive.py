"""A duty against its motor: torque for ever, torque for a short time, and speed."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np

from ballscrew import units
from ballscrew._arrays import ByValue, lazy
from ballscrew.axis.duty import Duty
from ballscrew.axis.motor import Motor
from ballscrew.motion.states import Numbers
from ballscrew.quantities import Energy, fields_of
from ballscrew.sizing.checks import Check

_LARGEST_SPEED = fields_of(Motor)["largest_speed"]


@dataclasses.dataclass(frozen=True, eq=False)
class MotorCheck(ByValue):
    """A duty against a motor."""

    duty: Duty
    motor: Motor
    #: The torque that is checked, N m; None for that of the duty.
    by_rule: Numbers | None = None

    @property
    def torque(self) -> Numbers:
        """Torque of the motor, N m."""
        return self.duty.torque if self.by_rule is None else self.by_rule

    @lazy
    def utilisation(self) -> Numbers:
        """Torque over the peak torque at the speed of each state; infinite beyond the largest speed."""
        peak = self.motor.peak_at(self.duty.motor_speed)
        size = np.abs(self.torque)
        return np.where(peak > 0, size / np.where(peak > 0, peak, 1.0), np.where(size > 0, math.inf, 0.0))

    @lazy
    def worst(self) -> int:
        """The state whose torque comes nearest to the peak torque at its speed."""
        return int(np.argmax(self.utilisation))

    @lazy
    def copper_loss(self) -> Energy | None:
        r"""Heat of the current in a cycle, :math:`R \int (\tau/K_t)^2 dt`, J; None without constant or resistance."""
        K_t, R = self.motor.torque_constant, self.motor.resistance
        if K_t is None or R is None:
            return None
        return self.duty.states.integral(R * (self.torque / K_t) ** 2)

    @property
    def checks(self) -> tuple[Check, ...]:
        """Torque for ever, torque for a short time and speed, each against what the motor gives."""
        at, motor = self.worst, self.motor
        speed = float(np.max(np.abs(self.duty.motor_speed)))
        name = self.duty.states.phases[int(self.duty.states.phase[at])]
        peak = float(motor.peak_at(self.duty.motor_speed[at : at + 1])[0])
        rms = math.sqrt(self.duty.states.integral(self.torque**2) / self.duty.states.cycle_time)
        of_rms = "RMS torque, rests included, against the rated torque"
        of_peak = f"torque against the curve of the motor, worst in “{name}”"
        if speed > motor.largest_speed:
            of_peak = (
                f"the motor has no torque above {units.shown(float(motor.largest_speed), _LARGEST_SPEED)}, where its "
                f"curve ends; the cycle needs {units.shown(speed, _LARGEST_SPEED)}"
            )
        of_speed = "speed of the motor against its largest"
        return (
            _check("motor_rms_torque", rms, motor.rated_torque, "N m", of_rms),
            _check("motor_peak_torque", float(abs(self.torque[at])), peak, "N m", of_peak),
            _check("motor_speed", speed, motor.largest_speed, "rad/s", of_speed),
        )


def _check(name: str, value: float, limit: Any, unit: str, text: str) -> Check:
    utilisation = value / float(limit) if limit else math.inf if value else 0.0
    return Check(name, float(value), float(limit), unit, utilisation, utilisation <= 1, text)

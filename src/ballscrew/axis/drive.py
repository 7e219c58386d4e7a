"""The motor and its drive: rated and peak torque over speed, and whether a duty fits."""

from __future__ import annotations

import dataclasses
import itertools
import math
from typing import Annotated, Any

import numpy as np

from ballscrew._arrays import ByValue, lazy
from ballscrew.axis.duty import Duty
from ballscrew.errors import Fault, faults_of, raise_if_any
from ballscrew.motion.states import Numbers
from ballscrew.quantities import AngularSpeed, Array, Energy, Info, Torque, Unit
from ballscrew.sizing.checks import Check

TorqueConstant = Annotated[Array, Unit("N m/A")]
Resistance = Annotated[Array, Unit("ohm")]


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Motor(ByValue):
    """A motor with its drive, by its data sheet.

    The peak torque holds up to the largest speed, or falls along a curve of points (speed, torque) with straight lines.
    Raises :class:`~ballscrew.errors.InputError` for values out of bounds, and for a curve whose speeds do not rise.
    """

    rated_torque: Annotated[Torque, Info("T_N", "torque that it gives for ever", "N m", above=0, hint="2.4 N m")]
    peak_torque: Annotated[Torque, Info("T_max", "torque that it gives for a short time", "N m", above=0, hint="7 N m")]
    largest_speed: Annotated[AngularSpeed, Info("n_max", "largest speed", "rpm", above=0, hint="3000 rpm")]
    curve: tuple[tuple[float, float], ...] = ()
    torque_constant: Annotated[
        TorqueConstant | None, Info("K_t", "torque over current", "N m/A", above=0, hint="0.5 N m/A")
    ] = None
    resistance: Annotated[
        Resistance | None, Info("R", "resistance that makes heat, of K_t² and i²R", "ohm", above=0, hint="1 ohm")
    ] = None

    def __post_init__(self) -> None:
        faults = faults_of("motor", self, optional=("torque_constant", "resistance"))
        if not faults and self.peak_torque < self.rated_torque:
            given = f"{float(self.peak_torque):g} N m"
            faults.append(Fault("motor.peak_torque", "is below the rated torque", given, "give the peak of the sheet"))
        speeds = [speed for speed, _ in self.curve]
        if any(after <= before for before, after in itertools.pairwise(speeds)):
            faults.append(Fault("motor.curve", "the speeds do not rise", "", "give points (speed, torque) by speed"))
        if any(not (speed >= 0 and torque >= 0) for speed, torque in self.curve):
            faults.append(Fault("motor.curve", "must not be negative", "", "give sizes of speeds and torques"))
        raise_if_any(faults)

    def peak_at(self, speed: Numbers) -> Numbers:
        """Largest torque at speeds of either sign, N m; zero beyond the largest speed."""
        size = np.abs(speed)
        if self.curve:
            speeds, torques = np.array(self.curve).T
            peak = np.interp(size, speeds, torques, right=0.0)
        else:
            peak = np.full_like(size, self.peak_torque)
        return np.where(size <= self.largest_speed, peak, 0.0)


@dataclasses.dataclass(frozen=True, eq=False)
class MotorCheck(ByValue):
    """A duty against a motor."""

    duty: Duty
    motor: Motor

    @lazy
    def utilisation(self) -> Numbers:
        """Torque over the peak torque at the speed of each state; infinite beyond the largest speed."""
        peak = self.motor.peak_at(self.duty.motor_speed)
        size = np.abs(self.duty.torque)
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
        return self.duty.states.integral(R * (self.duty.torque / K_t) ** 2)

    @property
    def checks(self) -> tuple[Check, ...]:
        """Torque for ever, torque for a short time and speed, each against what the motor gives."""
        at, motor = self.worst, self.motor
        speed = float(np.max(np.abs(self.duty.motor_speed)))
        name = self.duty.states.phases[int(self.duty.states.phase[at])]
        peak = float(motor.peak_at(self.duty.motor_speed[at : at + 1])[0])
        of_rms = "RMS torque, rests included, against the rated torque"
        of_peak = f"torque against the curve of the motor, worst in “{name}”"
        of_speed = "speed of the motor against its largest"
        return (
            _check("motor_rms_torque", self.duty.torque_rms, motor.rated_torque, "N m", of_rms),
            _check("motor_peak_torque", float(abs(self.duty.torque[at])), peak, "N m", of_peak),
            _check("motor_speed", speed, motor.largest_speed, "rad/s", of_speed),
        )


def _check(name: str, value: float, limit: Any, unit: str, text: str) -> Check:
    utilisation = value / float(limit) if limit else math.inf if value else 0.0
    return Check(name, float(value), float(limit), unit, utilisation, utilisation <= 1, text)

"""The motor with its drive: rated and peak torque over speed, by its data sheet."""

from __future__ import annotations

import dataclasses
import itertools
from typing import Annotated

import numpy as np

from ballscrew.axis.motion.states import Numbers
from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import Fault, faults_of, raise_if_any, shown
from ballscrew.basis.quantities import AngularSpeed, Array, Info, Torque, Unit

TorqueConstant = Annotated[Array, Unit("N m/A")]
Resistance = Annotated[Array, Unit("ohm")]


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Motor(ByValue):
    """A motor with its drive, by its data sheet.

    The peak torque holds up to the largest speed, or falls along a ``curve`` of points (speed in rad/s, torque in N m)
    with straight lines.
    Raises :class:`~ballscrew.basis.errors.InputError` for values out of bounds, and for a curve whose speeds do not
    rise.
    """

    rated_torque: Annotated[
        Torque, Info("T_N", "torque that it gives for ever", "N m", above=0, hint="2.4 N m", usual=(0.01, 1000.0))
    ]
    peak_torque: Annotated[
        Torque,
        Info("T_max", "torque that it gives for a short time", "N m", above=0, hint="7 N m", usual=(0.01, 3000.0)),
    ]
    largest_speed: Annotated[
        AngularSpeed, Info("n_max", "largest speed", "rpm", above=0, hint="3000 rpm", usual=(1.0, 5000.0))
    ]
    curve: tuple[tuple[float, float], ...] = ()
    torque_constant: Annotated[
        TorqueConstant | None, Info("K_t", "torque over current", "N m/A", above=0, hint="0.5 N m/A")
    ] = None
    resistance: Annotated[
        Resistance | None, Info("R", "resistance that makes heat, of K_t² and i²R", "ohm", above=0, hint="1 ohm")
    ] = None
    holding_torque: Annotated[
        Torque | None,
        Info(
            "M_h",
            "torque without current at rest: detent, friction; shorted windings have none there",
            "N m",
            at_least=0,
            hint="0.1 N m",
            usual=(0.0, 100.0),
        ),
    ] = None

    def __post_init__(self) -> None:
        faults = faults_of("motor", self, optional=("torque_constant", "resistance", "holding_torque"))
        if not faults and self.peak_torque < self.rated_torque:
            given = f"{float(self.peak_torque):g} N m"
            faults.append(Fault("motor.peak_torque", "is below the rated torque", given, "give the peak of the sheet"))
        speeds = [speed for speed, _ in self.curve]
        if any(after <= before for before, after in itertools.pairwise(speeds)):
            faults.append(Fault("motor.curve", "the speeds do not rise", "", "give points (speed, torque) by speed"))
        if len(self.curve) == 1:
            faults.append(Fault("motor.curve", "has one point only", "", "give two at least, or leave it out"))
        faults += self._misfits()
        if any(not (speed >= 0 and torque >= 0) for speed, torque in self.curve):
            faults.append(Fault("motor.curve", "must not be negative", "", "give sizes of speeds and torques"))
        raise_if_any(faults)

    def _misfits(self) -> list[Fault]:
        """Faults of a curve against the numbers of the data sheet beside it."""
        if len(self.curve) < 2:
            return []
        misfits: list[Fault] = []
        highest, last = max(torque for _, torque in self.curve), self.curve[-1][0]
        if highest > self.peak_torque * (1 + 1e-9):
            given, remedy = f"{highest:g} N m", "check the unit of the points, or give the peak torque of the curve"
            misfits.append(Fault("motor.curve", "lies above the peak torque", given, remedy))
        if last < self.largest_speed * (1 - 1e-9):
            remedy = "add a point at the largest speed"
            misfits.append(Fault("motor.curve", "ends below the largest speed", shown(last, "rad/s"), remedy))
        return misfits

    def peak_at(self, speed: Numbers) -> Numbers:
        """Largest torque at each ``speed`` (rad/s) of either sign, N m; zero beyond the largest speed."""
        size = np.abs(speed)
        if self.curve:
            speeds, torques = np.array(self.curve).T
            peak = np.interp(size, speeds, torques, right=0.0)
        else:
            peak = np.full_like(size, self.peak_torque)
        return np.where(size <= self.largest_speed, peak, 0.0)

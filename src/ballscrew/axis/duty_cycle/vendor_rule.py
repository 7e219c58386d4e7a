"""Torques as catalogues compute them in their worked examples, to be held against those by mechanics."""

from __future__ import annotations

import dataclasses
import math

import numpy as np

from ballscrew.axis.duty_cycle.duty import Duty
from ballscrew.axis.motion.states import Numbers
from ballscrew.basis.arrays import ByValue, lazy
from ballscrew.basis.quantities import Ratio, Torque


@dataclasses.dataclass(frozen=True, eq=False)
class VendorRule(ByValue):
    r"""The rule of THK514E (selection of the motor) for the torque of a duty.

    .. math:: \tau = \frac{F P_h}{2 \pi \eta} + \left(J + m \left(\frac{P_h}{2 \pi}\right)^2\right) \alpha

    F has weight, process and friction of the guides, but no inertia: the mass is an inertia of its own, for which the
    efficiency does not count. The force is divided by the efficiency also where it drives the screw, so that a load
    which is lowered asks for more torque than it can give: mechanics has :math:`F P_h/2\pi (2 - 1/\eta)`. At rest
    the friction of the guides helps to hold.
    """

    duty: Duty
    efficiency: Ratio

    @lazy
    def force(self) -> Numbers:
        """Force along the axis without inertia, N."""
        loads = self.duty.loads
        steady = loads.gravity + loads.process
        held = self.duty.axis.resting_guide_friction
        rests = self.duty.states.direction == 0
        left = np.sign(steady) * np.maximum(np.abs(steady) - held, 0.0)
        return np.where(rests, left, steady + loads.guides + loads.guide_seals)

    @lazy
    def torque(self) -> Numbers:
        """Torque of the motor, N m."""
        axis, lead = self.duty.axis, float(self.duty.driven.lead)
        arm = lead / (2 * math.pi) / axis.transmission_ratio
        inertia = axis.turning_inertia + axis.moving_mass * arm**2
        rubs = sum(self.duty.support_friction.values(), np.zeros_like(self.force))
        friction = self.duty.states.direction * rubs / axis.transmission_ratio
        turned = self.force * arm / self.efficiency + friction
        held = np.where((self.duty.states.direction == 0) & axis.brake_holds, 0.0, turned)
        return held / axis.transmission_efficiency + inertia * self.duty.states.acceleration / arm

    @lazy
    def torque_rms(self) -> Torque:
        """Root mean square of the torque, N m."""
        return math.sqrt(self.duty.states.integral(self.torque**2) / self.duty.states.cycle_time)

    @property
    def torque_peak(self) -> Torque:
        """Largest size of the torque, N m."""
        return float(np.max(np.abs(self.torque)))

"""A nut whose friction torque is a product of powers, so that all that is found from its torques has a closed form.

The logarithm of the torque is a plane in the logarithms of preload, speed and boundary friction, and in the
temperature: ``ln M = ln M_0 + p ln(F/F_0) + q ln(ω/ω_0) + s ln(µ/µ_0) − c (T − T_0)``.
"""

from __future__ import annotations

import math
import types

import ballscrew as bs
from ballscrew.basis.arrays import namespace
from support.service_logs import OIL, PRELOAD, WARM

#: Torque, N m, at the preload, temperature and boundary friction of the case, and the speed there, rad/s.
TORQUE, SPEED = 0.3, 10.0
#: Powers of preload, speed and boundary friction, and what a kelvin takes.
P, Q, S, PER_KELVIN = 0.8, 0.15, 0.4, 0.02
BOUNDARY_FRICTION = 0.2
#: Torque of a load without friction, N m/N.
LEVER = 0.01 / (2 * math.pi)


class PowerLaw(bs.FrictionModel):
    """The torque as a product of powers, beside the losses of the nut that are constant."""

    def __call__(self, screw, lubricant, *, axial_load, screw_speed):
        """As those of any model, as far as a service reads it."""
        losses = {
            name: one.seal_torque if isinstance(one, bs.Seals) else one.constant_torque
            for name, one in screw.nut.losses.items()
        }
        torque = sum(losses.values()) + torque_of(
            screw.nut.preload / PRELOAD,
            screw_speed,
            _kelvin_beyond(lubricant),
            self.friction.boundary_friction_coefficient / BOUNDARY_FRICTION,
        )
        return types.SimpleNamespace(
            screw_torque=torque + 0.0 * axial_load,
            ideal_torque=LEVER * axial_load + 0.0 * torque,
            loads=types.SimpleNamespace(lift_off_load=2**1.5 * screw.nut.preload),
            contributions=losses,
        )


MODEL = PowerLaw.olaru2005()


def torque_of(share=1.0, speed=SPEED, warmer=0.0, friction=1.0):
    """Friction torque, N m, by shares of preload and boundary friction, the speed and the kelvin beyond the case."""
    heat = namespace(warmer).exp(-PER_KELVIN * warmer)
    return TORQUE * share**P * (speed / SPEED) ** Q * friction**S * heat


def _kelvin_beyond(lubricant: bs.Lubricant):
    """By the temperature of an oil of a grade, by the viscosity of another one."""
    if lubricant.follows_temperature:
        return lubricant.temperature - WARM
    thinner = OIL.viscosity / lubricant.viscosity
    return namespace(thinner).log(thinner) / OIL.temperature_coefficient

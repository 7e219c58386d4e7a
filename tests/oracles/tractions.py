r"""Local laws of traction: the shear stress at one point of a contact, from pressure and sliding speed there.

Each law is monotone in the sliding speed s, so it has a convex potential :math:`\psi(p, s)` with
:math:`\tau = \partial\psi/\partial s`; that is what makes the balance of a ball the minimum of a
convex function (:mod:`oracles.contact_integral`).
"""

from __future__ import annotations

import dataclasses
from typing import Annotated, Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.quantities import Info, Length, Pressure, PressureCoefficient, Ratio, Viscosity
from ballscrew.physics.equations import friction, rheology

#: Values at the points of a contact, or components of a vector.
Field: TypeAlias = NDArray[np.float64]

#: Above this an oil is a solid to any contact, and products of viscosities no longer fit a float, Pa s.
STIFFEST = 1e30
#: Roelands' law needs a viscosity above this, Pa s: it takes the logarithm of the ratio.
THINNEST = 6.3e-5


class TractionLaw(Protocol):
    """Shear stress against sliding speed at one pressure, speeds without a sign."""

    def stress(self, pressure: Field, slip: Field, /) -> Field:
        """Shear stress, Pa."""
        ...

    def slope(self, pressure: Field, slip: Field, /) -> Field:
        """Derivative of the stress by the sliding speed, Pa s/m; never negative."""
        ...

    def potential(self, pressure: Field, slip: Field, /) -> Field:
        """Integral of the stress over the sliding speed from rest, W/m²."""
        ...


@dataclasses.dataclass(frozen=True, eq=False)
class Coulomb:
    r"""Dry or boundary friction, the same coefficient everywhere.

    .. math:: \tau = \mu p

    Whatever the sliding speed is: torques do not depend on speed, slip power is proportional to it.
    """

    friction_coefficient: Annotated[
        Ratio, Info(r"\mu", "friction coefficient", above=0, hint="boundary friction is 0.08 to 0.2")
    ]

    def stress(self, pressure: Field, slip: Field) -> Field:
        """Shear stress, Pa."""
        return self.friction_coefficient * pressure + 0 * slip

    def slope(self, pressure: Field, slip: Field) -> Field:
        """Zero, Pa s/m."""
        return 0 * (pressure + slip)

    def potential(self, pressure: Field, slip: Field) -> Field:
        """Integral of the stress over the sliding speed, W/m²."""
        return self.friction_coefficient * pressure * slip


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class _Film:
    """An oil film of one thickness, whose viscosity follows the local pressure by Roelands' law."""

    viscosity: Annotated[
        Viscosity,
        Info(
            r"\eta_0", "viscosity at ambient pressure", "mPa s", above=THINNEST, hint="oils have 0.005 Pa s to 1 Pa s"
        ),
    ]
    pressure_viscosity_coefficient: Annotated[
        PressureCoefficient,
        Info(r"\alpha_p", "pressure–viscosity coefficient", "1/GPa", above=0, hint="mineral oils have 1e-8 to 2.5e-8"),
    ]
    film_thickness: Annotated[
        Length,
        Info("h_c", "film thickness in the middle of the contact", "um", above=0, hint="films have 0.01 um to 1 um"),
    ]

    def _film_viscosity(self, pressure: Field) -> Field:
        exponent = rheology.roelands_exponent(self.viscosity, self.pressure_viscosity_coefficient)
        with np.errstate(over="ignore"):
            return np.minimum(rheology.roelands_viscosity(self.viscosity, pressure, exponent), STIFFEST)


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Eyring(_Film):
    r"""A film that thins with the rate of shear.

    .. math:: \tau = \tau_E \sinh^{-1}\frac{\eta(p) s}{\tau_E h_c}

    Eyring1936, JohnsonTevaarwerk1977; :math:`\eta(p)` by Roelands1966. Isothermal, one film thickness
    all over the contact, no limit: at high pressure compare :class:`LimitingShear`.
    """

    eyring_stress: Annotated[
        Pressure, Info(r"\tau_E", "Eyring stress", "MPa", above=0, hint="mineral oils have 2e6 Pa to 10e6 Pa")
    ]

    def stress(self, pressure: Field, slip: Field) -> Field:
        """Shear stress, Pa."""
        rate = friction.film_shear_rate(slip, self.film_thickness)
        return friction.eyring_shear_stress(self._film_viscosity(pressure), rate, self.eyring_stress)

    def slope(self, pressure: Field, slip: Field) -> Field:
        """Derivative of the stress by the sliding speed, Pa s/m."""
        return self.eyring_stress / np.hypot(slip, self._newtonian_speed(pressure))

    def potential(self, pressure: Field, slip: Field) -> Field:
        """Integral of the stress over the sliding speed, W/m²."""
        scale = self._newtonian_speed(pressure)
        speeds = slip * np.arcsinh(slip / scale) - slip**2 / (np.hypot(slip, scale) + scale)
        return self.eyring_stress * speeds

    def _newtonian_speed(self, pressure: Field) -> Field:
        """Sliding speed at which a Newtonian film would reach the Eyring stress."""
        return self.eyring_stress * self.film_thickness / self._film_viscosity(pressure)


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class LimitingShear(_Film):
    r"""A film that yields at a share of the local pressure.

    .. math:: \tau = \Lambda p \left(1 - \exp\left(-\frac{\eta(p) s}{\Lambda p h_c}\right)\right)

    BairWiner1979 without the elastic part; :math:`\eta(p)` by Roelands1966. Isothermal, one film
    thickness all over the contact.
    """

    limiting_shear_coefficient: Annotated[
        Ratio, Info(r"\Lambda", "limiting shear stress / pressure", above=0, hint="mineral oils have 0.05 to 0.1")
    ]

    def stress(self, pressure: Field, slip: Field) -> Field:
        """Shear stress, Pa."""
        rate = friction.film_shear_rate(slip, self.film_thickness)
        limit = friction.limiting_shear_stress(pressure, self.limiting_shear_coefficient)
        return friction.bair_winer_shear_stress(self._film_viscosity(pressure), rate, limit)

    def slope(self, pressure: Field, slip: Field) -> Field:
        """Derivative of the stress by the sliding speed, Pa s/m."""
        newtonian = self._film_viscosity(pressure) / self.film_thickness
        return newtonian * np.exp(-slip / self._yield_speed(pressure))

    def potential(self, pressure: Field, slip: Field) -> Field:
        """Integral of the stress over the sliding speed, W/m²."""
        scale = self._yield_speed(pressure)
        limit = friction.limiting_shear_stress(pressure, self.limiting_shear_coefficient)
        return limit * (slip + scale * np.expm1(-slip / scale))

    def _yield_speed(self, pressure: Field) -> Field:
        """Sliding speed at which a Newtonian film would reach the limiting stress."""
        limit = friction.limiting_shear_stress(pressure, self.limiting_shear_coefficient)
        return limit * self.film_thickness / self._film_viscosity(pressure)

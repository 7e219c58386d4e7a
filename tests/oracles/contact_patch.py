r"""One contact of a ball as a patch of points: it answers a twist with a wrench.

The common surface of ball and groove bends across the path like a circle of radius
:math:`R_d = 2 d_w f/(2f + 1)` and is straight along the path. A point lies at x along and y across the
path, :math:`d = R_d - \sqrt{R_d^2 - y^2}` below the middle of the contact, and its normal leans by
:math:`\sin\theta = y/R_d`. There presses the Hertz pressure of the exact ellipse,
:math:`p = p_0\sqrt{1 - (x/b)^2 - (y/a)^2}`.

The race moves against the ball with the *twist* :math:`(u_t, u_c, w_t, w_c, w_N)`: velocities along
and across the path at the middle of the contact, and the rotation about the directions along, across
and normal (the outward normal of the ball; along × across = normal). The slip is what the tangent
plane sees of it,

.. math:: s_t = u_t - w_c d - w_N y, \quad
    s_c = (u_c + w_N x + w_t d) \cos\theta - (w_t y - w_c x) \sin\theta

The *wrench* is the force along and across, and the moment about the same three axes through the
middle of the contact, that the race puts on the ball: the power of the wrench on the twist is the
power dissipated.

Left out: the bend of the surface along the path, elastic (Heathcote) micro-slip, the change of
pressure by traction, and edges of the groove.
"""

from __future__ import annotations

import dataclasses
import functools
from typing import NamedTuple

import numpy as np

from ballscrew.basis.quantities import Force, Length, Pressure, Ratio
from ballscrew.physics.equations import geometry, hertz, rheology
from oracles.tractions import Field, TractionLaw


class Ellipse(NamedTuple):
    """A Hertz contact ellipse and the radius of its surface across the path."""

    across: Length
    along: Length
    maximum_pressure: Pressure
    deformed_radius: Length

    @property
    def fits(self) -> bool:
        """Whether the circle of the common surface is wide enough for the ellipse."""
        return bool(0 < self.across < self.deformed_radius)


def hertz_ellipse(
    contact_load: Force, equivalent_modulus: Pressure, ball_diameter: Length, conformity: Ratio, rolling_radius: Length
) -> Ellipse:
    """The exact Hertz ellipse of a ball in a groove (Johnson1985 §4.2)."""
    k = geometry.radii_ratio(geometry.transverse_radius(ball_diameter, conformity), rolling_radius)
    kappa = hertz.ellipticity(k)
    major = hertz.semi_major_axis_coefficient(k, kappa, hertz.elliptic_integrals(kappa).E)
    W = rheology.load_parameter(contact_load, equivalent_modulus, rolling_radius)
    return Ellipse(
        across=float(hertz.semi_axis(major, rolling_radius, W)),
        along=float(hertz.semi_axis(major / kappa, rolling_radius, W)),
        maximum_pressure=float(hertz.maximum_pressure(major, major / kappa, equivalent_modulus, W)),
        deformed_radius=float(geometry.deformed_radius(ball_diameter, conformity)),
    )


@functools.cache
def _gauss_legendre(points: int) -> tuple[Field, Field]:
    """Points and weights between -1 and 1: an eigenvalue problem, worth keeping."""
    return np.polynomial.legendre.leggauss(points)


class SlipField(NamedTuple):
    """Positions, pressure, slip of the race against the ball, and the shear it puts on the ball, at every point."""

    along: Field
    across: Field
    pressure: Field
    area: Field
    slip_along: Field
    slip_across: Field
    shear_along: Field
    shear_across: Field

    @property
    def dissipation(self) -> float:
        """Power of the shear on the slip, summed point by point, W."""
        return float(self.area @ (self.shear_along * self.slip_along + self.shear_across * self.slip_across))


class Answer(NamedTuple):
    """What a contact does under a twist: its wrench, the slope of that, and the most it could carry."""

    wrench: Field
    slope: Field
    capacity: float


@dataclasses.dataclass(frozen=True, eq=False)
class ContactPatch:
    """Points of one contact with pressure and area, and the law of traction at each."""

    law: TractionLaw
    along: Field
    across: Field
    depth: Field
    sine: Field
    cosine: Field
    pressure: Field
    area: Field

    @classmethod
    def of(cls, ellipse: Ellipse, law: TractionLaw, resolution: tuple[int, int]) -> ContactPatch:
        """Gauss–Legendre points across the path, Chebyshev points of the second kind along it.

        Pressure times area sums to the load to the last digit, whatever the resolution.
        """
        points_across, points_along = resolution
        eta, weight = _gauss_legendre(points_across)
        angle = np.arange(1, points_along + 1) * np.pi / (points_along + 1)
        half_chord = np.sqrt(1 - eta**2)[:, None]
        t = np.broadcast_to(eta[:, None], (points_across, points_along)).ravel()
        s = (half_chord * np.cos(angle)).ravel()
        a, b, p_0, R_d = ellipse
        pressure = p_0 * (half_chord * np.sin(angle)).ravel()
        share = (weight[:, None] * half_chord**2 * np.sin(angle) ** 2).ravel()
        load = 2 * np.pi / 3 * p_0 * a * b * share / share.sum()
        y = a * t
        sine = y / R_d
        cosine = np.sqrt(1 - sine**2)
        depth = y * sine / (1 + cosine)
        return cls(law, b * s, y, depth, sine, cosine, pressure, load / pressure)

    @functools.cached_property
    def _twist_to_slip(self) -> tuple[Field, Field]:
        """Slip along and across at each point for each component of the twist."""
        x, y, d, sine, cosine = self.along, self.across, self.depth, self.sine, self.cosine
        one, none = np.ones_like(x), np.zeros_like(x)
        to_along = np.stack([one, none, none, -d, -y], axis=-1)
        to_across = np.stack([none, cosine, d * cosine - y * sine, x * sine, x * cosine], axis=-1)
        return to_along, to_across

    def slip(self, twist: Field) -> tuple[Field, Field]:
        """Sliding speed of the race against the ball along and across the path at each point, m/s."""
        to_along, to_across = self._twist_to_slip
        return to_along @ twist, to_across @ twist

    def answer(self, twist: Field, blur: float) -> Answer:
        r"""The wrench under a twist, where speeds read :math:`\sqrt{s^2 + blur^2}`.

        The blur, above zero, rounds off the jump of dry friction where the slip changes sign. The slope
        is the matrix of derivatives of the wrench by the twist: symmetric, and positive as the law is.
        """
        to_along, to_across = self._twist_to_slip
        s_t, s_c = to_along @ twist, to_across @ twist
        speed = np.sqrt(s_t**2 + s_c**2 + blur**2)
        stress = self.law.stress(self.pressure, speed)
        drag = self.area * stress / speed
        wrench = to_along.T @ (drag * s_t) + to_across.T @ (drag * s_c)
        # more slip of the same direction raises the stress, slip of another direction turns it
        raising, turning = self.area * self.law.slope(self.pressure, speed) / speed**2, drag / speed**2
        along = (raising * s_t**2 + turning * (s_c**2 + blur**2))[:, None]
        mixed = ((raising - turning) * s_t * s_c)[:, None]
        across = (raising * s_c**2 + turning * (s_t**2 + blur**2))[:, None]
        slope = to_along.T @ (along * to_along + mixed * to_across)
        slope += to_across.T @ (mixed * to_along + across * to_across)
        return Answer(wrench, slope, float(self.area @ stress))

    def field(self, twist: Field, blur: float) -> SlipField:
        """Slip and shear at every point under a twist."""
        s_t, s_c = self.slip(twist)
        speed = np.sqrt(s_t**2 + s_c**2 + blur**2)
        drag = self.law.stress(self.pressure, speed) / speed
        return SlipField(self.along, self.across, self.pressure, self.area, s_t, s_c, drag * s_t, drag * s_c)

    def potential(self, twist: Field, blur: float) -> float:
        """Integral of the law's potential over the contact, W: its gradient by the twist is the wrench."""
        s_t, s_c = self.slip(twist)
        return float(self.area @ self.law.potential(self.pressure, np.sqrt(s_t**2 + s_c**2 + blur**2)))

"""Equations and figures that the tests alone need, to compare the package with."""

from __future__ import annotations

import math

import numpy as np

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import Angle, Energy, Force, Length, Ratio
from ballscrew.physics.equations.rolling import SMALLEST
from ballscrew.physics.moving_balls.loaded_zone import Groove


def speed_deviation(
    curvature_ratio: Ratio, contact_angle: Angle, contact_angle_change: Angle, path_shift: Length, path_radius: Length
) -> Ratio:
    r"""Deviation of the natural speed of a ball, over that speed, with both contact angles changed alike.

    .. math:: \epsilon = \frac{\gamma}{1 - \gamma} \tan(\alpha) \Delta_\alpha + \frac{e_L}{L (1 - \gamma)}

    The slope of :func:`~ballscrew.physics.equations.kinematics.orbital_speed`, which goes with
    :math:`L (1 - \gamma)`, where :math:`\gamma L` depends on the angle alone. The shift of the path is the mean of
    those of the two grooves.
    """
    gamma, alpha, Delta_alpha, e_L, L = (
        curvature_ratio, contact_angle, contact_angle_change, path_shift, path_radius,
    )  # fmt: skip
    xp = namespace(gamma, alpha, Delta_alpha, e_L, L)
    return gamma / (1 - gamma) * xp.tan(alpha) * Delta_alpha + e_L / (L * (1 - gamma))


def rigid_regime_share_ellipse(
    ellipse_shape_parameter: Ratio, ellipticity: Ratio, load_parameter: Ratio, speed_parameter: Ratio
) -> Ratio:
    r"""Share of the rolling force that follows the isoviscous-rigid asymptote, by the Hertz ellipse.

    .. math:: s = \frac{6.6 \kappa (2 U)^{3/4}}{6.6 \kappa (2 U)^{3/4} + \beta^{1/4} W}

    BibouletHoupert2010 (32). Limits as in :func:`rigid_regime_share`.
    """
    beta, kappa, W, U = ellipse_shape_parameter, ellipticity, load_parameter, speed_parameter
    xp = namespace(beta, kappa, W, U)
    rigid = 6.6 * kappa * (2 * U) ** 0.75
    return rigid / xp.maximum(rigid + beta ** (1 / 4) * W, SMALLEST)


def first_integral_brewe_hamrock(radii_ratio: Ratio) -> Ratio:
    r"""Complete elliptic integral of the first kind, without solving for the ellipticity.

    .. math:: K = \frac{\pi}{2} + \left(\frac{\pi}{2} - 1\right) \ln k

    BreweHamrock1977. For 1 ≤ k ≤ 100: within 2.1 % there.
    """
    k = radii_ratio
    xp = namespace(k)
    return xp.pi / 2 + (xp.pi / 2 - 1) * xp.log(k)


def line_traction_ratio(lower_line: Ratio, upper_line: Ratio) -> Ratio:
    r"""Net force of a contact, friction times load being one, that slips backwards between two lines.

    .. math:: T = 1 - \frac{3}{2} (t_2 - t_1) + \frac{1}{2} \left(t_2^3 - t_1^3\right)
    """
    t_1, t_2 = lower_line, upper_line
    return 1 - 3 / 2 * (t_2 - t_1) + 1 / 2 * (t_2**3 - t_1**3)


def guide_life(dynamic_load_rating: Force, equivalent_load: Force, service_factor: Ratio) -> Length:
    r"""Basic rating life of carriages with balls, as a distance.

    .. math:: L = 50000 \left(\frac{C}{f_w P}\right)^3

    For a rating C at 50 km, as most catalogues of Asia print it; one at 100 km is 1.26 times smaller for the same
    carriage. The factor is 1 without shocks.
    """
    C, P, f_w = dynamic_load_rating, equivalent_load, service_factor
    return 50000 * (C / (f_w * P)) ** 3


def mirrored(groove: Groove, angle: Angle) -> Groove:
    """The groove seen in a mirror across its axis: what lay at an angle lies at ``angle`` less that one."""
    multiples = angle * np.arange(1, groove.harmonics.shape[-1] + 1)
    cosine, sine = groove.harmonics[:, 0], groove.harmonics[:, 1]
    turned = np.stack(
        [
            cosine * np.cos(multiples) + sine * np.sin(multiples),
            cosine * np.sin(multiples) - sine * np.cos(multiples),
        ],
        axis=1,
    )
    return Groove(turned * np.array([-1.0, 1.0])[:, None, None])


def mechanical_energy(found) -> Energy:
    r"""Change of kinetic and potential energy of a duty by its states themselves, J.

    :math:`\frac12 (m + J (2 \pi i/P_h)^2) \Delta v^2 + F_g \Delta x`, phase by phase: a jump of the speed between
    two phases is left out.
    """
    turns = 2 * math.pi * found.axis.transmission_ratio / float(found.driven.lead)
    mass = found.axis.moving_mass + found.axis.turning_inertia * turns**2
    kinetic = sum(mass * (after**2 - before**2) / 2 for before, after in found.states.speeds_of_ends)
    rise = found.states.integral(found.states.speed)
    return float(kinetic + found.axis.gravity_force * rise)


def amplitude_of(found, name: str) -> float:
    """Amplitude of a named order of a ripple, N m."""
    return next(float(one.amplitude) for one in found.orders if one.name == name)

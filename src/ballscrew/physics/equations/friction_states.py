r"""Friction with a state, as control engineering writes it: what the torque is after so much rotation.

The state is a deflection that winds up. Dahl and LuGre have one stiffness :math:`\sigma_0`, which wears off as the
torque comes near its limit; a Maxwell-slip element is a spring in series with a block that slides, and several of them
side by side have a stiffness for each range of the rotation.
"""

from __future__ import annotations

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import (
    Angle,
    AngularSpeed,
    MomentOfInertia,
    Ratio,
    RotationalDamping,
    RotationalStiffness,
    Torque,
)


def dahl_torque(
    presliding_stiffness: RotationalStiffness, coulomb_torque: Torque, initial_torque: Torque, screw_angle: Angle
) -> Torque:
    r"""Torque of the model of Dahl after a rotation in one direction.

    .. math:: M = M_c - (M_c - M_0) \exp\left(-\frac{\sigma_0 \theta}{M_c}\right)

    Dahl1968, with the exponent one: the solution of
    :math:`\mathrm{d}M/\mathrm{d}\theta = \sigma_0 (1 - M/M_c)` from the torque :math:`M_0` at the start, which is
    :math:`-M_c` after a long way in the other direction, and zero from rest. For a rotation of zero or more.
    """
    sigma_0, M_c, M_0, theta = presliding_stiffness, coulomb_torque, initial_torque, screw_angle
    xp = namespace(sigma_0, M_c, M_0, theta)
    return M_c - (M_c - M_0) * xp.exp(-sigma_0 * theta / M_c)


def lugre_torque(
    elastic_torque: Torque,
    coulomb_torque: Torque,
    micro_damping: RotationalDamping,
    viscous_slope: RotationalDamping,
    screw_speed: AngularSpeed,
) -> Torque:
    r"""Torque of the model LuGre at a steady speed.

    .. math:: M = M_z + \sigma_1 \omega \left(1 - \frac{M_z}{M_c}\right) + \sigma_2 \omega

    CanudasDeWit1995. The bristles hold :math:`M_z = \sigma_0 z`, and their deflection z grows by
    :math:`\omega (1 - M_z/M_c)`, where :math:`M_c` is what they hold at this speed. So at a steady speed
    :math:`M_z` is the torque of Dahl (:func:`dahl_torque`), however slow it is. For a speed above zero.
    """
    M_z, M_c, sigma_1, sigma_2, omega = elastic_torque, coulomb_torque, micro_damping, viscous_slope, screw_speed
    return M_z + sigma_1 * omega * (1 - M_z / M_c) + sigma_2 * omega


def micro_damping(
    presliding_stiffness: RotationalStiffness, moment_of_inertia: MomentOfInertia, damping_ratio: Ratio
) -> RotationalDamping:
    r"""Damping of the bristles with which an inertia that sticks on them swings with a damping ratio.

    .. math:: \sigma_1 = 2 \zeta \sqrt{\sigma_0 J}

    A choice and no property of the contact: the example of CanudasDeWit1995 has :math:`\zeta = 1/2`.
    """
    sigma_0, J, zeta = presliding_stiffness, moment_of_inertia, damping_ratio
    xp = namespace(sigma_0, J, zeta)
    return 2 * zeta * xp.sqrt(sigma_0 * J)


def slip_element_torque(
    element_stiffness: RotationalStiffness, slip_torque: Torque, initial_torque: Torque, screw_angle: Angle
) -> Torque:
    r"""Torque of a Maxwell-slip element, a spring in series with a block that slides, after a rotation.

    .. math:: M = \min\left(\max\left(M_0 + k \theta, -M_s\right), M_s\right)

    Lampaert2003, below the speeds at which the sliding torque depends on the speed. Exact for a rotation
    :math:`\theta` of either sign that does not turn back on its way.
    """
    k, M_s, M_0, theta = element_stiffness, slip_torque, initial_torque, screw_angle
    xp = namespace(k, M_s, M_0, theta)
    return xp.minimum(xp.maximum(M_0 + k * theta, -M_s), M_s)

"""Preload: drag torque of a nut without load, and the load on its halves."""

from __future__ import annotations

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import Angle, Force, Length, Ratio, Torque


def preload_torque(preload_torque_coefficient: Ratio, preload: Force, lead: Length) -> Torque:
    r"""Drag torque of a preloaded nut without load, as a share of the torque that would lift the preload.

    .. math:: T = \frac{K_p F_{pr} P_h}{2 \pi}

    JISB1192, as THK514E prints it. Seals come on top.
    """
    K_p, F_pr, P_h = preload_torque_coefficient, preload, lead
    xp = namespace(K_p, F_pr, P_h)
    return K_p * F_pr * P_h / (2 * xp.pi)


def preload_torque_coefficient(lead_angle: Angle, drag_coefficient: Ratio, drag_exponent: Ratio) -> Ratio:
    r"""Share of the preload's ideal torque that is drag, from the lead angle alone.

    .. math:: K_p = \frac{k_p}{\left(\tan\varphi\right)^{m}}

    JISB1192, as THK514E prints it, with 0.05 and 0.5: then the torque is
    :math:`0.0141 F_{pr} \sqrt{d_m P_h}`. A rule for all nuts and oils; a catalogue's example allows 30 %
    on both sides. Without limit where the lead vanishes.
    """
    phi, k_p, m = lead_angle, drag_coefficient, drag_exponent
    xp = namespace(phi, k_p, m)
    return k_p / xp.tan(phi) ** m


def preload_torque_coefficient_of_halves(efficiency: Ratio, back_driving_efficiency: Ratio) -> Ratio:
    r"""Share of the preload's ideal torque that is drag, from the efficiency of each half of a double nut.

    .. math:: K_p = \frac{1}{\eta} - \eta_b

    One half is driven against the preload, the other is driven by it. With the same friction torque
    :math:`M_S` in both it is :math:`2 M_S` over the ideal torque. Both efficiencies at the preload.
    """
    eta, eta_b = efficiency, back_driving_efficiency
    return 1 / eta - eta_b


def diameter_drag_torque(preload: Force, nominal_diameter: Length, drag_coefficient: Ratio) -> Torque:
    r"""Drag torque of a preloaded nut without load, as a friction force on the nominal diameter.

    .. math:: T = c_p F_{pr} d_0

    The rule behind the tables of Rexroth2006, at 100 rpm and without seals: any lead from 5 mm to 40 mm,
    diameters from 16 mm to 125 mm. The coefficient is that of the kind of nut.
    """
    F_pr, d_0, c_p = preload, nominal_diameter, drag_coefficient
    return c_p * F_pr * d_0


def forward_half_load(preload: Force, relative_displacement: Ratio) -> Force:
    r"""Axial load of the half of a double nut that an external load presses on.

    .. math:: F_f = F_{pr} (1 + x)^{3/2}

    Hertz contacts only, all balls of a half alike; the displacement is in units of what the preload
    alone approaches either half. The external load is this less :func:`backward_half_load`.
    """
    F_pr, x = preload, relative_displacement
    return F_pr * (1 + x) ** 1.5


def backward_half_load(preload: Force, relative_displacement: Ratio) -> Force:
    r"""Axial load of the half of a double nut that an external load relieves.

    .. math:: F_b = F_{pr} \left(\max\left(1 - x, 0\right)\right)^{3/2}

    As :func:`forward_half_load`; zero from a displacement of one on, where the half lifts off. The same is left of a
    preload whose approach heat takes, by so much in units of it.
    """
    F_pr, x = preload, relative_displacement
    xp = namespace(F_pr, x)
    return F_pr * xp.maximum(1 - x, 0.0) ** 1.5


def lift_off_load(preload: Force) -> Force:
    r"""External load at which the relieved half of a double nut no longer carries anything.

    .. math:: F = 2^{3/2} F_{pr}

    What catalogues call about three times the preload (THK514E). Hertz contacts only.
    """
    F_pr = preload
    return 2**1.5 * F_pr

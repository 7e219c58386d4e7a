"""Formulas of the makers of bearings and guides, and of what gives way: plain functions, as those of ``equations/``.

Moments of bearings are fits in millimetres, rpm and mm²/s. SI comes in and goes out; the powers of ten in the formulas
are the units of the catalogues.
"""

from __future__ import annotations

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import (
    AngularSpeed,
    Force,
    KinematicViscosity,
    Length,
    Pressure,
    Ratio,
    RotationalStiffness,
    Stiffness,
    Torque,
)


def inlet_heating_factor(kinematic_viscosity: KinematicViscosity, speed: AngularSpeed, mean_diameter: Length) -> Ratio:
    r"""Share of the rolling moment that the heat of the inlet leaves.

    .. math:: \phi_h = \frac{1}{1 + 1.84 \cdot 10^{-9} \left(30000 \omega d_m / \pi\right)^{1.28}
        \left(10^6 \nu\right)^{0.64}}

    SKF2018, as two public programs have it; the page itself was not read. One at rest.
    """
    nu, omega, d_m = kinematic_viscosity, speed, mean_diameter
    xp = namespace(nu, omega, d_m)
    return 1 / (1 + 1.84e-9 * (30000 * omega * d_m / xp.pi) ** 1.28 * (1e6 * nu) ** 0.64)


def bearing_replenishment_factor(
    kinematic_viscosity: KinematicViscosity,
    speed: AngularSpeed,
    bore: Length,
    outside_diameter: Length,
    replenishment_constant: Ratio,
    geometry_constant: Ratio,
) -> Ratio:
    r"""Share of the rolling moment that is left where oil flows back into the track too late.

    .. math:: \phi_r = \exp\left(-\frac{3 \cdot 10^{10}}{\pi} K_r \nu \omega (d + D)
        \sqrt{\frac{K_Z}{2000 (D - d)}}\right)

    SKF2018, as two public programs have it, with :math:`K_r` = 3e-8 for oil of low level, 6e-8 for grease, and
    :math:`K_Z` = 4.4 for angular-contact bearings of one row; the page itself was not read.
    """
    nu, omega, d, D = kinematic_viscosity, speed, bore, outside_diameter
    K_r, K_Z = replenishment_constant, geometry_constant
    xp = namespace(nu, omega, d, D, K_r, K_Z)
    return xp.exp(-3e10 / xp.pi * K_r * nu * omega * (d + D) * xp.sqrt(K_Z / (2000 * (D - d))))


def bearing_centrifugal_load(speed: AngularSpeed, mean_diameter: Length, centrifugal_constant: Ratio) -> Force:
    r"""Load of the balls on the outer race by their mass, as an angular-contact bearing's radial load.

    .. math:: F_g = R_3 \left(1000 d_m\right)^4 \left(\frac{30 \omega}{\pi}\right)^2

    SKF2018, read on a copy of the page.
    """
    omega, d_m, R_3 = speed, mean_diameter, centrifugal_constant
    xp = namespace(omega, d_m, R_3)
    return R_3 * (1000 * d_m) ** 4 * (30 * omega / xp.pi) ** 2


def bearing_rolling_moment(
    axial_load: Force,
    centrifugal_load: Force,
    kinematic_viscosity: KinematicViscosity,
    speed: AngularSpeed,
    mean_diameter: Length,
    rolling_constant: Ratio,
    axial_rolling_constant: Ratio,
) -> Torque:
    r"""Rolling moment of an angular-contact ball bearing under an axial load, before its reduction factors.

    .. math:: M_r = 10^{-3} R_1 \left(1000 d_m\right)^{1.97} \left(F_g + R_2 F\right)^{0.54}
        \left(\frac{3 \cdot 10^{7}}{\pi} \nu \omega\right)^{0.6}

    SKF2018, its variable :math:`G_{rr}` in N mm read on a copy of the page; without a radial load.
    """
    F, F_g, nu, omega, d_m = axial_load, centrifugal_load, kinematic_viscosity, speed, mean_diameter
    R_1, R_2 = rolling_constant, axial_rolling_constant
    xp = namespace(F, F_g, nu, omega, d_m, R_1, R_2)
    return 1e-3 * R_1 * (1000 * d_m) ** 1.97 * (F_g + R_2 * F) ** 0.54 * (3e7 / xp.pi * nu * omega) ** 0.6


def bearing_boundary_share(
    kinematic_viscosity: KinematicViscosity, speed: AngularSpeed, mean_diameter: Length
) -> Ratio:
    r"""Share of the sliding that the boundary film carries; the oil film carries the rest.

    .. math:: \phi_b = \exp\left(-2.6 \cdot 10^{-8} \left(\frac{3 \cdot 10^{7}}{\pi} \nu \omega\right)^{1.4}
        1000 d_m\right)

    SKF2018, as two public programs have it; the page itself was not read. One at rest.
    """
    nu, omega, d_m = kinematic_viscosity, speed, mean_diameter
    xp = namespace(nu, omega, d_m)
    return xp.exp(-2.6e-8 * (3e7 / xp.pi * nu * omega) ** 1.4 * 1000 * d_m)


def bearing_sliding_coefficient(
    boundary_share: Ratio, boundary_friction_coefficient: Ratio, film_friction_coefficient: Ratio
) -> Ratio:
    r"""Friction coefficient of the sliding in a bearing between boundary and film.

    .. math:: \mu = \phi_b \mu_0 + \left(1 - \phi_b\right) \mu_f

    SKF2018: 0.12 in motion and 0.15 at the start, 0.05 in mineral oils.
    """
    phi_b, mu_0, mu_f = boundary_share, boundary_friction_coefficient, film_friction_coefficient
    return phi_b * mu_0 + (1 - phi_b) * mu_f


def bearing_sliding_moment(
    axial_load: Force,
    centrifugal_load: Force,
    friction_coefficient: Ratio,
    mean_diameter: Length,
    sliding_constant: Ratio,
    axial_sliding_constant: Ratio,
) -> Torque:
    r"""Sliding moment of an angular-contact ball bearing under an axial load.

    .. math:: M_s = 10^{-3} S_1 \left(1000 d_m\right)^{0.26} \left(F_g^{4/3} + S_2 F^{4/3}\right) \mu

    SKF2018, its variable :math:`G_{sl}` in N mm read on a copy of the page; without a radial load.
    """
    F, F_g, mu, d_m = axial_load, centrifugal_load, friction_coefficient, mean_diameter
    S_1, S_2 = sliding_constant, axial_sliding_constant
    return 1e-3 * S_1 * (1000 * d_m) ** 0.26 * (F_g ** (4 / 3) + S_2 * F ** (4 / 3)) * mu


def palmgren_load_moment(equivalent_load: Force, mean_diameter: Length, load_factor: Ratio) -> Torque:
    r"""Moment of a bearing by its load, after Palmgren.

    .. math:: M_1 = f_1 P d_m

    Harris2001, as recalled: no page with it could be read. The factor is of the type of bearing, and of the load for
    many of them; it is read in the table of a maker.
    """
    P, d_m, f_1 = equivalent_load, mean_diameter, load_factor
    return f_1 * P * d_m


def palmgren_viscous_moment(
    kinematic_viscosity: KinematicViscosity, speed: AngularSpeed, mean_diameter: Length, viscous_factor: Ratio
) -> Torque:
    r"""Moment of a bearing without load by the drag of its oil, after Palmgren.

    .. math:: M_0 = 10^{-1} f_0 d_m^3 \max\left(160, \left(\frac{3 \cdot 10^{7}}{\pi} \nu \omega\right)^{2/3}\right)

    Harris2001, as recalled: no page with it could be read. :math:`10^{-7} f_0 (\nu n)^{2/3} d_m^3` in N mm, mm²/s, rpm
    and mm, and 160 in place of the power below 2000 mm²/s rpm (to 2024 here, where the two meet). A torque at rest too.
    """
    nu, omega, d_m, f_0 = kinematic_viscosity, speed, mean_diameter, viscous_factor
    xp = namespace(nu, omega, d_m, f_0)
    return 0.1 * f_0 * d_m**3 * xp.maximum(160, (3e7 / xp.pi * nu * omega) ** (2 / 3))


def guide_friction(load: Force, friction_coefficient: Ratio, seal_force: Force) -> Force:
    r"""Force that moves one carriage of a linear guide.

    .. math:: F = \mu P + f

    Rollon2020 and NB2024: the friction of the rolling bodies by the size of the load of the carriage, and of its seals
    without it.
    """
    P, mu, f = load, friction_coefficient, seal_force
    return mu * P + f


def shaft_torsional_rigidity(
    shear_modulus: Pressure, shaft_force_diameter: Length, distance_to_bearing: Length
) -> RotationalStiffness:
    r"""Torsional rigidity of a solid shaft between its driven end and the nut.

    .. math:: k_t = \frac{\pi d_c^4 G}{32 l_1}

    TimoshenkoGoodier1970: a bar of one diameter, that which stands for the shaft in its axial rigidity.
    """
    G, d_c, l_1 = shear_modulus, shaft_force_diameter, distance_to_bearing
    xp = namespace(G, d_c, l_1)
    return xp.pi * d_c**4 * G / (32 * l_1)


def axial_rigidity_of_torsion(torsional_rigidity: RotationalStiffness, lead: Length) -> Stiffness:
    r"""Axial rigidity at the nut by the twist of the shaft.

    .. math:: R_t = k_t \left(\frac{2 \pi}{P_h}\right)^2

    Derived by virtual work: a force F twists the shaft with :math:`F P_h / (2 \pi)`, and the twist moves the nut by
    itself times :math:`P_h / (2 \pi)`.
    """
    k_t, P_h = torsional_rigidity, lead
    xp = namespace(k_t, P_h)
    return k_t * (2 * xp.pi / P_h) ** 2


def lost_motion(friction_force: Force, axial_rigidity: Stiffness) -> Length:
    r"""Way that is lost where the motion reverses and friction changes its side.

    .. math:: u = \frac{2 F_r}{R}

    What lies between motor and table gives way by :math:`F_r / R` in one direction and then in the other. Play, and the
    micro-slip of balls and guides before they roll, come on top of it.
    """
    F_r, R = friction_force, axial_rigidity
    return 2 * F_r / R

"""The screw as a shaft: what it bears before it buckles, how fast it may turn, and what its turning costs."""

from __future__ import annotations

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import (
    AngularSpeed,
    Density,
    DiameterSpeed,
    Force,
    Length,
    MomentOfInertia,
    Pressure,
    Ratio,
)


def shaft_stress(axial_load: Force, root_diameter: Length) -> Pressure:
    r"""Stress that an axial load makes in the core of the shaft, pulled or pushed.

    .. math:: \sigma = \frac{4 F}{\pi d_r^2}

    THK514E allows 147 MPa. A solid shaft; without what torque and bending add.
    """
    F, d_r = axial_load, root_diameter
    xp = namespace(F, d_r)
    return 4 * F / (xp.pi * d_r**2)


def buckling_load(
    buckling_root: Ratio, young_modulus: Pressure, root_diameter: Length, unsupported_length: Length
) -> Force:
    r"""Axial load at which a straight shaft of one diameter buckles.

    .. math:: F_k = \frac{\beta^2 \pi E d_r^4}{64 l^2}

    Euler's, TimoshenkoGere1961: :math:`\beta` is the least root of its end conditions (π for two hinges). Slender
    shafts only: where :func:`shaft_stress` nears the yield point before this load is reached, the shaft yields first.
    """
    beta, E, d_r, l = buckling_root, young_modulus, root_diameter, unsupported_length  # noqa: E741  (l is the formula's letter)
    xp = namespace(beta, E, d_r, l)
    return beta**2 * xp.pi * E * d_r**4 / (64 * l**2)


def critical_speed(
    whirling_root: Ratio,
    young_modulus: Pressure,
    density: Density,
    root_diameter: Length,
    unsupported_length: Length,
) -> AngularSpeed:
    r"""Speed at which a shaft of one diameter starts to whirl, that of its lowest bending vibration.

    .. math:: \omega_k = \frac{\lambda^2 d_r}{4 l^2} \sqrt{\frac{E}{\rho}}

    Euler and Bernoulli's beam, Timoshenko1974: :math:`\lambda` is the least root of its end conditions (π for two
    hinges). Rigid bearings, a slender solid shaft, no axial load: one that pushes lowers it.
    """
    lam, E, rho, d_r, l = whirling_root, young_modulus, density, root_diameter, unsupported_length  # noqa: E741  (l is the formula's letter)
    xp = namespace(lam, E, rho, d_r, l)
    return lam**2 * d_r / (4 * l**2) * xp.sqrt(E / rho)


def diameter_speed_product(pitch_circle_diameter: Length, screw_speed: AngularSpeed) -> DiameterSpeed:
    r"""The DN value: how fast the balls are carried round, which the return tubes must stand.

    .. math:: V = d_m \omega

    THK514E, there in mm · rpm (70000 of them are 7.33 m rad/s). Twice the speed of the pitch circle.
    """
    d_m, omega = pitch_circle_diameter, screw_speed
    return d_m * omega


def shaft_inertia(diameter: Length, bore: Length, length: Length, density: Density) -> MomentOfInertia:
    r"""Moment of inertia of a shaft about its axis.

    .. math:: J = \frac{\pi \rho l}{32} \left(d^4 - d_b^4\right)

    Half the mass of a uniform cylinder times its radius squared, less the same of its bore. With the nominal diameter
    of a screw, as THK514E takes it, it is too large by what the groove leaves out.
    """
    d, d_b, l, rho = diameter, bore, length, density  # noqa: E741  (l is the formula's letter)
    xp = namespace(d, d_b, l, rho)
    return xp.pi * rho * l * (d**4 - d_b**4) / 32

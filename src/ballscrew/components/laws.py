"""Laws: the interchangeable pieces of a friction model.

Each slot of :class:`~ballscrew.model.FrictionModel` is a Protocol. A law without coefficients is a
plain function, a law with coefficients a frozen dataclass that can be called; anything that fits
the signature may be plugged in.
"""

from __future__ import annotations

import dataclasses
from typing import Annotated, NamedTuple, Protocol

from ballscrew.components.frame import Frame
from ballscrew.components.screw import BallScrew
from ballscrew.equations import equilibrium, film, friction, hertz, transmission
from ballscrew.faults import faults_of, raise_if_any
from ballscrew.quantities import Angle, Count, Force, Info, Length, Pressure, Ratio, Torque

# -- slots ----------------------------------------------------------------------------------------


class FrameLaw(Protocol):
    """Where the balls roll."""

    def __call__(self, screw: BallScrew, /) -> Frame: ...


class ContactLoadLaw(Protocol):
    """Normal load of a ball from the axial load."""

    def __call__(self, axial_load: Force, loaded_balls: Count, contact_angle: Angle, lead_angle: Angle, /) -> Force: ...


class HertzLaw(Protocol):
    """Shape of the contact ellipse."""

    def __call__(self, radii_ratio: Ratio, /) -> HertzShape: ...


class FilmLaw(Protocol):
    """Minimum film thickness."""

    def __call__(
        self,
        rolling_radius: Length,
        speed_parameter: Ratio,
        material_parameter: Ratio,
        load_parameter: Ratio,
        ellipticity: Ratio,
        /,
    ) -> Length: ...


class FilmParameterLaw(Protocol):
    """Film thickness against roughness."""

    def __call__(self, minimum_film_thickness: Length, ball_roughness: Length, race_roughness: Length, /) -> Ratio: ...


class FrictionLaw(Protocol):
    """Friction coefficient of a contact from its film parameter."""

    def __call__(self, film_parameter: Ratio, /) -> Ratio: ...


class RollingLaw(Protocol):
    """Hydrodynamic rolling force."""

    def __call__(
        self,
        equivalent_modulus: Pressure,
        rolling_radius: Length,
        radii_ratio: Ratio,
        material_parameter: Ratio,
        speed_parameter: Ratio,
        load_parameter: Ratio,
        /,
    ) -> Force: ...


class ElasticResistanceLaw(Protocol):
    """Elastic resistance to rolling."""

    def __call__(self, ball_diameter: Length, contact_load: Force, radii_ratio: Ratio, /) -> Torque: ...


class BallChainLaw(Protocol):
    """What the neighbouring balls do to a ball."""

    def __call__(
        self,
        ball_friction_coefficient: Ratio,
        ball_to_ball_force: Force,
        ball_diameter: Length,
        frame: Frame,
        /,
    ) -> BallChain: ...


class RaceTorqueLaw(Protocol):
    """Friction torque of one ball on screw and nut."""

    def __call__(
        self,
        screw_tangential_force: Force,
        nut_tangential_force: Force,
        screw_contact_moment: Torque,
        nut_contact_moment: Torque,
        frame: Frame,
        /,
    ) -> RaceTorques: ...


class IdealTorqueLaw(Protocol):
    """Drive torque without friction."""

    def __call__(self, axial_load: Force, screw: BallScrew, frame: Frame, /) -> Torque: ...


# -- Hertz contact --------------------------------------------------------------------------------


class HertzShape(NamedTuple):
    """Coefficients of a Hertz contact, and the largest radii ratio they are good for."""

    major: Ratio
    minor: Ratio
    ellipticity: Ratio
    largest_radii_ratio: float


def houpert_hertz(radii_ratio: Ratio) -> HertzShape:
    """The paper's power laws, Olaru2005 §2.2 (18) and (19); 12 % too long at their limit k = 60."""
    major = hertz.semi_major_axis_coefficient_houpert(radii_ratio)
    minor = hertz.semi_minor_axis_coefficient_houpert(radii_ratio)
    return HertzShape(major, minor, major / minor, largest_radii_ratio=60.0)


def exact_hertz(radii_ratio: Ratio) -> HertzShape:
    """The exact solution with elliptic integrals (Johnson1985 §4.2)."""
    kappa = hertz.ellipticity(radii_ratio)
    major = hertz.semi_major_axis_coefficient(radii_ratio, kappa, hertz.elliptic_integrals(kappa).E)
    return HertzShape(major, major / kappa, kappa, largest_radii_ratio=1000.0)


# -- film and friction ----------------------------------------------------------------------------


@dataclasses.dataclass(frozen=True, eq=False)
class HamrockDowson:
    """Minimum film thickness by HamrockDowson1977; the paper prints the exponent as 0.66."""

    speed_exponent: Annotated[
        Ratio, Info("m", "exponent of the speed parameter", above=0, below=1, hint="0.68; the paper prints 0.66")
    ] = 0.68

    def __post_init__(self) -> None:
        raise_if_any(faults_of("model.film", self))

    def __call__(
        self,
        rolling_radius: Length,
        speed_parameter: Ratio,
        material_parameter: Ratio,
        load_parameter: Ratio,
        ellipticity: Ratio,
    ) -> Length:
        """Minimum film thickness, m."""
        return film.minimum_film_thickness(
            rolling_radius, speed_parameter, material_parameter, load_parameter, ellipticity, self.speed_exponent
        )


@dataclasses.dataclass(frozen=True, eq=False)
class ZhouHoeprich:
    """Friction coefficient between the boundary and the full-film value, Olaru2005 §5 (23)–(26).

    After ZhouHoeprich1991. With the paper's coefficients the full-film value is reached at a film
    parameter of 1.83, not at 2.5 to 3 as its text says. The decay and its exponent belong to the
    surfaces; other published pairs are (2.32, 0.97), (1.90, 0.99) and (2.1, 0.85).
    """

    boundary_friction_coefficient: Annotated[
        Ratio, Info(r"\mu_0", "friction coefficient without a film", at_least=0, hint="boundary friction is 0.1 to 0.2")
    ] = 0.2
    decay: Annotated[Ratio, Info("B", "decay of the asperities' share", at_least=0, hint="the paper has 1.42")] = 1.42
    exponent: Annotated[Ratio, Info("C", "exponent of the film parameter", above=0, hint="the paper has 0.8")] = 0.8
    full_film_friction_coefficient: Annotated[
        Ratio, Info(r"\mu_f", "friction coefficient of the full film", at_least=0, hint="the paper has 0.02")
    ] = 0.02

    def __post_init__(self) -> None:
        raise_if_any(faults_of("model.friction", self))

    def __call__(self, film_parameter: Ratio) -> Ratio:
        """Friction coefficient."""
        mu_a = friction.asperity_friction_coefficient(
            film_parameter, self.boundary_friction_coefficient, self.decay, self.exponent
        )
        return friction.clamped_friction_coefficient(
            mu_a, self.boundary_friction_coefficient, self.full_film_friction_coefficient
        )


# -- the ball chain -------------------------------------------------------------------------------


class BallChain(NamedTuple):
    """What its neighbours do to a ball: a moment, and a force along the path."""

    moment: Torque
    braking_force: Force


def one_neighbour(
    ball_friction_coefficient: Ratio, ball_to_ball_force: Force, ball_diameter: Length, frame: Frame
) -> BallChain:
    """The paper's: one neighbour rubs, the chain is straight, Olaru2005 §2.2 (21)."""
    moment = friction.ball_friction_moment(ball_friction_coefficient, ball_to_ball_force, ball_diameter)
    return BallChain(moment, ball_to_ball_force)


def two_neighbours(
    ball_friction_coefficient: Ratio, ball_to_ball_force: Force, ball_diameter: Length, frame: Frame
) -> BallChain:
    """Both neighbours rub, and the chain is curved like the path."""
    moment = 2 * friction.ball_friction_moment(ball_friction_coefficient, ball_to_ball_force, ball_diameter)
    braking_force = equilibrium.chain_braking_force(
        ball_to_ball_force, moment, frame.path_radius, frame.rolling_plane_cosine
    )
    return BallChain(moment, braking_force)


# -- torques --------------------------------------------------------------------------------------


class RaceTorques(NamedTuple):
    """Friction torque of one ball on each race."""

    screw: Torque
    nut: Torque


def printed_race_torques(
    screw_tangential_force: Force,
    nut_tangential_force: Force,
    screw_contact_moment: Torque,
    nut_contact_moment: Torque,
    frame: Frame,
) -> RaceTorques:
    """Tangential forces on their levers only, Olaru2005 §6 (28) and (31)."""
    return RaceTorques(
        equilibrium.race_torque(screw_tangential_force, frame.screw_contact_radius),
        equilibrium.race_torque(nut_tangential_force, frame.nut_contact_radius),
    )


def balanced_race_torques(
    screw_tangential_force: Force,
    nut_tangential_force: Force,
    screw_contact_moment: Torque,
    nut_contact_moment: Torque,
    frame: Frame,
) -> RaceTorques:
    """Tangential forces on their levers, and the moments of the contacts, which the paper left out."""
    cosine = frame.rolling_plane_cosine
    return RaceTorques(
        equilibrium.balanced_screw_torque(
            screw_tangential_force, frame.screw_contact_radius, screw_contact_moment, cosine
        ),
        equilibrium.balanced_nut_torque(nut_tangential_force, frame.nut_contact_radius, nut_contact_moment, cosine),
    )


def printed_ideal_torque(axial_load: Force, screw: BallScrew, frame: Frame) -> Torque:
    """The paper's torque without friction, Olaru2005 §7 (35); low by the factor 1 - γ."""
    return transmission.ideal_torque_printed(
        axial_load, frame.screw_contact_radius, screw.lead, screw.pitch_circle_diameter
    )


def virtual_work_torque(axial_load: Force, screw: BallScrew, frame: Frame) -> Torque:
    """The torque without friction that conserves energy, F P_h/2π."""
    return transmission.ideal_torque(axial_load, screw.lead)

"""Laws: the interchangeable pieces of a friction model.

Each slot of :class:`~ballscrew.physics.friction.model.FrictionModel` is a Protocol. A law without coefficients is a
plain function, a law with coefficients a frozen dataclass that can be called; anything that fits
the signature may be plugged in.
"""

from __future__ import annotations

import dataclasses
from typing import Annotated, NamedTuple, Protocol

from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import faults_of, raise_if_any
from ballscrew.basis.quantities import Angle, Count, Force, Info, Length, Ratio, Torque
from ballscrew.physics.components.conditions import ContactConditions, HertzShape
from ballscrew.physics.components.frame import Frame
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.components.traits import law_traits
from ballscrew.physics.equations import equilibrium, friction, hertz, rolling, transmission

# -- slots ----------------------------------------------------------------------------------------


class FrameLaw(Protocol):
    """Law of the frame in which the balls roll."""

    def __call__(self, screw: BallScrew, /) -> Frame: ...


class ContactLoadLaw(Protocol):
    """Normal load of a ball from the axial load."""

    def __call__(self, axial_load: Force, loaded_balls: Count, contact_angle: Angle, lead_angle: Angle, /) -> Force: ...


class HertzLaw(Protocol):
    """Shape of the contact ellipse: of the radii alone, as it is what the conditions of a contact are made of."""

    def __call__(self, radii_ratio: Ratio, /) -> HertzShape: ...


class FilmLaw(Protocol):
    """Minimum film thickness, inlet cool and full."""

    def __call__(self, conditions: ContactConditions, /) -> Length: ...


class FilmParameterLaw(Protocol):
    """Film thickness against roughness."""

    def __call__(self, conditions: ContactConditions, /) -> Ratio: ...


class InletFactors(NamedTuple):
    """Factors of the inlet: its heat on the film, all it does on the rolling force, missing oil on the film."""

    film: Ratio
    rolling: Ratio
    supply: Ratio = 1.0


class InletLaw(Protocol):
    """Heating and filling of the inlet."""

    def __call__(self, conditions: ContactConditions, /) -> InletFactors: ...


class FullFilmLaw(Protocol):
    """Friction coefficient of the film itself, where it alone carries the load."""

    def __call__(self, conditions: ContactConditions, /) -> Ratio: ...


class FrictionLaw(Protocol):
    """Friction coefficient of a contact, most often from its film parameter."""

    def __call__(self, conditions: ContactConditions, /) -> Ratio: ...


class RollingLaw(Protocol):
    """Hydrodynamic rolling force."""

    def __call__(self, conditions: ContactConditions, /) -> Force: ...


class ElasticResistanceLaw(Protocol):
    """Elastic resistance to rolling."""

    def __call__(self, conditions: ContactConditions, /) -> Torque: ...


class BallForceLaw(Protocol):
    """Net braking force between neighbouring balls."""

    def __call__(self, ball_to_ball_force: Force, contact_load: Force, /) -> Force: ...


class BallChainLaw(Protocol):
    """Law of the contact of a ball with its neighbours."""

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


@law_traits(excluded="approximates the exact contact: a known error, and no doubt")
def houpert_hertz(radii_ratio: Ratio) -> HertzShape:
    """The paper's power laws, Olaru2005 §2.2 (18) and (19); 12 % too long at their limit k = 60."""
    major = hertz.semi_major_axis_coefficient_houpert(radii_ratio)
    minor = hertz.semi_minor_axis_coefficient_houpert(radii_ratio)
    return HertzShape(major, minor, major / minor, largest_radii_ratio=60.0)


@law_traits(alternative=True)
def exact_hertz(radii_ratio: Ratio) -> HertzShape:
    """The exact solution with elliptic integrals (Johnson1985 §4.2)."""
    kappa = hertz.ellipticity(radii_ratio)
    major = hertz.semi_major_axis_coefficient(radii_ratio, kappa, hertz.elliptic_integrals(kappa).E)
    return HertzShape(major, major / kappa, kappa, largest_radii_ratio=1000.0)


@law_traits(excluded="approximates the exact contact: a known error, and no doubt")
def brewe_hamrock_hertz(radii_ratio: Ratio) -> HertzShape:
    """The exact formulas with the fits of BreweHamrock1977 for ellipticity and elliptic integral."""
    kappa = hertz.ellipticity_brewe_hamrock(radii_ratio)
    second_integral = hertz.second_integral_brewe_hamrock(radii_ratio)
    major = hertz.semi_major_axis_coefficient(radii_ratio, kappa, second_integral)
    return HertzShape(major, major / kappa, kappa, largest_radii_ratio=100.0)


# -- elastic resistance ---------------------------------------------------------------------------


@law_traits(alternative=True)
def snare_resistance(conditions: ContactConditions) -> Torque:
    """The paper's fit for steel, Olaru2005 §2.2 (20)."""
    return rolling.elastic_resistance_moment(conditions.ball_diameter, conditions.contact_load, conditions.radii_ratio)


@law_traits(alternative=True)
@dataclasses.dataclass(frozen=True, eq=False)
class Hysteresis(ByValue):
    """Elastic resistance as the part of the work of deformation that the material keeps, Johnson1985 §9.3."""

    loss_factor: Annotated[
        Ratio,
        Info(
            r"\alpha",
            "share of the elastic work lost in hysteresis",
            at_least=0,
            hint="steel has 0.01 to 0.04",
            usual=(0.0, 0.3),
        ),
    ] = 0.02

    def __post_init__(self) -> None:
        raise_if_any(faults_of("model.elastic_resistance", self))

    def __call__(self, conditions: ContactConditions) -> Torque:
        """Moment about the ball."""
        return rolling.hysteresis_moment(self.loss_factor, conditions.contact_load, conditions.semi_minor_axis)


# -- the ball chain -------------------------------------------------------------------------------


class BallChain(NamedTuple):
    """Moment and force along the path that its neighbours exert on a ball."""

    #: Moment of the rubbing surfaces of the neighbours.
    moment: Torque
    #: Force against the motion: the net push of the neighbours, and what a curved chain makes of the moment.
    braking_force: Force
    #: The net push alone, as on a straight path; None where all of the braking force is that.
    net_push: Force | None = None

    @property
    def net_braking_force(self) -> Force:
        """Net push of the neighbours against the motion."""
        return self.braking_force if self.net_push is None else self.net_push


@law_traits(excluded="leaves one of the two neighbours out")
def one_neighbour(
    ball_friction_coefficient: Ratio, ball_to_ball_force: Force, ball_diameter: Length, frame: Frame
) -> BallChain:
    """The paper's: one neighbour rubs, the chain is straight, Olaru2005 §2.2 (21)."""
    moment = friction.ball_friction_moment(ball_friction_coefficient, ball_to_ball_force, ball_diameter)
    return BallChain(moment, ball_to_ball_force)


@law_traits(excluded="brakes with all of the force between balls, as an imposed net force does")
def two_neighbours(
    ball_friction_coefficient: Ratio, ball_to_ball_force: Force, ball_diameter: Length, frame: Frame
) -> BallChain:
    """Both neighbours rub, and the chain is curved like the path."""
    moment = 2 * friction.ball_friction_moment(ball_friction_coefficient, ball_to_ball_force, ball_diameter)
    braking_force = equilibrium.chain_braking_force(
        ball_to_ball_force, moment, frame.path_radius, frame.rolling_plane_cosine
    )
    return BallChain(moment, braking_force, ball_to_ball_force)


@law_traits(alternative=True)
def opposed_neighbours(
    ball_friction_coefficient: Ratio, ball_to_ball_force: Force, ball_diameter: Length, frame: Frame
) -> BallChain:
    """Both neighbours rub and press equally: what the one pushes, the other holds, and no net braking is left."""
    moment = 2 * friction.ball_friction_moment(ball_friction_coefficient, ball_to_ball_force, ball_diameter)
    nothing = 0 * ball_to_ball_force
    braking_force = equilibrium.chain_braking_force(nothing, moment, frame.path_radius, frame.rolling_plane_cosine)
    return BallChain(moment, braking_force, nothing)


@law_traits(excluded="leaves the contact of the balls out: holds where spacers part them")
def parted_neighbours(
    ball_friction_coefficient: Ratio, ball_to_ball_force: Force, ball_diameter: Length, frame: Frame
) -> BallChain:
    """No ball touches another, as with a spacer ball after every loaded one."""
    nothing = 0 * ball_to_ball_force
    return BallChain(nothing * ball_diameter, nothing, nothing)


@law_traits(excluded="is the number of one screw, and no law")
def imposed_ball_force(ball_to_ball_force: Force, contact_load: Force) -> Force:
    """The same force at any load, as in the paper."""
    return ball_to_ball_force


@law_traits(excluded="how large the force is, is a matter of its uncertainty", uses_imposed_force=False)
@dataclasses.dataclass(frozen=True, eq=False)
class ProportionalBallForce(ByValue):
    """A force that grows with the load of the ball; an imposed one does not count.

    The load of a ball is that of its contacts with one race: one on two contacts, the sum of both flank
    pairs on four. No measured value is known. The default is that of a full circuit without gaps whose
    grooves are some 2 µm off their place: along the circuit the balls want to travel at speeds that differ by some
    2.4e-4, and the creep of their contacts holds them with nine to twenty times the load for each unit of it.
    With the gap of a usual fill the mechanics gives a tenth and less; the torques of makers ask for 0.012 to 0.029
    (``data/calibrations.toml``). The paper's 1 N / z is 0.0002 at the paper's load, where it is a net braking force.
    """

    share_of_load: Annotated[
        Ratio,
        Info(
            "F_B/Q",
            "force between balls / load of a ball",
            at_least=0,
            hint="0.0075, of known order only; the paper's net force is about 0.0002",
            usual=(0.0, 0.5),
        ),
    ] = 0.0075

    def __post_init__(self) -> None:
        raise_if_any(faults_of("model.ball_force", self))

    def __call__(self, ball_to_ball_force: Force, contact_load: Force) -> Force:
        """Force between balls, N."""
        return self.share_of_load * contact_load


# -- torques --------------------------------------------------------------------------------------


class RaceTorques(NamedTuple):
    """Friction torque of one ball on each race."""

    screw: Torque
    nut: Torque


@law_traits(printed_form=True, excluded="leaves the moments of the contacts out: breaks the balance of energy")
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


@law_traits(alternative=True)
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


@law_traits(printed_form=True, excluded="low by the factor 1 - γ: breaks the balance of energy")
def printed_ideal_torque(axial_load: Force, screw: BallScrew, frame: Frame) -> Torque:
    """The paper's torque without friction, Olaru2005 §7 (35); low by the factor 1 - γ."""
    return transmission.ideal_torque_printed(
        axial_load, frame.screw_contact_radius, screw.lead, screw.pitch_circle_diameter
    )


@law_traits(alternative=True)
def virtual_work_torque(axial_load: Force, screw: BallScrew, frame: Frame) -> Torque:
    """The torque without friction that conserves energy, F P_h/2π."""
    return transmission.ideal_torque(axial_load, screw.lead)

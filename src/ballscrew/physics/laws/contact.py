"""One ball against one race: the contact, no iteration."""

from __future__ import annotations

import dataclasses
from typing import Annotated

from ballscrew.basis.arrays import lazy, namespace
from ballscrew.basis.quantities import AngularSpeed, Force, Info, Length, Ratio, Speed, Stiffness, Torque
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.screw import BallScrew, Raceway
from ballscrew.physics.equations import film, friction, geometry, hertz, rheology, rolling
from ballscrew.physics.laws.conditions import ContactConditions, Motion
from ballscrew.physics.laws.protocols import (
    ElasticResistanceLaw,
    FilmLaw,
    FilmParameterLaw,
    FrictionLaw,
    FullFilmLaw,
    HertzLaw,
    InletLaw,
    RollingLaw,
)


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Contact(ContactConditions):
    """State of a ball–race contact as far as load and speed determine it.

    What the torque needs is computed at once, the rest when it is asked for.
    """

    friction_coefficient: Annotated[Ratio, Info(r"\mu_m", "friction coefficient of the contact")]
    hydrodynamic_rolling_force: Annotated[Force, Info("F_R", "hydrodynamic rolling force")]
    elastic_resistance_moment: Annotated[Torque, Info("M_ER", "elastic resistance moment", "N mm")]

    @lazy
    def elastic_regime_parameter(self) -> Annotated[Ratio, Info("M", "elastic against rigid lubrication regime")]:
        """Elastic against rigid lubrication regime; infinite at rest."""
        xp = namespace(self.radii_ratio, self.load_parameter, self.speed_parameter)
        at_rest = self.speed_parameter == 0
        speed = xp.where(at_rest, 1.0, self.speed_parameter)
        return xp.where(at_rest, xp.inf, rolling.elastic_regime_parameter(self.radii_ratio, self.load_parameter, speed))

    def curvature_moment_at(self, pure_rolling_offset: Ratio) -> Torque:
        """Curvature friction moment for a given position of the lines of pure rolling."""
        return friction.curvature_friction_moment(
            self.friction_coefficient,
            self.contact_load,
            self.semi_major_axis,
            self.deformed_radius,
            pure_rolling_offset,
        )

    @lazy
    def mutual_approach(
        self,
    ) -> Annotated[Length, Info(r"\delta", "mutual approach of ball and race, exact Hertz", "um")]:
        """Mutual approach of ball and race by the exact Hertz solution, whatever fit the model uses."""
        return hertz.mutual_approach(self._approach_coefficient, self.rolling_radius, self.load_parameter)

    @lazy
    def _approach_coefficient(self) -> Ratio:
        kappa = hertz.ellipticity(self.radii_ratio)
        integrals = hertz.elliptic_integrals(kappa)
        return hertz.approach_coefficient(self.radii_ratio, kappa, integrals.K, integrals.E)


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class RaceState(Contact):
    """State of a ball–race contact in the equilibrium of the ball: with forces and moments."""

    pure_rolling_offset: Annotated[Ratio, Info("Y", "offset of the lines of pure rolling / semi-major axis")]
    creep_speed: Annotated[Speed, Info("A", "slip of the race ahead of the ball, in the middle of the contact", "mm/s")]
    spin: Annotated[AngularSpeed, Info(r"\Omega_P", "spin in the contact, its share of that of the ball", "rad/s")]
    lateral_slip_speed: Annotated[Speed, Info("D", "slip across the path, the contact's share", "mm/s")]
    curvature_friction_moment: Annotated[Torque, Info("M_C", "curvature friction moment", "N mm")]
    sliding_force: Annotated[Force, Info("F_S", "sliding force between ball and race")]
    contact_radius: Annotated[Length, Info("R", "lever of the tangential force about the screw axis", "mm")]
    pressure_force: Annotated[Force, Info("F_P", "force of the inlet pressure through the ball centre")]
    tangential_force: Annotated[Force, Info("F_t", "tangential force between ball and race")]
    friction_torque: Annotated[Torque, Info("M", "friction torque of one ball on the race", "N mm")]

    @lazy
    def traction_limit(self) -> Annotated[Force, Info(r"\mu_m Q", "greatest sliding force the contact can carry")]:
        """Greatest sliding force the contact can carry."""
        return self.friction_coefficient * self.contact_load

    @lazy
    def spin_parameter(self) -> Annotated[Ratio, Info("E_s", "slip of the spin / slip of the curvature, at the rim")]:
        """Spin against curvature; from one on, pure spin takes over. Zero at rest, infinite without load in motion."""
        rotation = self.motion.entrainment_speed / self.rolling_radius
        xp = namespace(rotation, self.spin, self.semi_major_axis)
        # Ω a²/(2 R_d) and Ω_P a, both without one a
        curvature = self.semi_major_axis * rotation / (2 * self.deformed_radius)
        moving, loaded = rotation > 0, self.semi_major_axis > 0
        ratio = self.spin / xp.where(moving & loaded, curvature, 1.0)
        return xp.where(moving & (self.spin > 0), xp.where(loaded, ratio, xp.inf), 0.0)

    @lazy
    def contact_stiffness(
        self,
    ) -> Annotated[Stiffness, Info("c", "stiffness of the contact, exact Hertz", "N/um")]:
        """Slope of the load over the mutual approach, exact Hertz."""
        return hertz.contact_stiffness(
            self._approach_coefficient, self.equivalent_modulus, self.rolling_radius, self.load_parameter
        )


@dataclasses.dataclass(frozen=True, eq=False)
class ContactLaws:
    """The laws one contact needs."""

    hertz: HertzLaw
    film: FilmLaw
    film_parameter: FilmParameterLaw
    inlet: InletLaw
    friction: FrictionLaw
    full_film: FullFilmLaw | None
    rolling: RollingLaw
    elastic_resistance: ElasticResistanceLaw


def rolling_contact(
    laws: ContactLaws,
    screw: BallScrew,
    raceway: Raceway,
    lubricant: Lubricant,
    rolling_radius: Length,
    contact_load: Force,
    motion: Motion,
) -> Contact:
    """The contact of one ball with one race under a load, in motion.

    At rest there is no film, whatever the load; without load there is no contact, and the film is
    infinite (in motion) by the law's own limit.
    """
    E = screw.equivalent_modulus(raceway)
    R_x, v = rolling_radius, motion.entrainment_speed
    R_y = geometry.transverse_radius(screw.ball_diameter, raceway.conformity)
    k = geometry.radii_ratio(R_y, R_x)
    shape = laws.hertz(k)
    G = rheology.material_parameter(E, lubricant.pressure_viscosity_coefficient)
    U = rheology.speed_parameter(lubricant.viscosity, v, E, R_x)
    W = rheology.load_parameter(contact_load, E, R_x)
    conditions = ContactConditions(
        contact_load=contact_load,
        equivalent_modulus=E,
        rolling_radius=R_x,
        transverse_radius=R_y,
        radii_ratio=k,
        deformed_radius=geometry.deformed_radius(screw.ball_diameter, raceway.conformity),
        hertz=shape,
        material_parameter=G,
        speed_parameter=U,
        load_parameter=W,
        semi_major_axis=hertz.semi_axis(shape.major, R_x, W),
        combined_roughness=film.combined_roughness(screw.ball_roughness, raceway.roughness),
        motion=motion,
        lubricant=lubricant,
        ball_diameter=screw.ball_diameter,
        ball_roughness=screw.ball_roughness,
        race_roughness=raceway.roughness,
    )
    known = vars(conditions)  # filled in stages, here and nowhere else: a new object for each costs more than its law
    inlet = laws.inlet(conditions)
    known["inlet_film_factor"], known["inlet_supply_factor"] = inlet.film, inlet.supply
    thickness = inlet.film * inlet.supply * laws.film(conditions)
    known["minimum_film_thickness"] = namespace(v, thickness).where(v == 0, 0.0, thickness)
    known["film_parameter"] = laws.film_parameter(conditions)
    if laws.full_film is not None:
        known["full_film_friction_coefficient"] = laws.full_film(conditions)
    return conditions.extended(
        Contact,
        friction_coefficient=laws.friction(conditions),
        hydrodynamic_rolling_force=inlet.rolling * laws.rolling(conditions),
        elastic_resistance_moment=laws.elastic_resistance(conditions),
    )

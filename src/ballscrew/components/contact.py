"""One ball against one race: the contact, no iteration."""

from __future__ import annotations

import dataclasses
from typing import Annotated

from ballscrew._arrays import lazy, namespace
from ballscrew.components.laws import (
    ElasticResistanceLaw,
    FilmLaw,
    FilmParameterLaw,
    FrictionLaw,
    HertzLaw,
    HertzShape,
    RollingLaw,
)
from ballscrew.components.materials import Lubricant
from ballscrew.components.screw import BallScrew, Raceway
from ballscrew.equations import friction, geometry, hertz, rheology, rolling
from ballscrew.quantities import Force, Info, Length, Pressure, Ratio, Speed, Torque


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Contact:
    """State of a ball–race contact as far as load and speed determine it.

    What the torque needs is computed at once, the rest when it is asked for.
    """

    contact_load: Annotated[Force, Info("Q", "normal load of the contact")]
    equivalent_modulus: Annotated[Pressure, Info("E'", "equivalent modulus of ball and race", "GPa")]
    rolling_radius: Annotated[Length, Info("R_x", "equivalent radius in the rolling direction", "mm")]
    transverse_radius: Annotated[Length, Info("R_y", "equivalent radius across the rolling direction", "mm")]
    radii_ratio: Annotated[Ratio, Info("k", "ratio of the equivalent radii R_y/R_x")]
    deformed_radius: Annotated[Length, Info("R_d", "radius of the deformed surface", "mm")]
    hertz: HertzShape
    material_parameter: Annotated[Ratio, Info("G", "dimensionless material parameter")]
    speed_parameter: Annotated[Ratio, Info("U", "dimensionless speed parameter")]
    load_parameter: Annotated[Ratio, Info("W", "dimensionless load parameter")]
    semi_major_axis: Annotated[Length, Info("a", "semi-axis of the ellipse across the rolling direction", "mm")]
    minimum_film_thickness: Annotated[Length, Info("h", "minimum film thickness", "um")]
    film_parameter: Annotated[Ratio, Info(r"\lambda", "film thickness / combined roughness")]
    friction_coefficient: Annotated[Ratio, Info(r"\mu_m", "friction coefficient of the contact")]
    hydrodynamic_rolling_force: Annotated[Force, Info("F_R", "hydrodynamic rolling force")]
    elastic_resistance_moment: Annotated[Torque, Info("M_ER", "elastic resistance moment", "N mm")]

    @lazy
    def ellipticity(self) -> Annotated[Ratio, Info(r"\kappa", "ratio of the semi-axes a/b")]:
        """Ratio of the semi-axes a/b."""
        return self.hertz.ellipticity

    @lazy
    def semi_minor_axis(
        self,
    ) -> Annotated[Length, Info("b", "semi-axis of the ellipse along the rolling direction", "mm")]:
        """Semi-axis of the contact ellipse along the rolling direction."""
        return hertz.semi_axis(self.hertz.minor, self.rolling_radius, self.load_parameter)

    @lazy
    def maximum_pressure(self) -> Annotated[Pressure, Info("p_0", "maximum contact pressure", "GPa")]:
        """Maximum contact pressure."""
        return hertz.maximum_pressure(self.hertz.major, self.hertz.minor, self.equivalent_modulus, self.load_parameter)

    @lazy
    def elastic_regime_parameter(self) -> Annotated[Ratio, Info("M", "elastic against rigid lubrication regime")]:
        """Elastic against rigid lubrication regime; infinite at rest."""
        xp = namespace(self.load_parameter, self.speed_parameter)
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


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class RaceState(Contact):
    """State of a ball–race contact in the equilibrium of the ball: with forces and moments."""

    pure_rolling_offset: Annotated[Ratio, Info("Y", "offset of the lines of pure rolling / semi-major axis")]
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
    def mutual_approach(
        self,
    ) -> Annotated[Length, Info(r"\delta", "mutual approach of ball and race, exact Hertz", "um")]:
        """Mutual approach of ball and race by the exact Hertz solution, whatever fit the model uses."""
        kappa = hertz.ellipticity(self.radii_ratio)
        integrals = hertz.elliptic_integrals(kappa)
        coefficient = hertz.approach_coefficient(self.radii_ratio, kappa, integrals.K, integrals.E)
        return hertz.mutual_approach(coefficient, self.rolling_radius, self.load_parameter)


@dataclasses.dataclass(frozen=True, eq=False)
class ContactLaws:
    """The laws one contact needs."""

    hertz: HertzLaw
    film: FilmLaw
    film_parameter: FilmParameterLaw
    friction: FrictionLaw
    rolling: RollingLaw
    elastic_resistance: ElasticResistanceLaw


def rolling_contact(
    laws: ContactLaws,
    screw: BallScrew,
    raceway: Raceway,
    lubricant: Lubricant,
    rolling_radius: Length,
    contact_load: Force,
    entrainment_speed: Speed,
) -> Contact:
    """The contact of one ball with one race under a load, at a speed.

    At rest there is no film, whatever the load; without load there is no contact, and the film is
    infinite (in motion) by the law's own limit.
    """
    E = screw.equivalent_modulus(raceway)
    R_x = rolling_radius
    R_y = geometry.transverse_radius(screw.ball_diameter, raceway.conformity)
    k = geometry.radii_ratio(R_y, R_x)
    shape = laws.hertz(k)
    G = rheology.material_parameter(E, lubricant.pressure_viscosity_coefficient)
    U = rheology.speed_parameter(lubricant.viscosity, entrainment_speed, E, R_x)
    W = rheology.load_parameter(contact_load, E, R_x)
    xp = namespace(U, W)
    h = xp.where(entrainment_speed == 0, 0.0, laws.film(R_x, U, G, W, shape.ellipticity))
    lam = laws.film_parameter(h, screw.ball_roughness, raceway.roughness)
    return Contact(
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
        minimum_film_thickness=h,
        film_parameter=lam,
        friction_coefficient=laws.friction(lam),
        hydrodynamic_rolling_force=laws.rolling(E, R_x, k, G, U, W),
        elastic_resistance_moment=laws.elastic_resistance(screw.ball_diameter, contact_load, k),
    )

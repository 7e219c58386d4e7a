"""One ball against one race: the contact, no iteration.

Laws of the slot ``hertz``: shape of the contact ellipse, by fits or exact.

Laws of the film: its thickness, and the film parameter.

Laws of rolling: the force of the film in the inlet, and the elastic resistance of steel.

Laws of the inlet: heat of the shear in it, and oil that comes back too late.
"""

from __future__ import annotations

import dataclasses
from typing import Annotated

from ballscrew.basis.arrays import ByValue, lazy, namespace
from ballscrew.basis.errors import faults_of, raise_if_any
from ballscrew.basis.quantities import AngularSpeed, Force, Info, Length, Pressure, Ratio, Speed, Stiffness, Torque
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.screw import BallScrew, Raceway
from ballscrew.physics.equations import film, friction, geometry, hertz, rheology, rolling
from ballscrew.physics.laws.conditions import ContactConditions, HertzShape, Motion
from ballscrew.physics.laws.protocols import (
    ElasticResistanceLaw,
    FilmLaw,
    FilmParameterLaw,
    FrictionLaw,
    FullFilmLaw,
    HertzLaw,
    InletFactors,
    InletLaw,
    RollingLaw,
)
from ballscrew.physics.laws.traits import law_traits


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


@law_traits(alternative=True)
@dataclasses.dataclass(frozen=True, eq=False)
class HamrockDowson(ByValue):
    """Minimum film thickness by HamrockDowson1977; the paper prints the exponent as 0.66.

    Raises :class:`~ballscrew.basis.errors.InputError` for an exponent out of bounds.
    """

    speed_exponent: Annotated[
        Ratio, Info("m", "exponent of the speed parameter", above=0, below=1, hint="0.68; the paper prints 0.66")
    ] = 0.68

    def __post_init__(self) -> None:
        raise_if_any(faults_of("model.film", self))

    def __call__(self, conditions: ContactConditions) -> Length:
        """Minimum film thickness at the ``conditions`` of a contact, m."""
        return film.minimum_film_thickness(*_film_groups(conditions), self.speed_exponent)


@law_traits(alternative=True)
def hamrock_dowson_central(conditions: ContactConditions) -> Length:
    """Central in place of minimum film thickness, HamrockDowson1977: for a film parameter of the middle."""
    return film.central_film_thickness(*_film_groups(conditions))


@law_traits(excluded="close to HamrockDowson1977: not yet judged for the band, whose numbers it would move")
def chittenden(conditions: ContactConditions) -> Length:
    """Minimum film thickness by Chittenden1985, from the radii of the contact in place of its ellipse."""
    R_x, U, G, W, _ = _film_groups(conditions)
    return film.minimum_film_thickness_chittenden(R_x, U, G, W, conditions.radii_ratio)


def _film_groups(conditions: ContactConditions) -> tuple[Length, Ratio, Ratio, Ratio, Ratio]:
    """R_x, U, G, W and κ."""
    c = conditions
    return c.rolling_radius, c.speed_parameter, c.material_parameter, c.load_parameter, c.ellipticity


# -- film and roughness ---------------------------------------------------------------------------


@law_traits(alternative=True)
def root_sum_square_film_parameter(conditions: ContactConditions) -> Ratio:
    """Film over the combined roughness, Olaru2005 §4 (22), with the square root that the print lost."""
    c = conditions
    return film.film_parameter(c.minimum_film_thickness, c.ball_roughness, c.race_roughness)


@law_traits(printed_form=True, excluded="lost its square root in print: has the unit 1/m")
def literal_film_parameter(conditions: ContactConditions) -> Ratio:
    """Without the square root, Olaru2005 §4 (22), to the letter."""
    c = conditions
    return film.literal_film_parameter(c.minimum_film_thickness, c.ball_roughness, c.race_roughness)


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


@law_traits(alternative=True)
def olaru_rolling(conditions: ContactConditions) -> Force:
    """The paper's, Olaru2005 §2.1 (1): a moderate supply of oil, elastic regime only."""
    E, R_x, k, U, W = _groups(conditions)
    return rolling.hydrodynamic_rolling_force(E, R_x, k, conditions.material_parameter, U, W)


@law_traits(alternative=True)
def biboulet_houpert_rolling(conditions: ContactConditions) -> Force:
    """Both regimes and what lies between, fully flooded, BibouletHoupert2010 in the form of Balan2015."""
    E, R_x, k, U, W = _groups(conditions)
    return rolling.blended_rolling_force(
        rolling.rigid_rolling_force(E, R_x, k, W, U),
        rolling.elastic_rolling_force(E, R_x, k, W, U),
        rolling.rigid_regime_share(k, W, U),
    )


@law_traits(alternative=True)
def houpert_rolling(conditions: ContactConditions) -> Force:
    """The fit that the paper rounds, Houpert1987: a moderate supply of oil, elastic regime only."""
    E, R_x, _, U, W = _groups(conditions)
    kappa = conditions.hertz.ellipticity
    beta = rolling.ellipse_shape_parameter(conditions.hertz.major, conditions.hertz.minor)
    return rolling.elastic_rolling_force_houpert(E, R_x, beta, kappa, conditions.material_parameter, W, U)


@law_traits(alternative=True)
def aihara_rolling(conditions: ContactConditions) -> Force:
    """The law of Aihara1987 for rollers, on a line as long as the ellipse.

    It has the heat of the inlet in it: with the inlet law ``Inlet`` that counts twice, which matters at high speed.
    """
    _, R_x, _, U, W = _groups(conditions)
    return rolling.rolling_force_aihara(
        R_x,
        conditions.semi_major_axis,
        conditions.lubricant.pressure_viscosity_coefficient,
        conditions.material_parameter,
        U,
        rolling.line_load_parameter(conditions.hertz.major, W),
        conditions.thermal_loading_parameter,
    )


def _groups(conditions: ContactConditions) -> tuple[Pressure, Length, Ratio, Ratio, Ratio]:
    """E', R_x, k, U and W."""
    c = conditions
    return c.equivalent_modulus, c.rolling_radius, c.radii_ratio, c.speed_parameter, c.load_parameter


# -- the inlet ------------------------------------------------------------------------------------

#: Share of the rolling force that an inlet leaves which has as much oil as the film of a full one.
JUST_ENOUGH = rolling.rolling_starvation_factor(1.0)


@law_traits(excluded="leaves the heat of the inlet out: a known error, and no doubt")
def ideal_inlet(conditions: ContactConditions) -> InletFactors:
    """The paper's: the inlet is full and as warm as the rest, Olaru2005 §2.1."""
    return InletFactors(1.0, 1.0)


@law_traits(alternative=True)
@dataclasses.dataclass(frozen=True, eq=False)
class Inlet(ByValue):
    """An inlet that its own shear heats (Gupta1992) and that may not be full.

    The heating thins the film and the rolling force alike. The oil that the balls push aside does not flow back in time
    at high speed and viscosity (SKF2018: kinematic replenishment); a supply that is known to be short is told by
    ``inlet_film_ratio`` (BibouletHoupertLines2010). Missing oil lowers the rolling force, and what is left of that says
    how much oil there is: the film is no thicker than the oil before it, which counts from a ninth of the force down.
    """

    inlet_film_ratio: Annotated[
        Ratio,
        Info("S", "film where the inlet begins / fully flooded film", above=0, hint="1e6 for a flooded inlet"),
    ] = 1e6
    replenishment_constant: Annotated[
        Ratio,
        Info(
            "K_rs",
            "constant of replenishment of the track; zero: always full",
            at_least=0,
            hint="3e-8 for a low oil bath or a jet, 6e-8 for grease or oil-air, 0 for a full bath",
            usual=(0.0, 1e-6),
        ),
    ] = 3e-8

    def __post_init__(self) -> None:
        raise_if_any(faults_of("model.inlet", self))

    def __call__(self, conditions: ContactConditions) -> InletFactors:
        """Factors of the film thickness and of the rolling force."""
        oil, heating = conditions.lubricant, _heating(conditions)
        replenished = rolling.replenishment_factor(
            oil.viscosity / oil.density,
            conditions.motion.entrainment_speed,
            conditions.ball_diameter,
            self.replenishment_constant,
        )
        supplied = rolling.rolling_starvation_factor(self.inlet_film_ratio)
        left = supplied * replenished
        xp = namespace(left)
        is_short = left < JUST_ENOUGH
        supply = xp.where(is_short, rolling.inlet_film_ratio(xp.where(is_short, left, JUST_ENOUGH)), 1.0)
        return InletFactors(heating, heating * supplied * replenished, supply)


@law_traits(alternative=True)
def flooded_inlet(conditions: ContactConditions) -> InletFactors:
    """An inlet that its own shear heats (Gupta1992), in a full bath of oil: the track is always full.

    What :class:`Inlet` is without replenishment. Which of the two a ball screw has is not measured.
    """
    heating = _heating(conditions)
    return InletFactors(heating, heating)


def _heating(conditions: ContactConditions) -> Ratio:
    """Share of the film that the heat of the inlet leaves; all of it at rest, whatever slides against what."""
    v, u_s = conditions.motion.entrainment_speed, conditions.nominal_sliding_speed
    xp = namespace(v, u_s)
    slide_to_roll = xp.where(v > 0, film.slide_to_roll_ratio(u_s, xp.where(v > 0, v, 1.0)), 0.0)
    return film.inlet_heating_factor(
        conditions.maximum_pressure,
        conditions.equivalent_modulus,
        conditions.thermal_loading_parameter,
        slide_to_roll,
    )

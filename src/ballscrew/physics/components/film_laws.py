"""Laws of the film: how thick it is, and what the heat of the inlet leaves of it."""

from __future__ import annotations

import dataclasses
from typing import Annotated

from ballscrew.basis.arrays import ByValue, namespace
from ballscrew.basis.errors import faults_of, raise_if_any
from ballscrew.basis.quantities import Info, Length, Ratio
from ballscrew.physics.components.conditions import ContactConditions
from ballscrew.physics.components.laws import InletFactors
from ballscrew.physics.components.traits import law_traits
from ballscrew.physics.equations import film, rolling


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

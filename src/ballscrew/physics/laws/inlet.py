"""Laws of the inlet: heat of the shear in it, and oil that comes back too late."""

from __future__ import annotations

import dataclasses
from typing import Annotated

from ballscrew.basis.arrays import ByValue, namespace
from ballscrew.basis.errors import faults_of, raise_if_any
from ballscrew.basis.quantities import Info, Ratio
from ballscrew.physics.equations import film, rolling
from ballscrew.physics.laws.conditions import ContactConditions
from ballscrew.physics.laws.protocols import InletFactors
from ballscrew.physics.laws.traits import law_traits

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

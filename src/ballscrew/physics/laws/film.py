"""Laws of the film: its thickness, and the film parameter."""

from __future__ import annotations

import dataclasses
from typing import Annotated

from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import faults_of, raise_if_any
from ballscrew.basis.quantities import Info, Length, Ratio
from ballscrew.physics.equations import film
from ballscrew.physics.laws.conditions import ContactConditions
from ballscrew.physics.laws.traits import law_traits


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

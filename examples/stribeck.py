"""A friction law of one's own: run it with --allow-code --set model.friction=stribeck:Stribeck."""

import dataclasses
from typing import Annotated

import numpy as np

from ballscrew.basis.quantities import Info, Ratio


@dataclasses.dataclass(frozen=True)
class Stribeck:
    """Friction falls from its boundary to its full-film value as a bell over the film parameter."""

    boundary_friction_coefficient: Annotated[Ratio, Info("mu_0", "friction without a film", at_least=0)] = 0.12
    full_film_friction_coefficient: Annotated[Ratio, Info("mu_f", "friction of the film", at_least=0)] = 0.02
    width: Annotated[Ratio, Info("w", "film parameter at which the bell is down to 1/e", above=0)] = 1.0

    def __call__(self, conditions):
        share = np.exp(-((conditions.film_parameter / self.width) ** 2))
        return share * self.boundary_friction_coefficient + (1 - share) * self.full_film_friction_coefficient

"""The steady state of a duty in its surroundings, in one call."""

from __future__ import annotations

from ballscrew.axis.duty import Duty
from ballscrew.errors import accepts_units
from ballscrew.quantities import Length
from ballscrew.thermal.equilibrium import Equilibrium, equilibrium
from ballscrew.thermal.network import network_of
from ballscrew.thermal.surroundings import Surroundings


@accepts_units("steady_heat")
def steady_heat(
    duty: Duty, surroundings: Surroundings | None = None, *, shaft_length: Length | None = None
) -> Equilibrium:
    """Temperatures, preload, friction and growth in which a duty ends, and the margin to running away.

    Of one operating point take the duty of :func:`~ballscrew.axis.to_and_fro.to_and_fro`. ``shaft_length`` is taken
    where the surroundings have none. Raises :class:`~ballscrew.errors.InputError` as
    :func:`~ballscrew.thermal.network.network_of` does.
    """
    return equilibrium(network_of(duty, surroundings or Surroundings(), shaft_length=shaft_length))

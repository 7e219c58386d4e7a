"""The steady state of a duty in its surroundings, in one call."""

from __future__ import annotations

from ballscrew.axis.duty_cycle.duty import Duty
from ballscrew.axis.thermal.equilibrium import Equilibrium, equilibrium
from ballscrew.axis.thermal.network import network_of
from ballscrew.axis.thermal.surroundings import Surroundings
from ballscrew.basis.errors import accepts_units
from ballscrew.basis.quantities import Length


@accepts_units("steady_heat")
def steady_heat(
    duty: Duty, surroundings: Surroundings | None = None, *, shaft_length: Length | None = None
) -> Equilibrium:
    """Temperatures, preload, friction and growth in which a duty ends, and the stability margin of the thermal loop.

    Returns an :class:`~ballscrew.axis.thermal.equilibrium.Equilibrium` of ``duty`` in its ``surroundings``, by default
    ``Surroundings()``. Of one operating point take the duty of
    :func:`~ballscrew.axis.duty_cycle.to_and_fro.to_and_fro`. ``shaft_length`` (m) is taken where the surroundings have
    none.

    Raises :class:`~ballscrew.basis.errors.InputError` as
    :func:`~ballscrew.axis.thermal.network.network_of` does.
    """
    return equilibrium(network_of(duty, surroundings or Surroundings(), shaft_length=shaft_length))

"""The steady state in which a duty ends, with the stability margin of its thermal loop."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
from scipy.optimize import root_scalar

from ballscrew.axis.duty_cycle.duty import Duty
from ballscrew.axis.motion.states import Numbers
from ballscrew.axis.thermal.network import Network, network_of
from ballscrew.axis.thermal.surroundings import Surroundings
from ballscrew.basis import units
from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import accepts_units
from ballscrew.basis.quantities import Length, Power, Ratio

#: Points of the powers among which an equilibrium is looked for.
_POWERS = 400


@dataclasses.dataclass(frozen=True, eq=False)
class Equilibrium(ByValue):
    """The state in which a duty ends, if it ends in one.

    ``margin`` is 1 − g, g being the gain of the loop heat → temperature → friction → heat there: above zero the
    state is stable. Where there is no equilibrium in the range in which oil and preload are known, the margin is the
    greatest surplus of what the surroundings take over the friction, as a share of the friction, and negative.
    """

    network: Network
    exists: bool
    margin: Ratio
    #: Mean friction power of the nut, W; NaN where there is no equilibrium.
    power: Power
    #: Temperatures of shaft cells, nut and bearings, K; NaN where there is no equilibrium.
    temperatures: Numbers

    @property
    def shown_margin(self) -> str:
        """The margin as people read it."""
        return units.number(self.margin, 3)

    @property
    def nut_temperature(self) -> float:
        """Temperature of the nut, K."""
        return float(self.temperatures[-3])

    @property
    def oil_temperature(self) -> float:
        """Temperature of the oil, K."""
        return float(self.network.of_oil @ self.temperatures)

    @property
    def shaft_temperature(self) -> float:
        """Mean temperature of the shaft, K."""
        return float(np.mean(self.temperatures[:-3]))

    @property
    def preload(self) -> float:
        """Preload, N."""
        return float(self.network.preload(self.network.of_excess @ self.temperatures))

    @property
    def growth(self) -> Length:
        """Growth of the shaft between its bearings, m."""
        shaft = self.network.shaft
        return float(shaft.growth_at(self.temperatures[:-3], self.network.surroundings.ambient, shaft.length)[0])


def equilibrium(network: Network) -> Equilibrium:
    r"""The steady state, by one equation for the friction power: :math:`P = f(T(P))`, T being linear in P.

    Of several the coolest is taken, which is the one that a cold machine reaches.
    """
    idle, per_watt = np.linalg.solve(network.conductances, np.stack([network.constant, network.source], axis=1)).T

    def surplus(power: Power) -> Power:
        """Friction beyond the power that the temperatures are those of."""
        return network.power(idle + per_watt * power) - power

    largest = 2 * max(float(np.max(network.friction.power)), 1e-9)
    powers = np.concatenate([[0.0], np.geomspace(1e-6, 1.0, _POWERS) * largest])
    values = network.powers(idle + powers[:, None] * per_watt) - powers
    known = np.isfinite(values)
    for i in range(powers.size - 1):
        if values[i] >= 0 > values[i + 1] and known[i] and known[i + 1]:
            power = root_scalar(surplus, bracket=(powers[i], powers[i + 1]), xtol=1e-12, rtol=1e-14).root
            step = 1e-4 * power
            gain = (surplus(power + step) - surplus(power - step)) / (2 * step) + 1 if step else 0.0
            return Equilibrium(network, True, 1 - gain, power, idle + per_watt * power)
    here = known & (powers > 0)
    friction = values[here] + powers[here]
    margin = float(np.max(-values[here] / np.maximum(friction, 1e-12))) if here.any() else -1.0
    return Equilibrium(network, False, min(margin, 0.0), math.nan, np.full(network.size, np.nan))


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

r"""Networks of heat by their modes: the linear part of each step is exact, whatever its length.

A network :math:`C \dot T = -A T + b + s P` has a symmetric A, so that :math:`T = W y` with
:math:`\dot y_i = -\lambda_i y_i + \beta_i + \sigma_i P`. Over a step of length h, with a friction power that goes
evenly from :math:`P_0` to :math:`P_1` and :math:`z = \lambda h`,

.. math::

    y(h) = e^{-z} y_0 + h \varphi_1(z) (\beta + \sigma P_0) + h \varphi_2(z) \sigma (P_1 - P_0)

An exponential integrator of second order (CoxMatthews2002, ETD2RK): only the friction is approximated. Networks stand
side by side, each with numbers of its own, and are stepped together.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Sequence

import numpy as np

from ballscrew.axis.motion.states import Numbers
from ballscrew.axis.thermal.network import Network
from ballscrew.basis.arrays import ByValue
from ballscrew.basis.quantities import Duration

#: Below it the functions φ are summed as series, whose further terms are beyond rounding.
_SMALL, _TERMS = 0.5, 14
Power = Callable[[Numbers], Numbers]


@dataclasses.dataclass(frozen=True, eq=False)
class Modes(ByValue):
    """Networks side by side, diagonalised; all have as many temperatures."""

    #: Rates λ of decay, 1/s: networks by modes.
    rates: Numbers
    #: Temperatures by modes, W, of each network, and its inverse.
    to_temperatures: Numbers
    from_temperatures: Numbers
    #: Heat from outside and share of the friction, in modes, and the loss to the outside by modes.
    constant: Numbers
    source: Numbers
    losses: Numbers
    #: Loss at a temperature of zero kelvin, W.
    loss_at_zero: Numbers
    #: Heat of the bearings, W.
    of_bearings: Numbers

    @classmethod
    def of(cls, networks: Sequence[Network], *, works: bool = True) -> Modes:
        """The modes of networks; of those that stand neither nut nor bearings make heat."""
        capacity = np.array([one.capacity for one in networks])
        root = np.sqrt(capacity)
        matrix = np.array([one.conductances for one in networks]) / root[:, :, None] / root[:, None, :]
        rates, vectors = np.linalg.eigh(matrix)
        to = vectors / root[:, :, None]
        back = np.swapaxes(to, 1, 2) * capacity[:, None, :]
        losses, outside = np.array([one.losses for one in networks]), np.array([one.outside for one in networks])
        given = np.array([one.constant for one in networks]) if works else losses * outside
        source = np.array([one.source for one in networks])

        def in_modes(heat: Numbers) -> Numbers:
            return np.einsum("kni,kn->ki", to, heat)

        return cls(
            np.maximum(rates, 0.0),
            to,
            back,
            in_modes(given),
            in_modes(source),
            in_modes(losses),
            -np.sum(losses * outside, axis=1),
            np.sum(given - losses * outside, axis=1),
        )

    def weights(self, of_temperatures: Numbers) -> Numbers:
        """Weights of the modes in sums of temperatures, whose weights are given: networks by temperatures."""
        return np.einsum("kni,kn->ki", self.to_temperatures, of_temperatures)

    def temperatures(self, modes: Numbers) -> Numbers:
        """Temperatures of modes, K: networks by temperatures."""
        return np.einsum("kni,ki->kn", self.to_temperatures, modes)

    def modes(self, temperatures: Numbers) -> Numbers:
        """Modes of temperatures."""
        return np.einsum("kin,kn->ki", self.from_temperatures, temperatures)

    def step(self, length: Duration) -> Step:
        """The step of a length."""
        e, p1, p2, p3 = functions(self.rates * length)
        h, beta, sigma, lost = length, self.constant, self.source, self.losses
        return Step(
            h,
            e,
            h * p1 * beta,
            h * p1 * sigma,
            h * p2 * sigma,
            h * p1 * lost,
            h * (np.sum(h * p2 * beta * lost, axis=1) + self.loss_at_zero),
            h**2 * np.sum(p2 * sigma * lost, axis=1),
            h**2 * np.sum(p3 * sigma * lost, axis=1),
            h * self.of_bearings,
        )


@dataclasses.dataclass(frozen=True, eq=False)
class Step(ByValue):
    """A step of one length of networks side by side."""

    length: Duration
    #: What becomes of the modes, and what they gain by the constant heat, the friction, and its change.
    decay: Numbers
    by_constant: Numbers
    by_friction: Numbers
    by_change: Numbers
    #: Heat lost by the modes, the constant heat, the friction, and its change.
    lost_of_modes: Numbers
    lost_by_constant: Numbers
    lost_by_friction: Numbers
    lost_by_change: Numbers
    #: Heat of the bearings, J.
    of_bearings: Numbers

    def after(
        self, modes: Numbers, power: Numbers, friction: Power | None
    ) -> tuple[Numbers, Numbers, Numbers, Numbers]:
        """Modes, friction power, and heat generated and lost after the step; without friction no power counts."""
        first = self.decay * modes + self.by_constant
        lost = np.sum(self.lost_of_modes * modes, axis=1) + self.lost_by_constant
        if friction is None:
            return first, power, self.of_bearings, lost
        held = first + self.by_friction * power[:, None]
        change = friction(held) - power
        reached = held + self.by_change * change[:, None]
        generated = self.length * (power + change / 2) + self.of_bearings
        lost = lost + self.lost_by_friction * power + self.lost_by_change * change
        return reached, friction(reached), generated, lost


def functions(z: Numbers) -> tuple[Numbers, Numbers, Numbers, Numbers]:
    r""":math:`e^{-z}` and :math:`\varphi_1, \varphi_2, \varphi_3` of −z.

    :math:`\varphi_{k+1}(-z) = (1/k! - \varphi_k(-z))/z` and :math:`\varphi_0(-z) = e^{-z}`, without cancellation.
    """
    small = np.minimum(z, _SMALL)
    series, term = np.zeros_like(small), np.full_like(small, 1 / 6)
    for k in range(_TERMS):
        series = series + term
        term = -term * small / (k + 4)
    below = z < _SMALL
    large = np.maximum(z, _SMALL)
    direct = (0.5 - (1 - (1 - np.exp(-large)) / large) / large) / large
    third = np.where(below, series, direct)
    second = 0.5 - z * third
    first = 1 - z * second
    return np.exp(-z), first, second, third

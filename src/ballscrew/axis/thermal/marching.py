"""Networks of heat through time, side by side, by exact steps of their linear parts
(:mod:`~ballscrew.axis.thermal.modes`).

A *slot* is a time in which the networks stay the same: that of a duty whose heat is spread over its stroke, or one
place after the other of a nut that moves.
"""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from ballscrew.axis.motion.states import Numbers
from ballscrew.axis.thermal.modes import Modes, Step
from ballscrew.axis.thermal.network import FrictionFactor, Network
from ballscrew.basis.arrays import ByValue
from ballscrew.basis.quantities import Duration

#: Steps in the time in which the nut warms up, and in the time that has passed: friction then changes little in one,
#: and of a start from the cold the temperature of the nut is within half a millikelvin.
PER_NUT, PER_TIME = 8.0, 30.0
#: Temperatures in all steps that are kept for the next of the same slot and length.
_KEPT = 2_000_000
#: A share of a doubling or of a step that is rounding.
_ROUNDING = 1e-9
_AS_IT_IS = FrictionFactor((0.0, 1.0), (1.0, 1.0))


class Piece(NamedTuple):
    """A time within one slot; after it, the state may be asked for."""

    slot: int
    start: Duration
    length: Duration
    shown: bool


class State(NamedTuple):
    """Temperatures of networks side by side, and the heat that they have generated and lost; NaN where unknown."""

    #: Networks by temperatures, K.
    temperatures: Numbers
    #: Of each network, J.
    generated: Numbers
    lost: Numbers


@dataclasses.dataclass(frozen=True, eq=False)
class Slot(ByValue):
    """Networks side by side as they are for a time, all with one map of friction; those that stand make no heat."""

    networks: Sequence[Network]
    modes: Modes
    works: bool

    @classmethod
    def of(cls, networks: Sequence[Network], *, works: bool = True) -> Slot:
        """The slot of networks."""
        return cls(tuple(networks), Modes.of(networks, works=works), works)

    def _array(self, name: str) -> Numbers:
        return np.array([getattr(network, name) for network in self.networks])

    @functools.cached_property
    def _nuts(self) -> Network:
        """The first network with the nuts of all in it: arrays of what their preload and friction follow from."""
        factors = [network.friction_factor or _AS_IT_IS for network in self.networks]
        cold, warm = np.array([one.temperatures for one in factors]).T
        of_cold, of_warm = np.array([one.factors for one in factors]).T
        numbers = {name: self._array(name) for name in ("preload_set", "approach_set", "approach_per_kelvin")}
        factor = FrictionFactor((cold, warm), (of_cold, of_warm))
        return dataclasses.replace(self.networks[0], friction_factor=factor, **numbers)

    @functools.cached_property
    def _in_modes(self) -> tuple[Numbers, Numbers]:
        return self.modes.weights(self._array("of_oil")), self.modes.weights(self._array("of_excess"))

    def power_of_modes(self, modes: Numbers) -> Numbers:
        """Friction power of each network by its modes, W; NaN where it is not known."""
        of_oil, of_excess = self._in_modes
        preload = self._nuts.preload(np.sum(of_excess * modes, axis=1))
        return self._nuts.power_at(np.sum(of_oil * modes, axis=1), preload)

    def power_of(self, temperatures: Numbers, spread: Numbers) -> tuple[Numbers, Numbers]:
        """Preload and friction power of each network with its nut over cells of those shares: N and W."""
        nut, shaft = temperatures[:, -3], temperatures[:, :-3] @ spread
        preload = self._nuts.preload(shaft - nut)
        return preload, self._nuts.power_at((nut + shaft) / 2, preload)


def marched(
    slots: Sequence[Slot], pieces: Iterable[Piece], start: Numbers, *, grows: bool = True, since: Duration = 0.0
) -> Iterator[State]:
    """States after the pieces that are shown; ``start`` has networks by temperatures.

    Steps grow with the time since the start where heat ``grows`` evenly, and stay short where its place moves.
    """
    at, kept = 0, dict[tuple[int, float], Step]()
    shortest = min(_nut_time(network) for slot in slots for network in slot.networks) / PER_NUT
    frictions = [slot.power_of_modes if slot.works else None for slot in slots]
    modes = slots[at].modes.modes(start)
    generated, lost = np.zeros(len(start)), np.zeros(len(start))
    power, first = np.zeros(len(start)), True
    for slot, begins, length, shown in pieces:
        if slot != at:
            modes, at, first = slots[slot].modes.modes(slots[at].modes.temperatures(modes)), slot, True
        friction = frictions[at]
        if first and friction is not None:
            power = friction(modes)
        first = False
        steps = [length] if friction is None else _steps(begins - since, length, shortest, grows=grows)
        for step in steps:
            key = at, float(f"{step:.12g}")
            if key not in kept:
                if len(kept) * modes.size >= _KEPT:
                    kept.clear()
                kept[key] = slots[at].modes.step(key[1])
            modes, power, made, gone = kept[key].after(modes, power, friction)
            generated, lost = generated + made, lost + gone
        if shown:
            yield State(slots[at].modes.temperatures(modes), generated, lost)


def _steps(begins: Duration, length: Duration, shortest: Duration, *, grows: bool) -> Iterator[Duration]:
    """Lengths of the steps in a time; where they grow, they double as the time does, so that few differ."""
    now, end = begins, begins + length
    while now < end:
        doublings = int(np.floor(np.log2(max(now / (PER_TIME * shortest), 1.0)) + _ROUNDING)) if grows else 0
        until = min(end, PER_TIME * shortest * 2.0 ** (doublings + 1)) if grows else end
        count = max(1, int(np.ceil((until - now) / (shortest * 2.0**doublings) - _ROUNDING)))
        yield from [(until - now) / count] * count
        now = until


def _nut_time(network: Network) -> Duration:
    """Time in which a nut warms up by itself, s."""
    return float(network.capacity[-3] / max(network.conductances[-3, -3], 1e-9))

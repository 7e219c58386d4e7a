"""A nut that heats the shaft where it is: slow motions and long moves, place after place in the same finite volumes.

A cycle is cut into slots in which the nut goes no farther than an eighth of its length. In each the network is the same
as that of heat spread over the stroke, with the nut where it is then and the friction of that time.
"""

from __future__ import annotations

import dataclasses
import functools
import itertools
from collections.abc import Iterable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

from ballscrew.axis.duty_cycle.duty import Duty
from ballscrew.axis.motion.states import Numbers
from ballscrew.axis.thermal.friction_map import FrictionMap, state_maps
from ballscrew.axis.thermal.modes import Modes, Step
from ballscrew.axis.thermal.network import FrictionFactor, Network, nut_length_of
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


def marched(slots: Sequence[Slot], pieces: Iterable[Piece], start: Numbers, *, grows: bool = True) -> Iterator[State]:
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
        steps = [length] if friction is None else _steps(begins, length, shortest, grows=grows)
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


#: A cycle longer than this share of the time is followed place by place; shorter ones pass each place so often that
#: their heat is spread.
LONG_CYCLE = 0.02
#: Slots in the time in which the nut goes its own length, in a cycle at least, and at most.
PER_NUT_LENGTH, LEAST, MOST = 8.0, 8, 400
#: Instants of a slot at which it is asked where the nut is.
_INSTANTS = 8


def is_long(duty: Duty, time: Duration) -> bool:
    """True of a cycle so long against the time that the heat goes with the nut."""
    return duty.states.cycle_time > LONG_CYCLE * time


@dataclasses.dataclass(frozen=True, eq=False)
class Itinerary(ByValue):
    """The slots of a cycle: when they are, where the nut is, and its friction."""

    #: Ends of the slots since the start of the cycle, s; one more than slots.
    edges: Numbers
    #: Shares of the cells of the shaft in the nut: slots by cells.
    spreads: Numbers
    frictions: Sequence[FrictionMap]

    def networks(self, network: Network) -> list[Network]:
        """The network of each slot, from that of the heat spread over the stroke."""
        return [
            dataclasses.replace(network, spread=spread, friction=friction)
            for spread, friction in zip(self.spreads, self.frictions, strict=True)
        ]

    def spreads_at(self, instants: Numbers) -> Numbers:
        """Shares of the cells in the nut at instants since the start, cycle after cycle: instants by cells."""
        within = np.mod(instants, self.edges[-1])
        slot = np.clip(np.searchsorted(self.edges, within, side="right") - 1, 0, len(self.spreads) - 1)
        return self.spreads[slot]

    def spreads_until(self, instants: Numbers) -> Numbers:
        """The same just before the instants: of a slot that ends there, which is still that of the state."""
        return self.spreads_at(instants * (1 - _ROUNDING))

    def pieces(self, instants: Numbers) -> Iterator[Piece]:
        """Slots one after the other, cycle after cycle, cut where the state is asked for; the first instant is now."""
        cycle, now, shown = self.edges[-1], float(instants[0]), 1
        least = _ROUNDING * cycle
        while shown < instants.size:
            begun = np.floor((now + least) / cycle) * cycle
            slot = int(np.clip(np.searchsorted(self.edges, now - begun + least, side="right") - 1, 0, _last(self)))
            end = begun + self.edges[slot + 1]
            until = min(end, float(instants[shown]))
            asked = until >= float(instants[shown]) - least
            yield Piece(slot, now, max(until - now, 0.0), asked)
            now, shown = until, shown + asked


def _last(itinerary: Itinerary) -> int:
    return len(itinerary.spreads) - 1


def itinerary_of(duty: Duty, network: Network) -> Itinerary:
    """The slots of a duty on the shaft of its network."""
    states = duty.states
    ends = np.concatenate([[0.0], np.cumsum(states.weight)])
    driven: Any = duty.driven
    nut_length = nut_length_of(driven.screw)
    # a measure that grows with the way and with the time, in slots
    way = np.concatenate([[0.0], np.cumsum(states.weight * np.abs(states.speed))])
    measure = PER_NUT_LENGTH * way / nut_length + LEAST * ends / ends[-1]
    count = int(np.clip(np.ceil(measure[-1]), LEAST, MOST))
    edges = np.interp(np.linspace(0.0, measure[-1], count + 1), measure, ends)
    start = network.ends[0] - float(np.min(states.position))
    shares = (np.arange(_INSTANTS) + 0.5) / _INSTANTS
    maps = state_maps(duty)
    spreads: list[Numbers] = []
    frictions: list[FrictionMap] = []
    for a, b in itertools.pairwise(edges):
        places = start + np.interp(a + shares * (b - a), states.time, states.position)
        spreads.append(network.shaft.spread(places, np.ones(_INSTANTS), nut_length))
        overlap = np.maximum(np.minimum(b, ends[1:]) - np.maximum(a, ends[:-1]), 0.0)
        frictions.append(maps.mean(overlap, b - a))
    return Itinerary(edges, np.array(spreads), frictions)

"""A nut that heats the shaft where it is: slow motions and long moves, place after place in the same finite volumes.

A cycle is cut into slots in which the nut goes no farther than an eighth of its length. In each the network is the same
as that of heat spread over the stroke, with the nut where it is then and the friction of that time.
"""

from __future__ import annotations

import dataclasses
import itertools
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from ballscrew.axis.duty_cycle.duty import Duty
from ballscrew.axis.motion.states import Numbers
from ballscrew.axis.thermal.friction_map import FrictionMap, state_maps
from ballscrew.axis.thermal.marching import Piece
from ballscrew.axis.thermal.network import Network, nut_length_of
from ballscrew.basis.arrays import ByValue
from ballscrew.basis.quantities import Duration

#: A cycle longer than this share of the time is followed place by place; shorter ones pass each place so often that
#: their heat is spread.
LONG_CYCLE = 0.02
#: Slots in the time in which the nut goes its own length, in a cycle at least, and at most.
PER_NUT_LENGTH, LEAST, MOST = 8.0, 8, 400
#: Instants of a slot at which it is asked where the nut is.
_INSTANTS = 8
#: Shorter pieces than this share of a cycle are rounding.
_ROUNDING = 1e-9


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

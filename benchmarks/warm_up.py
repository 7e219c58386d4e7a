"""How fast a screw warms up: transients of a preloaded nut, against the model itself as right-hand side, in one run.

``python benchmarks/warm_up.py`` prints a table, ``--json`` one object. The nut is a double one of the catalogue with
3.5 kN, the duty to and fro at 1000 rpm over half a metre, four hours.

- ``first``: the first transient of a duty, with the map of its friction.
- ``transient``: the next ones, with other surroundings.
- ``steady``: the steady state alone.
- ``band``: a thousand transients for a band, side by side (``bs.warm_up_band``), on one processor.
- ``plain``: the same four hours with the model called at every right-hand side; temperatures of both are compared.
"""

from __future__ import annotations

import dataclasses
import functools
import math
import statistics
from typing import Any

import numpy as np

import ballscrew as bs
from ballscrew.axis.duty_cycle.duty import Duty
from ballscrew.axis.thermal.friction_map import state_maps
from ballscrew.axis.thermal.network import Network
from ballscrew.axis.thermal.warm_up import WarmUp, warm_up
from harness import asked, seconds, told

PRELOAD, RPM, STROKE, START = 3500.0, 1000.0, 0.5, 293.15
AIR = bs.Surroundings(shaft_length=1.2, ambient=START)
MODEL = bs.FrictionModel.reference()
SCREW = bs.catalogue()["rexroth-40x10x6-6-double"].screw(nut=bs.DoubleNut(preload=PRELOAD))
OIL = bs.Lubricant.from_grade("ISO VG 100", START)
#: Seconds of the transient.
HOURS = 4 * 3600.0


def duty() -> Duty:
    """To and fro without a load."""
    return bs.to_and_fro(MODEL, SCREW, OIL, axial_load=0.0, screw_speed=RPM * math.tau / 60, stroke=STROKE)


@dataclasses.dataclass(frozen=True, eq=False)
class Plain(Network):
    """The network, with the model in place of the map."""

    of: Any = None
    calls: list[int] = dataclasses.field(default_factory=lambda: [0])

    def power(self, temperatures: Any) -> float:
        """Mean friction power of the nut, W, by a call of the model."""
        self.calls[0] += 1
        screw = dataclasses.replace(SCREW, nut=bs.DoubleNut(preload=float(self.preload(self.of_excess @ temperatures))))
        oil = OIL.at(float(self.of_oil @ temperatures))
        speed = RPM * math.tau / 60
        found = MODEL(screw, oil, axial_load=0.0, screw_speed=np.array([speed, -speed]))
        return float(np.mean(found.screw_torque)) * speed


def plain(network: Network, duration: float) -> tuple[float, int, float]:
    """Time of the plain way, its calls, and the temperature of the nut at the end."""
    from ballscrew.axis.thermal import warm_up

    fields = {field.name: getattr(network, field.name) for field in dataclasses.fields(Network)}
    own = Plain(**fields)
    start = np.full(own.size, START)
    made: list[Any] = []
    took = seconds(lambda: made.extend(warm_up._integrated(own, start, np.array([0.0, duration]), works=True)))
    instants, states, stopped = made
    found = WarmUp(duty(), own, instants, states, np.ones(instants.size, dtype=bool), stopped)
    return took, own.calls[0], float(found.nut_temperature[-1])


def transient(surroundings: bs.Surroundings) -> WarmUp:
    """Four hours, with everything that is shown of them."""
    found = warm_up(duty(), surroundings)
    assert np.isfinite(found.screw_torque).all() or found.stopped is not None
    assert found.shaft_growth.shape == found.preload.shape
    return found


def measured(rounds: int) -> dict[str, float]:
    """All times in seconds, and ratios."""

    def timed(work: Any, rounds: int = rounds) -> float:
        return statistics.median(seconds(work) for _ in range(rounds))

    MODEL(SCREW, OIL, axial_load=0.0, screw_speed=1.0)  # imports and tables that every use of the model pays once
    found: dict[str, float] = {"first": seconds(lambda: transient(AIR))}
    found["transient"] = timed(lambda: transient(AIR))
    found["map"] = timed(lambda: state_maps.__wrapped__(duty()))
    found["steady"] = timed(lambda: bs.steady_heat(duty(), AIR))
    found["band"] = seconds(lambda: bs.warm_up_band(duty(), AIR, samples=1000))
    ours = functools.partial(warm_up, duty(), AIR, time=HOURS, outputs=2)
    short, last = timed(ours), ours()
    took, calls, temperature = plain(last.network, HOURS)
    difference = abs(temperature - float(last.nut_temperature[-1]))
    return found | {"plain": took, "plain_calls": calls, "plain_over_ours": took / short, "difference": difference}


#: Asked for, s.
LIMITS = {"transient": (0.3, False)}

if __name__ == "__main__":
    given = asked(__doc__, rounds=5)
    told(measured(given.rounds), given.json, LIMITS)

"""How fast an axis is: a recorded motion, cycles of a Monte Carlo, and hours of warming up, in one run.

``python benchmarks/axis.py`` prints a table, ``--json`` one object, ``--only`` one of its parts. The nut is a double
one of the catalogue, rigid, with 3.5 kN; the model ``reference``.

- ``duty``: a million samples of a motion with the noise of an encoder, all of them different, and again; the largest
  memory of the process until then; cycles of a Monte Carlo over preload, temperature and boundary friction, on a duty
  of about 400 states.
- ``warm-up``: four hours of a duty to and fro at 1000 rpm over half a metre; a thousand of these transients for a band,
  side by side (``bs.warm_up_band``), on one processor; the same four hours with the model called at every right-hand
  side (``plain``), whose last temperatures are compared.
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
from ballscrew.axis.motion.trajectory import Trajectory
from ballscrew.axis.thermal import warm_up
from ballscrew.axis.thermal.network import Network
from ballscrew.axis.thermal.warm_up import WarmUp
from harness import asked, megabytes, seconds, told

PRELOAD, RPM, STROKE, START = 3500.0, 1000.0, 0.5, 293.15
MODEL = bs.FrictionModel.reference()
SCREW = bs.catalogue()["rexroth-40x10x6-6-double"].screw(nut=bs.DoubleNut(preload=PRELOAD))
WARM, COLD = (bs.Lubricant.from_grade("ISO VG 100", temperature) for temperature in (313.15, START))
AXIS = bs.Axis(mass=400.0, inclination=math.pi / 2, guide_seal_force=40.0, inertia=5e-3)
AIR = bs.Surroundings(shaft_length=1.2, ambient=START)
#: Samples of the recorded motion, their rate in Hz, and the noise of its encoder, m.
SAMPLES, RATE, NOISE = 1_000_000, 1000.0, 1e-6
UNCERTAIN = {
    "nut.preload": bs.Normal(PRELOAD, 350.0),
    "temperature": bs.Normal(313.15, 5.0),
    "friction.boundary_friction_coefficient": bs.Normal(0.12, 0.02),
}
#: Seconds of the transient.
HOURS = 4 * 3600.0
#: Asked for, s.
LIMITS = {"transient": (0.3, False)}


def of_duty(cycles: int, _: int) -> dict[str, float]:
    """Times of a recorded motion, a sine of 0.4 m in 4 s, and of a band."""
    time = np.arange(SAMPLES) / RATE
    position = 0.2 * (1 - np.cos(2 * math.pi * time / 4)) + np.random.default_rng(1).normal(0.0, NOISE, SAMPLES)
    motion = Trajectory(time=time, position=position)

    def whole() -> None:
        found = bs.duty(MODEL, SCREW, WARM, axis=AXIS, motion=motion)
        assert math.isfinite(found.torque_rms + found.energy_lost)  # everything computed

    taken = {"first": seconds(whole), "again": seconds(whole), "memory_MB": megabytes()}
    stroke = bs.SCurve(stroke=0.5, speed=0.5, acceleration=4.9, jerk=50.0, dwell=1.0, force=500.0)
    found = bs.duty(MODEL, SCREW, WARM, axis=AXIS, motion=stroke)
    bs.duty_band(found, distributions=UNCERTAIN, samples=1024)
    band = seconds(lambda: bs.duty_band(found, distributions=UNCERTAIN, samples=cycles))
    return {**taken, "cycles": cycles, "band": band, "states": found.screw.points}


def to_and_fro() -> Duty:
    """To and fro without a load."""
    return bs.to_and_fro(MODEL, SCREW, COLD, axial_load=0.0, screw_speed=RPM * math.tau / 60, stroke=STROKE)


@dataclasses.dataclass(frozen=True, eq=False)
class Plain(Network):
    """The network, with the model in place of the map."""

    calls: list[int] = dataclasses.field(default_factory=lambda: [0])

    def power(self, temperatures: Any) -> float:
        """Mean friction power of the nut, W, by a call of the model."""
        self.calls[0] += 1
        screw = dataclasses.replace(SCREW, nut=bs.DoubleNut(preload=float(self.preload(self.of_excess @ temperatures))))
        oil = COLD.at(float(self.of_oil @ temperatures))
        speed = RPM * math.tau / 60
        found = MODEL(screw, oil, axial_load=0.0, screw_speed=np.array([speed, -speed]))
        return float(np.mean(found.screw_torque)) * speed


def plain(network: Network, duration: float) -> tuple[float, int, float]:
    """Time of the plain way, its calls, and the temperature of the nut at the end."""
    own = Plain(**{field.name: getattr(network, field.name) for field in dataclasses.fields(Network)})
    start = np.full(own.size, START)
    made: list[Any] = []
    took = seconds(lambda: made.extend(warm_up._integrated(own, start, np.array([0.0, duration]), works=True)))
    instants, states, stopped = made
    found = WarmUp(to_and_fro(), own, instants, states, np.ones(instants.size, dtype=bool), stopped)
    return took, own.calls[0], float(found.nut_temperature[-1])


def transient() -> None:
    """Four hours, with everything that is shown of them."""
    found = warm_up.warm_up(to_and_fro(), AIR)
    assert np.isfinite(found.screw_torque).all() or found.stopped is not None
    assert found.shaft_growth.shape == found.preload.shape


def of_warm_up(_: int, rounds: int) -> dict[str, float]:
    """Times in seconds, and what the model itself takes and finds."""

    def timed(work: Any) -> float:
        return statistics.median(seconds(work) for _ in range(rounds))

    transient()  # imports, tables and the map of the friction, which are made once
    found = {"transient": timed(transient)}
    found["band"] = seconds(lambda: bs.warm_up_band(to_and_fro(), AIR, samples=1000))
    ours = functools.partial(warm_up.warm_up, to_and_fro(), AIR, time=HOURS, outputs=2)
    short, last = timed(ours), ours()
    took, calls, temperature = plain(last.network, HOURS)
    difference = abs(temperature - float(last.nut_temperature[-1]))
    return found | {"plain": took, "plain_calls": calls, "plain_over_ours": took / short, "difference": difference}


PARTS = {"duty": of_duty, "warm-up": of_warm_up}

if __name__ == "__main__":
    given = asked(__doc__, cycles=100_000, rounds=5, only=list(PARTS))
    told({name: PARTS[name](given.cycles, given.rounds) for name in given.only or PARTS}, given.json, LIMITS)

"""How fast a duty is: a million samples of a recorded motion, and a Monte Carlo over a cycle, against the plain way.

``python benchmarks/duty.py`` prints a table, ``--json`` one object. The nut is a double one of the catalogue, rigid,
with 3.5 kN; the model ``reference``.

- ``noisy``: a million samples of a motion with the noise of an encoder, all of them different.
- ``repeated``: a million samples that repeat those of one cycle.
- ``band``: cycles of a Monte Carlo over preload, temperature and boundary friction, on a duty of about 400 states.
- ``plain`` beside each: the model itself on arrays, for a part of the points, extrapolated.

Memory is the largest of the process until then, so that the first figure has that of the program in it.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

import ballscrew as bs
from ballscrew.axis.duty_cycle.duty import Duty
from ballscrew.axis.motion.trajectory import Trajectory
from harness import asked, megabytes, seconds, told

MODEL = bs.FrictionModel.reference()
SCREW = bs.catalogue()["rexroth-40x10x6-6-double"].screw(nut=bs.DoubleNut(preload=3500.0))
OIL = bs.Lubricant.from_grade("ISO VG 100", 313.15)
AXIS = bs.Axis(mass=400.0, inclination=math.pi / 2, guide_seal_force=40.0, inertia=5e-3)
SAMPLES, RATE = 1_000_000, 1000.0
#: Encoder noise, m.
NOISE = 1e-6
UNCERTAIN = {
    "nut.preload": bs.Normal(3500.0, 350.0),
    "temperature": bs.Normal(313.15, 5.0),
    "friction.boundary_friction_coefficient": bs.Normal(0.12, 0.02),
}
PLAIN = 20_000


def recorded(noise: float) -> Trajectory:
    """A sine of 0.4 m in 4 s, sampled, with the noise of an encoder."""
    time = np.arange(SAMPLES) / RATE
    position = 0.2 * (1 - np.cos(2 * math.pi * time / 4))
    if noise:
        position = position + np.random.default_rng(1).normal(0.0, noise, SAMPLES)
    return Trajectory(time=time, position=position)


def whole(trajectory: Trajectory) -> Duty:
    """The duty of a recorded motion, everything computed."""
    found = bs.duty(MODEL, SCREW, OIL, axis=AXIS, motion=trajectory)
    assert math.isfinite(found.torque_rms + found.energy_lost)
    return found


def of_the_model(points: int) -> float:
    """Seconds of the model on arrays for so many points of a duty, extrapolated from a part of them."""
    random = np.random.default_rng(2)
    load, speed = random.normal(4000.0, 500.0, PLAIN), random.normal(0.0, 100.0, PLAIN)

    def work() -> None:
        result = MODEL(SCREW, OIL, axial_load=load, screw_speed=speed)
        _ = (result.contributions, result.valid, result.maximum_pressure, result.minimum_film_parameter)

    work()
    return seconds(work) * points / PLAIN


def measured(cycles: int) -> dict[str, dict[str, Any]]:
    """Times by name."""
    rows: dict[str, dict[str, Any]] = {}
    for name, noise in (("noisy", NOISE), ("repeated", 0.0)):
        motion = recorded(noise)
        first = seconds(lambda motion=motion: whole(motion))
        again = seconds(lambda motion=motion: whole(motion))
        rows[name] = {"first": first, "again": again, "memory": megabytes(), "plain": of_the_model(SAMPLES)}
    motion = bs.SCurve(stroke=0.5, speed=0.5, acceleration=4.9, jerk=50.0, dwell=1.0, force=500.0)
    found = bs.duty(MODEL, SCREW, OIL, axis=AXIS, motion=motion)
    states = found.screw.points
    bs.duty_band(found, distributions=UNCERTAIN, samples=1024)
    time = seconds(lambda: bs.duty_band(found, distributions=UNCERTAIN, samples=cycles))
    plain = of_the_model(cycles * states)
    rows["band"] = {"first": time, "again": time, "memory": megabytes(), "plain": plain, "states": states}
    return rows


if __name__ == "__main__":
    options = asked(__doc__, cycles=100_000)
    rows = measured(options.cycles)
    told({name: {**row, "ratio": row["plain"] / row["again"]} for name, row in rows.items()}, options.json)

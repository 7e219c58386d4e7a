"""How often the intervals of a fit hold the truth if the sensor of the oil temperature is off.

40 synthetic logs of a double nut, each of 300 rows with noise of 1 % at 25 to 45 °C, whose temperatures are off by one
number in the whole log: normal, with a standard deviation of 1 K. Boundary friction coefficient and preload are free.
Each log is fitted twice: with the usual error of the temperature (2 K at 95 %), and with none.

    python benchmarks/temperature_error.py            print the table, as Markdown
    python benchmarks/temperature_error.py --write    and store it in docs/temperature_coverage.inc
"""

from __future__ import annotations

import argparse
import dataclasses
import math
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import ballscrew as bs
from ballscrew.physics.components.materials import Lubricant

PAGE = Path(__file__).parents[1] / "docs" / "temperature_coverage.inc"
LOGS, ROWS, NOISE = 40, 300, 0.01
#: Standard deviation of the error of the sensor, K.
SENSOR = 1.0
FREE = ("boundary_friction_coefficient", "nut.preload")
WORDS = {"boundary_friction_coefficient": "boundary friction coefficient", "nut.preload": "preload"}
TRUE = {"boundary_friction_coefficient": 0.105, "nut.preload": 3000.0}
MODEL = bs.FrictionModel.reference()
OIL = Lubricant.from_grade("ISO VG 68", 308.15)
SCREW = bs.catalogue()["rexroth-40x10x6-6-double"].screw(nut=bs.DoubleNut(preload=4000.0))
RPM = 2 * math.pi / 60


def log(seed: int) -> dict[str, NDArray[np.float64]]:
    """Friction torques of the true nut in both directions, without load and loaded, and what the sensor says."""
    random = np.random.default_rng(seed)
    friction: Any = MODEL.friction
    friction = dataclasses.replace(friction, boundary_friction_coefficient=TRUE["boundary_friction_coefficient"])
    screw = dataclasses.replace(SCREW, nut=bs.DoubleNut(preload=TRUE["nut.preload"]))
    load = np.where(random.random(ROWS) < 0.5, 0.0, random.uniform(0.0, 6000.0, ROWS))
    speed = np.exp(random.uniform(math.log(10), math.log(600), ROWS)) * RPM
    sign = np.where(random.random(ROWS) < 0.5, -1.0, 1.0)
    warm = random.uniform(298.15, 318.15, ROWS)
    torque = dataclasses.replace(MODEL, friction=friction)(
        screw, OIL.at(warm), axial_load=load, screw_speed=speed
    ).screw_torque
    torque = sign * torque * (1 + NOISE * random.standard_normal(ROWS))
    logged = warm + SENSOR * random.standard_normal()
    return {"axial_load": load, "screw_speed": sign * speed, "friction_torque": torque, "temperature": logged}


def covered(logs: int = LOGS, first: int = 0) -> dict[str, dict[float | None, list[bool]]]:
    """By number and error of the temperature (None: the usual one), for each log: does the interval hold the truth?"""
    hits: dict[str, dict[float | None, list[bool]]] = {name: {None: [], 0.0: []} for name in FREE}
    for seed in range(first, first + logs):
        columns = log(seed)
        for error in (None, 0.0):
            found = bs.fit(MODEL, SCREW, OIL, columns, FREE, temperature_error=error)
            for name in FREE:
                interval = found.estimates[name].interval()
                hits[name][error].append(interval is not None and interval[0] <= TRUE[name] <= interval[1])
    return hits


def table(hits: dict[str, dict[float | None, list[bool]]]) -> str:
    """The counts as Markdown."""
    lines = ["| number | logs | 2 K (95 %) in the interval | none |", "| --- | --- | --- | --- |"]
    for name, found in hits.items():
        counts = {error: f"{sum(each)} of {len(each)} hold the truth" for error, each in found.items()}
        lines.append(f"| {WORDS[name]} | {len(found[None])} | {counts[None]} | {counts[0.0]} |")
    return "\n".join(lines) + "\n"


def main() -> None:
    """Fit, count, print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--logs", type=int, default=LOGS, help="how many logs")
    parser.add_argument("--write", action="store_true", help="store the table in the docs")
    options = parser.parse_args()
    found = table(covered(options.logs))
    print(found, end="")
    if options.write:
        PAGE.write_text(found, encoding="utf-8")


if __name__ == "__main__":
    main()

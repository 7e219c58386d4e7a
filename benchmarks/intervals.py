"""How often the intervals of a fit hold the truth: synthetic logs of a double nut with noise of 1 %, 40 a kind.

Boundary friction coefficient and preload are free.

- ``loads``: 48 drive torques at random loads against the positive direction, the negative one, or both. A nut of
  elastic bodies has another friction under the opposite load, one of rigid bodies has not. Five minutes.
- ``temperature``: 300 friction torques at 25 to 45 °C whose logged temperatures are off by one number in the whole log:
  normal, with a standard deviation of 1 K. Each is fitted with the usual error of the temperature (2 K at 95 %) and
  with none.

    python benchmarks/intervals.py loads [--write]            the table, as Markdown; --write: into docs/load_signs.inc
    python benchmarks/intervals.py temperature [--write]      the same for docs/temperature_coverage.inc
"""

from __future__ import annotations

import dataclasses
import math
import sys
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

import ballscrew as bs
from ballscrew.questions.shared.text_tables import markdown_table
from harness import study

LOGS, NOISE = 40, 0.01
FREE = {"boundary_friction_coefficient": "boundary friction coefficient", "nut.preload": "preload"}
MODEL = bs.FrictionModel.reference()
Columns = dict[str, NDArray[np.float64]]
Found = tuple[tuple[float, float] | None, float]


def nut_of(row: str, values: Mapping[str, float], bodies: bs.Bodies | None) -> tuple[bs.FrictionModel, bs.BallScrew]:
    """The model and the screw with these numbers."""
    friction: Any = MODEL.friction
    changed = dataclasses.replace(friction, boundary_friction_coefficient=values["boundary_friction_coefficient"])
    nut = bs.DoubleNut(preload=values["nut.preload"], bodies=bodies)
    return dataclasses.replace(MODEL, friction=changed), bs.catalogue()[row].screw(nut=nut)


def held(found: list[Found], true: float) -> tuple[int, int]:
    """How many intervals hold the truth, of those that there are."""
    ends = [interval for interval, _ in found if interval is not None]
    return sum(low <= true <= high for low, high in ends), len(ends)


def fitted(model: Any, screw: Any, oil: Any, log: Columns, **options: Any) -> dict[str, Found]:
    """By number its interval and its estimate."""
    found = bs.fit(model, screw, oil, log, list(FREE), **options).estimates
    return {name: (found[name].interval(), found[name].value) for name in FREE}


# -- loads of one sign or of both ---------------------------------------------------------------------

SMALL, OIL = "rexroth-25x5x3-4-double", bs.Lubricant(viscosity=0.1)
LOADS = {"positive": (200.0, 2000.0), "negative": (-2000.0, -200.0), "both": (-2000.0, 2000.0)}
BODIES = {"elastic": bs.Bodies(), "rigid": None}
TRUE_OF_LOADS = {"boundary_friction_coefficient": 0.12, "nut.preload": 1113.0}
START = {"boundary_friction_coefficient": 0.15, "nut.preload": 1300.0}


def log_of_loads(bodies: bs.Bodies | None, loads: tuple[float, float], seed: int) -> Columns:
    """Drive torques of the true nut, at 2 to 80 rad/s in both directions."""
    random, rows = np.random.default_rng(1000 + seed), 48
    load = random.uniform(*loads, rows)
    speed = np.exp(random.uniform(*np.log((2.0, 80.0)), rows)) * np.where(np.arange(rows) % 2, 1.0, -1.0)
    model, screw = nut_of(SMALL, TRUE_OF_LOADS, bodies)
    result = model(screw, OIL, axial_load=load, screw_speed=speed)
    noise = NOISE * float(np.median(result.screw_torque)) * random.standard_normal(rows)
    return {"axial_load": load, "screw_speed": speed, "torque": result.drive_torque + noise}


def rows_of_loads() -> Iterator[list[str]]:
    """Of each number how many of the intervals hold the truth, and the median error of the estimates."""
    # the oil of these logs is exactly as warm as said
    options = {"temperature_error": 0.0, "kind": "drive", "holdout": 0.0}
    for name, bodies in BODIES.items():
        model, screw = nut_of(SMALL, START, bodies)
        for sign, loads in LOADS.items():
            found = [fitted(model, screw, OIL, log_of_loads(bodies, loads, i), **options) for i in range(LOGS)]
            cells = [name, sign]
            for number, true in TRUE_OF_LOADS.items():
                of_number = [one[number] for one in found]
                off = np.median([value / true - 1 for _, value in of_number])
                cells.append("{} of {}, ".format(*held(of_number, true)) + f"{off:+.1%}")
            yield cells


# -- a sensor of temperature that is off --------------------------------------------------------------

LARGE, GRADE = "rexroth-40x10x6-6-double", bs.Lubricant.from_grade("ISO VG 68", 308.15)
TRUE = {"boundary_friction_coefficient": 0.105, "nut.preload": 3000.0}
CASE = bs.catalogue()[LARGE].screw(nut=bs.DoubleNut(preload=4000.0))


def warm_log(seed: int) -> Columns:
    """Friction torques of the true nut in both directions, without load and loaded, and what the sensor says."""
    random, rows = np.random.default_rng(seed), 300
    model, screw = nut_of(LARGE, TRUE, None)
    load = np.where(random.random(rows) < 0.5, 0.0, random.uniform(0.0, 6000.0, rows))
    speed = np.exp(random.uniform(math.log(10), math.log(600), rows)) * 2 * math.pi / 60
    sign = np.where(random.random(rows) < 0.5, -1.0, 1.0)
    warm = random.uniform(298.15, 318.15, rows)
    torque = model(screw, GRADE.at(warm), axial_load=load, screw_speed=speed).screw_torque
    torque = sign * torque * (1 + NOISE * random.standard_normal(rows))
    logged = warm + random.standard_normal()
    return {"axial_load": load, "screw_speed": sign * speed, "friction_torque": torque, "temperature": logged}


def held_of_warm_logs() -> dict[str, list[int]]:
    """By number how many intervals hold the truth: with the usual error of the temperature, and with none."""
    hits: dict[str, list[int]] = {name: [] for name in FREE}
    for error in (None, 0.0):
        found = [fitted(MODEL, CASE, GRADE, warm_log(seed), temperature_error=error) for seed in range(LOGS)]
        for name in FREE:
            hits[name].append(held([one[name] for one in found], TRUE[name])[0])
    return hits


def table(kind: str) -> str:
    """The counts as Markdown."""
    if kind == "loads":
        return markdown_table(("bodies", "loads", *FREE.values()), list(rows_of_loads()))
    hits = held_of_warm_logs().items()
    rows = [(FREE[name], str(LOGS), *(f"{hit} of {LOGS} hold the truth" for hit in found)) for name, found in hits]
    return markdown_table(("number", "logs", "2 K (95 %) in the interval", "none"), rows)


if __name__ == "__main__":
    kind = sys.argv.pop(1) if sys.argv[1:2] in (["loads"], ["temperature"]) else sys.exit(__doc__)
    study(__doc__, lambda: table(kind), "load_signs.inc" if kind == "loads" else "temperature_coverage.inc")

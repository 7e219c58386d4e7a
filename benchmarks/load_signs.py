"""How often the intervals of a fit hold the truth where the loads of a log have one sign or both.

40 synthetic logs a kind, each of 48 drive torques of a 25 x 5 double nut with noise of 1 %, in both directions of
rotation, at random loads of 200 N to 2000 N, against the positive direction, or both. Boundary friction coefficient and
preload are free. A nut of elastic bodies has another friction under the opposite load, one of rigid bodies has not.

    python benchmarks/load_signs.py            print the table, as Markdown; five minutes
    python benchmarks/load_signs.py --write    and store it in docs/load_signs.inc
"""

from __future__ import annotations

import argparse
import dataclasses
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import ballscrew as bs

PAGE = Path(__file__).parents[1] / "docs" / "load_signs.inc"
LOGS, ROWS, NOISE = 40, 48, 0.01
FREE = ("boundary_friction_coefficient", "nut.preload")
TRUE = {"boundary_friction_coefficient": 0.12, "nut.preload": 1113.0}
#: Where each fit starts.
START = {"boundary_friction_coefficient": 0.15, "nut.preload": 1300.0}
LOADS = {"positive": (200.0, 2000.0), "negative": (-2000.0, -200.0), "both": (-2000.0, 2000.0)}
BODIES = {"elastic": bs.Bodies(), "rigid": None}
#: Speeds of the screw, rad/s.
SPEEDS = (2.0, 80.0)
MODEL = bs.FrictionModel.reference()
OIL = bs.Lubricant(viscosity=0.1)
ROW = bs.catalogue()["rexroth-25x5x3-4-double"]


def model_and_screw(bodies: bs.Bodies | None, values: dict[str, float]) -> tuple[bs.FrictionModel, bs.BallScrew]:
    """The model and the screw with these numbers."""
    friction: Any = MODEL.friction
    changed = dataclasses.replace(friction, boundary_friction_coefficient=values["boundary_friction_coefficient"])
    nut = bs.DoubleNut(preload=values["nut.preload"], bodies=bodies)
    return dataclasses.replace(MODEL, friction=changed), ROW.screw(nut=nut)


def log(bodies: bs.Bodies | None, loads: tuple[float, float], seed: int) -> dict[str, NDArray[np.float64]]:
    """Drive torques of the true nut."""
    random = np.random.default_rng(1000 + seed)
    load = random.uniform(*loads, ROWS)
    speed = np.exp(random.uniform(*np.log(SPEEDS), ROWS)) * np.where(np.arange(ROWS) % 2, 1.0, -1.0)
    model, screw = model_and_screw(bodies, TRUE)
    result = model(screw, OIL, axial_load=load, screw_speed=speed)
    noise = NOISE * float(np.median(result.screw_torque)) * random.standard_normal(ROWS)
    return {"axial_load": load, "screw_speed": speed, "torque": result.drive_torque + noise}


def cells(bodies: bs.Bodies | None, loads: tuple[float, float]) -> list[str]:
    """Of each number how many of the intervals hold the truth, and the median error of the estimates."""
    held, given = dict.fromkeys(FREE, 0), dict.fromkeys(FREE, 0)
    off: dict[str, list[float]] = {name: [] for name in FREE}
    model, screw = model_and_screw(bodies, START)
    for seed in range(LOGS):
        columns = log(bodies, loads, seed)
        # the oil of these logs is exactly as warm as said
        fit = bs.fit(model, screw, OIL, columns, list(FREE), temperature_error=0.0, kind="drive", holdout=0.0)
        for name in FREE:
            interval = fit.estimates[name].interval()
            off[name].append(fit.estimates[name].value / TRUE[name] - 1)
            if interval is not None:
                given[name] += 1
                held[name] += interval[0] <= TRUE[name] <= interval[1]
    return [f"{held[name]} of {given[name]}, {float(np.median(off[name])):+.1%}" for name in FREE]


def table() -> str:
    """The table as Markdown."""
    lines = ["| bodies | loads | boundary friction coefficient | preload |", "|---|---|---|---|"]
    for name, bodies in BODIES.items():
        for sign, loads in LOADS.items():
            lines.append(f"| {name} | {sign} | {' | '.join(cells(bodies, loads))} |")
    return "\n".join(lines) + "\n"


def main() -> None:
    """Print the table, and store it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true", help=f"store it in {PAGE.name}")
    options = parser.parse_args()
    text = table()
    print(text, end="")
    if options.write:
        PAGE.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()

"""Time of a fit of a moving log, and of one evaluation of the screw's model at all its rows, the plain way.

``python benchmarks/moving_fit.py`` prints a table, ``--json`` one object. The log is synthetic: 25 000 rows at 1 kHz of
an axis with the screw of ``examples/axis.toml``. A fit evaluates the friction some dozen times; the plain way would do
each of them at every row: one evaluation of all rows, times the steps of the fit, is what the table of friction saves.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from pathlib import Path

import numpy as np

import ballscrew as bs
from ballscrew.cases.case_files import case_file

ROOT = Path(__file__).parents[1]
ROWS, STEP = 25_000, 1e-3
MASS, CONSTANT, VISCOUS, NOISE = 70.0, 30.0, 150.0, 1.0


def log() -> dict[str, np.ndarray]:
    """A sum of two waves: strokes of many speeds, with noise and steps of a micrometre."""
    random = np.random.default_rng(0)
    moment = STEP * np.arange(ROWS)
    slow, fast = 2 * np.pi * 0.31, 2 * np.pi * 0.83
    position = 0.1 * np.sin(slow * moment) + 0.02 * np.sin(fast * moment)
    speed = 0.1 * slow * np.cos(slow * moment) + 0.02 * fast * np.cos(fast * moment)
    acceleration = -0.1 * slow**2 * np.sin(slow * moment) - 0.02 * fast**2 * np.sin(fast * moment)
    force = MASS * acceleration + np.sign(speed) * CONSTANT + VISCOUS * speed + NOISE * random.standard_normal(ROWS)
    return {"time": moment, "position": 1e-6 * np.round(position / 1e-6), "force": force}


def main() -> None:
    """Measure, and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--json", action="store_true")
    as_json = parser.parse_args().json
    case = case_file.load(ROOT / "examples" / "axis.toml")
    data = log()
    begin = time.perf_counter()
    found = bs.fit_motion(case.model, case.screw, case.lubricant, data)
    fit = time.perf_counter() - begin
    speed, acceleration = found.equation.speed, found.equation.acceleration
    turns = 2 * np.pi / float(case.screw.lead)
    moves = np.abs(speed) > found.equation.rest
    begin = time.perf_counter()
    case.model(case.screw, case.lubricant, axial_load=MASS * acceleration[moves], screw_speed=turns * speed[moves])
    plain = time.perf_counter() - begin
    told = {"rows": ROWS, "fit_s": fit, "one_plain_evaluation_s": plain, "fit_over_one_evaluation": fit / plain}
    told["mass"] = found.estimates["mass"].value
    if as_json:
        print(json.dumps(told))
    else:
        for name, value in told.items():
            print(f"{name:28} {value:.4g}")
    sys.exit(0 if abs(told["mass"] / MASS - 1) < 0.01 else 1)


if __name__ == "__main__":
    main()

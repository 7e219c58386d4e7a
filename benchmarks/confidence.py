"""How fast bands and fits are, and how often the intervals of a fit hold the truth.

``python benchmarks/confidence.py`` prints a table, ``--json`` one object; exit code 1 if a figure misses what is
asked. Other work on the machine counts against it.

- ``band``: what ``ballscrew run --band`` computes for the paper's case, with 100 000 samples of all that is usually
  uncertain and of all other laws, once the program has started and compiled its formulas. Under 1 s.
- ``fit``: a fit of 10 000 rows with exact derivatives, two numbers free, from arrays to the calibrated model: under
  5 s, the first of a process as well.
- ``coverage``: over 200 synthetic logs of 400 rows with noise, outliers and drift, how many of the intervals of 95 %
  hold the truth: 90 to 99 %. With fewer than 100 logs it is not judged.
"""

from __future__ import annotations

import argparse
import dataclasses
import json
import math
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import ballscrew as bs
from ballscrew.cases.case_files import case_file
from ballscrew.evidence.papers.olaru2005 import SCREW
from ballscrew.questions.band import compute

CASE = Path(__file__).parents[1] / "examples" / "olaru2005.toml"
MODELS: dict[str, Callable[[], bs.FrictionModel]] = {
    "olaru2005": bs.FrictionModel.olaru2005,
    "corrected": bs.FrictionModel.corrected,
    "reference": bs.FrictionModel.reference,
}
SAMPLES, ROWS = 100_000, 10_000
#: For coverage: rows of a log, and logs.
LOG, SEEDS = 400, 200
#: Fewer logs than this say little.
JUDGED = 100
#: What is asked for, s and shares.
BAND, FIT, COVERED = 1.0, 5.0, (0.90, 0.99)
TRUE = {"boundary_friction_coefficient": 0.11, "constant_torque": 0.03}
NOISE, DRIFT, OUTLIERS = 0.01, 0.02, 0.03
OIL = bs.Lubricant(viscosity=0.1)
RPM = 2 * math.pi / 60
#: How often something warm is timed; the median counts.
TIMES = 5


def log(model: bs.FrictionModel, rows: int, seed: int) -> dict[str, NDArray[np.float64]]:
    """Drive torques of a screw with a known friction, in both directions."""
    random = np.random.default_rng(seed)
    friction: Any = model.friction
    changed = dataclasses.replace(friction, boundary_friction_coefficient=TRUE["boundary_friction_coefficient"])
    load = random.uniform(200, 4000, rows)
    speed = np.exp(random.uniform(*np.log((10, 1000)), rows)) * RPM
    sign = np.where(random.random(rows) < 0.5, -1.0, 1.0)
    hours = np.linspace(0, 1, rows)
    result = dataclasses.replace(model, friction=changed)(SCREW, OIL, axial_load=load, screw_speed=speed)
    torque = result.ideal_torque + sign * (result.screw_torque + TRUE["constant_torque"])
    torque = torque + DRIFT * hours + random.normal(0, NOISE, rows)
    torque += np.where(random.random(rows) < OUTLIERS, random.normal(0, 20 * NOISE, rows), 0.0)
    return {"axial_load": load, "screw_speed": sign * speed, "torque": torque, "time": 3600 * hours}


def seconds(work: Callable[[], Any]) -> tuple[float, float]:
    """How long the first call takes, and the median of later ones."""
    times: list[float] = []
    for _ in range(1 + TIMES):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return times[0], float(np.median(times[1:]))


def measured(name: str, samples: int, rows: int, seeds: int) -> dict[str, Any]:
    """The figures of a model."""
    model = MODELS[name]()
    case = case_file.build(case_file.read(CASE), name, CASE.parent)
    columns = log(model, rows, 0)
    first_band, warm_band = seconds(lambda: compute.band(case, compute.BandOptions(samples=samples)))
    first_fit, warm_fit = seconds(lambda: bs.fit(model, SCREW, OIL, columns, list(TRUE)))
    return {
        "band": {"first_s": first_band, "s": warm_band},
        "fit": {"first_s": first_fit, "s": warm_fit},
        "coverage": coverage(model, seeds) if seeds else {},
    }


def coverage(model: bs.FrictionModel, seeds: int) -> dict[str, float]:
    """By number, the share of the intervals of 95 % that hold the truth."""
    hits = dict.fromkeys(TRUE, 0)
    for seed in range(seeds):
        # the oil of these logs is exactly as warm as said
        found = bs.fit(model, SCREW, OIL, log(model, LOG, seed), list(TRUE), temperature_error=0.0)
        for name, true in TRUE.items():
            interval = found.estimates[name].interval()
            hits[name] += interval is not None and interval[0] <= true <= interval[1]
    return {name: count / seeds for name, count in hits.items()}


def main() -> None:
    """Measure, print, judge."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.add_argument("--model", choices=list(MODELS), action="append", help="only this one; may be repeated")
    parser.add_argument("--samples", type=int, default=SAMPLES, help="of the band")
    parser.add_argument("--rows", type=int, default=ROWS, help="of the log that the fit is timed with")
    parser.add_argument("--seeds", type=int, default=SEEDS, help="logs for the coverage; 0 leaves it out")
    options = parser.parse_args()
    found: dict[str, Any] = {}
    missed: list[str] = []
    if not options.json:
        print(f"{'':10s} {'':>12s} {'first':>8s} {'then':>8s}   asked")
    for name in options.model or MODELS:
        found[name] = measured(name, options.samples, options.rows, options.seeds)
        lines = {"band": (options.samples, "samples", BAND), "fit": (options.rows, "rows", FIT)}
        for what, (count, unit, limit) in lines.items():
            figures = found[name][what]
            slowest = figures["first_s"] if what == "fit" else figures["s"]
            missed += [f"{name} {what}"] if slowest >= limit else []
            if not options.json:
                times = f"{figures['first_s']:7.2f}s {figures['s']:7.3f}s"
                print(f"{name:10s} {what:>12s} {times}   < {limit:g} s for {count} {unit}")
        for number, share in found[name]["coverage"].items():
            missed += (
                [] if options.seeds < JUDGED or COVERED[0] <= share <= COVERED[1] else [f"{name} coverage of {number}"]
            )
            if not options.json:
                print(f"{name:10s} {'coverage':>12s} {share:17.1%}   {COVERED[0]:.0%} to {COVERED[1]:.0%}  {number}")
        sys.stdout.flush()
    if options.json:
        print(json.dumps({**found, "missed": missed}, indent=1))
    elif missed:
        print(f"missed: {', '.join(missed)}")
    sys.exit(1 if missed else 0)


if __name__ == "__main__":
    main()

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

import dataclasses
import math
import sys
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

import ballscrew as bs
from ballscrew.cases.case_files import case_file
from ballscrew.evidence.papers.olaru2005 import SCREW
from ballscrew.questions.band import compute
from harness import ROOT, asked, first_and_then, told

CASE = ROOT / "examples" / "olaru2005.toml"
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


def measured(name: str, samples: int, rows: int, seeds: int) -> dict[str, Any]:
    """The figures of a model."""
    model = MODELS[name]()
    case = case_file.build(case_file.read(CASE), name, CASE.parent)
    columns = log(model, rows, 0)
    first_band, warm_band = first_and_then(lambda: compute.band(case, compute.BandOptions(samples=samples)))
    first_fit, warm_fit = first_and_then(lambda: bs.fit(model, SCREW, OIL, columns, list(TRUE)))
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
    options = asked(__doc__, model=list(MODELS), samples=SAMPLES, rows=ROWS, seeds=SEEDS)
    found = {n: measured(n, options.samples, options.rows, options.seeds) for n in options.model or MODELS}
    missed: list[str] = []
    for name, figures in found.items():
        # the first band of a process compiles
        slowest = {"band": (figures["band"]["s"], BAND), "fit": (figures["fit"]["first_s"], FIT)}
        missed += [f"{name} {what}" for what, (taken, limit) in slowest.items() if taken >= limit]
        judged = figures["coverage"].items() if options.seeds >= JUDGED else ()
        missed += [f"{name} coverage of {what}" for what, share in judged if not COVERED[0] <= share <= COVERED[1]]
    told({**found, "missed": missed or "none"}, options.json)
    sys.exit(bool(missed))


if __name__ == "__main__":
    main()

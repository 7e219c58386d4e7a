"""How fast preloaded nuts are: compiled sweeps, derivatives, bands and fits, as ratios in one run.

``python benchmarks/nuts.py`` prints a table, ``--json`` one object. What is compared is measured in turn, round after
round; ratios are medians over the rounds. The nut is a double one of the catalogue, rigid, with the reference model,
and olaru2005() beside it.

- ``sweep``: a million points over load, speed and preload, compiled, against the model on NumPy arrays.
- ``gradient``: the torque and its derivatives by eight inputs, against the torque alone, both compiled.
- ``elastic``: ten thousand points of an elastic nut, all balls one by one, compiled, against the model on NumPy
  arrays.
- ``band``: 100,000 samples; ``fit``: 10,000 rows with the preload and a friction coefficient free.

``--only sweep`` measures one of them, ``--avx2`` compiles as for a processor without AVX-512.
"""

from __future__ import annotations

import dataclasses
import statistics
from typing import Any

import numpy as np
import xarray as xr

import ballscrew as bs
from ballscrew.engine.evaluation.derivatives import slopes_of
from ballscrew.engine.evaluation.evaluation import Evaluation
from ballscrew.engine.evaluation.plan import Configuration, Plan
from harness import asked, in_turn, ratio, seconds, told

PRELOAD = 4326.0
SCREW = bs.catalogue()["rexroth-40x10x6-6-double"].screw(nut=bs.DoubleNut(preload=PRELOAD))
OIL = bs.Lubricant.from_grade("ISO VG 100", 313.15)
MODELS = {"olaru2005": bs.FrictionModel.olaru2005(), "reference": bs.FrictionModel.reference()}
SIDE = 100
#: Points of the model itself, which a million would keep busy for minutes.
OF_THE_MODEL = 40_000
#: Loaded balls of each half of the elastic nut, and points of the model itself with it.
BALLS_OF_A_HALF, OF_THE_ELASTIC_MODEL = 54, 1000
BY = (
    "axial_load", "screw_speed", "nut.preload", "viscosity", "ball_diameter", "screw_conformity", "contact_angle",
    "screw_roughness",
)  # fmt: skip


def grid(side: int) -> dict[str, Any]:
    """Loads, speeds and preloads, so many of each."""
    return {
        "axial_load": np.linspace(-20e3, 20e3, side),
        "screw_speed": np.linspace(1.0, 100.0, side),
        "nut.preload": np.linspace(1000.0, 6000.0, side),
    }


def cloud(number: int, seed: int = 1) -> dict[str, Any]:
    """Random points of the same ranges."""
    rng = np.random.default_rng(seed)
    return {name: xr.DataArray(rng.uniform(a[0], a[-1], number), dims="point") for name, a in grid(2).items()}


def per_point(evaluations: dict[str, Evaluation], rounds: int) -> dict[str, list[float]]:
    """Seconds a point of evaluations, in turn; a round before them warms up."""

    def filled(e: Evaluation) -> Any:
        return lambda: e.fill(e.empty(e.plan.total), slice(0, e.plan.total))

    times = in_turn({name: filled(e) for name, e in evaluations.items()}, rounds + 1)
    return {name: [one / e.plan.total for one in times[name][1:]] for name, e in evaluations.items()}


def rates(found: dict[str, list[float]]) -> dict[str, float]:
    """Compiled points a second, and their ratio to the model on arrays."""
    return {
        "points_per_second": 1 / statistics.median(found["compiled"]),
        "over_numpy": ratio(found, "model", "compiled"),
    }


OUTPUTS = "screw_torque", "efficiency", "valid"


def sweep(model: bs.FrictionModel, rounds: int) -> dict[str, float]:
    """Rates of compiled points and of the model on arrays, and their ratio."""
    subject = Configuration(model, SCREW, OIL)
    points = {"compiled": grid(SIDE), "model": cloud(OF_THE_MODEL)}
    return rates(per_point({e: Evaluation.of(Plan.of(subject, OUTPUTS, at), e) for e, at in points.items()}, rounds))


def gradient(model: bs.FrictionModel, rounds: int) -> dict[str, float]:
    """Time of value and derivatives, in units of that of the value."""
    subject, points = Configuration(model, SCREW, OIL), cloud(100_000)
    held = {name: xr.DataArray(np.full(100_000, subject.value_of(name)), dims="point") for name in BY[3:]}
    plans = {
        "value": Plan.of(subject, ("screw_torque",), points | held),
        "slopes": slopes_of(subject, ("screw_torque",), BY, points | held),
    }
    found = per_point({name: Evaluation.of(plan, "compiled") for name, plan in plans.items()}, rounds)
    return {"over_value": ratio(found, "slopes", "value")}


def elastic(model: bs.FrictionModel, rounds: int) -> dict[str, float]:
    """Rates of an elastic nut, compiled and by the model, and their ratio."""
    nut = bs.DoubleNut(preload=PRELOAD, bodies=bs.Bodies())
    subject = Configuration(model, dataclasses.replace(SCREW, nut=nut, loaded_balls=BALLS_OF_A_HALF), OIL)

    def scattered(number: int) -> dict[str, Any]:
        load, speed = np.random.default_rng(2).uniform([[100.0], [1.0]], [[20e3], [100.0]], (2, number))
        return {"axial_load": xr.DataArray(load, dims="point"), "screw_speed": xr.DataArray(speed, dims="point")}

    points = {"compiled": scattered(10_000), "model": scattered(OF_THE_ELASTIC_MODEL)}
    return rates(per_point({e: Evaluation.of(Plan.of(subject, OUTPUTS, at), e) for e, at in points.items()}, rounds))


def band(model: bs.FrictionModel) -> dict[str, float]:
    """Seconds of a band of 100,000 samples."""
    uncertain = {"nut.preload": bs.Normal(PRELOAD, 500.0), "viscosity": bs.LogNormal(0.088, 1.2)}

    def work() -> Any:
        at = {"axial_load": 3000.0, "screw_speed": 50.0}
        return bs.band(model, SCREW, OIL, distributions=uncertain, samples=100_000, **at)

    return {"first_s": seconds(work), "second_s": seconds(work)}


def fit(model: bs.FrictionModel) -> dict[str, float]:
    """Seconds of a fit of 10,000 rows."""
    rng, rows = np.random.default_rng(3), 10_000
    log = {
        "axial_load": rng.uniform(0.0, 20e3, rows),
        "screw_speed": rng.uniform(1.0, 100.0, rows) * rng.choice([-1, 1], rows),
    }
    truth = bs.catalogue()["rexroth-40x10x6-6-double"].screw(nut=bs.DoubleNut(preload=0.8 * PRELOAD))
    torque = model(truth, OIL, **log).drive_torque
    log["torque"] = torque + 0.01 * np.abs(torque) * rng.standard_normal(rows)
    free = ["nut.preload", "boundary_friction_coefficient"]
    return {"seconds": seconds(lambda: bs.fit(model, SCREW, OIL, log, free))}


def without_avx512() -> None:
    """Have kernels compiled, and kept, as for a processor of the kind that has AVX2 and no more."""
    from llvmlite import binding

    features = binding.get_host_cpu_features()
    for name in features:
        features[name] = features[name] and not name.startswith(("avx10", "avx512", "amx"))
    binding.get_host_cpu_features = lambda: features
    binding.get_host_cpu_name = lambda: "haswell"


CASES = {
    "sweep": sweep,
    "gradient": gradient,
    "elastic": elastic,
    "band": lambda model, _: band(model),
    "fit": lambda model, _: fit(model),
}

if __name__ == "__main__":
    options = asked(__doc__, rounds=5, only=list(CASES), avx2=False)
    if options.avx2:
        without_avx512()
    chosen = options.only or CASES
    found = {name: {case: CASES[case](model, options.rounds) for case in chosen} for name, model in MODELS.items()}
    told(found, options.json)

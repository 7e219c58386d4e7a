"""How fast preloaded nuts are: compiled sweeps, derivatives, bands and fits, as ratios in one run.

``python benchmarks/nuts.py`` prints a table, ``--json`` one object. What is compared is measured in turn, round after
round; ratios are medians over the rounds. The nut is a double one of the catalogue, rigid, with the reference model,
and olaru2005() beside it.

- ``sweep``: a million points over load, speed and preload, compiled, against the model on NumPy arrays.
- ``gradient``: the torque and its derivatives by eight inputs, against the torque alone, both compiled.
- ``second call``: what a sweep of ten points takes when the same one was asked for before.
- ``elastic``: ten thousand points of an elastic nut, all balls one by one, compiled, against the model on NumPy
  arrays; and twelve hundred points of a map of loads and speeds, as a page has them.
- ``band``: 100,000 samples; ``fit``: 10,000 rows with the preload and a friction coefficient free.

``--only sweep`` measures one of them, ``--avx2`` compiles as for a processor without AVX-512.
"""

from __future__ import annotations

import argparse
import dataclasses
import functools
import json
import statistics
from collections.abc import Callable
from typing import Any

import numpy as np
import xarray as xr

import ballscrew as bs
from ballscrew.engine.evaluation.derivatives import slopes_of
from ballscrew.engine.evaluation.evaluation import Evaluation
from ballscrew.engine.evaluation.plan import Configuration, Plan
from timing import seconds

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


def sweep(model: bs.FrictionModel, rounds: int) -> dict[str, float]:
    """Rates of compiled points and of the model on arrays, and their ratio."""
    outputs = ("screw_torque", "efficiency", "valid")
    compiled = Evaluation.of(Plan.of(Configuration(model, SCREW, OIL), outputs, grid(SIDE)), "compiled")
    arrays = Evaluation.of(Plan.of(Configuration(model, SCREW, OIL), outputs, cloud(OF_THE_MODEL)), "model")
    ratios: list[float] = []
    rates: list[float] = []
    for _ in range(rounds):
        fast, slow = (
            seconds(lambda e=e: e.fill(e.empty(e.plan.total), slice(0, e.plan.total))) / e.plan.total
            for e in (compiled, arrays)
        )
        ratios.append(slow / fast)
        rates.append(1 / fast)
    return {"points_per_second": statistics.median(rates), "over_numpy": statistics.median(ratios)}


def gradient(model: bs.FrictionModel, rounds: int) -> dict[str, float]:
    """Time of value and derivatives, in units of that of the value."""
    subject, points = Configuration(model, SCREW, OIL), cloud(100_000)
    held = {name: xr.DataArray(np.full(100_000, subject.value_of(name)), dims="point") for name in BY[3:]}
    value = Evaluation.of(Plan.of(subject, ("screw_torque",), points | held), "compiled")
    slopes = Evaluation.of(slopes_of(subject, ("screw_torque",), BY, points | held), "compiled")
    ratios: list[float] = []
    for _ in range(rounds):
        one, all_of_them = (
            seconds(lambda e=e: e.fill(e.empty(e.plan.total), slice(0, e.plan.total))) for e in (value, slopes)
        )
        ratios.append(all_of_them / one)
    return {"over_value": statistics.median(ratios)}


def second_call(model: bs.FrictionModel) -> dict[str, float]:
    """Seconds of the first call of a small sweep and of the second."""
    points = {"axial_load": np.linspace(0.0, 9000.0, 10), "screw_speed": 50.0}

    def work() -> Any:
        return bs.sweep(model, SCREW, OIL, outputs=["screw_torque"], engine="compiled", **points)

    first = seconds(work)
    return {"first_s": first, "second_s": min(seconds(work) for _ in range(5))}


def elastic(model: bs.FrictionModel, rounds: int) -> dict[str, float]:
    """Rates of an elastic nut, compiled and by the model, their ratio, and milliseconds of a map."""
    nut = bs.DoubleNut(preload=PRELOAD, bodies=bs.Bodies())
    subject = Configuration(model, dataclasses.replace(SCREW, nut=nut, loaded_balls=BALLS_OF_A_HALF), OIL)
    outputs = ("screw_torque", "efficiency", "valid")

    def scattered(number: int) -> dict[str, Any]:
        load, speed = np.random.default_rng(2).uniform([[100.0], [1.0]], [[20e3], [100.0]], (2, number))
        return {"axial_load": xr.DataArray(load, dims="point"), "screw_speed": xr.DataArray(speed, dims="point")}

    side = {"axial_load": np.linspace(100.0, 20e3, 40), "screw_speed": np.linspace(1.0, 100.0, 30)}
    compiled, arrays, page = (
        Evaluation.of(Plan.of(subject, outputs, points), engine)
        for points, engine in (
            (scattered(10_000), "compiled"), (scattered(OF_THE_ELASTIC_MODEL), "model"), (side, "compiled"),
        )
    )  # fmt: skip
    found: list[tuple[float, ...]] = []
    for _ in range(rounds + 1):
        found.append(
            tuple(
                seconds(lambda e=e: e.fill(e.empty(e.plan.total), slice(0, e.plan.total))) / e.plan.total
                for e in (compiled, arrays, page)
            )
        )
    fast, slow, of_page = np.array(found[1:]).T  # the first round warms up
    return {
        "points_per_second": 1 / statistics.median(fast),
        "over_numpy": statistics.median(slow / fast),
        "page_ms": 1e3 * page.plan.total * statistics.median(of_page),
    }


def band(model: bs.FrictionModel) -> dict[str, float]:
    """Seconds of a band of 100,000 samples."""
    uncertain = {"nut.preload": bs.Normal(PRELOAD, 500.0), "viscosity": bs.LogNormal(0.088, 1.2)}

    def work() -> Any:
        at = {"axial_load": 3000.0, "screw_speed": 50.0}
        return bs.band(model, SCREW, OIL, distributions=uncertain, samples=100_000, **at)

    first = seconds(work)
    return {"first_s": first, "second_s": seconds(work)}


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


def main() -> None:
    """Measure, and print a table or one object."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--only", metavar="NAME", help="measure one alone")
    parser.add_argument("--avx2", action="store_true", help="compile without AVX-512")
    options = parser.parse_args()
    if options.avx2:
        without_avx512()
    work: dict[str, Callable[[bs.FrictionModel], dict[str, float]]] = {
        "sweep": functools.partial(sweep, rounds=options.rounds),
        "gradient": functools.partial(gradient, rounds=options.rounds),
        "second call": second_call,
        "elastic": functools.partial(elastic, rounds=options.rounds),
        "band": band,
        "fit": fit,
    }
    chosen = {case: measure for case, measure in work.items() if options.only in (None, case)}
    found = {name: {case: measure(model) for case, measure in chosen.items()} for name, model in MODELS.items()}
    if options.json:
        print(json.dumps(found, indent=1))
        return
    for name, cases in found.items():
        print(name)
        for case, numbers in cases.items():
            print(f"  {case:12s} " + ", ".join(f"{what} {value:.4g}" for what, value in numbers.items()))


if __name__ == "__main__":
    main()

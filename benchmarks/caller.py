"""What a caller sees of the engine: a whole sweep against its kernel, a second call, one point; in one run.

``python benchmarks/caller.py`` prints a table, ``--json`` one object, ``--fresh`` the first sweep of a process alone.
All that is compared is measured in turn, round after round; ratios and times are medians over the rounds.

- ``of_kernel``: the rate of ``bs.sweep`` of `olaru2005()` (load, speed and viscosity vary, seven outputs) in units of
  that of its kernel alone, into memory that was written to before. The caller drops each dataset before the next call.
- ``of_kernel_keeping``: the same where the caller keeps all datasets, so that the memory of each is new to the process.
- ``of_kernel_fresh``: the kernel alone into new memory: what its first touch costs, page ``faults`` counted.
- ``of_kernel_checked``: the kernel alone where it also checks the inputs as it reads them, as in a sweep.
- ``import_s``, ``fresh_s``: in a process of its own, the package and its parts imported, and the first sweep over a
  hundred points, whose kernel is compiled; ``without_dask_s`` the same where dask, which xarray imports with its first
  array, is not installed.
- ``first_s``, ``second_ms``: a sweep over a hundred points, by a model that has not been recorded, and again.
- ``point_us``: one point by ``bs.evaluator``, and ``over_model``: how many times as fast as a call of the model.
"""

from __future__ import annotations

import functools
import resource
import statistics
import subprocess
import sys
from collections.abc import Callable

import numpy as np
import xarray as xr

import ballscrew as bs
from ballscrew.compiler.kernels import kernel
from ballscrew.engine.evaluation import recordings
from ballscrew.engine.evaluation.evaluation import Evaluation
from ballscrew.engine.evaluation.plan import Configuration, Plan
from ballscrew.evidence.papers.olaru2005 import OIL, SCREW
from engine import OPERATION, OUTPUTS, drawn
from harness import Limits, asked, in_turn, ratio, seconds, told

ROUNDS = 7
MODELS = ("olaru2005", "reference")
CALLS = 2000

#: What is asked for: (bound, is it a lower bound).
LIMITS: Limits = {
    "of_kernel": (0.7, True),
    "second_ms": (10.0, False),
    "point_us": (20.0, False),
}


def faults() -> int:
    """The page faults of this process so far."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_minflt


def large_sweep(points: int) -> dict[str, float]:
    """A sweep over random points, and its kernel alone."""
    model = bs.FrictionModel.olaru2005()
    varied = {name: xr.DataArray(values, dims="point") for name, values in drawn(OPERATION, points).items()}

    def plan(*, later: bool = False) -> Plan:
        return Plan.of(Configuration(model, SCREW, OIL), OUTPUTS, varied, later=later)

    def sweep() -> xr.Dataset:
        return bs.sweep(model, SCREW, OIL, outputs=OUTPUTS, engine="compiled", **varied)

    evaluation = Evaluation.of(plan(), "compiled")
    touched = evaluation.empty(points)
    everything = slice(0, points)
    evaluation.fill(touched, everything)
    sweep()
    times: dict[str, list[float]] = {name: [] for name in ("kernel", "call", "checked", "fresh", "keeping")}
    counts: dict[str, list[int]] = {"call": [], "fresh": []}
    for _ in range(ROUNDS):
        times["kernel"].append(seconds(lambda: evaluation.fill(touched, everything)))
        before = faults()
        times["call"].append(seconds(sweep))
        counts["call"].append(faults() - before)
        checked = Evaluation.of(plan(later=True), "compiled")
        times["checked"].append(seconds(functools.partial(checked.fill, touched, everything)))
        kernel.forget()
        before = faults()
        times["fresh"].append(seconds(lambda: evaluation.fill(evaluation.empty(points), everything)))
        counts["fresh"].append(faults() - before)
        kernel.forget()
        times["keeping"].append(seconds(sweep))  # into new memory, as if all before were kept
    return {
        "points": points,
        "kernel_Mpoint_per_s": points / statistics.median(times["kernel"]) / 1e6,
        "sweep_Mpoint_per_s": points / statistics.median(times["call"]) / 1e6,
        "of_kernel": ratio(times, "kernel", "call"),
        "of_kernel_keeping": ratio(times, "kernel", "keeping"),
        "of_kernel_fresh": ratio(times, "kernel", "fresh"),
        "of_kernel_checked": ratio(times, "kernel", "checked"),
        "faults": statistics.median(counts["call"]),
        "faults_fresh": statistics.median(counts["fresh"]),
    }


def small_calls(name: str) -> dict[str, float]:
    """The first and the second sweep over a few points, and single points."""
    model = getattr(bs.FrictionModel, name)()
    axes = {"axial_load": np.linspace(10.0, 4000.0, 10), "screw_speed": np.linspace(1.0, 100.0, 10)}

    def sweep() -> None:
        bs.sweep(model, SCREW, OIL, engine="compiled", **axes)

    def first() -> None:
        recordings.forget()
        sweep()

    f = bs.evaluator(model, SCREW, OIL, inputs=["axial_load", "screw_speed", "viscosity"], outputs=OUTPUTS)

    def point() -> None:
        f(4000.0, 62.83, 0.1)

    def call() -> None:
        result = model(SCREW, OIL, axial_load=4000.0, screw_speed=62.83)
        _ = result.screw_torque, result.nut_torque, result.efficiency

    work: dict[str, tuple[Callable[[], None], int]] = {
        "first": (first, 1), "second": (sweep, 10), "point": (point, CALLS), "model": (call, 20),
    }  # fmt: skip
    sweep()
    point()
    often = {key: lambda do=do, calls=calls: [do() for _ in range(calls)] for key, (do, calls) in work.items()}
    times = in_turn(often, ROUNDS)
    times = {key: [each / work[key][1] for each in found] for key, found in times.items()}
    return {
        "first_s": statistics.median(times["first"]),
        "second_ms": 1e3 * statistics.median(times["second"]),
        "point_us": 1e6 * statistics.median(times["point"]),
        "over_model": ratio(times, "model", "point"),
    }


#: A first sweep in a process: argument one the model, argument two whether dask is hidden.
_FRESH = """
import sys, time
if sys.argv[2] == "hidden":
    sys.modules["dask"] = None
started = time.perf_counter()
import numpy as np
import ballscrew as bs
from ballscrew.evidence.papers.olaru2005 import OIL, SCREW
model = getattr(bs.FrictionModel, sys.argv[1])()
imported = time.perf_counter()
axes = {"axial_load": np.linspace(10.0, 4000.0, 10), "screw_speed": np.linspace(1.0, 100.0, 10)}
bs.sweep(model, SCREW, OIL, **axes)
print(imported - started, time.perf_counter() - imported)
"""


def fresh(name: str) -> dict[str, float]:
    """What a process waits for at first."""
    found: dict[str, list[tuple[float, float]]] = {"there": [], "hidden": []}
    for _ in range(ROUNDS):
        for dask, times in found.items():
            command = (sys.executable, "-c", _FRESH, name, dask)
            done = subprocess.run(command, check=True, capture_output=True, text=True)
            imported, swept = map(float, done.stdout.split())
            times.append((imported, swept))
    imported, swept = (statistics.median(each) for each in zip(*found["there"], strict=True))
    without = statistics.median(swept for _, swept in found["hidden"])
    return {"import_s": imported, "fresh_s": swept, "without_dask_s": without}


if __name__ == "__main__":
    options = asked(__doc__, points=10_000_000, fresh=False)
    found = {name: fresh(name) for name in MODELS}
    if not options.fresh:
        found = {"sweep": large_sweep(options.points), **{n: found[n] | small_calls(n) for n in MODELS}}
    told(found, options.json, LIMITS)

"""What a caller waits for: the first sweep of a process, the first of a model, a second call, one point; in one run.

``python benchmarks/caller.py`` prints a table, ``--json`` one object. All is measured in turn, round after round; times
and ratios are medians over the rounds.

- ``import_s``, ``fresh_s``: in a process of its own, the package and its parts imported, and the first sweep over a
  hundred points, whose kernel is compiled.
- ``first_s``, ``second_ms``: a sweep over a hundred points, by a model that has not been recorded, and again.
- ``point_us``: one point by ``bs.evaluator``, and ``over_model``: how many times as fast as a call of the model.
"""

from __future__ import annotations

import statistics
import subprocess
import sys
from collections.abc import Callable

import numpy as np

import ballscrew as bs
from ballscrew.engine.evaluation import recordings
from ballscrew.evidence.papers.olaru2005 import OIL, SCREW
from harness import Limits, asked, in_turn, ratio, told
from script import OUTPUTS

ROUNDS = 7
MODELS = ("olaru2005", "reference")
CALLS = 2000

#: What is asked for: (bound, is it a lower bound).
LIMITS: Limits = {
    "second_ms": (10.0, False),
    "point_us": (20.0, False),
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


#: A first sweep in a process, by the model that the argument names.
_FRESH = """
import sys, time
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
    command = (sys.executable, "-c", _FRESH, name)
    said = [subprocess.run(command, check=True, capture_output=True, text=True).stdout for _ in range(ROUNDS)]
    imported, swept = (statistics.median(map(float, each)) for each in zip(*map(str.split, said), strict=True))
    return {"import_s": imported, "fresh_s": swept}


if __name__ == "__main__":
    told({name: fresh(name) | small_calls(name) for name in MODELS}, asked(__doc__).json, LIMITS)

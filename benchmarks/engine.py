"""How fast the engine is: against formulas on whole NumPy arrays, and against the machine's memory, in one run.

``python benchmarks/engine.py`` prints a table, ``--json`` one object. All that is compared is measured in turn,
round after round, so that what else the machine does falls on all sides alike; ratios are medians over the rounds.
The figure of a case is the worse of those at a million and at ten million points.

- ``A``: `olaru2005()`, load, speed and viscosity vary; seven outputs. ``vs_numpy_engine`` is against the engine by
  NumPy alone.
- ``B``: `olaru2005()`, all 22 numbers it depends on vary; seven outputs.
- ``cartesian``: A on a grid of loads, speeds and viscosities.
- ``reference``: `reference()` with the inputs and outputs of A, against the model itself on whole arrays.
- ``gradient``: the torque of `olaru2005()` and its derivatives by twelve inputs, all of which vary; against one-sided
  differences of the formulas, thirteen evaluations. ``over_value`` is its time in units of that of the torque alone.

The memory's limit is what a kernel of the same engine reaches that reads and writes as many arrays and does next to
nothing with them.
"""

from __future__ import annotations

import json
import math
import statistics
import time
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

import ballscrew as bs
from ballscrew.basis.arrays import map_blocks, processors
from ballscrew.compiler.kernels.emission import kernel_text
from ballscrew.compiler.kernels.kernel import Kernel, aligned_array
from ballscrew.compiler.tracing.program import Program, Source
from ballscrew.compiler.tracing.tape import Tape
from ballscrew.engine.evaluation.derivatives import slopes_of
from ballscrew.engine.evaluation.evaluation import Evaluation
from ballscrew.engine.evaluation.outputs import known_outputs
from ballscrew.engine.evaluation.plan import Configuration, Plan
from ballscrew.evidence.papers.olaru2005 import OIL, SCREW
from ballscrew.questions.shared.text_tables import markdown_table
from harness import Limits, asked, in_turn, ratio, told
from script import OUTPUTS, formulas_on_arrays

SIZES = (1_000_000, 10_000_000)
#: Rounds at each size, and the largest size of the cases that NumPy is slow at.
ROUNDS = {1_000_000: 7, 10_000_000: 3}
LARGEST = {"reference": 1_000_000, "gradient": 1_000_000}
#: Seconds that something is timed for, at least.
MOMENT = 0.05
BLOCKS_PER_THREAD = 4

#: Each input that olaru2005() depends on: its letter in the script, and the range it is drawn from, in SI.
RANGES: dict[str, tuple[str, float, float]] = {
    "axial_load": ("F", 100, 4000),
    "screw_speed": ("omega", 1, 105),
    "viscosity": ("eta_0", 0.05, 0.5),
    "pitch_circle_diameter": ("d_m", 0.035, 0.045),
    "lead": ("p", 0.004, 0.006),
    "ball_diameter": ("d_w", 0.003, 0.0035),
    "loaded_balls": ("z", 50, 60),
    "contact_angle": ("alpha", 0.7, 0.85),
    "screw_conformity": ("f_s", 0.512, 0.54),
    "nut_conformity": ("f_n", 0.512, 0.54),
    "ball_roughness": ("sigma_b", 0.5e-7, 1e-7),
    "screw_roughness": ("sigma_s", 1e-7, 4e-7),
    "nut_roughness": ("sigma_n", 1e-7, 4e-7),
    "pressure_viscosity_coefficient": ("alpha_p", 1.8e-8, 2.4e-8),
    "ball_to_ball_force": ("F_B", 0.01, 0.03),
    "ball_friction_coefficient": ("mu_b", 0.05, 0.15),
    "pure_rolling_offset": ("Y", 0.3, 0.38),
    "film.speed_exponent": ("speed_exponent", 0.64, 0.7),
    "friction.boundary_friction_coefficient": ("mu_0", 0.1, 0.2),
    "friction.decay": ("B", 1.2, 1.6),
    "friction.exponent": ("C", 0.7, 0.9),
    "friction.full_film_friction_coefficient": ("mu_f", 0.01, 0.03),
}
OPERATION = ("axial_load", "screw_speed", "viscosity")
WHOLE = ("loaded_balls",)
#: The twelve inputs that the gradient is taken by.
BY = tuple(name for name in RANGES if name not in WHOLE)[:12]

#: What is asked for.
LIMITS: dict[str, Limits] = {
    "A": {"vs_numpy": (20, True), "of_memory_limit": (0.40, True)},
    "B": {"vs_numpy": (12, True), "of_memory_limit": (0.30, True)},
    "cartesian": {"vs_numpy": (30, True)},
    "reference": {"vs_numpy": (10, True)},
    "gradient": {"over_value": (2, False)},
}


class Case(NamedTuple):
    """What is run in turn, by name: ``engine``, ``numpy`` (on fewer points where it is slow), ``memory`` and others."""

    points: int
    numpy_points: int
    work: Mapping[str, Callable[[], Any]]
    agreement: float


def drawn(names: tuple[str, ...], points: int) -> dict[str, NDArray[np.float64]]:
    """Random values of some inputs."""
    rng = np.random.default_rng(2005)
    values = {name: rng.uniform(*RANGES[name][1:], points) for name in names}
    return {name: np.round(v) if name in WHOLE else v for name, v in values.items()}


def in_letters(values: Mapping[str, Any]) -> dict[str, Any]:
    """Inputs under the names they have in the script."""
    return {RANGES[name][0]: value for name, value in values.items()}


def ready(plan: Plan) -> tuple[Evaluation, dict[str, NDArray[Any]]]:
    """A plan compiled, and arrays for its results that have been written to once."""
    evaluation = Evaluation.of(plan, "compiled")
    results = evaluation.empty(plan.total)
    evaluation.fill(results, slice(0, plan.total))
    return evaluation, results


def moving(inputs: int, outputs: int, points: int) -> Callable[[], None]:
    """Reading and writing so many arrays, and next to no arithmetic: the limit of the memory."""
    tape = Tape(inputs)
    total: Any = sum((tape.value(i) for i in range(1, inputs)), tape.value(0)) if inputs else 1.0
    names = [str(i) for i in range(outputs)]
    step = total.index if inputs else tape.record(np.multiply, 1.0, 1.0)
    program = Program.of(tape, {name: tape.value(step) for name in names})
    sources: list[Source] = ["points"] * inputs
    kernel = Kernel.of(kernel_text(program, sources, dict.fromkeys(names, False)), sources)
    arrays = [np.ones(points) for _ in range(inputs)]
    results = [aligned_array(points, float) for _ in range(outputs)]
    block = math.ceil(points / (BLOCKS_PER_THREAD * processors()) / 64) * 64
    return lambda: map_blocks(lambda part: kernel(slice(0, 1), part, points, arrays, results), points, block_size=block)


def difference(found: Mapping[str, NDArray[Any]], expected: Mapping[str, NDArray[Any]]) -> float:
    """The largest relative difference; of the nut's torque, which passes through zero, in units of the screw's."""
    worst = 0.0
    for name, value in expected.items():
        scale = np.abs(expected["screw_torque"] if name == "nut_torque" else value)
        worst = max(worst, float(np.max(np.abs(found[name].reshape(value.shape) - value) / scale)))
    return worst


def by_formulas(_: Configuration, values: Mapping[str, Any]) -> dict[str, NDArray[Any]]:
    """The outputs by the formulas of the script."""
    return dict(zip(OUTPUTS, formulas_on_arrays(**in_letters(values)), strict=True))


def by_model(subject: Configuration, values: Mapping[str, Any]) -> dict[str, NDArray[Any]]:
    """The outputs by the model itself."""
    result = subject.at(values)
    return {name: known_outputs()[name].read(result) for name in OUTPUTS}


def points_case(model: bs.FrictionModel, names: tuple[str, ...], points: int, whole_arrays: Any, part: int = 1) -> Case:
    """A model at random points, against whole arrays of all of them or of a part."""
    values = drawn(names, points)
    subject = Configuration(model, SCREW, OIL)
    plan = Plan.of(subject, OUTPUTS, {name: xr.DataArray(v, dims="point") for name, v in values.items()})
    evaluation, results = ready(plan)
    fewer = points // part
    some = {name: v[:fewer] for name, v in values.items()}
    numpy = Evaluation.of(plan, "numpy")
    played = numpy.empty(fewer)
    work: dict[str, Callable[[], Any]] = {
        "memory": moving(len(names), len(OUTPUTS), points),
        "numpy": lambda: whole_arrays(subject, some),
        "numpy_engine": lambda: numpy.fill(played, slice(0, fewer)),
        "engine": lambda: evaluation.fill(results, slice(0, points)),
    }
    numpy.fill(played, slice(0, fewer))
    checked = min(fewer, 100_000)
    expected = whole_arrays(subject, {name: v[:checked] for name, v in values.items()})
    both = ({n: v[:checked] for n, v in found.items()} for found in (results, played))
    return Case(points, fewer, work, max(difference(found, expected) for found in both))


def grid_case(points: int) -> Case:
    """Case A on a grid of about so many points."""
    side = round(points ** (1 / 3))
    axes = {name: np.linspace(*RANGES[name][1:], side) for name in OPERATION}
    evaluation, results = ready(Plan.of(Configuration(bs.FrictionModel.olaru2005(), SCREW, OIL), OUTPUTS, axes))
    grid = in_letters(dict(zip(OPERATION, np.meshgrid(*axes.values(), indexing="ij"), strict=True)))
    broad = in_letters(dict(zip(OPERATION, np.meshgrid(*axes.values(), indexing="ij", sparse=True), strict=True)))
    shape = (side,) * 3
    expected = {n: np.broadcast_to(v, shape) for n, v in zip(OUTPUTS, formulas_on_arrays(**broad), strict=True)}
    total = side**3
    work: dict[str, Callable[[], Any]] = {
        "memory": moving(0, len(OUTPUTS), total),
        "numpy": lambda: formulas_on_arrays(**grid),
        "engine": lambda: evaluation.fill(results, slice(0, total)),
    }
    return Case(total, total, work, difference(results, expected))


def gradient_case(points: int) -> Case:
    """The torque and its twelve derivatives."""
    values = drawn(BY, points)
    subject = Configuration(bs.FrictionModel.olaru2005(), SCREW, OIL)
    varied = {name: xr.DataArray(v, dims="point") for name, v in values.items()}
    alone, value = ready(Plan.of(subject, ["screw_torque"], varied))
    both, results = ready(slopes_of(subject, ["screw_torque"], BY, varied))
    letters = in_letters(values)
    fewer = points // 5
    few = {name: v[:fewer] for name, v in letters.items()}

    def differences() -> list[NDArray[Any]]:
        start = formulas_on_arrays(**few)[0]
        return [(formulas_on_arrays(**few | {n: v * (1 + 1e-7)})[0] - start) / (v * 1e-7) for n, v in few.items()]

    worst = 0.0
    for name, slope in zip(BY, differences(), strict=True):
        exact = results[f"d_screw_torque_d_{name.replace('.', '_')}"][:fewer]
        scale = np.abs(results["screw_torque"][:fewer] / values[name][:fewer])
        worst = max(worst, float(np.max(np.abs(slope - exact) / scale)))
    work: dict[str, Callable[[], Any]] = {
        "memory": moving(len(BY), 1 + len(BY), points),
        "numpy": differences,
        "value": lambda: alone.fill(value, slice(0, points)),
        "engine": lambda: both.fill(results, slice(0, points)),
    }
    return Case(points, fewer, work, worst)


CASES: dict[str, Callable[[int], Case]] = {
    "A": lambda points: points_case(bs.FrictionModel.olaru2005(), OPERATION, points, by_formulas),
    "B": lambda points: points_case(bs.FrictionModel.olaru2005(), tuple(RANGES), points, by_formulas),
    "cartesian": grid_case,
    "reference": lambda points: points_case(bs.FrictionModel.reference(), OPERATION, points, by_model, 5),
    "gradient": gradient_case,
}


def seconds(work: Callable[[], Any]) -> float:
    """How long one call takes: one to warm up, and then as many as fill a moment."""
    start = time.perf_counter()
    work()
    calls = math.ceil(MOMENT / (time.perf_counter() - start))
    start = time.perf_counter()
    for _ in range(calls):
        work()
    return (time.perf_counter() - start) / calls


def measured(case: Case, rounds: int) -> dict[str, float]:
    """Ratios and rates of a case: medians over rounds in which everything is run in turn."""
    scale = case.points / case.numpy_points
    times = {
        name: [scale * one if name.startswith("numpy") else one for one in found]
        for name, found in in_turn(case.work, rounds, seconds).items()
    }
    rates = {name: case.points / statistics.median(times[name]) / 1e6 for name in ("engine", "memory")}
    figures = {
        "points": case.points,
        "vs_numpy": ratio(times, "numpy", "engine"),
        "of_memory_limit": ratio(times, "memory", "engine"),
        "mpoints_per_s": rates["engine"],
        "memory_mpoints_per_s": rates["memory"],
        "agreement": case.agreement,
    }
    figures |= {f"vs_{name}": ratio(times, name, "engine") for name in times if name.startswith("numpy_")}
    return figures | ({"over_value": ratio(times, "engine", "value")} if "value" in times else {})


#: What the documentation calls the cases.
TITLES = {
    "A": "`olaru2005()`; load, speed and viscosity vary",
    "B": "`olaru2005()`; all 22 numbers it depends on vary",
    "cartesian": "`olaru2005()` on a grid of loads, speeds and viscosities",
    "reference": "`reference()`; load, speed and viscosity vary",
    "gradient": "torque of `olaru2005()` and its 12 derivatives",
}


def table(found: Mapping[str, Any]) -> str:
    """The figures as a table: the worse of all sizes."""
    rows = [
        (TITLES[name], f"{f['mpoints_per_s']:.0f}", f"{f['vs_numpy']:.0f} ×", f"{f['of_memory_limit']:.2f}")
        for name, f in found.items()
    ]
    said = markdown_table(("case", "Mpoint/s", "against NumPy", "of the memory's limit"), rows)
    if "gradient" in found:
        over = found["gradient"]["over_value"]
        said += f"\nValue and 12 derivatives take {over:.2f} times as long as the value alone.\n"
    return said


def main() -> None:
    """Measure, and print; ``--markdown`` the table of docs/speed.md."""
    options = asked(__doc__, markdown=False, points=0, case=list(CASES))
    sizes = (options.points,) if options.points else SIZES
    found: dict[str, dict[str, Any]] = {}
    for name in options.case or CASES:
        by_points = {
            str(points): measured(CASES[name](points), ROUNDS.get(points, 5))
            for points in sizes
            if points <= LARGEST.get(name, points)
        }
        worst = {
            key: min(f[key] for f in by_points.values()) for key in ("vs_numpy", "of_memory_limit", "mpoints_per_s")
        }
        if name == "gradient":
            worst["over_value"] = max(f["over_value"] for f in by_points.values())
        found[name] = {**worst, "by_points": by_points}
        if not options.json and not options.markdown:
            told({name: found[name]}, False, LIMITS[name])
    if options.markdown:
        print(table(found), end="")
    if options.json:
        print(json.dumps({**found, "threads": processors()}, indent=1))


if __name__ == "__main__":
    main()

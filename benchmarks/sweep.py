"""How fast sweeps are by NumPy alone, against the same formulas on whole NumPy arrays in the same run.

``python benchmarks/sweep.py`` prints a table, ``--json`` one object. Times are medians of
interleaved rounds, so that what else the machine does falls on both sides alike.
"""

from __future__ import annotations

import argparse
import json
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

import ballscrew as bs
from ballscrew.evidence.papers.olaru2005 import OIL, SCREW
from script import OUTPUTS, formulas_on_arrays
from timing import seconds

ROOT = Path(__file__).parents[1]
ROUNDS = 7
COLD_STARTS = 5
AGREEMENT = 1e-10

#: What is asked for: (bound, is it a lower bound).
LIMITS: dict[str, tuple[float, bool]] = {
    "ratio": (3.0, True),
    "agreement": (AGREEMENT, False),
    "import_over_numpy_s": (0.1, False),
    "cli_help_s": (0.3, False),
}


def sweeps(points: int) -> dict[str, float]:
    """Random points in load, speed and viscosity: the package against the script."""
    rng = np.random.default_rng(2005)
    F = rng.uniform(100, 4000, points)
    omega = rng.uniform(10, 1000, points) * (np.pi / 30)
    eta_0 = rng.uniform(0.05, 0.5, points)
    operation = {
        "axial_load": xr.DataArray(F, dims="point"),
        "screw_speed": xr.DataArray(omega, dims="point"),
        "viscosity": xr.DataArray(eta_0, dims="point"),
    }
    printed, corrected = bs.FrictionModel.olaru2005(), bs.FrictionModel.corrected()

    def swept(model: bs.FrictionModel) -> xr.Dataset:
        return bs.sweep(model, SCREW, OIL, outputs=OUTPUTS, engine="numpy", **operation)

    expected, found = formulas_on_arrays(F, omega, eta_0), swept(printed)
    scale = np.abs(expected[0])  # of a torque; the nut's passes through zero
    agreement = max(
        float(np.max(np.abs(found[name].to_numpy() - value) / (scale if name == "nut_torque" else np.abs(value))))
        for name, value in zip(OUTPUTS, expected, strict=True)
    )
    del expected, found
    work: dict[str, Callable[[], Any]] = {
        "script": lambda: formulas_on_arrays(F, omega, eta_0),
        "sweep": lambda: swept(printed),
        "corrected": lambda: swept(corrected),
    }
    times: dict[str, list[float]] = {name: [] for name in work}
    for _ in range(ROUNDS):
        for name, call in work.items():
            times[name].append(seconds(call))
    script, sweep, other = (statistics.median(times[name]) for name in ("script", "sweep", "corrected"))

    def single() -> None:
        printed(SCREW, OIL, axial_load=4000.0, screw_speed=62.83).screw_torque  # noqa: B018  (read, it is computed)

    calls = 200
    single_point = statistics.median(seconds(lambda: [single() for _ in range(calls)]) / calls for _ in range(ROUNDS))
    return {
        "points": points,
        "agreement": agreement,
        "script_s": script,
        "sweep_s": sweep,
        "script_Mpoint_per_s": points / script / 1e6,
        "sweep_Mpoint_per_s": points / sweep / 1e6,
        "ratio": statistics.median(a / b for a, b in zip(times["script"], times["sweep"], strict=True)),
        "corrected_sweep_s": other,
        "corrected_sweep_Mpoint_per_s": points / other / 1e6,
        "single_point_us": single_point * 1e6,
    }


def cold(*arguments: str) -> float | None:
    """Median time of a fresh Python process; None if it fails (a command that is not there yet)."""
    times: list[float] = []
    for _ in range(COLD_STARTS):
        start = time.perf_counter()
        outcome = subprocess.run([sys.executable, *arguments], cwd=ROOT, capture_output=True, check=False)
        times.append(time.perf_counter() - start)
        if outcome.returncode != 0:
            return None
    return statistics.median(times)


def cold_starts() -> dict[str, float | None]:
    """What a person waits for before the first answer."""
    bare, whole = cold("-c", "import numpy"), cold("-c", "import numpy; import ballscrew")
    command = ("-c", "import sys; from ballscrew.faces.cli.main import main; sys.exit(main())")
    return {
        "import_over_numpy_s": None if bare is None or whole is None else whole - bare,
        "cli_help_s": cold(*command, "--help"),
        "cli_run_s": cold(*command, "run", "examples/olaru2005.toml"),
    }


def main() -> None:
    """Measure, and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.add_argument("--points", type=int, default=1_000_000, help="random operating points (default: a million)")
    parser.add_argument("--no-cold", action="store_true", help="leave out the fresh processes")
    options = parser.parse_args()
    figures: dict[str, float | None] = {**sweeps(options.points), **({} if options.no_cold else cold_starts())}
    if options.json:
        limits = {name: {"at_least" if lower else "at_most": bound} for name, (bound, lower) in LIMITS.items()}
        print(json.dumps({**figures, "limits": limits}, indent=1))
        return
    for name, value in figures.items():
        shown = "not there" if value is None else f"{value:.4g}"
        bound = ""
        if name in LIMITS and value is not None:
            limit, lower = LIMITS[name]
            met = value >= limit if lower else value <= limit
            bound = f"  required: {'at least' if lower else 'at most'} {limit:g}  {'met' if met else 'MISSED'}"
        print(f"{name:30s} {shown:>12s}{bound}")


if __name__ == "__main__":
    main()

"""The benchmarks run, their sides agree, and on a quiet machine the speed of sweeps has not been lost."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

BENCHMARKS = Path(__file__).parents[3] / "benchmarks"


def figures_of(name, *options):
    command = [sys.executable, str(BENCHMARKS / name), "--json", *options]
    outcome = subprocess.run(command, capture_output=True, text=True, check=False)
    assert outcome.returncode == 0, outcome.stderr
    return json.loads(outcome.stdout)


@pytest.mark.long
@pytest.mark.compiles
def test_the_sides_of_the_engine_agree():
    figures = figures_of("engine.py", "--points", "20000")
    for name in ("A", "B", "cartesian", "reference"):
        (by_points,) = figures[name]["by_points"].values()
        assert by_points["agreement"] < 1e-12, name


@pytest.mark.long
@pytest.mark.compiles
def test_engine():
    """What is asked for on a quiet machine is 20, 12, 30 and 10; other tests are running, and ratios are what is left.

    A loop that goes lane by lane would be ten times slower than this, and slower than NumPy.
    """
    figures = figures_of("engine.py", "--points", "1000000")
    assert figures["A"]["vs_numpy"] > 6
    (a,) = figures["A"]["by_points"].values()
    assert a["vs_numpy"] > 1.5 * a["vs_numpy_engine"]  # of NumPy alone on a quiet machine 3, and it has two threads
    assert figures["B"]["vs_numpy"] > 3
    assert figures["cartesian"]["vs_numpy"] > 8
    assert figures["reference"]["vs_numpy"] > 4
    assert figures["gradient"]["over_value"] < 2.5
    for name in ("A", "B", "cartesian", "reference"):
        (by_points,) = figures[name]["by_points"].values()
        assert by_points["agreement"] < 1e-12, name


@pytest.mark.long
@pytest.mark.compiles
def test_the_transient_with_the_map_is_that_with_the_model():
    figures = figures_of("axis.py", "--only", "warm-up", "--rounds", "1")["warm-up"]
    assert figures["difference"] < 1e-3
    assert figures["plain_over_ours"] > 1

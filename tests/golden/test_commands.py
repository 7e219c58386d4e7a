"""Change detector: what users own, by the commands that they run. Says that numbers moved, not that they are right.

Each kind of nut between rigid and elastic bodies, a cycle, a warm-up, an axis, a band, a fit, a service, a selection
and an export: a few numbers of each. If a change was meant: ``python tests/golden/test_commands.py --write``, and an
entry under "Results" in the change log that says why.
"""

import argparse
import json
import math
import tempfile
from collections.abc import Iterator
from functools import reduce
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from ballscrew.faces.cli.main import app

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "examples"
STORED = Path(__file__).with_name("commands.json")
#: Room for other processors and mathematical libraries; random numbers have their seed. What an iteration ends at, or
#: what is in the sixth digit of a fit, has more.
RELATIVE, OF_ITERATIONS = 1e-9, 1e-6

NUTS = {
    "single": 'type = "single"',
    "double": 'type = "double"\npreload = "4 kN"',
    "oversize-balls": 'type = "oversize-balls"\npreload = "2 kN"',
    "offset-lead": 'type = "offset-lead"\npreload = "4 kN"',
}
CASE = """
[screw]
catalogue = "rexroth-40x10x6-6-double"
[nut]
{nut}
{bodies}
[lubricant]
grade = "ISO VG 100"
temperature = "40 degC"
[operation]
axial_load = "7 kN"
screw_speed = "600 rpm"
"""
OF_NUT = (
    "results.screw_torque", "results.drive_torque", "results.efficiency", "results.back_driving_efficiency",
    "results.contributions.ball_to_ball", "results.maximum_pressure", "loads.remaining_preload", "loads.deflection",
)  # fmt: skip
#: Commands, and the numbers of their documents.
COMMANDS: dict[str, tuple[str, tuple[str, ...]]] = {
    **{
        f"run, {nut} nut, {bodies} bodies": (f"run {nut}-{bodies}.toml", OF_NUT)
        for nut in NUTS
        for bodies in ("rigid", "elastic")
    },
    "check": (
        "check catalogue_screw.toml", ("checks.0.utilisation", "results.screw_torque", "loads.remaining_preload"),
    ),
    "band": (
        "run olaru2005.toml --band --samples 1024",
        ("band.screw_torque.median", "band.screw_torque.low", "band.screw_torque.high", "band.efficiency.median"),
    ),
    "duty": (
        "duty vertical_axis.toml",
        ("results.torque_rms", "results.torque_peak", "results.energy_drawn", "results.energy_lost",
         "results.life.revolutions", "results.brake.brake_torque", "results.brake.holding_torque",
         "results.motor.utilisation", "results.motor.copper_loss"),
    ),
    "warm-up": (
        "warm-up warm_up.toml",
        ("results.equilibrium.margin", "results.equilibrium.nut_temperature", "results.equilibrium.preload",
         "results.equilibrium.growth", "results.nut_temperature.60", "results.shaft_growth.60", "results.preload.60",
         "results.heat.generated"),
    ),
    "axis": (
        "axis vertical_axis.toml",
        ("results.softest.total", "results.softest.nut", "results.softest.shaft", "results.softest.lost_motion",
         "results.softest.critical_speed", "results.softest.buckling_load"),
    ),
    "fit": (
        "fit rig_log.csv --case rig.toml",
        ("estimates.boundary_friction_coefficient.value", "estimates.boundary_friction_coefficient.std",
         "residual_rms", "holdout_rms", "rows.used", "rows.outliers"),
    ),
    "service": (
        "service nut_new.csv nut_worn.csv --case service.toml",
        ("results.new.preload", "results.worn.preload", "results.ratio.value", "results.ratio.low",
         "results.ratio.high"),
    ),
    "service by the quickest model": (
        "service nut_new.csv nut_worn.csv --case service.toml --set model.name=olaru2005",
        ("results.new.preload", "results.worn.preload", "results.ratio.value", "results.ratio.low",
         "results.ratio.high"),
    ),
    "select": (
        "select needs/feed_axis.toml",
        ("holding", "ruled_out", "candidates.0.worst", "candidates.0.objectives.loss", "candidates.0.objectives.life",
         "candidates.1.objectives.loss", "candidates.5.objectives.rigidity"),
    ),
    "select of few rows": (
        "select needs/feed_axis.toml --filter 63x",
        ("holding", "ruled_out", "candidates.0.worst", "candidates.0.objectives.loss", "candidates.0.objectives.life",
         "candidates.1.objectives.loss", "candidates.5.objectives.rigidity"),
    ),
    "hand-over": (
        "hand-over olaru2005.toml --to table --out {folder}",
        ("results.worst_error.screw_torque.relative", "results.worst_error.drive_torque.value"),
    ),
}  # fmt: skip
#: What follows from an optimum, a root, random numbers.
ITERATED = ("fit", "service", "service by the quickest model", "band", "warm-up", "hand-over")
#: Half a minute each: the tests of every day have a smaller one of the same command.
SLOW = ("service", "select")
#: By the least of eigenvalues, up to 1e8 times as large: the library of another processor finds a speed 5e-9 off.
OF_EIGENVALUES = ("results.softest.critical_speed", "results.softest.buckling_load")


def document(command: str, folder: Path) -> Any:
    """What a command prints as JSON; its files are examples, or cases that are written into the folder."""
    words = [word.format(folder=folder / "out") for word in command.split()]
    words = [str(EXAMPLES / word) if (EXAMPLES / word).is_file() else word for word in words]
    words = [str(folder / word) if (folder / word).is_file() else word for word in words]
    ended = CliRunner().invoke(app, [*words, "--json"], catch_exceptions=False)
    assert ended.exit_code == 0, ended.output
    return json.loads(ended.stdout)


def write_cases(folder: Path) -> None:
    """A case of each kind of nut, rigid and elastic."""
    for nut, lines in NUTS.items():
        for bodies, table in (("rigid", ""), ("elastic", "[bodies]")):
            (folder / f"{nut}-{bodies}.toml").write_text(CASE.format(nut=lines, bodies=table), encoding="utf-8")


def at(found: Any, path: str) -> Any:
    """The number of a document at a path."""
    return reduce(lambda one, name: one[int(name)] if isinstance(one, list) else one[name], path.split("."), found)


def numbers(folder: Path) -> Iterator[tuple[str, dict[str, Any]]]:
    """The numbers of all commands by their names."""
    write_cases(folder)
    for name, (command, paths) in COMMANDS.items():
        found = document(command, folder)
        yield name, {path: at(found, path) for path in paths}


def within(name: str, path: str) -> float:
    """Room for a number of a command."""
    return OF_ITERATIONS if name in ITERATED or path in OF_EIGENVALUES else RELATIVE


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[pytest.mark.slow] if name in SLOW else []) for name in COMMANDS]
)
def test_numbers_have_not_moved(name, tmp_path):
    write_cases(tmp_path)
    command, paths = COMMANDS[name]
    stored = json.loads(STORED.read_text(encoding="utf-8"))[name]
    found = document(command, tmp_path)
    moved = {
        path: (stored[path], at(found, path))
        for path in paths
        if stored[path] != at(found, path)
        and (
            at(found, path) is None
            or stored[path] is None
            or not math.isclose(at(found, path), stored[path], rel_tol=within(name, path))
        )
    }
    assert not moved, "if this was meant: python tests/golden/test_commands.py --write"


def test_every_number_is_stored():
    stored = json.loads(STORED.read_text(encoding="utf-8"))
    assert {name: tuple(each) for name, each in stored.items()} == {
        name: paths for name, (_, paths) in COMMANDS.items()
    }


def main() -> None:
    """Store the present numbers."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--write", action="store_true", required=True, help="store the present numbers")
    parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        STORED.write_text(json.dumps(dict(numbers(Path(folder))), indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()

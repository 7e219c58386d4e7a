"""Does the proposed next test teach more than a random one? On synthetic screws, where the truth is known.

``python benchmarks/next_test.py`` prints a table, ``--json`` one object; exit code 1 if the proposed test is not better
than the median of the random ones in every run.

For each scenario and seed: a log with noise, outliers and drift is made from a true model and fitted. The fit proposes
a test. That test is run on the true model, its readings join the log, and all is fitted again; so are 50 tests at
random points within the same limits. Nothing of the proposal is taken on trust: what is compared is the volume after
the refits, the square root of the determinant of the covariance of the free numbers, over that before. For numbers that
are open altogether, beforehand each is known to its own size.
"""

from __future__ import annotations

import argparse
import dataclasses
import json
import math
import sys
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

import ballscrew as bs
from ballscrew.evidence.calibration.identifiability import weighted_derivatives
from ballscrew.evidence.papers.olaru2005 import SCREW

RPM = 2 * math.pi / 60
CELSIUS = 273.15
FRICTION = "boundary_friction_coefficient"
#: Of a log: rows, and for the torque sensor noise, drift over the log (N m), and share of outliers.
ROWS, NOISE, DRIFT, OUTLIERS = 300, 0.01, 0.02, 0.02
#: Readings of a test, half of them in each direction.
READINGS = 20
SEEDS, RANDOM_TESTS = 3, 50

Columns = dict[str, NDArray[np.float64]]


class Scenario(NamedTuple):
    """What is true, what was logged, what is free, and where tests can be run; loads in N, speeds in rpm, °C."""

    model: bs.FrictionModel
    #: Coefficients of friction that are not as the model says.
    true: Mapping[str, float]
    free: Sequence[str]
    loads: tuple[float, float]
    speeds: tuple[float, float]
    limits: Mapping[str, tuple[float, float]]
    #: Of an oil by its grade.
    temperatures: tuple[float, float] | None = None
    constant_torque: float = 0.0
    kind: str = "drive"


WIDE = {"axial_load": (100, 8000), "screw_speed": (5, 3000)}
SCENARIOS: dict[str, Scenario] = {
    "one number": Scenario(bs.FrictionModel.olaru2005(), {FRICTION: 0.11}, [FRICTION], (200, 4000), (10, 1000), WIDE),
    "friction and seals, high loads only": Scenario(
        bs.FrictionModel.corrected(), {FRICTION: 0.11}, [FRICTION, "constant_torque"], (2000, 4000), (10, 1000),
        WIDE, constant_torque=0.05, kind="friction",
    ),
    "boundary and full film, slow and warm only": Scenario(
        bs.FrictionModel.reference(), {FRICTION: 0.11, "full_film_friction_coefficient": 0.03},
        [FRICTION, "full_film_friction_coefficient"], (500, 4000), (5, 200),
        {**WIDE, "temperature": (20, 60)}, temperatures=(35, 55),
    ),
    "two that the log cannot tell apart": Scenario(
        bs.FrictionModel.olaru2005(), {FRICTION: 0.11}, [FRICTION, "pure_rolling_offset"], (200, 4000), (10, 600),
        {"axial_load": (100, 8000), "screw_speed": (5, 10_000)},
    ),
}  # fmt: skip


@dataclasses.dataclass(frozen=True)
class Rig:
    """A screw whose friction is known, with a torque sensor."""

    scenario: Scenario
    random: np.random.Generator

    @property
    def oil(self) -> bs.Lubricant:
        """The oil; by grade where temperatures count."""
        grade = bs.Lubricant.from_grade("ISO VG 100", temperature=313.15)
        return bs.Lubricant(viscosity=0.1) if self.scenario.temperatures is None else grade

    @property
    def truth(self) -> bs.FrictionModel:
        """The model that the torques are made with."""
        friction: Any = self.scenario.model.friction
        return dataclasses.replace(
            self.scenario.model, friction=dataclasses.replace(friction, **dict(self.scenario.true))
        )

    def log(self) -> Columns:
        """A log at random points, an hour long."""
        points = {
            "axial_load": self.random.uniform(*self.scenario.loads, ROWS),
            "screw_speed": np.exp(self.random.uniform(*np.log(self.scenario.speeds), ROWS)) * RPM,
        }
        if self.scenario.temperatures is not None:
            points["temperature"] = self.random.uniform(*self.scenario.temperatures, ROWS) + CELSIUS
        sign = np.where(self.random.random(ROWS) < 0.5, -1.0, 1.0)
        columns = self.measured(points, sign, np.linspace(0, 3600, ROWS))
        wild = self.random.random(ROWS) < OUTLIERS
        columns["torque"] += np.where(wild, self.random.normal(0, 20 * NOISE, ROWS), 0.0)
        return columns

    def test(self, point: Mapping[str, float]) -> Columns:
        """Readings at one point, half of them in each direction, ten minutes after the log."""
        points = {name: np.full(READINGS, value) for name, value in point.items()}
        sign = np.repeat([1.0, -1.0], READINGS // 2)
        return self.measured(points, sign, np.linspace(4200, 4260, READINGS))

    def measured(self, points: Columns, sign: NDArray[np.float64], time: NDArray[np.float64]) -> Columns:
        """What the sensor reads, with noise and drift."""
        result = self.result(points)
        torque = sign * (result.screw_torque + self.scenario.constant_torque)
        torque = torque + (result.ideal_torque if self.scenario.kind == "drive" else 0.0)
        torque = torque + DRIFT * time / 3600 + self.random.normal(0, NOISE, time.size)
        return {**points, "screw_speed": sign * points["screw_speed"], "time": time, "torque": torque}

    def result(self, points: Mapping[str, Any]) -> bs.FrictionResult:
        """What is true at points."""
        oil = self.oil.at(points["temperature"]) if "temperature" in points else self.oil
        return self.truth(SCREW, oil, axial_load=points["axial_load"], screw_speed=points["screw_speed"])

    def limits(self) -> dict[str, tuple[float, float]]:
        """Where tests can be run, in SI."""
        of = self.scenario.limits
        found = {
            "axial_load": of["axial_load"],
            "screw_speed": (of["screw_speed"][0] * RPM, of["screw_speed"][1] * RPM),
        }
        if "temperature" in of:
            found["temperature"] = of["temperature"][0] + CELSIUS, of["temperature"][1] + CELSIUS
        return found

    def random_test(self) -> dict[str, float]:
        """A valid point within the limits: load and speed by ratios, the temperature by differences."""
        while True:
            point = {
                name: float(
                    self.random.uniform(low, high)
                    if name == "temperature"
                    else np.exp(self.random.uniform(np.log(low), np.log(high)))
                )
                for name, (low, high) in self.limits().items()
            }
            if self.result(point).valid:
                return point

    def fitted(self, columns: Columns) -> bs.CalibratedModel:
        """The fit of a log; the kind of torque is known."""
        kind: Any = self.scenario.kind
        return bs.fit(self.scenario.model, SCREW, self.oil, columns, self.scenario.free, kind=kind, holdout=0)


def volume(found: bs.CalibratedModel) -> float:
    """The square root of the determinant of the covariance of the free numbers; see the module."""
    root = weighted_derivatives(found.solution)
    own = np.diag(1 / found.uncertainty.scale**2)
    count = len(found.estimates)
    covariance = np.linalg.inv(root.T @ root + own)[:count, :count]
    return math.exp(0.5 * float(np.linalg.slogdet(covariance)[1]))


def joined(one: Columns, other: Columns) -> Columns:
    """A log with more rows behind."""
    return {name: np.concatenate([values, other[name]]) for name, values in one.items()}


def run(scenario: Scenario, seed: int, tests: int) -> dict[str, Any]:
    """The proposed test against random ones."""
    rig = Rig(scenario, np.random.default_rng(seed))
    log = rig.log()
    found = rig.fitted(log)
    before = volume(found)
    proposal = found.next_test(rig.limits(), READINGS)

    def left(point: Mapping[str, float]) -> float:
        return volume(rig.fitted(joined(log, rig.test(point)))) / before

    proposed = left(proposal.best)
    random = [left(rig.random_test()) for _ in range(tests)]
    return {
        "point": proposal.best,
        "promised": proposal.best_volume,
        "left": proposed,
        "median": float(np.median(random)),
        "best": min(random),
        "beaten_by": float(np.mean(np.array(random) < proposed)),
        "better": proposed < float(np.median(random)),
    }


def in_words(point: Mapping[str, float]) -> str:
    """A test in the units people use."""
    words = f"{point['axial_load']:.0f} N, {point['screw_speed'] / RPM:.0f} rpm"
    return words + (f", {point['temperature'] - CELSIUS:.0f} °C" if "temperature" in point else "")


def main() -> None:
    """Run, print, judge."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.add_argument("--seeds", type=int, default=SEEDS, help="runs of each scenario")
    parser.add_argument("--random", type=int, default=RANDOM_TESTS, help="random tests of each run")
    parser.add_argument("--scenario", choices=list(SCENARIOS), action="append", help="only this one; may be repeated")
    options = parser.parse_args()
    found: dict[str, list[dict[str, Any]]] = {}
    if not options.json:
        print("Volume left by one more test, in % of that before\n")
        print(f"{'proposed test':>28s} {'promised':>9s} {'left':>6s} {'median random':>14s} {'best random':>12s}")
    for name in options.scenario or SCENARIOS:
        found[name] = []
        if not options.json:
            print(name)
        for seed in range(options.seeds):
            one = run(SCENARIOS[name], seed, options.random)
            found[name].append(one)
            if not options.json:
                shares = (f"{100 * one[key]:.1f}" for key in ("promised", "left", "median", "best"))
                print("{:>28s} {:>9s} {:>6s} {:>14s} {:>12s}".format(in_words(one["point"]), *shares), flush=True)
    every = [one for runs in found.values() for one in runs]
    better = sum(one["better"] for one in every)
    if options.json:
        print(json.dumps(found, indent=1))
    else:
        beaten = np.mean([one["beaten_by"] for one in every])
        print(
            f"\nbetter than the median of {options.random} random tests in {better} of {len(every)} runs; "
            f"{beaten:.0%} of the random tests left less"
        )
    sys.exit(0 if better == len(every) else 1)


if __name__ == "__main__":
    main()

"""Two SYNTHETIC logs of a double nut without load: ``examples/nut_new.csv`` and ``nut_worn.csv``. No nut was measured.

The screw of ``examples/service.toml`` turns to and fro without load, when new and after years, when 60 % of the preload
is left. The truth behind the logs is known:

- friction: the model of the case, with the preload below;
- the sensor: a zero error that drifts, white noise, and a few readings that are far off;
- oil that warms up, from another temperature on each of the two days; speeds in random order.

    python examples/make_service_logs.py            fail if the files are not what this script makes
    python examples/make_service_logs.py --write    write them

The same bytes every time.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ballscrew.cases.case_files import case_file
from ballscrew.engine.evaluation.plan import Configuration

HERE = Path(__file__).parent
PRELOAD, LEFT = 4326.0, 0.6  # N, and the share of it that is left
NOISE, DRIFT, ZERO_ERROR = 0.006, 0.01, 0.012  # N m: of one reading; over the log; at its beginning
OUTLIERS, OUTLYING = 0.01, 0.15  # share of the readings, and how far off they are, N m
SPEEDS = 10.0, 20.0, 50.0, 100.0, 200.0, 400.0, 800.0  # rpm
READINGS, STEP = 12, 2.0  # readings of a speed in one direction; s between them
WARMING = 6.0  # K over the log
RPM = 2 * np.pi / 60


class Day(NamedTuple):
    """One log."""

    file: str
    preload: float
    cold: float  # °C at its beginning
    seed: int


DAYS = Day("nut_new.csv", PRELOAD, 30.0, 2019), Day("nut_worn.csv", LEFT * PRELOAD, 38.0, 2026)


def columns(day: Day) -> dict[str, Any]:
    """The log as it is written: s, rpm, N, N m, °C."""
    random = np.random.default_rng(day.seed)
    settings = random.permutation(SPEEDS)
    speed = np.concatenate([speed * np.repeat([1.0, -1.0], READINGS) for speed in settings])
    time = STEP * np.arange(speed.size)
    share = time / time[-1]
    temperature = day.cold + WARMING * share
    case = case_file.load(HERE / "service.toml")
    true = Configuration(case.model, case.screw, case.lubricant).changed({"nut.preload": day.preload})
    load = np.zeros(speed.size)
    oil = true.lubricant.at(temperature + 273.15)
    result = true.model(true.screw, oil, axial_load=load, screw_speed=np.abs(speed) * RPM)
    torque = np.sign(speed) * result.screw_torque + ZERO_ERROR + DRIFT * share + random.normal(0, NOISE, time.size)
    wild = random.random(time.size) < OUTLIERS
    torque[wild] += random.choice([-OUTLYING, OUTLYING], np.count_nonzero(wild))
    return {
        "time [s]": time,
        "speed [rpm]": speed,
        "axial load [N]": load,
        "torque [N m]": torque,
        "temperature [degC]": temperature + random.normal(0, 0.1, time.size),
    }


def text(day: Day) -> str:
    """The file."""
    found = columns(day)
    digits = 0, 0, 0, 4, 1
    lines = [
        "# SYNTHETIC: made by examples/make_service_logs.py; no nut was measured. "
        f"True preload {day.preload:.0f} N, noise {NOISE} N m",
        ",".join(found),
    ]
    for row in zip(*(values.tolist() for values in found.values()), strict=True):
        lines.append(",".join(f"{x + 0.0:.{n}f}" for x, n in zip(row, digits, strict=True)))
    return "\n".join(lines) + "\n"


def main() -> None:
    """Compare or write."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true", help="write both logs")
    write = parser.parse_args().write
    for day in DAYS:
        path, made = HERE / day.file, text(day).encode()
        if write:
            path.write_bytes(made)
        elif path.read_bytes() != made:
            raise SystemExit(f"{path.name} is not what this script makes; --write writes it anew")


if __name__ == "__main__":
    main()
